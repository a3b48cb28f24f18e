// SPDX-License-Identifier: Apache-2.0
// One rectangle around all of the scene, made once (core/src/scene_memory.h): no camera moves it.
// Based on: A. Marinescu, "Achieving real-time soft shadows using LVSM in an RTS game", 2011, section 4: the matrices
// are made when the map is loaded, of a box around its geometry, and
//   LightPos = 1/8 sum of the box's corners - LightDir * Distance   (6)
// with a distance by which floating casters are in front, too. We take the least such distance.
#include "fit/scene.h"

#include "fit/fit.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>

namespace gnomon {
namespace {

/// Share of the farthest coordinate that single precision may be off by, on all sides.
constexpr double kRounding = 1e-6;
/// Share of the range of depth that is added at its ends.
constexpr double kMargin = 1e-4;

glm::dvec3 centreOf(const Aabb& box)
{
    return glm::dvec3(box.min) * 0.5 + glm::dvec3(box.max) * 0.5;
}
glm::dvec3 halfOf(const Aabb& box)
{
    return glm::dvec3(box.max) * 0.5 - glm::dvec3(box.min) * 0.5;
}
double roundingOf(const Aabb& box)
{
    const glm::dvec3 farthest = glm::max(glm::abs(glm::dvec3(box.min)), glm::abs(glm::dvec3(box.max)));
    return kRounding * std::max({farthest.x, farthest.y, farthest.z});
}

} // namespace

Warp fitScene(const FitInput& /*input*/)
{
    return {};
}

LightRect rectOfScene(const LightSpace& space, const Aabb& scene_ws)
{
    const glm::dvec2 at(space.coordinates(centreOf(scene_ws)));
    const glm::dvec3 half = halfOf(scene_ws);
    const glm::dvec2 reach(glm::dot(glm::abs(space.right_ws), half), glm::dot(glm::abs(space.up_ws), half));
    const double more = roundingOf(scene_ws);
    return {at - reach - more, at + reach + more};
}

SceneDepths depthsOfScene(const LightSpace& space, const Aabb& scene_ws, double least_m)
{
    const double at = space.coordinates(centreOf(scene_ws)).z;
    const double reach = glm::dot(glm::abs(space.depth_ws), halfOf(scene_ws));
    const double rounding = roundingOf(scene_ws) * glm::length(space.depth_ws);
    const double more = 2.0 * kMargin * reach + rounding;
    const double near_m = at - reach - more;
    return {near_m, std::max(at + reach + more, near_m + std::max({least_m, 16.0 * rounding, 1e-6}))};
}

glm::dvec3 lightPlaceOfScene(const LightSpace& space, const Aabb& scene_ws, double near_m)
{
    const glm::dvec3 centre_ws = centreOf(scene_ws);
    return centre_ws - space.forward_ws * (space.coordinates(centre_ws).z - near_m); // (6)
}

} // namespace gnomon
