// SPDX-License-Identifier: Apache-2.0
#include "view/camera_moves.h"

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>

namespace gnomon::app::view {
namespace {

// Nearer to straight up or down the picture has no sideways.
constexpr double kSteepest_rad = 1.55;

struct Axes {
    glm::dvec3 forward;
    glm::dvec3 right;
    glm::dvec3 up; // of the picture
};

glm::dvec3 anyAcross(const glm::dvec3& axis)
{
    const glm::dvec3 other = std::abs(axis.x) < 0.9 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 0.0, 1.0);
    return glm::normalize(glm::cross(axis, other));
}

Axes axesOf(const host::Eye& eye)
{
    Axes axes{glm::normalize(eye.target_ws - eye.position_ws), {}, {}};
    const glm::dvec3 across = glm::cross(axes.forward, glm::normalize(eye.up_ws));
    axes.right = glm::length(across) > 1e-6 ? glm::normalize(across) : anyAcross(axes.forward);
    axes.up = glm::cross(axes.right, axes.forward);
    return axes;
}

/// `forward` turned about `up` and tilted, without passing the pole.
glm::dvec3 turned(const Axes& axes, const glm::dvec3& up, const glm::dvec2& turn)
{
    const double now = std::asin(std::clamp(glm::dot(axes.forward, up), -1.0, 1.0));
    const double then = std::clamp(now + turn.y, std::min(now, -kSteepest_rad), std::max(now, kSteepest_rad));
    const glm::dquat tilt = glm::angleAxis(then - now, axes.right);
    const glm::dquat swing = glm::angleAxis(-turn.x, up);
    return glm::normalize(swing * (tilt * axes.forward));
}

} // namespace

host::Eye orbited(const host::Eye& eye, const glm::dvec2& turn)
{
    // The side of the scene that is seen goes with the hand, so the eye goes round the other way.
    const glm::dvec3 forward = turned(axesOf(eye), glm::normalize(eye.up_ws), turn);
    host::Eye moved = eye;
    moved.position_ws = eye.target_ws - forward * glm::length(eye.target_ws - eye.position_ws);
    return moved;
}

host::Eye looked(const host::Eye& eye, const glm::dvec2& turn)
{
    const glm::dvec3 forward = turned(axesOf(eye), glm::normalize(eye.up_ws), turn);
    host::Eye moved = eye;
    moved.target_ws = eye.position_ws + forward * glm::length(eye.target_ws - eye.position_ws);
    return moved;
}

host::Eye panned(const host::Eye& eye, const glm::dvec2& pixels, double picture_height_px)
{
    const Axes axes = axesOf(eye);
    const double distance = glm::length(eye.target_ws - eye.position_ws);
    const double metres_per_px = host::pictureHeight(eye, distance) / picture_height_px;
    const glm::dvec3 by = (axes.up * pixels.y - axes.right * pixels.x) * metres_per_px;
    host::Eye moved = eye;
    moved.position_ws += by;
    moved.target_ws += by;
    return moved;
}

host::Eye dollied(const host::Eye& eye, double steps)
{
    constexpr double kLeft = 0.9;
    host::Eye moved = eye;
    if (eye.height_m > 0.0) { // nearer things are no larger, and what is behind the eye is cut away
        moved.height_m *= std::pow(kLeft, steps);
    } else {
        moved.position_ws = eye.target_ws + (eye.position_ws - eye.target_ws) * std::pow(kLeft, steps);
    }
    return moved;
}

host::Eye flown(const host::Eye& eye, const glm::dvec3& metres)
{
    const Axes axes = axesOf(eye);
    const glm::dvec3 by = axes.right * metres.x + glm::normalize(eye.up_ws) * metres.y + axes.forward * metres.z;
    host::Eye moved = eye;
    moved.position_ws += by;
    moved.target_ws += by;
    return moved;
}

SightLine lineThrough(const glm::dmat4& clip_from_world, const glm::dvec2& point)
{
    // Reversed depth: from the near plane to any other place, half depth is one.
    const glm::dmat4 world_from_clip = glm::inverse(clip_from_world);
    const auto placeAt = [&](double depth) {
        const glm::dvec4 place = world_from_clip * glm::dvec4(2.0 * point.x - 1.0, 2.0 * point.y - 1.0, depth, 1.0);
        return glm::dvec3(place) / place.w;
    };
    const glm::dvec3 from = placeAt(1.0);
    return {from, glm::normalize(placeAt(0.5) - from)};
}

std::optional<glm::dvec2> pointOf(const glm::dmat4& clip_from_world, const glm::dvec3& place_ws)
{
    const glm::dvec4 clip = clip_from_world * glm::dvec4(place_ws, 1.0);
    if (!(clip.w > 1e-9)) {
        return std::nullopt;
    }
    return glm::dvec2(clip) / clip.w * 0.5 + 0.5;
}

SunDome domeOf(const host::Eye& eye)
{
    constexpr double kShare = 0.55; // of half the picture's height
    const double distance = glm::length(eye.target_ws - eye.position_ws);
    host::Eye seen = eye;
    seen.fov_y_rad = std::min(eye.fov_y_rad, 2.0);
    return {eye.target_ws, kShare * 0.5 * host::pictureHeight(seen, distance)};
}

glm::dvec3 sunFrom(const SunDome& dome, const SightLine& line)
{
    const glm::dvec3& ray = line.along;
    const glm::dvec3 to_centre = dome.centre_ws - line.from_ws;
    const double along = glm::dot(to_centre, ray);
    const glm::dvec3 nearest = line.from_ws + ray * along - dome.centre_ws;
    const double missed = glm::length(nearest);
    glm::dvec3 towards = nearest;
    if (missed < dome.radius_m) {
        towards = nearest - ray * std::sqrt(dome.radius_m * dome.radius_m - missed * missed);
    }
    constexpr double kLowest = 0.02; // sine of its height: a sun in the horizon has shadows without end
    glm::dvec3 flat(towards.x, 0.0, towards.z);
    towards /= std::max(glm::length(towards), 1e-12);
    if (towards.y < kLowest) {
        flat = glm::length(flat) > 1e-9 ? glm::normalize(flat) : glm::dvec3(1.0, 0.0, 0.0);
        towards = glm::normalize(flat * std::sqrt(1.0 - kLowest * kLowest) + glm::dvec3(0.0, kLowest, 0.0));
    }
    return -towards;
}

} // namespace gnomon::app::view
