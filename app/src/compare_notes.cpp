// SPDX-License-Identifier: Apache-2.0
#include "compare_steps.h"

#include "compare_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

namespace gnomon::app {
namespace {

using Notes = std::vector<std::string>;

/// One note for all that have an outcome for the same reason.
void noteOutcomes(const CompareResult& result, Notes& notes)
{
    struct Seen {
        Outcome outcome;
        std::string who;
    };
    std::vector<Seen> seen;
    const auto add = [&](const Outcome& outcome, const std::string& who) {
        if (outcome.kind == OutcomeKind::ok) {
            return;
        }
        const auto same = std::find_if(seen.begin(), seen.end(), [&](const Seen& other) {
            return other.outcome.kind == outcome.kind && other.outcome.reason == outcome.reason;
        });
        if (same == seen.end()) {
            seen.push_back({outcome, who});
        } else if (!same->who.ends_with(who)) {
            same->who += ", " + who;
        }
    };
    for (const ComparedTechnique& technique : result.techniques) {
        add(technique.score.outcome, technique.name);
    }
    for (std::size_t i = 0; result.sweep && i < result.sweep->points.size(); ++i) {
        for (const SweepResult::Point& point : result.sweep->points[i]) {
            add(point.outcome, result.sweep->plan.lines[i].technique);
        }
    }
    for (const Seen& one : seen) {
        const std::string what = one.outcome.hasMap() ? fmt::format("{}", nameOf(one.outcome.kind))
                                                      : "no shadow map, so the mask is all lit";
        notes.push_back(
            fmt::format("light {} with {}: {}: {}", result.light().name, one.who, what, one.outcome.reason));
    }
}

/// Whether truth and pixels are others at each value of a sweep.
bool hasMany(const Json& json)
{
    return json.contains("sweep") && json.at("sweep").contains("truth");
}

/// The member `key`, "truth" or "pixels", for each value of a sweep that has many; else the only one.
Json placesOf(const Json& json, const char* key)
{
    const bool many = hasMany(json);
    return many ? json.at("sweep").at(key) : Json::array({json.at(key)});
}

void notePixels(const Json& json, Notes& notes)
{
    const Json pixels = placesOf(json, "pixels");
    const Json truths = placesOf(json, "truth");
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        const std::string where =
            hasMany(json) ? placeText(textAt(json, "/sweep/key"), json.at("sweep").at("values")[i].get<double>()) + ": "
                          : "";
        if (const std::string note = pixelsNote(pixels[i], truths[i].at("rays").get<std::uint64_t>()); !note.empty()) {
            notes.push_back(where + note);
        }
    }
}

/// Notes that the light has no extent, unless a sweep has values with one.
void noteSize(const CompareResult& result, const Json& json, Notes& notes)
{
    const Json truths = placesOf(json, "truth");
    if (std::all_of(truths.begin(), truths.end(),
                    [](const Json& truth) { return truth.at("requested") == "area" && truth.at("kind") == "hard"; })) {
        const host::ShadedLight& light = result.light();
        notes.push_back(fmt::format("light {} has no extent, so its area truth is the hard one; {} gives it one",
                                    light.name,
                                    light.caster.type == LightType::directional ? "--sun-angle" : "--light-size"));
    }
}

/// Notes the results that a path could not have.
void notePath(const CompareResult& result, Notes& notes)
{
    if (result.path->frames.first == result.path->frames.last) {
        notes.emplace_back("a path of one frame has no change from frame to frame, so there is no stability");
        return;
    }
    const auto& first = *result.techniques.front().path;
    if (!first.stability) {
        notes.emplace_back("no pixel that counts is found in the frame before it, so there is no shimmer and no pop");
    }
    const auto empty = std::count(first.rmse.begin(), first.rmse.end(), std::nullopt);
    if (empty != 0 && static_cast<std::size_t>(empty) != first.rmse.size()) {
        notes.push_back(fmt::format("in {} of {} frames no pixel counts; the errors are means over the others", empty,
                                    first.rmse.size()));
    }
}

} // namespace

std::string pixelsNote(const Json& pixels, std::uint64_t rays)
{
    constexpr std::uint64_t kFew = 20; // one in twenty
    const auto counted = pixels.at("counted").get<std::uint64_t>();
    if (counted == 0) {
        return fmt::format("no pixel counts, so there are no error numbers: {}{}", pixelsText(pixels),
                           rays == 0 ? "; no ray was traced" : "");
    }
    const std::uint64_t surface = counted + pixels.at("left_out").get<std::uint64_t>() -
                                  pixels.at("left_out_by_reason").at("background").get<std::uint64_t>();
    if (counted * kFew >= surface) {
        return "";
    }
    return fmt::format("only {} of {} pixels with a surface count, so the error numbers say little of the picture: {}",
                       counted, surface, pixelsText(pixels));
}

std::vector<std::string> compareNotes(const CompareResult& result, const Json& json)
{
    Notes notes;
    notePixels(json, notes);
    noteOutcomes(result, notes);
    noteSize(result, json, notes);
    if (result.path) {
        notePath(result, notes);
    }
    if (result.sweep) {
        const SweepPlan& plan = result.sweep->plan;
        notes.insert(notes.end(), plan.left_out.begin(), plan.left_out.end());
        if (plan.ends_automatic_bias) {
            notes.push_back(
                fmt::format("{} ends the automatic bias: where the sweep sets one part, the others are 0", plan.key));
        }
    }
    return notes;
}

} // namespace gnomon::app
