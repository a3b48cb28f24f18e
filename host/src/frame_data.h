// SPDX-License-Identifier: Apache-2.0
// The uniform buffer of a frame, and what it is made from: camera, lights, exposure, sky.
#pragma once

#include "daylight.h"

#include "host/view.h"

#include <glm/mat4x4.hpp>

#include <array>
#include <span>

namespace gnomon::host {

/// Laid out as in host/shaders/frame.glsl (std140).
struct LightData {
    glm::vec4 place;
    glm::vec4 colour;
    glm::vec4 axis;
    glm::vec4 cone;
    glm::vec4 right;
};
struct FrameData {
    glm::mat4 clip_from_eye;
    glm::vec4 ray_x;
    glm::vec4 ray_y;
    glm::vec4 ray_0;
    glm::vec4 depth;
    std::array<glm::vec4, 7> skylight;
    std::array<glm::vec4, 7> sky;
    glm::uvec4 counts;
    std::array<LightData, kMaxLights> lights;
};
static_assert(sizeof(FrameData) == 64 + 18 * 16 + 16 + kMaxLights * 80);

/// An Eye with its axes and distances computed.
struct Sight {
    glm::dvec3 eye_ws;
    glm::dvec3 right_ws;
    glm::dvec3 up_ws;
    glm::dvec3 forward_ws;
    bool orthographic = false;
    double half_x = 1.0; // half the picture's width: metres, or of a perspective one metres at 1 m
    double half_y = 1.0;
    double near_m = 0.1;
    double far_m = 100.0;
    glm::dvec2 jitter{0.0}; // how far the picture is moved, of clip space's [-1, 1]
};
/// Throws Error when position and target are the same or up is along the view.
[[nodiscard]] Sight sightOf(const Eye& eye, std::uint32_t width, std::uint32_t height, const Aabb& scene_bounds_ws);
/// Reversed z, y down, about the eye.
[[nodiscard]] glm::dmat4 clipFromEye(const Sight& sight);
/// The camera of a picture of `drawn_px` pixels.
[[nodiscard]] Camera cameraOf(const Sight& sight, const glm::dvec2& drawn_px);

/// LightData::right.w: the place of a light's mask.
[[nodiscard]] float maskSlot(std::uint32_t layer, std::uint32_t channel, bool coloured);

/// Fills everything but the lights' cookie layers and mask slots from the arguments; `cookie_layers` has one per light.
void fillFrameData(FrameData& data, const Sight& sight, std::uint32_t width, std::uint32_t height,
                   std::span<const ShadedLight> lights, std::span<const int> cookie_layers, const FrameLight& light,
                   bool has_mask);

} // namespace gnomon::host
