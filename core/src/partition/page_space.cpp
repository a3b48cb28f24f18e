// SPDX-License-Identifier: Apache-2.0
#include "partition/page_space.h"

#include "fit/projection.h"
#include "motion/steps.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace gnomon {
namespace {

/// Room for rounding, as a share of a distance along a light with a place.
constexpr double kRounding = 1e-4;

/// The row that gives a coordinate along an axis.
glm::dvec4 rowOf(const LightSpace& space, const glm::dvec3& axis)
{
    return {axis, -glm::dot(axis, space.origin_ws)};
}

/// The row that coordinates across are divided by.
glm::dvec4 divisorOf(const LightSpace& space)
{
    return space.perspective ? rowOf(space, space.depth_ws) : glm::dvec4(0.0, 0.0, 0.0, 1.0);
}

/// Depth in the square of a distance along the light.
double depthOf(const LightSpace& space, double along_m)
{
    return space.perspective ? -1.0 / along_m : along_m;
}

struct Bounds {
    glm::dvec3 low{std::numeric_limits<double>::infinity()};
    glm::dvec3 high{-std::numeric_limits<double>::infinity()};

    void add(const glm::dvec3& p)
    {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
};

/// Bounds of the image of a box as LightSpace::project() has it: of a box that reaches behind a light's near distance,
/// that of its part before it.
Bounds imageOf(const LightSpace& space, const Aabb& box)
{
    std::array<glm::dvec3, 8> corners;
    for (unsigned i = 0; i < 8; ++i) {
        corners[i] = space.coordinates(glm::dvec3(box.corner(static_cast<int>(i))));
    }
    const auto isBefore = [&](const glm::dvec3& c) {
        return !space.perspective || c.z >= space.near_m;
    };
    Bounds bounds;
    for (unsigned i = 0; i < 8; ++i) {
        const glm::dvec3& c = corners[i];
        if (isBefore(c)) {
            bounds.add(space.perspective ? glm::dvec3(c.x / c.z, c.y / c.z, c.z) : c);
        }
        for (unsigned axis = 1; axis < 8; axis *= 2) {
            const glm::dvec3& d = corners[i ^ axis];
            if (isBefore(c) && !isBefore(d)) {
                const glm::dvec3 cut = c + (d - c) * ((c.z - space.near_m) / (c.z - d.z));
                bounds.add({cut.x / space.near_m, cut.y / space.near_m, space.near_m});
            }
        }
    }
    return bounds;
}

} // namespace

PageSpace pageSpaceOf(const Light& light, const Slice& slice, const Aabb& scene_ws)
{
    PageSpace made;
    made.space = lightSpaceOf(light, slice.axis_ws, slice.half_angle_rad, scene_ws);
    made.unit = made.space.perspective && pageFaces(light) == 1 ? made.space.tangent : 1.0; // of a cube's face: 1
    return made;
}

std::uint32_t pageFaces(const Light& light)
{
    return layoutOf(light) == LightType::point ? kCubeFaces : 1;
}

std::uint32_t pageFaceAt(const Light& light, const glm::dvec3& p_ws)
{
    if (pageFaces(light) == 1) {
        return 0;
    }
    const glm::dvec3 p = p_ws - light.position_ws;
    const glm::dvec3 far = glm::abs(p);
    const int axis = far.x >= std::max(far.y, far.z) ? 0 : far.y >= far.z ? 1 : 2;
    return static_cast<std::uint32_t>(2 * axis + (p[axis] < 0.0 ? 1 : 0));
}

std::optional<PagePoint> pagePointOf(const Light& light, const PageSpace& space, const glm::dvec3& p_ws, double pixel_m)
{
    PagePoint point;
    const glm::dvec3 c = space.space.coordinates(p_ws);
    if (!space.space.perspective) {
        point.at = glm::dvec2(c);
        point.depth = c.z;
        point.pixel = pixel_m;
        return point;
    }
    const double far_m = glm::length(c);
    const double outside = std::max(std::abs(c.x), std::abs(c.y)) - space.unit * c.z;
    if (!(c.z > space.space.near_m) || !(far_m <= space.space.reach_m) || outside > 0.0) {
        return std::nullopt;
    }
    if (light.type == LightType::spot && glm::dot(glm::normalize(light.direction_ws), p_ws - light.position_ws) <
                                             std::cos(light.outer_half_angle_rad) * far_m) {
        return std::nullopt;
    }
    point.at = glm::dvec2(c) / (c.z * space.unit);
    point.depth = depthOf(space.space, c.z);
    point.pixel = pixel_m / (c.z * space.unit);
    return point;
}

std::optional<PageCaster> pageCasterOf(const PageSpace& in, std::uint32_t object, const Aabb& box)
{
    constexpr double kAlong = 1e-6; // the cosine of faces that light does not come in by
    const LightSpace& space = in.space;
    const Bounds image = imageOf(space, box);
    if (!(image.low.z <= image.high.z)) {
        return std::nullopt;
    }
    PageCaster caster;
    caster.object = object;
    caster.low = glm::dvec2(image.low) / in.unit;
    caster.high = glm::dvec2(image.high) / in.unit;
    caster.nearest = depthOf(space, image.low.z);
    for (int axis = 0; axis < 3; ++axis) {
        const double low = static_cast<double>(box.min[axis]) - space.origin_ws[axis];
        const double high = static_cast<double>(box.max[axis]) - space.origin_ws[axis];
        const double along = space.depth_ws[axis];
        const glm::dvec2 across = glm::dvec2(space.right_ws[axis], space.up_ws[axis]) * in.unit;
        caster.faces[axis] = {0.0, 0.0, caster.nearest};
        if (!space.perspective && std::abs(along) > kAlong) {
            caster.faces[axis] = glm::dvec3(-across, along > 0.0 ? low : high) / along;
        } else if (space.perspective && (low > 0.0 || high < 0.0)) {
            // A ray that leads away from it comes in beyond infinity, at a depth above 0.
            caster.faces[axis] = -glm::dvec3(across, along) / (low > 0.0 ? low : high);
        }
    }
    return caster;
}

void planesAroundPage(const PageSpace& in, const glm::dvec2& low, const glm::dvec2& high, std::vector<Plane>& out)
{
    const LightSpace& space = in.space;
    const glm::dvec4 divisor = divisorOf(space) * in.unit;
    const glm::dvec4 right = rowOf(space, space.right_ws);
    const glm::dvec4 up = rowOf(space, space.up_ws);
    out.clear();
    for (const glm::dvec4& row :
         {right - divisor * low.x, divisor * high.x - right, up - divisor * low.y, divisor * high.y - up}) {
        const double length = glm::length(glm::dvec3(row));
        out.push_back({glm::dvec3(row) / length, row.w / length});
    }
    if (space.perspective) {
        const glm::dvec4 depth = rowOf(space, space.depth_ws);
        out.push_back({glm::dvec3(depth), depth.w - space.near_m});
        out.push_back({-glm::dvec3(depth), (1.0 + kRounding) * space.reach_m - depth.w});
    }
}

DepthRange pageDepths(const PageSpace& in, const Aabb& scene_ws, std::span<const PageCaster> casters, double pad_m)
{
    const LightSpace& space = in.space;
    const glm::dvec3 centre = 0.5 * (glm::dvec3(scene_ws.min) + glm::dvec3(scene_ws.max));
    const glm::dvec3 half = 0.5 * (glm::dvec3(scene_ws.max) - glm::dvec3(scene_ws.min));
    const double middle_m = space.coordinates(centre).z;
    const double reach_m = glm::dot(glm::abs(space.depth_ws), half) + 32.0 * pad_m + kLeastRange * glm::length(half);
    if (!space.perspective) {
        const SteppedRange stepped = steppedRange(middle_m - reach_m, middle_m + reach_m);
        return {stepped.low, stepped.high};
    }
    double nearest = 0.0;
    for (const PageCaster& caster : casters) {
        nearest = std::min(nearest, caster.nearest);
    }
    // Precision of depth goes with the near distance, so it is that of the nearest caster.
    const double before_m = std::exp2(std::floor(std::log2((kRounding - 1.0) / nearest)));
    DepthRange range;
    range.near_m = std::max(space.near_m, before_m);
    const double end_m = std::min(space.reach_m, middle_m + reach_m);
    range.far_m = steppedRatio(1.0, std::max(end_m, 2.0 * range.near_m) * (1.0 + kRounding)).high;
    return range;
}

PageSpread pageSpreadOf(const Light& light, const PageSpace& space)
{
    return space.space.perspective ? PageSpread{light.radius_m / space.unit, space.unit * space.unit}
                                   : PageSpread{std::tan(0.5 * light.angular_diameter_rad), 0.0};
}

void projectPage(const PageSpace& in, const PageKey& page, std::uint32_t side, double border, View& view)
{
    const LightSpace& space = in.space;
    const DepthRange& range = in.range;
    const double length = sideOf(page) * in.unit;
    const double texel = length / (side * (1.0 - 2.0 * border));
    const glm::dvec2 centre = (lowOf(page) + 0.5 * sideOf(page)) * in.unit;
    const MapFrame frame{centre, glm::dvec2(0.5 * side * texel), glm::dvec2(texel)};
    ViewProjection& projection = view.projection;
    projection.clip_from_world = clipFromWorld(space, {}, frame, range.near_m, range.far_m);
    projection.parallel = !space.perspective;
    projection.orthographic = !space.perspective;
    projection.clamp_near = false; // the range has room for all casters
    projection.texel_m = texel;
    projection.texel_xy_m = glm::dvec2(texel);
    projection.light_reach = 0.0;
    const double place_m = space.perspective ? 0.0 : range.near_m;
    projection.light_place_ws =
        space.perspective ? space.origin_ws
                          : space.right_ws * centre.x + space.up_ws * centre.y + space.forward_ws * range.near_m;
    projection.metric.near_m = range.near_m - place_m;
    projection.metric.far_m = range.far_m - place_m;
    const glm::dvec4 from_near = rowOf(space, space.depth_ws) - glm::dvec4(0.0, 0.0, 0.0, range.near_m);
    projection.metric.metric_ws = from_near / (range.far_m - range.near_m);
    view.fit.finest_texel = glm::dvec2(texel);
    view.fit.coarsest_texel = glm::dvec2(texel);
    const glm::dvec4 divisor = divisorOf(space);
    view.serves.sector.x = (rowOf(space, space.right_ws) - divisor * centre.x) / (0.5 * length);
    view.serves.sector.y = (rowOf(space, space.up_ws) - divisor * centre.y) / (0.5 * length);
    view.serves.sector.w = divisor;
}

} // namespace gnomon
