// SPDX-License-Identifier: Apache-2.0
#include "auto/sight.h"

#include <glm/common.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace gnomon {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The cells, counted from 0, whose middles lie between two places of [-1, 1].
struct Cells {
    int begin = 0;
    int end = 0;
};
Cells cellsBetween(double low, double high, int count)
{
    if (!(low <= high)) { // no numbers
        return {0, count};
    }
    // How many middles lie below a place; a cast takes less time than std::floor, which counts here.
    const auto below = [&](double place) {
        return static_cast<int>(0.5 * ((std::clamp(place, -1.0, 1.0) + 1.0) * count + 1.0));
    };
    return {below(low), below(high)};
}

/// Across which axis a box is flat; -1: none.
int flatAxis(const glm::dvec3& half)
{
    constexpr double kFlat = 1.0 / 3.0;
    const int thin = half.x <= half.y && half.x <= half.z ? 0 : half.y <= half.z ? 1 : 2;
    const double next = std::min(half[(thin + 1) % 3], half[(thin + 2) % 3]);
    return half[thin] <= kFlat * next ? thin : -1;
}

} // namespace

Sight::Ray Sight::rayAt(const glm::dvec2& place) const
{
    const auto at = [&](double z) {
        const glm::dvec4 h = world_from_clip_ * glm::dvec4(place, z, 1.0);
        return glm::dvec3(h) / h.w;
    };
    Ray ray;
    ray.from_ws = at(near_z_);
    ray.along_ws = glm::normalize(at(0.5) - ray.from_ws);
    ray.met = kInfinity;
    return ray;
}

glm::dvec3 Sight::meetPlane(const Ray& ray, const glm::dvec3& p_ws, const glm::dvec3& normal_ws)
{
    return ray.from_ws + ray.along_ws * (glm::dot(normal_ws, p_ws - ray.from_ws) / glm::dot(normal_ws, ray.along_ws));
}

/// The slabs of T. Kay, J. Kajiya, "Ray tracing complex scenes", 1986.
void Sight::meetSlabs(const glm::dvec3& low, const glm::dvec3& high, int flat_axis, Ray& ray)
{
    double enter = -kInfinity;
    double leave = kInfinity;
    int enter_axis = 0;
    int leave_axis = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const double a = (low[axis] - ray.from_ws[axis]) / ray.along_ws[axis];
        const double b = (high[axis] - ray.from_ws[axis]) / ray.along_ws[axis];
        // Along a face 0 / 0 is no number, which both comparisons pass over.
        if (std::min(a, b) > enter) {
            enter = std::min(a, b);
            enter_axis = axis;
        }
        if (std::max(a, b) < leave) {
            leave = std::max(a, b);
            leave_axis = axis;
        }
    }
    if (flat_axis < 0 && enter < 0.0 && leave > 0.0) {
        if (leave > ray.left) {
            ray.left = leave;
            ray.left_axis = leave_axis;
        }
        return;
    }
    enter = std::max(enter, 0.0);
    if (!(enter <= leave) || enter >= ray.met) {
        return;
    }
    double met = enter + ray.share * (leave - enter);
    int axis = ray.share < 0.5 && enter > 0.0 ? enter_axis : leave_axis;
    if (flat_axis >= 0) {
        axis = flat_axis;
        met = (0.5 * (low[axis] + high[axis]) - ray.from_ws[axis]) / ray.along_ws[axis];
        if (!(met > enter && met < leave)) {
            met = leave_axis == flat_axis ? leave : kInfinity;
        }
    }
    if (met < ray.met) {
        ray.met = met;
        ray.normal_ws = glm::dvec3(0.0);
        ray.normal_ws[axis] = 1.0;
    }
}

void Sight::endInside(Ray& ray)
{
    if (ray.met == kInfinity && ray.left > 0.0) {
        ray.met = ray.left;
        ray.normal_ws = glm::dvec3(0.0);
        ray.normal_ws[ray.left_axis] = 1.0;
    }
}

void Sight::meet(const glm::dmat4& clip_from_world, const Aabb& box)
{
    const glm::dvec3 low(box.min);
    const glm::dvec3 high(box.max);
    const glm::dvec3 half = (high - low) * 0.5;
    const glm::dvec4 centre = clip_from_world * glm::dvec4((low + high) * 0.5, 1.0);
    const glm::dvec4 reach = glm::abs(clip_from_world[0]) * half.x + glm::abs(clip_from_world[1]) * half.y +
                             glm::abs(clip_from_world[2]) * half.z;
    Cells columns{0, kColumns};
    Cells rows{0, kRows};
    if (centre.w > reach.w) { // all of it is before the eye
        const double near_scale = 1.0 / (centre.w - reach.w);
        const double far_scale = 1.0 / (centre.w + reach.w);
        const auto most = [&](double at) {
            return at * (at > 0.0 ? near_scale : far_scale);
        };
        columns = cellsBetween(-most(reach.x - centre.x), most(reach.x + centre.x), kColumns);
        rows = cellsBetween(-most(reach.y - centre.y), most(reach.y + centre.y), kRows);
        if (columns.begin >= columns.end || rows.begin >= rows.end) {
            return; // between the rays, as most small boxes are
        }
    }
    const int flat_axis = flatAxis(half);
    for (int row = rows.begin; row < rows.end; ++row) {
        for (int column = columns.begin; column < columns.end; ++column) {
            meetSlabs(low, high, flat_axis, rays_[static_cast<std::size_t>(row * kColumns + column)]);
        }
    }
}

void Sight::addPoint(const CameraView& view, const Ray& ray, const glm::dvec2& place, const glm::dvec2& pixel)
{
    constexpr double kStep = 0.5; // pixels: the horizon of a face seen at a flat angle stays away
    SightPoint point;
    point.p_ws = ray.from_ws + ray.along_ws * ray.met;
    const auto stepTo = [&](const glm::dvec2& next) {
        return (meetPlane(rayAt(next), point.p_ws, ray.normal_ws) - point.p_ws) / kStep;
    };
    point.right_ws = stepTo(place + glm::dvec2(kStep * pixel.x, 0.0));
    point.down_ws = stepTo(place + glm::dvec2(0.0, kStep * pixel.y));
    point.depth_m = view.depthOf(point.p_ws);
    point.pixel_m = std::sqrt(glm::length(point.right_ws) * glm::length(point.down_ws));
    const auto across = [&](const glm::dvec3& step) {
        return glm::length(step - ray.along_ws * glm::dot(ray.along_ws, step));
    };
    point.facing_m = std::max(across(point.right_ws), across(point.down_ws));
    if (std::isfinite(point.pixel_m) && point.pixel_m > 0.0) {
        points_.push_back(point);
    }
}

double Sight::pixelAt_m(double depth_m, bool perspective) const
{
    if (points_.empty()) {
        return 0.0;
    }
    const SightPoint& any = points_.front();
    return perspective ? any.facing_m * depth_m / any.depth_m : any.facing_m;
}

void Sight::look(const Frame& frame, const CameraView& view, std::span<const std::uint32_t> receivers)
{
    world_from_clip_ = glm::inverse(view.clip_from_world);
    near_z_ = frame.camera.reversed_z ? 1.0 : 0.0;
    const auto placeOf = [](std::size_t cell) {
        const std::size_t column = cell % kColumns;
        const std::size_t row = cell / kColumns;
        return glm::dvec2((2.0 * static_cast<double>(column) + 1.0) / kColumns - 1.0,
                          (2.0 * static_cast<double>(row) + 1.0) / kRows - 1.0);
    };
    for (std::size_t cell = 0; cell < rays_.size(); ++cell) {
        rays_[cell] = rayAt(placeOf(cell));
        rays_[cell].share = std::fmod((static_cast<double>(cell) + 0.5) / std::numbers::phi, 1.0);
    }
    const std::span<const Aabb> bounds = frame.objects->allBounds();
    for (const std::uint32_t object : receivers) {
        meet(view.clip_from_world, bounds[object]);
    }
    points_.clear();
    points_.reserve(rays_.size());
    const glm::dvec2 pixel = 2.0 / glm::dvec2(glm::max(frame.size_px, glm::uvec2(1)));
    double logs = 0.0;
    for (std::size_t cell = 0; cell < rays_.size(); ++cell) {
        endInside(rays_[cell]);
        if (std::isfinite(rays_[cell].met)) {
            addPoint(view, rays_[cell], placeOf(cell), pixel);
        }
    }
    for (const SightPoint& point : points_) {
        logs += std::log(point.pixel_m);
    }
    mean_pixel_m_ = points_.empty() ? 0.0 : std::exp(logs / static_cast<double>(points_.size()));
}

} // namespace gnomon
