// SPDX-License-Identifier: Apache-2.0
// Based on: J. R. Frisvad, "Building an Orthonormal Basis from a 3D Unit Vector Without Normalization", 2012.
#include "light_space.h"

#include <gnomon/world_range.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace gnomon {
namespace {

constexpr double kWidestSun_rad = 1.5708;       // 90 degrees and a rounding
constexpr double kWidestHalfAngle_rad = 1.0472; // 60 degrees and a rounding
constexpr double kWidestSpot_rad = 1.5708;      // 90 degrees and a rounding

bool finite(const glm::dvec3& v)
{
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// A near distance, as a share of the reach, costs precision of depth: at the distance z a step of it is z * z / near *
/// 2^-24. At the reach that is a fifth of a texel of 512 where the near distance is a 6000th.
constexpr double kMostNear = 0.001;
constexpr double kLeastNear = 1e-5;
/// Where a caster's bounds are around the light, and do not tell how near it is.
constexpr double kNearInBounds = 0.00025;

Outcome checkPlacedLight(const Light& light)
{
    if (!finite(light.position_ws)) {
        return {OutcomeKind::degenerate, "the light's position is not finite"};
    }
    if (!std::isfinite(light.range_m) || light.range_m < 0.0) {
        return {OutcomeKind::degenerate, "the light's range is negative or not finite"};
    }
    if (!std::isfinite(light.near_m) || light.near_m < 0.0) {
        return {OutcomeKind::degenerate, "the light's near distance is negative or not finite"};
    }
    if (!std::isfinite(light.radius_m) || light.radius_m < 0.0) {
        return {OutcomeKind::degenerate, "the light's radius is negative or not finite"};
    }
    if (light.range_m > 0.0 && light.near_m >= light.range_m) {
        return {OutcomeKind::degenerate, "the light's near distance is not before its range"};
    }
    if (isTooFar(light.position_ws)) {
        return {OutcomeKind::degenerate, "the light is farther than 1e9 m from the origin"};
    }
    if (std::max(light.range_m, light.radius_m) > kFarthestPlace_m) {
        return {OutcomeKind::degenerate, "the light's range or radius is larger than 1e9 m"};
    }
    return {};
}

} // namespace

Outcome checkLight(const Light& light)
{
    if (light.type == LightType::directional) {
        if (!std::isfinite(light.angular_diameter_rad) || light.angular_diameter_rad < 0.0) {
            return {OutcomeKind::degenerate, "the light's angular diameter is negative or not finite"};
        }
        if (light.angular_diameter_rad > kWidestSun_rad) {
            return {OutcomeKind::degenerate,
                    "the light's angular diameter is more than a quarter turn; it is in radians"};
        }
    } else {
        if (const Outcome outcome = checkPlacedLight(light); outcome.kind != OutcomeKind::ok) {
            return outcome;
        }
    }
    if (light.type == LightType::point) {
        return {};
    }
    if (!finite(light.direction_ws)) {
        return {OutcomeKind::degenerate, "the light's direction is not finite"};
    }
    const double length = glm::length(light.direction_ws);
    if (!std::isfinite(length) || !(length > 1e-9)) {
        return {OutcomeKind::degenerate, "the light's direction has no length"};
    }
    if (light.type == LightType::spot) {
        if (!(light.outer_half_angle_rad > 0.0)) {
            return {OutcomeKind::degenerate, "the spot light's angle is not greater than zero"};
        }
        if (light.outer_half_angle_rad > kWidestSpot_rad) {
            return {OutcomeKind::degenerate, "the spot light is wider than 180 degrees; its angle is in radians, from "
                                             "the axis"};
        }
    }
    return {};
}

LightType layoutOf(const Light& light)
{
    const bool wide = light.type == LightType::spot && light.outer_half_angle_rad > kWidestHalfAngle_rad;
    return wide ? LightType::point : light.type;
}

bool shinesInto(const Light& light, const glm::dvec3& axis_ws, double half_angle_rad)
{
    if (light.type != LightType::spot) {
        return true;
    }
    const double between_rad = std::acos(std::clamp(glm::dot(glm::normalize(light.direction_ws), axis_ws), -1.0, 1.0));
    return between_rad < light.outer_half_angle_rad + half_angle_rad;
}

void axesAcross(const glm::dvec3& forward_ws, glm::dvec3& right_ws, glm::dvec3& up_ws)
{
    // The axes turn with the light alone, never with the camera, so that a camera that turns leaves the texels'
    // directions as they are. No field of axes is continuous all over the sphere; Frisvad's has its one flaw where we
    // put it: at a light that shines straight up. At noon, straight down, nothing jumps: right is +x and up is -z.
    const glm::dvec3 n = -forward_ws;
    const double k = 1.0 + n.y;
    right_ws = {1.0, 0.0, 0.0};
    if (k > 1e-9) {
        right_ws = {1.0 - n.x * n.x / k, -n.x, -n.x * n.z / k};
    }
    right_ws = glm::normalize(right_ws - n * glm::dot(n, right_ws));
    up_ws = glm::cross(n, right_ws);
}

LightExtent extentOf(const Light& light, const Aabb& scene_bounds_ws)
{
    if (light.type == LightType::directional) {
        return {};
    }
    LightExtent extent{.near_m = light.near_m, .reach_m = light.range_m};
    if (!(extent.reach_m > 0.0)) {
        const glm::dvec3 low = glm::abs(glm::dvec3(scene_bounds_ws.min) - light.position_ws);
        const glm::dvec3 high = glm::abs(glm::dvec3(scene_bounds_ws.max) - light.position_ws);
        extent.reach_m = std::max(glm::length(glm::max(low, high)), 2.0 * light.near_m);
        if (!(extent.reach_m > 0.0)) {
            extent.reach_m = 1.0;
        }
    }
    if (!(extent.near_m > 0.0)) {
        extent.near_m = kMostNear * extent.reach_m;
    }
    return extent;
}

double nearBefore(const Light& light, const ObjectSet& objects, std::vector<std::uint32_t>& scratch)
{
    const LightExtent extent = extentOf(light, objects.bounds());
    const double side_m = 2.0 * extent.near_m;
    const glm::dvec3& p = light.position_ws;
    scratch.clear();
    objects.query(planesAround(p - side_m, p + side_m), ObjectSet::Want::casters, scratch, light.groups);
    double nearest_m = side_m;
    double near_m = extent.near_m;
    for (const std::uint32_t object : scratch) {
        const Aabb box = objects.bounds(object);
        const double away_m = glm::distance(p, glm::clamp(p, glm::dvec3(box.min), glm::dvec3(box.max)));
        if (away_m > 0.0) {
            nearest_m = std::min(nearest_m, away_m);
        } else {
            near_m = std::min(near_m, kNearInBounds * extent.reach_m);
        }
    }
    // By powers of two: a caster that moves does not change all maps in every frame.
    const double before_m = std::exp2(std::floor(std::log2(0.5 * nearest_m)));
    return std::max(std::min(near_m, before_m), kLeastNear * extent.reach_m);
}

LightSpace lightSpaceOf(const Light& light, const glm::dvec3& axis_ws, double half_angle_rad, const Aabb& scene_ws)
{
    LightSpace space;
    space.forward_ws = axis_ws;
    space.depth_ws = axis_ws;
    axesAcross(axis_ws, space.right_ws, space.up_ws);
    if (light.type == LightType::directional) {
        return space;
    }
    space.perspective = true;
    space.origin_ws = light.position_ws;
    space.tangent = std::tan(std::min(half_angle_rad, kWidestHalfAngle_rad));
    const LightExtent extent = extentOf(light, scene_ws);
    space.near_m = extent.near_m;
    space.reach_m = extent.reach_m;
    return space;
}

} // namespace gnomon
