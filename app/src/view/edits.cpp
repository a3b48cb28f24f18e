// SPDX-License-Identifier: Apache-2.0
#include "view/edits.h"

#include "debug_views.h"
#include "setting_values.h"

#include <fmt/format.h>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <array>

namespace gnomon::app::view {
namespace {

/// Settings with the same texts, but for one that is left out; in the table's order, as presets have them.
Settings without(const Settings& settings, std::string_view left_out)
{
    Settings made = defaultSettings();
    made.subcommand = settings.subcommand;
    made.scene = settings.scene;
    for (const Setting& setting : settingTable()) {
        const auto value = settings.values.find(setting.key);
        if (value == settings.values.end() || setting.key == left_out || isNotedOnly(settings, setting.key) ||
            value->second.empty()) {
            continue;
        }
        const auto usual = made.values.find(setting.key);
        if (usual != made.values.end() && usual->second == value->second) {
            continue;
        }
        for (const std::string_view piece : setting.repeatable ? split(value->second, setting.separator.front())
                                                               : std::vector<std::string_view>{value->second}) {
            applySetting(made, setting, piece);
        }
    }
    return made;
}

void apply(Settings& settings, std::string_view key, const std::string& text)
{
    if (text.empty()) {
        settings = without(settings, key);
        return;
    }
    replaceCamera(settings, key);
    applySetting(settings, key, text);
    if (key == "filter" && settings.shadow.format && refusal(filterOf(settings.shadow), formatOf(settings.shadow))) {
        settings = without(settings, "map-format"); // it was another filter's
    }
}

} // namespace

bool isNotedOnly(const Settings& settings, std::string_view key)
{
    return (key == "map-format" && !settings.shadow.format) || (key == "border" && !settings.shadow.border_texels);
}

Edited checked(Settings settings)
{
    try {
        validateSettings(settings);
        requireDebugView(settings);
    } catch (const UsageError& error) {
        return {std::nullopt, error.what()};
    }
    return {std::move(settings), ""};
}

Settings withoutTechnique(Settings settings)
{
    for (const Setting& setting : settingTable()) {
        if (setting.group == SettingGroup::technique) {
            settings.values.erase(std::string(setting.key));
        }
    }
    return without(settings, "");
}

Edited edited(const Settings& settings, const Changes& changes)
{
    Settings next = settings;
    try {
        for (const auto& [key, text] : changes) {
            apply(next, key, text);
        }
        completeTechnique(next);
    } catch (const UsageError& error) {
        return {std::nullopt, error.what()};
    }
    return checked(std::move(next));
}

Edited withTechnique(const Settings& settings, std::string_view text)
{
    try {
        return checked(parseTechnique(withoutTechnique(settings), text));
    } catch (const UsageError& error) {
        return {std::nullopt, error.what()};
    }
}

Settings asRender(Settings settings)
{
    settings.subcommand = kRender;
    settings.given.clear(); // what a refused option is called by; here nothing was typed
    return settings;
}

std::string textOf(const glm::dvec3& vector)
{
    return fmt::format("{},{},{}", vector.x, vector.y, vector.z);
}

Changes changesTo(const host::Eye& eye)
{
    return {{"eye", textOf(eye.position_ws)},
            {"target", textOf(eye.target_ws)},
            {"up", textOf(eye.up_ws)},
            {"fov", eye.height_m > 0.0 ? std::string() : fmt::format("{}", glm::degrees(eye.fov_y_rad))},
            {"ortho", eye.height_m > 0.0 ? fmt::format("{}", eye.height_m) : std::string()}};
}

namespace {

bool differs(const Settings& a, const Settings& b, std::string_view key)
{
    const auto in_a = a.values.find(key);
    const auto in_b = b.values.find(key);
    const std::string_view text_a = in_a != a.values.end() ? std::string_view(in_a->second) : std::string_view();
    const std::string_view text_b = in_b != b.values.end() ? std::string_view(in_b->second) : std::string_view();
    return text_a != text_b;
}

} // namespace

bool changesScene(const Settings& from, const Settings& to)
{
    constexpr std::array<std::string_view, 6> kOfScene{"object", "ground", "up-axis", "override-material",
                                                       "seed",   "limit"};
    return from.scene != to.scene ||
           std::any_of(kOfScene.begin(), kOfScene.end(), [&](std::string_view key) { return differs(from, to, key); });
}

bool changesRenderer(const Settings& from, const Settings& to)
{
    const auto groups = settingTable();
    return std::any_of(groups.begin(), groups.end(), [&](const Setting& setting) {
        const bool is_of_renderer = setting.group == SettingGroup::technique ||
                                    setting.group == SettingGroup::picture || setting.key == "debug" ||
                                    setting.key == "truth-pixels";
        return is_of_renderer && setting.key != "size" && differs(from, to, setting.key);
    });
}

} // namespace gnomon::app::view
