// SPDX-License-Identifier: Apache-2.0
// The options of a sun that moves in steps, and of what is kept of a map between frames. A new one is one row here.
#include "options/option_access.h"
#include "options/option_rows.h"

#include <glm/trigonometric.hpp>

namespace gnomon {
namespace {

using enum OptionType;

bool isStepping(const ShadowOptions& o)
{
    const Motion motion = o.technique.motion;
    return motion != Motion::free && motion != Motion::snap;
}
bool stepsByAngle(const ShadowOptions& o)
{
    return isStepping(o) && o.steps.by == StepBy::angle;
}
bool stepsByTime(const ShadowOptions& o)
{
    return isStepping(o) && o.steps.by == StepBy::time;
}
bool hasBand(const ShadowOptions& o)
{
    return o.technique.motion == Motion::step_band;
}
bool jumps(const ShadowOptions& o)
{
    return o.technique.motion == Motion::step_jump;
}
bool waits(const ShadowOptions& o)
{
    return jumps(o) && o.steps.wait != StepWait::none;
}
/// A jump goes from one position to the next without a share of either.
bool fades(const ShadowOptions& o)
{
    return isStepping(o) && o.technique.motion != Motion::step_jump;
}

void setAngle(ShadowOptions& o, const OptionValue& value)
{
    o.steps.angle_rad = glm::radians(value.real);
}
OptionValue getAngle(const ShadowOptions& o)
{
    return valueOf(glm::degrees(o.steps.angle_rad));
}

void setFade(ShadowOptions& o, const OptionValue& value)
{
    o.steps.smooth = value.text == "smooth";
}
OptionValue getFade(const ShadowOptions& o)
{
    OptionValue value;
    value.text = o.steps.smooth ? "smooth" : "linear";
    return value;
}
std::vector<std::string_view> fadeNames()
{
    return {"linear", "smooth"};
}

} // namespace

void addStepRows(std::vector<OptionRow>& table)
{
    const OptionRow rows[]{
        // clang-format off
        {.key = "step.by", .type = choice, .form = "NAME", .choices = namesOf<StepBy>, .doc = "when a stepping sun takes its next step: after an angle or a time", .used = isStepping, .used_when = "motion step-jump, -band, -blend or -alternate", GNOMON_MEMBER(steps.by)},
        {.key = "step.angle", .type = real, .form = "A", .unit = "degrees", .min = 0.01, .max = 28, .doc = "of one step; the sun itself is 0.53 across", .used = stepsByAngle, .used_when = "a motion that steps and step.by angle", .get = getAngle, .set = setAngle},
        {.key = "step.interval", .type = real, .form = "S", .unit = "s", .min = 0.01, .max = 86400, .doc = "from step to step, of the scene's time", .used = stepsByTime, .used_when = "a motion that steps and step.by time", GNOMON_MEMBER(steps.interval_s)},
        {.key = "step.fade", .type = choice, .form = "NAME", .choices = fadeNames, .doc = "how one position gives way to the next", .used = fades, .used_when = "motion step-band, -blend or -alternate", .get = getFade, .set = setFade},
        {.key = "step.band", .type = real, .form = "W", .unit = "of the picture's width", .min = 0.01, .max = 1, .doc = "width of the band in which both positions are mixed", .used = hasBand, .used_when = "motion step-band", GNOMON_MEMBER(steps.band)},
        {.key = "step.wait", .type = choice, .form = "NAME", .choices = namesOf<StepWait>, .doc = "what a jump that is due waits for: nothing, or the camera to move", .used = jumps, .used_when = "motion step-jump", GNOMON_MEMBER(steps.wait)},
        {.key = "step.longest-wait", .type = real, .form = "S", .unit = "s", .min = 0, .max = 86400, .doc = "after which it waits no longer, of the scene's time", .used = waits, .used_when = "motion step-jump and step.wait camera", GNOMON_MEMBER(steps.longest_wait_s)},
        {.key = "keep-still", .type = choice, .form = "NAME", .choices = namesOf<KeepStill>, .doc = "keep maps of what stands still apart; auto: with motions that step", .used = hasMaps, .used_when = "every filter but volumes", GNOMON_MEMBER(keep_still)},
        // clang-format on
    };
    table.insert(table.end(), std::begin(rows), std::end(rows));
}

} // namespace gnomon
