// SPDX-License-Identifier: Apache-2.0
// What a screen pass made of the mask in the frame before, and where that frame saw it from: for passes that join
// frames. Two sets of images take turns. A pass writes visibility and distances of this frame and reads those of the
// one before.
#pragma once

#include "device.h"

#include <glm/vec4.hpp>

#include <array>

namespace gnomon::vulkan {

/// Takes a point relative to this frame's eye to the frame before: shaders/lib/reprojection.glsl.
struct Reprojection {
    glm::vec4 x; // rows of that frame's pixel, homogeneous
    glm::vec4 y;
    glm::vec4 w;
    glm::vec4 eye; // xyz: this frame's eye as seen from that one's, metres; w is free
};

class MaskHistory {
public:
    struct Images {
        Image visibility; // as the mask
        Image distances;  // R32_SFLOAT: from the eye, metres; 0: no surface
    };

    explicit MaskHistory(Device& device) : device_(device) {}

    /// Makes images like the mask if those that are there are not; true when it did. Then nothing is known of the frame
    /// before.
    bool prepare(const ImageInfo& mask);
    /// Which of the two sets is this frame's: 0 or 1.
    [[nodiscard]] std::size_t turn() const { return turn_; }
    [[nodiscard]] const Images& now() const { return images_[turn_]; }
    [[nodiscard]] const Images& before() const { return images_[1 - turn_]; }
    [[nodiscard]] static constexpr VkFormat distanceFormat() { return VK_FORMAT_R32_SFLOAT; }

    /// Brings this frame's distances into COLOR_ATTACHMENT_OPTIMAL, and what the frame before would have left, if there
    /// was none, into SHADER_READ_ONLY_OPTIMAL.
    void begin(VkCommandBuffer commands);
    /// Makes this frame's distances readable by fragment shaders, and this frame the one before.
    void end(VkCommandBuffer commands, const Frame& frame);
    /// From this frame to the one before, in pixels of the mask. Of use from the second frame on.
    [[nodiscard]] Reprojection reprojection(const Frame& frame) const;

private:
    Device& device_;
    std::array<Images, 2> images_;
    std::size_t turn_ = 0;
    Camera camera_;     // of the frame before
    bool fresh_ = true; // there is none
};

} // namespace gnomon::vulkan
