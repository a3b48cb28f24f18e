// SPDX-License-Identifier: Apache-2.0
#include "sweep.h"

#include "app/shot.h"
#include "compare_table.h"
#include "report_pages.h"
#include "setting_values.h"
#include "technique_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace gnomon::app {
namespace {

/// As one would type it: twelve digits hide what binary fractions make of 0.1. Whole numbers have all of theirs.
std::string valueText(double value)
{
    return std::floor(value) == value ? fmt::format("{:.0f}", value + 0.0) : fmt::format("{:.12g}", value);
}

std::vector<double> sweepValues(const Sweep& sweep, const Setting& setting)
{
    const bool whole = setting.type == SettingType::integer;
    const double unit = static_cast<double>(setting.multiple_of);
    std::vector<double> values;
    for (std::uint32_t i = 0; i < sweep.steps; ++i) {
        const double share = static_cast<double>(i) / static_cast<double>(sweep.steps - 1);
        double value = sweep.logarithmic ? sweep.from * std::pow(sweep.to / sweep.from, share)
                                         : sweep.from + (sweep.to - sweep.from) * share;
        value = whole ? std::round(value / unit) * unit : toNumber(valueText(value)).value_or(value);
        if (values.empty() || values.back() != value) {
            values.push_back(value);
        }
    }
    return values;
}

/// Applies one value; false when it has no effect on the technique.
bool applyPoint(Settings& settings, const Setting& setting, double value)
{
    applySetting(settings, setting, valueText(value));
    completeTechnique(settings);
    return isUsed(setting, settings);
}

/// "#0072b2"
} // namespace

SweepPlan planSweep(const Sweep& sweep, const std::vector<Settings>& techniques)
{
    const Setting* setting = findSetting(sweep.key);
    assert(setting != nullptr && sweep.steps >= 2);
    SweepPlan plan;
    plan.key = setting->key;
    plan.unit = setting->unit;
    plan.logarithmic = sweep.logarithmic;
    plan.remakes_shot = setting->group != SettingGroup::technique;
    plan.values = sweepValues(sweep, *setting);
    for (const Settings& technique : techniques) {
        SweepPlan::Line line;
        line.technique = describeTechnique(technique);
        bool used = true;
        for (const double value : plan.values) {
            line.points.push_back(technique);
            used = applyPoint(line.points.back(), *setting, value) && used;
        }
        if (!used) {
            plan.left_out.push_back(fmt::format("{} is left out: {} has an effect only with {}", line.technique,
                                                plan.key, setting->used_when));
            continue;
        }
        if (technique.shadow.bias.automatic && !line.points.front().shadow.bias.automatic) {
            plan.ends_automatic_bias = true;
        }
        line.technique = withoutParts(describeTechnique(line.points.front()), placeText(plan.key, plan.values.front()));
        for (const SweepPlan::Line& other : plan.lines) {
            if (describeTechnique(other.points.front()) == describeTechnique(line.points.front())) {
                throw UsageError(fmt::format("--sweep: {} is twice among the techniques once {} is swept",
                                             line.technique, plan.key));
            }
        }
        plan.lines.push_back(std::move(line));
    }
    if (plan.lines.empty()) {
        throw UsageError(fmt::format("--sweep: {} has an effect only with {}", plan.key, setting->used_when));
    }
    return plan;
}

Settings settingsAt(const SweepPlan& plan, std::size_t value, const Settings& settings)
{
    Settings changed = settings;
    applySetting(changed, plan.key, valueText(plan.values[value]));
    changed.given[plan.key] = true; // so that it is refused where the shot has nothing that it could change
    return changed;
}

std::string placeText(const std::string& key, double value)
{
    return fmt::format("{}={}", key, valueText(value));
}

SweepResult runSweep(const host::SceneOnGpu& scene, SweepPlan plan, const JudgedAt& judged_at,
                     const std::function<void()>& step)
{
    SweepResult result;
    result.plan = std::move(plan);
    result.points.resize(result.plan.lines.size());
    for (std::size_t value = 0; value < result.plan.values.size(); ++value) {
        const Judged& judged = judged_at(value);
        std::optional<host::SceneOnGpu> other; // the scene of a shot that the value has made anew
        if (value > 0 && result.plan.remakes_shot) {
            other.emplace(scene.gpu(), *judged.subject.scene, *judged.subject.state);
        }
        for (std::size_t line = 0; line < result.plan.lines.size(); ++line) {
            const Settings& settings = result.plan.lines[line].points[value];
            const lab::Score score = lab::scoreTechnique(other ? *other : scene, judged.subject, judged.truth,
                                                         renderOptions(settings), false, settings.converge);
            result.points[line].push_back(
                {score.error, score.classification ? std::optional(score.classification->errors) : std::nullopt,
                 score.outcome});
            if (line == 0 && (value == 0 || result.plan.remakes_shot)) {
                result.places.push_back({judged.facts, lab::truthNoise(judged.truth.visibility, score.pixels.counted),
                                         score.pixels.counts});
            }
            step();
        }
    }
    return result;
}

Json sweepJson(const SweepResult& result)
{
    Json json{{"key", result.plan.key},
              {"unit", result.plan.unit.empty() ? Json(nullptr) : Json(result.plan.unit)},
              {"logarithmic", result.plan.logarithmic},
              {"values", result.plan.values}};
    json["class_colours"] = pageLegends().at("classes");
    json["results"] = Json::array();
    for (std::size_t i = 0; i < result.plan.lines.size(); ++i) {
        Json line{{"technique", result.plan.lines[i].technique}};
        for (const SweepResult::Point& point : result.points[i]) {
            const Json error = errorJson(point.error, point.classes);
            for (const auto& [key, number] : error.items()) {
                line[key].push_back(number);
            }
        }
        line["settings"] = repeatJson(result.plan.lines[i].points.front(), kCompare);
        line["settings"].erase(result.plan.key);
        json["results"].push_back(line);
    }
    return json;
}

} // namespace gnomon::app
