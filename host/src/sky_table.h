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
    /// With room for each frame in flight to bring its own. Throws Error.
    SkyTable(SceneData& scene, Memory& memory, std::size_t slots);

    /// What a physical frame needs that is not there yet: true when there is something to record. The GPU has finished
    /// the slot's last frame.
    [[nodiscard]] bool bring(std::uint32_t slot, const FrameLight& light);
    /// Before anything reads them, outside rendering. Frames before this one have what they need: the queue is one.
    void record(VkCommandBuffer cmd, std::uint32_t slot);
    /// A frame was recorded and not submitted: nobody knows what is there.
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
