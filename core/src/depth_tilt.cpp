// SPDX-License-Identifier: Apache-2.0
// A filterable map stores averages of depth, and their bounds are tight only while the receiver's own depth is one:
// under a slanted sun, level ground is a slope in depth along the light's axis, whose variance within a kernel lights
// every shadow from close above (W. Donnelly, A. Lauritzen, "Variance Shadow Maps", 2006, section 4.2: any strictly
// monotonic depth metric will do). Monotonic along each ray is all that is needed: we add a plane to depth, which no
// ray sees, and choose the one that makes the receivers level. That also takes the slope out of the range from near to
// far, so every format holds more digits, and layers of depth (A. Marinescu, 2011) become layers of height: ground, and
// what floats above it.
#include "depth_tilt.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <cmath>

namespace gnomon {
namespace {

// Receivers that the light grazes at less than 10 degrees are not followed: tan 80 degrees.
constexpr double kSteepest = 5.67;
constexpr double kSteps = 128.0; // the share is a multiple of one over this
constexpr double kRidge = 1e-3;  // share of the spread across, which keeps the regression stable where all points lie
                                 // in a line

/// Weighted sums over sheets, of their coordinates (right, up, forward).
struct Sums {
    double area = 0.0;
    glm::dvec3 mean{0.0}; // times area
    double xx = 0.0, xy = 0.0, yy = 0.0, xz = 0.0, yz = 0.0;

    void addProducts(const glm::dvec3& p, double weight)
    {
        xx += weight * p.x * p.x;
        xy += weight * p.x * p.y;
        yy += weight * p.y * p.y;
        xz += weight * p.x * p.z;
        yz += weight * p.y * p.z;
    }
};

void addBox(const LightSpace& space, const glm::dvec3& origin_ws, const Aabb& box, Sums& sums)
{
    const glm::dvec3 low(box.min);
    const glm::dvec3 high(box.max);
    const glm::dvec3 half = (high - low) * 0.5;
    const int thin = half.x < half.y ? (half.x < half.z ? 0 : 2) : (half.y < half.z ? 1 : 2);
    const int a = (thin + 1) % 3;
    const int b = (thin + 2) % 3;
    const double area = half[a] * half[b];
    if (!(area > 0.0)) {
        return;
    }
    const auto across = [&](const glm::dvec3& v) {
        return glm::dvec3(glm::dot(space.right_ws, v), glm::dot(space.up_ws, v), glm::dot(space.forward_ws, v));
    };
    const glm::dvec3 centre = across((low + high) * 0.5 - origin_ws);
    sums.area += area;
    sums.mean += centre * area;
    sums.addProducts(centre, area);
    for (const int axis : {a, b}) { // an even sheet's variance along its side of length 2 h is h^2 / 3
        glm::dvec3 side(0.0);
        side[axis] = half[axis];
        sums.addProducts(across(side), area / 3.0);
    }
}

} // namespace

glm::dvec3 levelDepth(const LightSpace& space, const ObjectSet& objects, std::span<const std::uint32_t> receivers)
{
    if (space.perspective || receivers.empty()) {
        return space.forward_ws;
    }
    const glm::dvec3 origin_ws(objects.bounds(receivers.front()).min); // near all of them, for precision far out
    Sums sums;
    for (const std::uint32_t object : receivers) {
        if (!objects.flags(object).dynamic) {
            addBox(space, origin_ws, objects.bounds(object), sums);
        }
    }
    if (!(sums.area > 0.0) || !std::isfinite(sums.area)) {
        return space.forward_ws;
    }
    sums.addProducts(sums.mean / sums.area, -sums.area);
    const double ridge = kRidge * (sums.xx + sums.yy);
    const double xx = sums.xx + ridge;
    const double yy = sums.yy + ridge;
    const double det = xx * yy - sums.xy * sums.xy;
    glm::dvec2 share((sums.xz * yy - sums.yz * sums.xy) / det, (sums.yz * xx - sums.xz * sums.xy) / det);
    const double steepness = glm::length(share);
    if (!std::isfinite(steepness)) {
        return space.forward_ws;
    }
    if (steepness > kSteepest) {
        share *= kSteepest / steepness;
    }
    share = glm::round(share * kSteps) / kSteps;
    return space.forward_ws - space.right_ws * share.x - space.up_ws * share.y;
}

} // namespace gnomon
