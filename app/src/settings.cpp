// SPDX-License-Identifier: Apache-2.0
#include "app/settings.h"

#include "app/scripted_path.h"
#include "contestants.h"
#include "setting_rows.h"
#include "setting_values.h"

#include <gnomon/choices.h>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace gnomon::app {
namespace {

void validateCamera(const Settings& s)
{
    if (!s.camera.empty() && (s.eye_ws || s.target_ws)) {
        throw UsageError("--camera and --eye both say where the camera is; give one");
    }
    if (s.eye_ws.has_value() != s.target_ws.has_value()) {
        throw UsageError(s.eye_ws ? "--eye needs --target" : "--target needs --eye");
    }
    if (!s.eye_ws) {
        return;
    }
    const glm::dvec3 forward = *s.target_ws - *s.eye_ws;
    const double distance = glm::length(forward);
    // Relative to the coordinates: two points that single precision cannot tell apart are one.
    if (!(distance > 1e-7 * (1e-3 + glm::length(*s.eye_ws)))) {
        throw UsageError("--eye and --target are the same point");
    }
    if (glm::length(glm::cross(forward / distance, s.up_ws)) < 1e-6) {
        throw UsageError("--up is parallel to the line from --eye to --target");
    }
}

/// How many depths layers placed by hand were given.
std::size_t splitCount(const MomentOptions& moments)
{
    return static_cast<std::size_t>(
        std::count_if(moments.splits.begin(), moments.splits.end(), [](float split) { return split != 0.0F; }));
}

constexpr std::string_view kPlacement = "lvsm.placement";

/// Throws UsageError for options of a filterable map that contradict each other.
void requireMoments(const Settings& settings)
{
    const Filter filter = filterOf(settings.shadow);
    const MapFormat format = formatOf(settings.shadow);
    const MomentOptions& moments = settings.shadow.moments;
    if (filter == Filter::lvsm && moments.placement == LayerPlacement::by_hand &&
        splitCount(moments) + 1 != moments.layers) {
        const std::size_t given = splitCount(moments);
        throw UsageError(fmt::format("--set lvsm.splits: {} layers placed by hand need {} of them; {} given",
                                     moments.layers, moments.layers - 1,
                                     given == 1 ? "1 is" : fmt::format("{} are", given)));
    }
    if (const auto reason = refusal(filter, format, moments)) {
        throw UsageError(fmt::format("filter {} with map-format {}: {}", nameOf(filter), nameOf(format), *reason));
    }
}

/// Where two settings say one thing, notes the value that the library has for the other one after this one was applied.
void noteTakenBack(Settings& settings, const Setting& setting)
{
    constexpr std::array<std::array<std::string_view, 2>, 5> kPairs{{{"cascades.count", "cascades.ends"},
                                                                     {"lvsm.placement", "lvsm.splits"},
                                                                     {"lvsm.placement", "lvsm.world"},
                                                                     {"lvsm.layers", "lvsm.world"},
                                                                     {"lvsm.splits", "lvsm.world"}}};
    for (const auto& [one, list] : kPairs) {
        if (setting.key != one && setting.key != list) {
            continue;
        }
        const OptionRow& other = *findOption(setting.key == one ? list : one);
        const OptionValue value = other.get(settings.shadow);
        if (value.none || value.numbers.empty() != (other.type != OptionType::numbers)) {
            settings.values.erase(std::string(other.key));
        } else {
            settings.values[std::string(other.key)] = textOf(other, value);
        }
    }
}

} // namespace

std::span<const Setting> settingTable()
{
    static const std::vector<Setting> table = [] {
        std::vector<Setting> made;
        addSceneRows(made);
        addTechniqueRows(made);
        addRunRows(made);
        return made;
    }();
    return table;
}

void applyValue(Settings& settings, const Setting& setting, const SettingValue& value)
{
    if (setting.option != nullptr) {
        setting.option->set(settings.shadow, value);
    } else {
        setting.apply(settings, value);
    }
}

bool isUsed(const Setting& setting, const Settings& settings)
{
    if (setting.option != nullptr) {
        return setting.option->used == nullptr || setting.option->used(settings.shadow);
    }
    return setting.used == nullptr || setting.used(settings);
}

std::string spelled(const Setting& setting)
{
    return fmt::format("{}{}", setting.own_option ? "--" : "--set ", setting.key);
}

const Setting* findSetting(std::string_view key)
{
    for (const Setting& setting : settingTable()) {
        if (setting.key == key) {
            return &setting;
        }
    }
    return nullptr;
}

void refuseKey(std::string_view key)
{
    std::vector<std::string_view> keys;
    for (const Setting& row : settingTable()) {
        keys.push_back(row.key);
    }
    throw UsageError(
        fmt::format("there is no setting \"{}\"{}; `gnomon list settings` shows them all", key, suggestion(key, keys)));
}

Settings defaultSettings()
{
    Settings settings;
    for (const Setting& setting : settingTable()) {
        if (!setting.default_text.empty()) {
            applySetting(settings, setting, setting.default_text);
        }
    }
    return settings;
}

void applySetting(Settings& settings, const Setting& setting, std::string_view text)
{
    const SettingValue parsed = parseValue(setting, text);
    applyValue(settings, setting, parsed);
    if (setting.key == "technique") { // kept as its parts, so that there is one way to write it down
        return;
    }
    noteTakenBack(settings, setting);
    std::string& value = settings.values[std::string(setting.key)];
    const std::string said = textOf(setting, parsed, text);
    value = setting.repeatable && !value.empty() ? fmt::format("{}{}{}", value, setting.separator, said) : said;
    if (setting.key == "map-format") {
        settings.format_preset.clear();
    }
    if (setting.key == "bias") { // says all of it: parts given before no longer hold
        std::erase_if(settings.values, [](const auto& entry) { return entry.first.starts_with("bias."); });
        if (text != "auto" && text != "none") { // kept as its parts, so that there is one way to write it down
            value = "none";
            for (const std::string_view part : split(text, ',')) {
                const std::size_t equals = part.find('=');
                const Setting& of_part = *findSetting(fmt::format("bias.{}", part.substr(0, equals)));
                const std::string_view number = part.substr(equals + 1);
                settings.values[std::string(of_part.key)] = textOf(of_part, parseValue(of_part, number), number);
            }
        }
    } else if (setting.key.starts_with("bias.") && settings.values["bias"] == "auto") {
        settings.values["bias"] = "none";
    }
}

void applySetting(Settings& settings, std::string_view key, std::string_view text)
{
    const Setting* setting = findSetting(key);
    if (setting == nullptr) {
        refuseKey(key);
    }
    applySetting(settings, *setting, text);
}

void replaceCamera(Settings& settings, std::string_view latest)
{
    if (latest == "eye" || latest == "target") {
        settings.camera.clear();
        settings.values.erase("camera");
    } else if (latest == "camera") {
        settings.eye_ws.reset();
        settings.target_ws.reset();
        settings.values.erase("eye");
        settings.values.erase("target");
    }
}

std::span<const std::string_view> placementPartners(std::string_view key)
{
    static constexpr std::array<std::string_view, 3> kKeys{"lvsm.splits", kPlacement, "lvsm.world"};
    if (key == kPlacement) {
        static constexpr std::array<std::string_view, 2> kLists{kKeys[0], kKeys[2]};
        return kLists;
    }
    return key == kKeys[0]   ? std::span(kKeys).last(2)
           : key == kKeys[2] ? std::span(kKeys).first(2)
                             : std::span<const std::string_view>();
}

void requireOnePlacement(const Settings& settings, std::string_view key, std::string_view text,
                         std::string_view partner)
{
    if (key != kPlacement && partner != kPlacement) {
        throw UsageError(
            "lvsm.splits are of layers placed by hand, lvsm.world of layers of the world; give one of them");
    }
    const std::string_view placement = key == kPlacement ? text : settings.values.at(std::string(kPlacement));
    const bool by_hand = (key == kPlacement ? partner : key) == "lvsm.splits";
    if (placement != nameOf(by_hand ? LayerPlacement::by_hand : LayerPlacement::world)) {
        throw UsageError(
            by_hand ? fmt::format("lvsm.splits are of layers placed by hand, not of lvsm.placement {}", placement)
                    : fmt::format("lvsm.world are layers of the world, not of lvsm.placement {}", placement));
    }
}

void forgetTechniques(Settings& settings)
{
    settings.techniques.clear();
    settings.technique_places.clear();
    settings.values.erase("techniques");
}

void validateSettings(const Settings& settings)
{
    validateCamera(settings);
    if (settings.frames && settings.frames->first > settings.frames->last) {
        throw UsageError(fmt::format("--frames: {}-{} runs backwards", settings.frames->first, settings.frames->last));
    }
    validatePath(settings);
    if (settings.sweep && settings.given.contains(settings.sweep->key)) {
        throw UsageError(fmt::format("{} and --sweep both say what {} is; give one",
                                     spelled(*findSetting(settings.sweep->key)), settings.sweep->key));
    }
    if (settings.sweep && settings.equal_error) {
        throw UsageError("--equal-error is of times, which a --sweep does not measure");
    }
    if (!settings.technique.empty() && settings.given.contains("techniques")) {
        throw UsageError("--technique and --techniques both say what is held against what; give one");
    }
    if (hasManyTechniques(settings)) {
        (void)contestants(settings); // throws for what is no technique
    }
}

void completeTechnique(Settings& settings)
{
    const ShadowOptions& shadow = settings.shadow;
    // The light comes later: this refuses what no light can have.
    if (const auto reason = refusal(shadow.technique)) {
        throw UsageError(std::string(*reason));
    }
    const MapFormat format = formatOf(shadow);
    if (const auto reason = refusal(filterOf(shadow), format)) {
        const std::string refused =
            fmt::format("{} cannot be had with filter {}: {}", nameOf(format), nameOf(filterOf(shadow)), *reason);
        throw UsageError(settings.format_preset.empty() ? fmt::format("--map-format: {}", refused)
                                                        : fmt::format("preset {}: map-format {}; add --map-format",
                                                                      settings.format_preset, refused));
    }
    requireMoments(settings);
    const Resolution resolution = resolve(shadow);
    if (!resolution) {
        throw UsageError(resolution.refusal);
    }
    settings.values["map-format"] = nameOf(format);
    settings.values["border"] = fmt::format("{}", resolution->border_texels());
}

} // namespace gnomon::app
