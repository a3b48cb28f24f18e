// SPDX-License-Identifier: Apache-2.0
#include "object_casting.h"

#include "setting_values.h"
#include "shot_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace gnomon::app {
namespace {

[[noreturn]] void refuse(std::string_view setting, std::string_view text, std::string_view expected)
{
    throw UsageError(fmt::format("--set {}: \"{}\" is not {}", setting, text, expected));
}

/// NAME and what follows the last colon.
std::pair<std::string_view, std::string_view> parts(std::string_view setting, std::string_view text,
                                                    std::string_view form)
{
    const std::size_t colon = text.rfind(':');
    if (colon == std::string_view::npos || colon == 0 || colon + 1 == text.size()) {
        refuse(setting, text, form);
    }
    return {text.substr(0, colon), text.substr(colon + 1)};
}

bool flagOf(std::string_view text, std::string_view whole)
{
    if (text == "1" || text == "true") {
        return true;
    }
    if (text != "0" && text != "false") {
        refuse("object", whole, "right: casts, receives and moves are true or false");
    }
    return false;
}

std::uint32_t groupsOf(std::string_view setting, std::string_view text, std::string_view whole)
{
    std::uint32_t groups = 0;
    for (const std::string_view piece : split(text, '+')) {
        const std::optional<std::int64_t> group = toInteger(piece);
        if (!group || *group < 0 || *group >= scene::kMostGroups) {
            refuse(setting, whole, "right: groups are numbers from 0 to 31 with + between");
        }
        groups |= 1U << static_cast<std::uint32_t>(*group);
    }
    return groups;
}

void take(std::string_view part, std::string_view whole, scene::Casting& casting)
{
    const std::size_t equals = part.find('=');
    const std::string_view key = part.substr(0, equals);
    const std::string_view text = equals == std::string_view::npos ? std::string_view() : part.substr(equals + 1);
    if (key == "casts") {
        casting.casts = flagOf(text, whole);
    } else if (key == "receives") {
        casting.receives = flagOf(text, whole);
    } else if (key == "moves") {
        casting.moves = flagOf(text, whole);
    } else if (key == "groups") {
        casting.groups = groupsOf("object", text, whole);
    } else if (key == "bias_m") {
        const std::optional<double> bias_m = toNumber(text);
        if (!bias_m || !(std::abs(*bias_m) <= scene::kMostBias_m)) {
            refuse("object", whole, "right: bias_m is a number of metres from -1e6 to 1e6");
        }
        casting.bias_m = static_cast<float>(*bias_m);
    } else {
        refuse("object", whole, "NAME:KEY=VALUE,... with the keys casts, receives, moves, bias_m and groups");
    }
}

/// Each node that has something to draw, or hangs above one that has.
std::vector<bool> drawingNodes(const scene::Scene& scene)
{
    std::vector<bool> draws(scene.nodes.size(), false);
    for (std::size_t i = draws.size(); i-- > 0;) {
        const scene::Node& node = scene.nodes[i];
        draws[i] = draws[i] || node.mesh != scene::kNone;
        if (draws[i] && node.parent != scene::kNone) {
            draws[node.parent] = true;
        }
    }
    return draws;
}

} // namespace

void applyObjects(Settings& settings, const SettingValue& value)
{
    for (const std::string_view text : split(value.text, ';')) {
        const auto [name, said] = parts("object", text, "NAME:KEY=VALUE,...");
        NamedCasting& added = settings.objects.emplace_back(NamedCasting{std::string(name), {}});
        for (const std::string_view part : split(said, ',')) {
            take(part, text, added.casting);
        }
    }
}

void applyLightGroups(Settings& settings, const SettingValue& value)
{
    for (const std::string_view text : split(value.text, ';')) {
        const auto [name, said] = parts("light-groups", text, "NAME:GROUP+GROUP...");
        settings.light_groups.push_back({std::string(name), groupsOf("light-groups", said, text)});
    }
}

void castAsTold(scene::Scene& scene, const Settings& settings)
{
    if (settings.objects.empty()) {
        return;
    }
    const std::vector<bool> draws = drawingNodes(scene);
    for (const auto& [name, casting] : settings.objects) {
        std::vector<std::string_view> names;
        bool found = false;
        for (std::uint32_t i = 0; i < draws.size(); ++i) {
            const std::string& other = scene.nodes[i].name;
            if (draws[i] && other == name) {
                scene::applyBelow(casting, i, scene);
                found = true;
            } else if (draws[i] && !other.empty()) {
                names.push_back(other);
            }
        }
        if (!found) {
            throw UsageError(
                fmt::format("--set object: the scene has no object \"{}\"{}", name, suggestion(name, names)));
        }
    }
}

void groupAsTold(Shot& shot, const Settings& settings)
{
    for (const auto& [name, groups] : settings.light_groups) {
        const std::optional<std::size_t> light = lightNamed(shot, settings, name);
        if (!light) {
            throw UsageError(fmt::format("--set light-groups: there is no light \"{}\"{}", name,
                                         suggestion(name, lightNames(shot))));
        }
        shot.lights[*light].caster.groups = groups;
    }
}

} // namespace gnomon::app
