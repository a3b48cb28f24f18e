// SPDX-License-Identifier: Apache-2.0
// A map that stands still under a moving camera: its size depends on neither where the camera is nor where it looks,
// and it moves by whole texels. So the centres of its texels are the same points of the world in every frame.
// Based on: M. Valient, "Stable Rendering of Cascaded Shadow Maps", ShaderX6, 2008 (the sphere around a slice of the
// view); "Common Techniques to Improve Shadow Depth Maps", Microsoft, 2010 (moving the light in texel-sized
// increments).
#include "light_reach.h"
#include "motion/motion.h"
#include "motion/steps.h"

#include <glm/common.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace gnomon {
namespace {

struct Sphere {
    glm::dvec3 centre_ws{0.0};
    double radius_m = 0.0;
};

/// The points where the picture's corners are at a depth of the view.
std::array<glm::dvec3, 4> cornersAt(const Camera& camera, const CameraView& view, double depth_m)
{
    // Relative to the eye, so that what should not depend on its place does not, up to rounding.
    glm::dmat4 clip_from_eye = view.clip_from_world;
    clip_from_eye[3] = view.clip_from_world * glm::dvec4(camera.eye_ws, 1.0);
    const glm::dmat4 eye_from_clip = glm::inverse(clip_from_eye);
    std::array<glm::dvec3, 4> corners;
    for (int i = 0; i < 4; ++i) {
        const auto at = [&](double z) {
            const glm::dvec4 h =
                eye_from_clip * glm::dvec4((i & 1) != 0 ? 1.0 : -1.0, (i & 2) != 0 ? 1.0 : -1.0, z, 1.0);
            return glm::dvec3(h) / h.w;
        };
        const glm::dvec3 a = at(0.25);
        const glm::dvec3 b = at(0.75);
        const double depth_a = glm::dot(view.forward_ws, a);
        const double depth_b = glm::dot(view.forward_ws, b);
        corners[i] = a + (b - a) * ((depth_m - depth_a) / (depth_b - depth_a));
    }
    return corners;
}

/// Around the slice of the view between two depths, its centre on the middle of the view.
Sphere sphereAround(const Camera& camera, const CameraView& view, double begin_m, double end_m)
{
    const auto near_corners = cornersAt(camera, view, begin_m);
    const auto far_corners = cornersAt(camera, view, end_m);
    const auto middle = [](const std::array<glm::dvec3, 4>& c) {
        return (c[0] + c[1] + c[2] + c[3]) * 0.25;
    };
    const glm::dvec3 a = middle(near_corners);
    const glm::dvec3 b = middle(far_corners);
    const double length = glm::distance(a, b);
    const double near_reach = glm::distance(near_corners[0], a);
    const double far_reach = glm::distance(far_corners[0], b);
    // As far from the near corners as from the far ones, if that is before the far end.
    const double t = (length * length + far_reach * far_reach - near_reach * near_reach) / (2.0 * length);
    const glm::dvec3 centre = a + (b - a) * std::clamp(t / length, 0.0, 1.0);
    double radius_m = 0.0;
    for (int i = 0; i < 4; ++i) {
        radius_m = std::max({radius_m, glm::distance(near_corners[i], centre), glm::distance(far_corners[i], centre)});
    }
    return {camera.eye_ws + centre, radius_m};
}

/// The rectangle of the scene across the light.
LightRect sceneRect(const LightSpace& space, const Aabb& scene_ws)
{
    const glm::dvec3 centre = glm::dvec3(scene_ws.min) * 0.5 + glm::dvec3(scene_ws.max) * 0.5;
    const glm::dvec3 half = glm::dvec3(scene_ws.max) * 0.5 - glm::dvec3(scene_ws.min) * 0.5;
    const glm::dvec2 at(space.coordinates(centre));
    const glm::dvec2 reach(glm::dot(glm::abs(space.right_ws), half), glm::dot(glm::abs(space.up_ws), half));
    return {at - reach, at + reach};
}

/// A map whose texels' size others hold: it pans over them, around what is wanted.
MapFrame panned(const LightRect& wanted, double texel, std::uint32_t map_size)
{
    MapFrame frame;
    frame.texel = glm::dvec2(texel);
    frame.half = frame.texel * (0.5 * map_size);
    const glm::dvec2 low = (wanted.low + wanted.high) * 0.5 - frame.half;
    frame.centre = glm::round(low / texel) * texel + frame.half;
    return frame;
}

} // namespace

MapFrame moveInTexels(const LightRect& wanted, const MotionInput& input)
{
    if (input.slice.texel > 0.0) {
        return panned(wanted, input.slice.texel, input.map_size);
    }
    // Without the border, and a texel less: that much the map may be off its place.
    const double texels = static_cast<double>(input.map_size) - 2.0 * input.border_texels - 1.0;
    MapFrame frame;
    glm::dvec2 centre(0.0);
    glm::dvec2 size(0.0);
    if (input.space.perspective) {
        size = glm::dvec2(2.0 *
                          (input.space.tangent + affordableReach(input.light_reach, glm::dvec2(input.space.tangent))));
    } else {
        const Sphere sphere =
            sphereAround(input.camera, input.view, std::max(input.slice.depth.begin_m, input.view.near_m),
                         std::min(input.slice.depth.end_m, input.view.far_m));
        const LightRect scene = sceneRect(input.space, input.view.scene_ws);
        const glm::dvec2 sphere_centre(input.space.coordinates(sphere.centre_ws));
        for (int axis = 0; axis < 2; ++axis) {
            const double reach = affordableReach(input.light_reach, glm::dvec2(2.0 * sphere.radius_m));
            const double around_view = 2.0 * (sphere.radius_m + reach + input.view.pad_m);
            const double around_scene = scene.high[axis] - scene.low[axis] + 2.0 * input.view.pad_m;
            // A scene that is smaller than the view's reach is shown whole, and the map stands still for good.
            const bool whole = around_scene <= around_view;
            size[axis] = steppedUp(std::max(whole ? around_scene : around_view, input.least_size));
            centre[axis] = whole ? (scene.low[axis] + scene.high[axis]) * 0.5 : sphere_centre[axis];
        }
    }
    frame.texel = size / texels;
    frame.half = frame.texel * (0.5 * static_cast<double>(input.map_size));
    frame.centre = glm::round(centre / frame.texel) * frame.texel;
    return frame;
}

} // namespace gnomon
