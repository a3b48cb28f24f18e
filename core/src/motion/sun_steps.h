// SPDX-License-Identifier: Apache-2.0
// A sun that moves in steps: where it stands for its maps, and how far it has got from one place to the next.
#pragma once

#include <gnomon/frame.h>
#include <gnomon/plan.h>
#include <gnomon/planner.h>

#include <cstdint>
#include <vector>

namespace gnomon {

/// How a motion uses a sun's steps.
enum class Stepping : std::uint8_t {
    none,
    jump, // one position at a time
    // Two positions and
    band,      // a band between them that sweeps over the picture,
    blend,     // a blend of them over time,
    alternate, // a blend of them, each drawn in every other frame.
};
/// Has the motion maps of two positions?
[[nodiscard]] constexpr bool paired(Stepping stepping)
{
    return stepping == Stepping::band || stepping == Stepping::blend || stepping == Stepping::alternate;
}

/// Rotates a unit vector about a unit axis (O. Rodrigues, 1840). By 0 it is the same to the last bit.
[[nodiscard]] glm::dvec3 rotated(const glm::dvec3& v, const glm::dvec3& axis, double angle_rad);
/// Between unit vectors: 0 .. pi, exact for small angles too.
[[nodiscard]] double angleBetween(const glm::dvec3& a, const glm::dvec3& b);

/// Which way and how fast a sun goes, measured over a stretch that is long beside the rounding of a direction and short
/// beside a step.
class SunMotion {
public:
    void restart(const glm::dvec3& sun_ws, double time_s);
    /// A new measure, when the sun is so far from where the last one ended.
    bool measureByAngle(const glm::dvec3& sun_ws, double time_s, double stretch_rad);
    /// A new measure, when so much time has passed since the last one.
    bool measureByTime(const glm::dvec3& sun_ws, double time_s, double stretch_s);
    /// Where the sun will be so much farther on along the great circle that it goes on at present.
    [[nodiscard]] glm::dvec3 ahead(const glm::dvec3& sun_ws, double angle_rad) const
    {
        return rotated(sun_ws, axis_ws_, angle_rad);
    }
    [[nodiscard]] const glm::dvec3& axis_ws() const { return axis_ws_; }
    /// The less of the last two measures by time, so that a sun which only jumped is not taken for a fast one.
    [[nodiscard]] double speed_rad_s() const;

private:
    bool measure(const glm::dvec3& sun_ws, double time_s);

    glm::dvec3 from_ws_{0.0, -1.0, 0.0};
    double from_s_ = 0.0;
    glm::dvec3 axis_ws_{1.0, 0.0, 0.0};
    double speed_rad_s_ = 0.0;
    double last_speed_rad_s_ = 0.0;
};

/// The steps of one sun. The rules:
/// - `later` is where the sun will be at the end of the step, so that what is shown does not lag behind it. It is
///   foretold from the sun's own place and motion at each step anew, so errors do not add up.
/// - A position's map is made or replaced only while its weight is nothing: `later` where the share is 0; where it
///   reaches 1, `later` becomes `earlier` and its map is kept, and a new `later` is foretold. So no step is seen.
/// - By angle the share is measured along the way, the great circle that the sun was on when the step began, from where
///   it was then. So the share starts where the last one ended, whether or not the sun kept to what was foretold.
/// - A sun that turns back goes back along its way, and the share with it. When the share has come to 0, `later` is
///   foretold anew, but only a quarter of a step later: a sun that trembles would have a map drawn in each frame.
/// - Of a sun that has left its way sideways, by a quarter of a step, neither position's weight is nothing. So the
///   share goes to its nearer end, twice as fast as the sun goes, whichever way, and there a right `later` is foretold.
/// - A sun that jumps (a step or more in one frame, or off its way in one frame; by time: half a degree more than twice
///   what its speed lets expect, or time that goes backward or on by a whole step) stands alone at its own place: what
///   is seen then is the sun's own jump.
/// - A jump that is due may have to wait for the camera to move (StepOptions::wait), but not for longer than it is
/// told.
///   Then it goes half a step ahead of where the sun is, as the first one does, however long it waited.
/// - A sun that has not moved yet, or by time stands still, has one position.
class SunCourse {
public:
    /// The next frame. `sun_ws` unit. Steps in range, see StepOptions. `camera_moves`: so a step that waits for that
    /// may be taken.
    void follow(const glm::dvec3& sun_ws, double time_s, Stepping stepping, const StepOptions& options,
                bool camera_moves = true);
    [[nodiscard]] const SunSteps& steps() const { return steps_; }
    /// Which of two places for maps the earlier (or only) position's is: it stays as long as the position does. The
    /// later one has the other.
    [[nodiscard]] std::uint32_t earlierSlot() const { return slot_; }

private:
    void standAlone(const glm::dvec3& sun_ws, double time_s);
    void jumpByAngle(const glm::dvec3& sun_ws, double time_s, const StepOptions& options, bool camera_moves);
    void jumpByTime(const glm::dvec3& sun_ws, double time_s, const StepOptions& options, bool camera_moves);
    [[nodiscard]] bool waits(double time_s, const StepOptions& options, bool camera_moves);
    void pairByAngle(const glm::dvec3& sun_ws, double time_s, double step_rad);
    void pairByTime(const glm::dvec3& sun_ws, double time_s, double interval_s);
    void beginWay(const glm::dvec3& sun_ws, double share_per_step);
    void foretell(const glm::dvec3& sun_ws, double share, double step_rad);
    [[nodiscard]] bool jumped(const glm::dvec3& sun_ws, double time_s, const StepOptions& options) const;

    bool known_ = false;
    glm::dvec3 sun_ws_{0.0, -1.0, 0.0}; // in the frame before
    double time_s_ = 0.0;
    SunMotion motion_;
    SunSteps steps_;
    std::uint32_t slot_ = 0;
    // By angle: where the way begins, the axis that it turns about, the share there, and what it gains in a step on.
    glm::dvec3 way_begin_ws_{0.0, -1.0, 0.0};
    glm::dvec3 way_axis_ws_{1.0, 0.0, 0.0};
    double way_share_ = 0.0;
    double share_per_step_ = 1.0;
    double begin_s_ = 0.0; // by time: when the share was 0
    bool moved_ = false;   // by time: the sun had left its only position at the last measure
    bool waiting_ = false; // a jump is due, since `due_s_`
    double due_s_ = 0.0;
};

/// The suns of a planner, by key. Those that a frame does not have are forgotten.
class SunCourses {
public:
    void begin();
    /// A light of the frame, in the frame's order; several may have one key.
    const SunCourse& follow(const Light& light, double time_s, Stepping stepping, const StepOptions& options,
                            bool camera_moves = true);
    void end();

private:
    struct Row {
        std::uint32_t key = 0;
        bool present = false;
        SunCourse course;
    };
    std::vector<Row> rows_;
    std::size_t first_ = 0; // before it all rows are present: lights that come as in the frame before are found at once
};

} // namespace gnomon
