// SPDX-License-Identifier: Apache-2.0
// All of a FrameRenderer that depends on the picture's size.
#pragma once

#include "bloom.h"
#include "occlusion.h"
#include "scene_data.h"
#include "targets.h"

#include <optional>

namespace gnomon::host {

/// The size that is drawn: the picture's, or twice that on each side with supersampling.
[[nodiscard]] VkExtent2D drawnExtent(const RenderOptions& options);

/// Frames that the GPU has not finished share one, so it lives until the last of them is done.
class Screen {
public:
    /// `frame_data`: the uniform buffer of each slot. `sky_tables`: any array where there are none. Throws Error for
    /// sizes and options beyond their range or the device's limits, or when memory runs out.
    Screen(SceneData& scene, const RenderOptions& options, std::span<const Buffer> frame_data,
           const VkDescriptorImageInfo& sky_tables);
    ~Screen() = default;
    Screen(const Screen&) = delete;
    Screen& operator=(const Screen&) = delete;

    /// The set 0 of a slot's frame, with this mask; the scene's cookies stand in for none. The GPU has finished the
    /// slot's last frame.
    [[nodiscard]] VkDescriptorSet frameSet(std::uint32_t slot, VkImageView mask) const;
    /// Makes the images that a frame of deferred shading draws to. Throws Error.
    void needGBuffer(const GBufferFormats& formats, const GBufferShape& shape)
    {
        targets.needGBuffer(memory_, formats, shape);
    }
    /// Makes the images of ambient occlusion. Throws Error.
    void needOcclusion();
    /// An image for `masks_instead`, with at least `layers` layers.
    [[nodiscard]] const Image& insteadFor(std::uint32_t layers);
    [[nodiscard]] const std::vector<vulkan::MemoryUse>& memory() const { return memory_.uses(); }

private:
    SceneData& scene_;
    Memory memory_;

public:
    Targets targets;
    std::optional<Bloom> bloom;
    std::optional<Occlusion> occlusion;
    VkPipeline tone = VK_NULL_HANDLE;
    VkPipeline fxaa = VK_NULL_HANDLE; // null without it

private:
    void makeSets(std::span<const Buffer> frame_data, const VkDescriptorImageInfo& sky_tables);

    Image instead_;
    OwnedDescriptorPool pool_;
    std::vector<VkDescriptorSet> sets_; // by slot
};

} // namespace gnomon::host
