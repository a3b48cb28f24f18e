// SPDX-License-Identifier: Apache-2.0
// Depths of what stands still, from which those of a filterable map start when something moves.
#pragma once

#include "draw_view.h"

namespace gnomon::vulkan {

/// Viewport and scissor are set to the tile.
void beginDepthRendering(const Device& device, VkCommandBuffer commands, const Tile& tile, VkImageView depth,
                         VkAttachmentLoadOp load);

class KeptDepth {
public:
    KeptDepth() = default;
    /// Like `working`, the image that maps are drawn in, with layers of its own.
    KeptDepth(Device& device, ImageInfo working, std::uint32_t layers);

    [[nodiscard]] std::uint32_t layers() const { return static_cast<std::uint32_t>(layouts_.size()); }
    /// What stands still into the view's layer.
    void draw(VkCommandBuffer commands, const Plan& plan, std::uint32_t view, const DrawCasters& draw);
    /// From there to the one layer of `working`, all of the tile; then casters can be drawn over it. Whatever was
    /// there, compute shaders alone have read it.
    void restore(VkCommandBuffer commands, const View& view, const Image& working) const;

private:
    Device* device_ = nullptr;
    Image image_;
    std::vector<VkImageLayout> layouts_;
};

} // namespace gnomon::vulkan
