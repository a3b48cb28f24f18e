// SPDX-License-Identifier: Apache-2.0
// An image whose layers are drawn to and read by shaders by turns, each on its own.
#pragma once

#include "barriers.h"
#include "outgrown_image.h"

namespace gnomon::vulkan {

class LayeredTarget {
public:
    LayeredTarget() = default;

    /// Makes an image, of depths if its aspect is that, else of colours. It has at least the size of the one before,
    /// whose texels it takes over at the next copyOutgrown(), and which is retired. Throws Error as Image does, and
    /// then nothing has changed.
    void grow(Device& device, ImageInfo info);
    /// Retires what copyOutgrown() has copied.
    void letGo() { outgrown_.letGo(); }
    /// To be called before anything else is recorded with an image that has grown.
    void copyOutgrown(VkCommandBuffer commands);

    /// After reads by shaders. The layer keeps its contents.
    void toAttachment(BarrierBatch& barriers, std::uint32_t layer);
    /// Makes drawing visible to shaders.
    void toReadable(BarrierBatch& barriers, std::uint32_t layer);
    /// All layers that are not; those that were never drawn hold anything.
    void makeReadable(BarrierBatch& barriers);
    /// Between two passes that draw to the same texels of a layer.
    void waitForDrawing(BarrierBatch& barriers, std::uint32_t layer) const;

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
    OutgrownImage outgrown_;
};

} // namespace gnomon::vulkan
