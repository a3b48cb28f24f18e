// SPDX-License-Identifier: Apache-2.0
#include <gnomon/pack/light_lists.h>

#include "reach_cells.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace gnomon::pack {
namespace {

/// Corners of a convex body.
struct Hull {
    std::array<glm::dvec3, 8> points{};
    std::size_t count = 0;

    void add(const glm::dvec3& p) { points[count++] = p; }
};

/// A pyramid around the cone: its base stands at the light's reach, around the circle there.
Hull hullOfSpot(const Light& light, double reach_m)
{
    const glm::dvec3 axis = glm::normalize(light.direction_ws);
    const glm::dvec3 other = std::abs(axis.y) < 0.9 ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(1.0, 0.0, 0.0);
    const glm::dvec3 right = glm::normalize(glm::cross(axis, other));
    const glm::dvec3 up = glm::cross(right, axis);
    const double half_m = reach_m * std::tan(light.outer_half_angle_rad);
    Hull hull;
    hull.add(light.position_ws);
    for (const double x : {-half_m, half_m}) {
        for (const double y : {-half_m, half_m}) {
            hull.add(light.position_ws + axis * reach_m + right * x + up * y);
        }
    }
    return hull;
}

Hull hullOfPoint(const Light& light, double reach_m)
{
    Hull hull;
    for (int i = 0; i < 8; ++i) {
        const glm::dvec3 corner((i & 1) != 0 ? 1.0 : -1.0, (i & 2) != 0 ? 1.0 : -1.0, (i & 4) != 0 ? 1.0 : -1.0);
        hull.add(light.position_ws + corner * reach_m);
    }
    return hull;
}

class Bounds {
public:
    void add(const glm::dvec4& clip)
    {
        low_ = glm::min(low_, glm::dvec2(clip) / clip.w);
        high_ = glm::max(high_, glm::dvec2(clip) / clip.w);
    }
    [[nodiscard]] ScreenBounds inPixels(glm::uvec2 size_px) const
    {
        const auto pixel = [](double ndc, std::uint32_t size, double more) {
            const double at = (0.5 * ndc + 0.5) * size + more;
            // Nothing for a camera with NaN.
            return at > 0.0 ? static_cast<std::uint32_t>(std::min(at, static_cast<double>(size))) : 0U;
        };
        if (low_.x > high_.x) {
            return {};
        }
        return {pixel(low_.x, size_px.x, -1.0), pixel(low_.y, size_px.y, -1.0), pixel(high_.x, size_px.x, 2.0),
                pixel(high_.y, size_px.y, 2.0)};
    }

private:
    glm::dvec2 low_{1e300};
    glm::dvec2 high_{-1e300};
};

/// The bounds of the hull's part before the eye's plane, w >= `least`: the hull of its points there and of the places
/// where lines between any two of its points pierce the plane. A projection keeps hulls there.
Bounds projectedBounds(const Hull& hull, const glm::dmat4& clip_from_world)
{
    std::array<glm::dvec4, 8> clip{};
    double greatest = 0.0;
    for (std::size_t i = 0; i < hull.count; ++i) {
        clip[i] = clip_from_world * glm::dvec4(hull.points[i], 1.0);
        greatest = std::max(greatest, std::abs(clip[i].w));
    }
    // Nearer than any near plane that single precision has a use for.
    const double least = 1e-9 * greatest;
    Bounds bounds;
    for (std::size_t i = 0; i < hull.count; ++i) {
        if (clip[i].w >= least) {
            bounds.add(clip[i]);
        }
        for (std::size_t j = 0; j < i; ++j) {
            if ((clip[i].w >= least) != (clip[j].w >= least)) {
                const double t = (least - clip[i].w) / (clip[j].w - clip[i].w);
                glm::dvec4 pierced = clip[i] + (clip[j] - clip[i]) * t;
                pierced.w = least;
                bounds.add(pierced);
            }
        }
    }
    return bounds;
}

bool isFinite(const glm::dvec3& v)
{
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

} // namespace

ScreenBounds screenBounds(const Light& light, const LightExtent& extent, const Camera& camera, glm::uvec2 size_px)
{
    const double reach_m = extent.reach_m;
    const bool bounded =
        light.type != LightType::directional && isFinite(light.position_ws) && isFinite(light.direction_ws) &&
        std::isfinite(reach_m) &&
        (light.type == LightType::point || (light.outer_half_angle_rad < 1.5 && glm::length(light.direction_ws) > 0.0));
    if (!bounded) {
        return {0, 0, size_px.x, size_px.y};
    }
    const Hull hull = light.type == LightType::spot ? hullOfSpot(light, reach_m) : hullOfPoint(light, reach_m);
    return projectedBounds(hull, clipFromWorld(camera)).inPixels(size_px);
}

namespace {

/// Calls `each(tile, light)` for every tile of each light's bounds.
template <class Each>
void forTiles(std::span<const Light> lights, const Camera& camera, const Aabb& scene_bounds_ws, glm::uvec2 size_px,
              const LightLists& lists, const Each& each)
{
    for (std::uint32_t i = 0; i < lights.size(); ++i) {
        const ScreenBounds bounds = litPixels(lights[i], camera, scene_bounds_ws, size_px);
        if (bounds.empty()) {
            continue;
        }
        for (std::uint32_t y = bounds.y0 / lists.side_px; y <= (bounds.y1 - 1) / lists.side_px; ++y) {
            for (std::uint32_t x = bounds.x0 / lists.side_px; x <= (bounds.x1 - 1) / lists.side_px; ++x) {
                each(std::size_t{y} * lists.tiles.x + x, i);
            }
        }
    }
}

} // namespace

void listLights(std::span<const Light> lights, const Camera& camera, const Aabb& scene_bounds_ws, glm::uvec2 size_px,
                std::uint32_t side_px, LightLists& out)
{
    out.side_px = side_px;
    if (side_px == 0 || size_px.x == 0 || size_px.y == 0) {
        out.tiles = {0, 0};
        out.first.assign(1, 0);
        out.lights.clear();
        return;
    }
    out.tiles = (size_px + (side_px - 1U)) / side_px;
    const std::size_t tiles = std::size_t{out.tiles.x} * out.tiles.y;
    // Counted first; then `first` walks on while lights are put in, and is moved back by one tile at the end.
    out.first.assign(tiles + 1, 0);
    forTiles(lights, camera, scene_bounds_ws, size_px, out,
             [&](std::size_t tile, std::uint32_t) { ++out.first[tile + 1]; });
    for (std::size_t i = 0; i < tiles; ++i) {
        out.first[i + 1] += out.first[i];
    }
    out.lights.resize(out.first[tiles]);
    forTiles(lights, camera, scene_bounds_ws, size_px, out,
             [&](std::size_t tile, std::uint32_t light) { out.lights[out.first[tile]++] = light; });
    for (std::size_t i = tiles; i > 0; --i) {
        out.first[i] = out.first[i - 1];
    }
    out.first[0] = 0;
}

} // namespace gnomon::pack
