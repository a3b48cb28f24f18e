// SPDX-License-Identifier: Apache-2.0
// Based on: P. Fortier, "Shadow maps for moving light sources", IceFall Games, 2010: light the scene by the sun's last
// and next position, and blend from one to the other.
// Departure: the source does not say where the next position is. Ours is foretold from the sun's motion, so that the
// blend is where the sun is, not a step behind.
#include "motion/sun_steps.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace gnomon {
namespace {

constexpr double kStretch = 1.0 / 32.0; // share of a step over which the sun's motion is measured
constexpr double kAstray = 0.25;        // share of a step by which the sun may leave its way
constexpr double kHaste = 2.0;          // the share then goes this number of times as fast as the sun
/// step_jump: how far past the middle between two positions the sun gets before the next one is taken, share of a
/// step: so a sun that trembles there does not make it jump to and fro.
constexpr double kPastMiddle = 1.0 / 16.0;
constexpr double kStill_rad = 1e-7;   // the rounding of a float direction is no movement
constexpr double kJump_rad = 0.00873; // the sun's own width
constexpr double kFarthest_rad = 0.5; // by time: a sun that goes farther in a step is too fast for steps

} // namespace

glm::dvec3 rotated(const glm::dvec3& v, const glm::dvec3& axis, double angle_rad)
{
    if (angle_rad == 0.0) {
        return v;
    }
    const double c = std::cos(angle_rad);
    const double s = std::sin(angle_rad);
    return glm::normalize(v * c + glm::cross(axis, v) * s + axis * (glm::dot(axis, v) * (1.0 - c)));
}

double angleBetween(const glm::dvec3& a, const glm::dvec3& b)
{
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

void SunMotion::restart(const glm::dvec3& sun_ws, double time_s)
{
    from_ws_ = sun_ws;
    from_s_ = time_s;
}

bool SunMotion::measure(const glm::dvec3& sun_ws, double time_s)
{
    const glm::dvec3 across = glm::cross(from_ws_, sun_ws);
    const double length = glm::length(across);
    if (length > 1e-12) { // else it stands still, or there is no telling which way it went
        axis_ws_ = across / length;
    }
    last_speed_rad_s_ = speed_rad_s_;
    const double passed_s = time_s - from_s_;
    speed_rad_s_ = length > 1e-12 && passed_s > 0.0 ? std::atan2(length, glm::dot(from_ws_, sun_ws)) / passed_s : 0.0;
    restart(sun_ws, time_s);
    return true;
}

bool SunMotion::measureByAngle(const glm::dvec3& sun_ws, double time_s, double stretch_rad)
{
    return angleBetween(from_ws_, sun_ws) >= stretch_rad && measure(sun_ws, time_s);
}

bool SunMotion::measureByTime(const glm::dvec3& sun_ws, double time_s, double stretch_s)
{
    return time_s - from_s_ >= stretch_s && measure(sun_ws, time_s);
}

double SunMotion::speed_rad_s() const
{
    return std::min(speed_rad_s_, last_speed_rad_s_);
}

void SunCourse::follow(const glm::dvec3& sun_ws, double time_s, Stepping stepping, const StepOptions& options,
                       bool camera_moves)
{
    const bool by_time = options.by == StepBy::time;
    steps_.stepping = true;
    if (!known_ || jumped(sun_ws, time_s, options)) {
        standAlone(sun_ws, time_s);
        // The first jump comes where the sun is half a step on, and each is half a step ahead.
        begin_s_ = stepping == Stepping::jump ? time_s - 0.5 * options.interval_s : time_s;
        if (!known_ || !by_time || !(time_s >= time_s_)) {
            motion_.restart(sun_ws, time_s);
        } else {
            (void)motion_.measureByTime(sun_ws, time_s, kStretch * options.interval_s);
        }
    } else if (paired(stepping)) {
        by_time ? pairByTime(sun_ws, time_s, options.interval_s) : pairByAngle(sun_ws, time_s, options.angle_rad);
    } else {
        by_time ? jumpByTime(sun_ws, time_s, options, camera_moves)
                : jumpByAngle(sun_ws, time_s, options, camera_moves);
    }
    steps_.smooth = options.smooth;
    steps_.band = stepping == Stepping::band && steps_.paired ? options.band : 0.0;
    steps_.edge = steps_.band > 0.0 ? steps_.share * (1.0 + steps_.band) : 0.0;
    steps_.alternate = stepping == Stepping::alternate && steps_.paired;
    known_ = std::isfinite(time_s) || !by_time;
    sun_ws_ = sun_ws;
    time_s_ = time_s;
}

bool SunCourse::jumped(const glm::dvec3& sun_ws, double time_s, const StepOptions& options) const
{
    const double move_rad = angleBetween(sun_ws_, sun_ws);
    if (options.by == StepBy::angle) {
        return !(move_rad < options.angle_rad);
    }
    const double passed_s = time_s - time_s_;
    return !(passed_s >= 0.0 && passed_s < options.interval_s &&
             move_rad <= kJump_rad + 2.0 * motion_.speed_rad_s() * passed_s);
}

void SunCourse::standAlone(const glm::dvec3& sun_ws, double time_s)
{
    steps_.paired = false;
    steps_.earlier_ws = sun_ws;
    steps_.later_ws = sun_ws;
    steps_.share = 0.0;
    begin_s_ = time_s;
    moved_ = false;
    waiting_ = false;
}

/// Is a jump that is due put off? Time that is not finite puts nothing off, nor does it begin anew where it goes back.
bool SunCourse::waits(double time_s, const StepOptions& options, bool camera_moves)
{
    if (options.wait == StepWait::none || camera_moves) {
        return false;
    }
    due_s_ = waiting_ ? std::min(due_s_, time_s) : time_s;
    waiting_ = time_s - due_s_ < options.longest_wait_s;
    return waiting_;
}

/// Half a step ahead of the sun, so that it is never much more than half a step off.
void SunCourse::jumpByAngle(const glm::dvec3& sun_ws, double time_s, const StepOptions& options, bool camera_moves)
{
    const double step_rad = options.angle_rad;
    (void)motion_.measureByAngle(sun_ws, time_s, kStretch * step_rad);
    const double off_rad = angleBetween(steps_.earlier_ws, sun_ws);
    if (off_rad < (0.5 + kPastMiddle) * step_rad) {
        waiting_ = false; // a sun that went back meanwhile
        return;
    }
    const bool waited = waiting_;
    if (!waits(time_s, options, camera_moves)) {
        standAlone(motion_.ahead(sun_ws, waited ? 0.5 * step_rad : std::max(step_rad - off_rad, 0.0)), time_s);
    }
}

void SunCourse::jumpByTime(const glm::dvec3& sun_ws, double time_s, const StepOptions& options, bool camera_moves)
{
    const double interval_s = options.interval_s;
    (void)motion_.measureByTime(sun_ws, time_s, kStretch * interval_s);
    const bool waited = waiting_;
    if (time_s - begin_s_ < interval_s || waits(time_s, options, camera_moves)) {
        return;
    }
    waiting_ = false;
    const double begin_s = waited ? time_s : begin_s_ + interval_s;
    const double ahead_rad = motion_.speed_rad_s() * (begin_s + 0.5 * interval_s - time_s);
    const glm::dvec3 next_ws = motion_.ahead(sun_ws, ahead_rad <= kFarthest_rad ? ahead_rad : 0.0);
    if (angleBetween(steps_.earlier_ws, next_ws) > kStill_rad) {
        standAlone(next_ws, begin_s);
    }
    begin_s_ = begin_s;
}

/// A way along the sun's present motion, on which the share goes from what it is to an end.
void SunCourse::beginWay(const glm::dvec3& sun_ws, double share_per_step)
{
    way_begin_ws_ = sun_ws;
    way_axis_ws_ = motion_.axis_ws();
    way_share_ = steps_.share;
    share_per_step_ = share_per_step;
}

/// A way to a new later position, of which `share` is done.
void SunCourse::foretell(const glm::dvec3& sun_ws, double share, double step_rad)
{
    steps_.share = std::clamp(share, 0.0, 1.0);
    steps_.later_ws = motion_.ahead(sun_ws, (1.0 - steps_.share) * step_rad);
    beginWay(sun_ws, 1.0);
}

void SunCourse::pairByAngle(const glm::dvec3& sun_ws, double time_s, double step_rad)
{
    const bool measured = motion_.measureByAngle(sun_ws, time_s, kStretch * step_rad);
    if (!steps_.paired) {
        steps_.paired = measured;
        if (measured) {
            foretell(sun_ws, 0.0, step_rad);
        }
        return;
    }
    const glm::dvec3 along_ws = glm::cross(way_axis_ws_, way_begin_ws_);
    const double gone_rad = std::atan2(glm::dot(sun_ws, along_ws), glm::dot(sun_ws, way_begin_ws_));
    const double aside_rad = std::abs(std::asin(std::clamp(glm::dot(sun_ws, way_axis_ws_), -1.0, 1.0)));
    const double share = way_share_ + share_per_step_ * gone_rad / step_rad;
    const bool aside = aside_rad > kAstray * step_rad;
    const bool behind = share < (share_per_step_ > 0.0 ? -kAstray * share_per_step_ : 0.0);
    if ((aside || behind) && angleBetween(sun_ws_, sun_ws) > kAstray * step_rad) {
        standAlone(sun_ws, time_s);
        motion_.restart(sun_ws, time_s);
    } else if (share >= 1.0) {
        steps_.earlier_ws = steps_.later_ws;
        slot_ = 1 - slot_;
        foretell(sun_ws, share - 1.0, step_rad);
    } else if (behind) {
        foretell(sun_ws, 0.0, step_rad);
    } else {
        steps_.share = std::max(share, 0.0);
        if (aside) {
            beginWay(sun_ws, steps_.share < 0.5 ? -kHaste : kHaste);
        }
    }
}

void SunCourse::pairByTime(const glm::dvec3& sun_ws, double time_s, double interval_s)
{
    const bool measured = motion_.measureByTime(sun_ws, time_s, kStretch * interval_s);
    if (!steps_.paired) {
        if (!measured) {
            return;
        }
        // Not at the first measure of a movement: its speed is known from the second on.
        const bool moved = angleBetween(steps_.earlier_ws, sun_ws) > kStill_rad;
        steps_.paired = moved && moved_;
        moved_ = moved;
        begin_s_ = time_s;
    } else {
        steps_.share = std::clamp((time_s - begin_s_) / interval_s, 0.0, 1.0);
        if (steps_.share < 1.0) {
            return;
        }
        begin_s_ += interval_s;
        steps_.earlier_ws = steps_.later_ws;
        slot_ = 1 - slot_;
    }
    if (!steps_.paired) {
        return;
    }
    const double left_rad = motion_.speed_rad_s() * (begin_s_ + interval_s - time_s);
    if (left_rad > kFarthest_rad) {
        standAlone(sun_ws, time_s);
        return;
    }
    steps_.later_ws = motion_.ahead(sun_ws, left_rad);
    steps_.share = std::clamp((time_s - begin_s_) / interval_s, 0.0, 1.0);
    if (angleBetween(steps_.earlier_ws, steps_.later_ws) <= kStill_rad) {
        standAlone(steps_.earlier_ws, time_s);
    }
}

void SunCourses::begin()
{
    for (Row& row : rows_) {
        row.present = false;
    }
    first_ = 0;
}

const SunCourse& SunCourses::follow(const Light& light, double time_s, Stepping stepping, const StepOptions& options,
                                    bool camera_moves)
{
    while (first_ < rows_.size() && rows_[first_].present) {
        ++first_;
    }
    auto row = std::find_if(rows_.begin() + static_cast<std::ptrdiff_t>(first_), rows_.end(),
                            [&](const Row& known) { return !known.present && known.key == light.key; });
    if (row == rows_.end()) {
        row = rows_.insert(rows_.end(), Row{.key = light.key, .present = false, .course = {}});
    }
    row->present = true;
    row->course.follow(glm::normalize(light.direction_ws), time_s, stepping, options, camera_moves);
    return row->course;
}

void SunCourses::end()
{
    std::erase_if(rows_, [](const Row& row) { return !row.present; });
}

} // namespace gnomon
