// SPDX-License-Identifier: Apache-2.0
#include "fit/projection.h"

#include <glm/common.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <limits>

namespace gnomon {
namespace {

glm::dvec2 mapPoint(const Warp& warp, const glm::dvec2& q)
{
    const double w = warp.wAt(q);
    return {(glm::dot(warp.across(), q) - warp.upright) / w, (glm::dot(warp.along, q) - warp.nearest) / w};
}

} // namespace

double usableBorder(double border_texels, std::uint32_t map_size)
{
    return std::min(border_texels, 0.25 * static_cast<double>(map_size));
}

double borderShare(double border_texels, std::uint32_t map_size)
{
    const double border = usableBorder(border_texels, map_size);
    return border / (static_cast<double>(map_size) - 2.0 * border);
}

double strongestWarp(double border_texels, std::uint32_t map_size)
{
    // Numbers in single precision are good for more, but no picture is: a texel would be a million times as long as
    // another.
    constexpr double kStrongest = 1000.0;
    // With r the border's share of the rest, 1/w falls from 1 to 1/W over the rest, and by (1 - 1/W) r beyond it:
    // to 1/(2 W) where (W - 1) r = 1/2.
    const double share = borderShare(border_texels, map_size);
    return share > 0.0 ? std::min(kStrongest, 1.0 + 0.5 / share) : kStrongest;
}

LightRect rectOf(const Warp& warp, std::span<const glm::dvec2> outline)
{
    LightRect rect{glm::dvec2(std::numeric_limits<double>::infinity()),
                   glm::dvec2(-std::numeric_limits<double>::infinity())};
    for (const glm::dvec2& q : outline) {
        const glm::dvec2 p = mapPoint(warp, q);
        rect.low = glm::min(rect.low, p);
        rect.high = glm::max(rect.high, p);
    }
    return rect;
}

MapFrame frameOf(const LightRect& rect, double least_size, std::uint32_t map_size, double border_texels)
{
    const double border = usableBorder(border_texels, map_size);
    const double texels = static_cast<double>(map_size);
    // size + 2 * border * texel spread over all texels, with texel = size / (texels - 2 * border).
    const glm::dvec2 size = glm::max(rect.high - rect.low, glm::dvec2(least_size));
    MapFrame frame;
    frame.centre = (rect.high + rect.low) * 0.5;
    frame.texel = size / (texels - 2.0 * border);
    frame.half = frame.texel * texels * 0.5;
    return frame;
}

FitReport reportOf(const Warp& warp, const MapFrame& frame, std::span<const glm::dvec2> outline)
{
    FitReport report;
    report.finest_texel = frame.texel;
    report.coarsest_texel = frame.texel;
    if (!warp.warped()) {
        return report;
    }
    for (const glm::dvec2& q : outline) {
        const double w = warp.wAt(q);
        report.strength = std::max(report.strength, w);
        // dq per dx is w across(); per dy it is w^2 along + w (b - upright) / n across().
        const double turned = std::abs(glm::dot(warp.across(), q) - warp.upright) / warp.n;
        const glm::dvec2 texel = frame.texel * glm::dvec2(w, w * std::sqrt(w * w + turned * turned));
        report.coarsest_texel = glm::max(report.coarsest_texel, texel);
    }
    return report;
}

double borderReach(const Warp& warp, const FitReport& report, double border_texels, std::uint32_t map_size)
{
    const double texels = usableBorder(border_texels, map_size) + 1.0;
    const glm::dvec2 texel = report.coarsest_texel;
    if (!warp.warped()) {
        return texels * std::max(texel.x, texel.y);
    }
    // A step dy from w leads to w', 1/w' = 1/w - dy/n, and as far as w'/w steps of its first size. So much 1/w falls
    // over the border of the far side at most, as strongestWarp() has it. Sheared texels may have both sides one way.
    const double fallen = (report.strength - 1.0) * borderShare(border_texels + 1.0, map_size);
    return texels * (texel.x + texel.y) / (1.0 - std::min(fallen, 0.75));
}

glm::dmat4 clipFromWorld(const LightSpace& space, const Warp& warp, const MapFrame& frame, double near_m, double far_m)
{
    // Rows that measure across and along the warp, and depth. A light with a place divides by depth, so whatever is
    // constant in the plane across the light is in proportion to depth in the world.
    const auto row = [&](const glm::dvec3& axis) {
        return glm::dvec4(axis, -glm::dot(axis, space.origin_ws));
    };
    const auto inPlane = [&](const glm::dvec2& q) {
        return row(space.right_ws * q.x + space.up_ws * q.y);
    };
    const glm::dvec4 one(0.0, 0.0, 0.0, 1.0);
    const glm::dvec4 depth = row(space.depth_ws);
    const glm::dvec4 constant = space.perspective ? depth : one;
    const glm::dvec4 s = inPlane(warp.along) - constant * warp.nearest;
    const glm::dvec4 w = warp.warped() ? constant + s / warp.n : constant;
    const double length = far_m - near_m;
    // Its share of w is constant along a ray of light, and at least 1: so z grows along the ray, and is in [0, w].
    const glm::dvec4 z =
        space.perspective ? (depth - one * near_m) * (far_m / length) : (depth - one * near_m) / length;
    const glm::dvec4 x = inPlane(warp.across()) - constant * warp.upright;
    // y is down in a Vulkan framebuffer.
    const glm::dmat4 rows((x - w * frame.centre.x) / frame.half.x, -(s - w * frame.centre.y) / frame.half.y, z, w);
    return glm::transpose(rows);
}

} // namespace gnomon
