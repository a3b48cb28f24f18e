// SPDX-License-Identifier: Apache-2.0
// The options of a sun that moves in steps, and of what is kept of a map between frames. A new one is one row here.
#include "setting_rows.h"

#include <glm/trigonometric.hpp>

#include <array>

namespace gnomon::app {
namespace {

using enum SettingType;
using Group = SettingGroup;
using Value = SettingValue;

bool isStepping(const Settings& s)
{
    switch (s.plan.technique.motion) {
    case Motion::free:
    case Motion::snap:
        return false;
    case Motion::step_jump:
    case Motion::step_band:
    case Motion::step_blend:
    case Motion::step_alternate:
        return true;
    }
    return false;
}
bool stepsByAngle(const Settings& s)
{
    return isStepping(s) && s.plan.steps.by == StepBy::angle;
}
bool stepsByTime(const Settings& s)
{
    return isStepping(s) && s.plan.steps.by == StepBy::time;
}
bool hasBand(const Settings& s)
{
    return s.plan.technique.motion == Motion::step_band;
}
/// A jump goes from one position to the next without a share of either.
bool fades(const Settings& s)
{
    return isStepping(s) && s.plan.technique.motion != Motion::step_jump;
}

constexpr std::array<std::string_view, 3> kKeepStill{"auto", "never", "always"}; // as KeepStill has them

void applyKeepStill(Settings& s, const Value& v)
{
    for (std::size_t i = 0; i < kKeepStill.size(); ++i) {
        if (v.text == kKeepStill[i]) {
            s.plan.keep_still = static_cast<KeepStill>(i);
        }
    }
}

const std::vector<Setting>& rows()
{
    static const std::vector<Setting> table{
        // clang-format off
        {.key = "step.by", .group = Group::technique, .type = choice, .form = "NAME", .default_text = "angle", .choices = [] { return std::vector<std::string_view>{"angle", "time"}; },
         .doc = "when a stepping sun takes its next step: after an angle or a time", .own_option = false, .used = isStepping, .used_when = "motion step-jump, -band, -blend or -alternate",
         .apply = [](Settings& s, const Value& v) { s.plan.steps.by = v.text == "time" ? StepBy::time : StepBy::angle; }},
        {.key = "step.angle", .group = Group::technique, .type = real, .form = "A", .unit = "degrees", .default_text = "0.5", .min = 0.01, .max = 28,
         .doc = "of one step; the sun itself is 0.53 across", .own_option = false, .used = stepsByAngle, .used_when = "a motion that steps and step.by angle",
         .apply = [](Settings& s, const Value& v) { s.plan.steps.angle_rad = glm::radians(v.real); }},
        {.key = "step.interval", .group = Group::technique, .type = real, .form = "S", .unit = "s", .default_text = "2", .min = 0.01, .max = 86400,
         .doc = "from step to step, of the scene's time", .own_option = false, .used = stepsByTime, .used_when = "a motion that steps and step.by time",
         .apply = [](Settings& s, const Value& v) { s.plan.steps.interval_s = v.real; }},
        {.key = "step.fade", .group = Group::technique, .type = choice, .form = "NAME", .default_text = "linear", .choices = [] { return std::vector<std::string_view>{"linear", "smooth"}; },
         .doc = "how one position gives way to the next", .own_option = false, .used = fades, .used_when = "motion step-band, -blend or -alternate",
         .apply = [](Settings& s, const Value& v) { s.plan.steps.smooth = v.text == "smooth"; }},
        {.key = "step.band", .group = Group::technique, .type = real, .form = "W", .unit = "of the picture's width", .default_text = "0.25", .min = 0.01, .max = 1,
         .doc = "width of the band in which both positions are mixed", .own_option = false, .used = hasBand, .used_when = "motion step-band",
         .apply = [](Settings& s, const Value& v) { s.plan.steps.band = v.real; }},
        {.key = "keep-still", .group = Group::technique, .type = choice, .form = "NAME", .default_text = "auto", .choices = [] { return std::vector<std::string_view>(kKeepStill.begin(), kKeepStill.end()); },
         .doc = "keep maps of what stands still apart; auto: with motions that step", .own_option = false, .apply = applyKeepStill},
        // clang-format on
    };
    return table;
}

} // namespace

void addStepRows(std::vector<Setting>& table)
{
    table.insert(table.end(), rows().begin(), rows().end());
}

} // namespace gnomon::app
