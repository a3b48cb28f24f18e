// SPDX-License-Identifier: Apache-2.0
// An image that a larger one has taken the place of, until its texels have been copied there.
#pragma once

#include "device.h"

namespace gnomon::vulkan {

class OutgrownImage {
public:
    /// `layouts`: each layer's, UNDEFINED where nothing was ever drawn. Where two are given before any copy, the first
    /// one has the texels: the second one was to be copied to itself.
    void take(Device& device, Image&& image, std::vector<VkImageLayout> layouts);
    /// Is there anything to copy?
    [[nodiscard]] explicit operator bool() const { return image_ && !copied_; }
    /// Did the layer hold anything?
    [[nodiscard]] bool holds(std::uint32_t layer) const
    {
        return layer < layouts_.size() && layouts_[layer] != VK_IMAGE_LAYOUT_UNDEFINED;
    }
    /// All layers that held anything, and as many mip levels as both have. `to` is in `layout`, TRANSFER_DST_OPTIMAL or
    /// GENERAL, and written by nobody else until then; afterwards its writes by ALL_TRANSFER are to be waited for.
    void copyTo(VkCommandBuffer commands, const Image& to, VkImageLayout layout);
    /// Its texels are not needed.
    void drop();
    /// Retires it if it has been copied. Not for copyTo() to do: while commands are recorded nothing is allocated, and
    /// retiring takes memory for a note.
    void letGo();

private:
    Device* device_ = nullptr;
    Image image_;
    std::vector<VkImageLayout> layouts_;
    bool copied_ = false;
};

} // namespace gnomon::vulkan
