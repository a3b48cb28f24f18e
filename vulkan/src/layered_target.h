// SPDX-License-Identifier: Apache-2.0
// An image whose layers are drawn to and read by shaders by turns, each on its own.
#pragma once

#include "device.h"

namespace gnomon::vulkan {

class LayeredTarget {
public:
    LayeredTarget() = default;
    /// A depth image if its aspect is that, else a colour image.
    LayeredTarget(Device& device, const ImageInfo& info);

    /// After reads by shaders. What the layer holds stays.
    void toAttachment(VkCommandBuffer commands, std::uint32_t layer);
    /// What was drawn is visible to shaders.
    void toReadable(VkCommandBuffer commands, std::uint32_t layer);
    /// All layers that are not; those that were never drawn hold anything.
    void makeReadable(VkCommandBuffer commands);
    /// Between two passes that draw to the same texels of a layer.
    void waitForDrawing(VkCommandBuffer commands, std::uint32_t layer) const;

    [[nodiscard]] const Image& image() const { return image_; }
    explicit operator bool() const { return static_cast<bool>(image_); }
    /// Is there room for an image of this size?
    [[nodiscard]] bool covers(VkExtent2D extent, std::uint32_t layers) const;

private:
    [[nodiscard]] bool isDepth() const { return image_.info().aspect == VK_IMAGE_ASPECT_DEPTH_BIT; }
    [[nodiscard]] ImageBarrier barrierOf(std::uint32_t layer) const;

    Device* device_ = nullptr;
    Image image_;
    std::vector<VkImageLayout> layouts_;
};

} // namespace gnomon::vulkan
