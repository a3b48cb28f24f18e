// SPDX-License-Identifier: Apache-2.0
// The tables of the sky's bodies on the GPU: an array of images, two for each body.
#pragma once

#include "daylight.h"
#include "memory.h"
#include "scene_data.h"

#include <vector>

namespace gnomon::host {

class SkyTable {
public:
    /// Makes room for each frame in flight to bring its own tables. Throws Error.
    SkyTable(SceneData& scene, Memory& memory, std::size_t slots);

    /// Prepares the tables that a physical frame needs and that are not there yet; true when there is something to
    /// record. Precondition: the GPU has finished the slot's last frame.
    [[nodiscard]] bool bring(std::uint32_t slot, const FrameLight& light);
    /// Copies the tables, outside rendering, before anything reads them. Frames share one queue, so earlier ones keep
    /// their tables.
    void record(VkCommandBuffer cmd, std::uint32_t slot);
    /// To be called when a frame was recorded and not submitted: the tables on the GPU are then unknown.
    void forget()
    {
        versions_ = {};
        ever_ = false;
    }
    [[nodiscard]] VkDescriptorImageInfo descriptor() const;

private:
    VkSampler sampler_;
    Image image_;
    std::vector<Buffer> staging_; // by slot
    std::array<std::uint64_t, kSkyBodies> versions_{};
    std::array<bool, kSkyBodies> fresh_{}; // to be copied by this frame
    bool ever_ = false;
};

} // namespace gnomon::host
