// SPDX-License-Identifier: Apache-2.0
// Depths of what stands still, from which those of a filterable map start when something moves.
#pragma once

#include "draw_view.h"
#include "outgrown_image.h"

namespace gnomon::vulkan {

/// Viewport and scissor are set to the tile.
void beginDepthRendering(const Device& device, VkCommandBuffer commands, const Tile& tile, VkImageView depth,
                         VkAttachmentLoadOp load);

class KeptDepth {
public:
    explicit KeptDepth(Device& device) : device_(device) {}

    /// Is there room for layers of this size?
    [[nodiscard]] bool covers(VkExtent2D extent, std::uint32_t layers) const;
    /// Makes an image with at least `layers` layers of this size. It takes over what the one before holds at the next
    /// copyOutgrown().
    void grow(VkFormat format, VkSampleCountFlagBits samples, VkExtent2D extent, std::uint32_t layers);
    /// Retires what copyOutgrown() has copied.
    void letGo() { outgrown_.letGo(); }
    /// To be called before anything else is recorded with an image that has grown.
    void copyOutgrown(VkCommandBuffer commands);
    /// Draws the still casters into the view's layer.
    void draw(const MapJob& job, std::uint32_t view);
    /// Copies all of the tile from there to the first texels of the single layer of `working`; then casters can be
    /// drawn over it. Only compute shaders have read the old contents of `working`.
    void restore(VkCommandBuffer commands, const View& view, const Image& working) const;

private:
    Device& device_;
    Image image_;
    std::vector<VkImageLayout> layouts_;
    OutgrownImage outgrown_;
};

} // namespace gnomon::vulkan
