// SPDX-License-Identifier: Apache-2.0
// Pixels of a mask's layer that are done, told from those that a draw left to the next one: an image of depths, as
// large as the mask, that serves one layer after the other. A draw marks what it does not discard with a depth that is
// less than those of the draws before it, and the draw of what it left passes where there is a greater one.
#pragma once

#include "device.h"

namespace gnomon::vulkan {

class MaskMarks {
public:
    static constexpr VkFormat kFormat = VK_FORMAT_D16_UNORM; // any device draws to it
    /// The most draws of a layer that leave pixels.
    static constexpr std::uint32_t kMostDraws = 32766;

    /// The state of draws that mark what they draw.
    [[nodiscard]] static VkPipelineDepthStencilStateCreateInfo marking();
    /// The state of draws of what was left.
    [[nodiscard]] static VkPipelineDepthStencilStateCreateInfo whereLeft();
    /// The viewport of the layer's draw `i`, less than kMostDraws, that marks what it draws, or of what that one left.
    [[nodiscard]] static VkViewport viewport(VkExtent2D extent, std::uint32_t i, bool left);

    /// Makes the image for masks of this size, if the one that is there does not fit.
    void prepare(Device& device, VkExtent2D extent);
    /// Is it there?
    [[nodiscard]] bool holds(VkExtent2D extent) const;
    /// Begins rendering to a layer of `target`. `keeps`: what this frame has drawn to it; else it is cleared to 1.
    void begin(const Device& device, VkCommandBuffer commands, const Image& target, std::uint32_t layer,
               bool keeps) const;

private:
    Image image_;
};

} // namespace gnomon::vulkan
