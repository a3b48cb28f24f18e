// SPDX-License-Identifier: Apache-2.0
// The cells of the octree and the spheres around what casts, over the picture: what A. Marinescu, "Achieving real-time
// soft shadows using LVSM in an RTS game", 2011, shows in figure 8.
#include "debug_drawn.h"

#include "lab/tint.h"

#include <gnomon/object_set.h>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <map>
#include <numbers>
#include <set>
#include <span>

namespace gnomon::app {
namespace {

/// Lines in the world as pixels of a kind.
class Pen {
public:
    Pen(const Camera& camera, ImageOf<std::uint8_t>& kinds) : clip_from_world_(camera.clip_from_world), kinds_(kinds) {}

    void line(const glm::dvec3& from_ws, const glm::dvec3& to_ws, std::uint8_t kind)
    {
        glm::dvec4 a = clip_from_world_ * glm::dvec4(from_ws, 1.0);
        glm::dvec4 b = clip_from_world_ * glm::dvec4(to_ws, 1.0);
        if (clip(a, b)) {
            const glm::dvec2 p = pixelOf(a);
            const glm::dvec2 step = pixelOf(b) - p;
            const int count = 1 + static_cast<int>(std::max(std::abs(step.x), std::abs(step.y)));
            for (int i = 0; i <= count; ++i) {
                const glm::dvec2 at = glm::floor(p + step * (double(i) / count));
                if (at.x >= 0.0 && at.y >= 0.0 && at.x < kinds_.width && at.y < kinds_.height) {
                    *kinds_.pixel(static_cast<std::uint32_t>(at.x), static_cast<std::uint32_t>(at.y)) = kind;
                }
            }
        }
    }

    void box(const Aabb& box, std::uint8_t kind)
    {
        for (int corner = 0; corner < 8; ++corner) {
            for (const int axis : {1, 2, 4}) {
                if ((corner & axis) == 0) {
                    line(box.corner(corner), box.corner(corner | axis), kind);
                }
            }
        }
    }

    /// The sphere around a box as it is seen from `eye_ws`: the circle across the line of sight.
    void sphere(const Aabb& box, const glm::dvec3& eye_ws)
    {
        constexpr int kSides = 32;
        const glm::dvec3 centre(box.centre());
        const double radius = glm::length(glm::dvec3(box.extent())) / 2.0;
        if (glm::distance(centre, eye_ws) <= radius) {
            return; // from within there is no rim
        }
        const glm::dvec3 away = glm::normalize(centre - eye_ws);
        const glm::dvec3 other = std::abs(away.y) < 0.9 ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(1.0, 0.0, 0.0);
        const glm::dvec3 x = glm::normalize(glm::cross(away, other)) * radius;
        const glm::dvec3 y = glm::cross(x, away);
        const auto rim = [&](int side) {
            const double angle = 2.0 * std::numbers::pi * side / kSides;
            return centre + std::cos(angle) * x + std::sin(angle) * y;
        };
        for (int side = 0; side < kSides; ++side) {
            line(rim(side), rim(side + 1), 1);
        }
    }

private:
    /// To what lies beyond the near plane and within the picture's sides. False: nothing does.
    static bool clip(glm::dvec4& a, glm::dvec4& b)
    {
        const std::array<glm::dvec4, 5> inward{{{0.0, 0.0, -1.0, 1.0},
                                                {1.0, 0.0, 0.0, 1.0},
                                                {-1.0, 0.0, 0.0, 1.0},
                                                {0.0, 1.0, 0.0, 1.0},
                                                {0.0, -1.0, 0.0, 1.0}}};
        double begin = 0.0;
        double end = 1.0;
        for (const glm::dvec4& plane : inward) {
            const double at_a = glm::dot(plane, a);
            const double at_b = glm::dot(plane, b);
            if (at_a < 0.0) {
                begin = at_b > 0.0 ? std::max(begin, at_a / (at_a - at_b)) : 1.0;
            } else if (at_b < 0.0) {
                end = std::min(end, at_a / (at_a - at_b));
            }
        }
        const glm::dvec4 way = b - a;
        b = a + end * way;
        a += begin * way;
        return begin < end;
    }

    [[nodiscard]] glm::dvec2 pixelOf(const glm::dvec4& clip) const
    {
        return (glm::dvec2(clip) / clip.w * 0.5 + 0.5) * glm::dvec2(kinds_.width, kinds_.height);
    }

    glm::dmat4 clip_from_world_;
    ImageOf<std::uint8_t>& kinds_;
};

/// How many cells have 2^n metres, by n, the largest first; each size is a kind, and those left over share the last
/// one.
using Sizes = std::map<int, std::uint32_t, std::greater<>>;

int sizeOf(const OctreeCell& cell)
{
    return static_cast<int>(std::lround(std::log2(cell.bounds_ws.extent().x))); // which rounding has touched
}

std::uint8_t kindOf(const Sizes& sizes, int size)
{
    const auto place = std::distance(sizes.begin(), sizes.find(size));
    return static_cast<std::uint8_t>(2 + std::min<std::ptrdiff_t>(place, lab::kMostTints - 2));
}

lab::TintLegend legendOf(const Sizes& sizes, std::size_t spheres)
{
    lab::TintLegend legend;
    legend.title = "Cells of the octree that hold objects";
    legend.subtitle = "and spheres around what the light's maps draw";
    legend.kinds = {fmt::format("{} spheres", spheres)};
    for (const auto& [size, count] : sizes) {
        if (legend.kinds.size() < lab::kMostTints) {
            legend.kinds.push_back(fmt::format("{} of {:g} m", count, std::ldexp(1.0, size)));
        } else {
            legend.kinds.back() = "smaller ones";
        }
    }
    return legend;
}

} // namespace

Image8 octreeView(const Drawn& drawn)
{
    requireMap(drawn, "octree");
    const ImageF& depth = drawn.picture.depth;
    ImageOf<std::uint8_t> kinds(depth.width, depth.height, 1);
    Pen pen(host::cameraOf(drawn.shot.eye, depth.width, depth.height, drawn.shot.state.bounds_ws), kinds);
    ObjectSet objects;
    host::fillObjectSet(drawn.shot.state, objects);
    Sizes sizes;
    for (const OctreeCell& cell : objects.cells()) {
        ++sizes[sizeOf(cell)];
    }
    for (const OctreeCell& cell : objects.cells()) {
        pen.box(cell.bounds_ws, kindOf(sizes, sizeOf(cell)));
    }
    std::set<std::uint32_t> casters;
    const LightPlan& light = drawn.plan.lights[drawn.light];
    for (const View& view : std::span(drawn.plan.views).subspan(light.first_view, light.view_count)) {
        const auto drawn_there = std::span(drawn.plan.casters).subspan(view.casters.first, view.casters.count);
        casters.insert(drawn_there.begin(), drawn_there.end());
    }
    for (const std::uint32_t caster : casters) {
        pen.sphere(objects.bounds(caster), drawn.shot.eye.position_ws);
    }
    return lab::tintedPicture(drawn.picture.colour, kinds, legendOf(sizes, casters.size()));
}

} // namespace gnomon::app
