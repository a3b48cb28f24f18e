// SPDX-License-Identifier: Apache-2.0
// The mask that a screen pass made in the last frame, and the camera of that frame: for passes that join frames. Two
// sets of images take turns. A pass writes visibility and distances of this frame and reads those of the one before.
#pragma once

#include "device.h"

#include <glm/vec4.hpp>

#include <array>
#include <span>

namespace gnomon::vulkan {

/// Takes a point relative to this frame's eye to the frame before: gnomon/lib/reprojection.glsl.
struct Reprojection {
    glm::vec4 x; // rows of that frame's pixel, homogeneous
    glm::vec4 y;
    glm::vec4 w;
    glm::vec4 eye; // xyz: this frame's eye as seen from that one's, metres; w is free
};

/// A light's place in the mask. The last frame's mask has another light there if this one was elsewhere.
struct MaskPlace {
    std::uint32_t layer = 0;
    std::uint32_t channels = 0; // maskChannelsOf()

    bool operator==(const MaskPlace&) const = default;
};
[[nodiscard]] MaskPlace maskPlaceOf(const LightPlan& light);

class MaskHistory {
public:
    struct Images {
        Image visibility;
        Image surfaces; // the seen surfaces, so that another frame can tell whether it sees the same
    };
    /// The images that a pass keeps.
    struct Kind {
        VkFormat surfaces = VK_FORMAT_UNDEFINED;
        bool makes_visibility = false; // the pass itself writes it, else the pass that draws the mask
        bool precise = false;          // visibility in half floats, else in the mask's format
    };

    MaskHistory(Device& device, const Kind& kind) : device_(device), kind_(kind) {}

    /// Makes images like the mask if those that are there are not; true when it did. Then nothing is known of the frame
    /// before.
    bool prepare(const ImageInfo& mask);
    /// Which of the two sets is this frame's: 0 or 1.
    [[nodiscard]] std::size_t turn() const { return turn_; }
    [[nodiscard]] const Images& now() const { return images_[turn_]; }
    [[nodiscard]] const Images& before() const { return images_[1 - turn_]; }
    /// The format of visibility that is kept for such masks.
    [[nodiscard]] static VkFormat visibilityFormat(const Kind& kind, VkFormat mask);

    /// Brings this frame's images into COLOR_ATTACHMENT_OPTIMAL. If there was no last frame, brings its images into
    /// SHADER_READ_ONLY_OPTIMAL.
    void begin(VkCommandBuffer commands);
    /// Makes what the pass wrote readable by fragment shaders, and this frame the one before.
    void end(VkCommandBuffer commands, const Plan& plan);
    /// After begin(), instead of end(): what the pass wrote is of no use, and the frame before stays what it is.
    void drop() { fresh_ = false; }
    /// From this frame to the last one, in pixels of the mask, as if neither camera were jittered. Valid from the
    /// second frame on, as is stands().
    [[nodiscard]] Reprojection reprojection(const Plan& plan) const;
    /// Is the camera, apart from its jitter, where it was?
    [[nodiscard]] bool stands(const Plan& plan) const;

private:
    [[nodiscard]] std::array<const Image*, 2> written(const Images& images) const;

    Device& device_;
    Kind kind_;
    std::array<Images, 2> images_;
    std::size_t turn_ = 0;
    Camera camera_;     // the last frame's
    bool fresh_ = true; // there is none
};

/// Begins the drawing of one layer of a mask that is joined with the frame before. `targets`, at most three: of the
/// mask and of what the next frame needs, in COLOR_ATTACHMENT_OPTIMAL and all of `extent`, every texel of which is to
/// be written.
void beginJoining(const Device& device, VkCommandBuffer commands, VkExtent2D extent,
                  std::span<const VkImageView> targets);

} // namespace gnomon::vulkan
