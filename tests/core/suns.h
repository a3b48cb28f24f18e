// SPDX-License-Identifier: Apache-2.0
// Suns for the tests of steps, and the visible part of a step.
#pragma once

#include "motion/sun_steps.h"

#include <glm/trigonometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace gnomon::test {

inline constexpr double kPi = 3.14159265358979323846;
inline constexpr double kStep = 0.00872664626;
inline constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// The sun of 50 degrees north. Hour angle 0 is noon, pi midnight, when it
/// shines from below.
inline glm::dvec3 sunAt(double hour_angle, double declination = 0.2)
{
    const double north = glm::radians(50.0);
    const glm::dvec3 pole(0.0, std::sin(north), -std::cos(north));
    const glm::dvec3 south(0.0, std::cos(north), std::sin(north)); // on the equator of the sky, at noon
    const glm::dvec3 toward =
        pole * std::sin(declination) +
        (south * std::cos(hour_angle) + glm::cross(south, pole) * std::sin(hour_angle)) * std::cos(declination);
    return -glm::normalize(toward);
}

/// On a great circle through the zenith.
inline glm::dvec3 overhead(double angle)
{
    return {std::sin(angle), -std::cos(angle), 0.0};
}

inline StepOptions byAngle(double step_rad = kStep)
{
    StepOptions options;
    options.angle_rad = step_rad;
    return options;
}

inline StepOptions byTime(double interval_s)
{
    StepOptions options;
    options.by = StepBy::time;
    options.interval_s = interval_s;
    return options;
}

struct Weighed {
    glm::dvec3 place_ws;
    double weight;
    std::uint32_t slot;
};

/// The positions that a frame shows, the share of each (without smoothing), and the places of their maps.
inline std::array<Weighed, 2> shown(const SunCourse& course)
{
    const SunSteps& steps = course.steps();
    return {Weighed{steps.earlier_ws, 1.0 - steps.share, course.earlierSlot()},
            Weighed{steps.later_ws, steps.share, 1 - course.earlierSlot()}};
}

/// The share of the picture that changed: 0 .. 1. Positions are the same if all their bits are.
inline double change(const std::array<Weighed, 2>& before, const std::array<Weighed, 2>& after)
{
    double kept = 0.0;
    for (const Weighed& a : before)
        for (const Weighed& b : after)
            if (a.place_ws == b.place_ws && a.slot == b.slot)
                kept += std::min(a.weight, b.weight);
    return 1.0 - kept;
}

/// The direction on the arc between the two positions, at the share.
inline glm::dvec3 mean(const SunSteps& steps)
{
    const double whole = angleBetween(steps.earlier_ws, steps.later_ws);
    if (whole == 0.0)
        return steps.earlier_ws;
    const glm::dvec3 axis = glm::normalize(glm::cross(steps.earlier_ws, steps.later_ws));
    return rotated(steps.earlier_ws, axis, steps.share * whole);
}

} // namespace gnomon::test
