// SPDX-License-Identifier: Apache-2.0
// The lights of a shot: the one that is meant, those that are taken of too many, whether what was said of lights
// applies to any, and whether they are near enough.
#include "shot_parts.h"

#include "scene/range.h"

#include <gnomon/error.h>
#include <gnomon/world_range.h>

#include <fmt/format.h>

#include <algorithm>

namespace gnomon::app {

std::size_t lightIndex(const Shot& shot, const Settings& settings)
{
    if (settings.light.empty() || shot.lights_chosen) {
        return 0;
    }
    if (const std::optional<std::size_t> light = lightNamed(shot, settings, settings.light)) {
        return *light;
    }
    const std::vector<std::string_view> names = lightNames(shot);
    throw UsageError(fmt::format("--light: there is no light \"{}\"{}; the scene has {}", settings.light,
                                 suggestion(settings.light, names), listed(names)));
}

std::vector<std::string_view> lightNames(const Shot& shot)
{
    std::vector<std::string_view> names;
    for (const host::ShadedLight& light : shot.lights) {
        names.push_back(light.name);
    }
    return names;
}

std::optional<std::size_t> lightNamed(const Shot& shot, const Settings& settings, std::string_view name)
{
    const auto named = std::ranges::find(shot.lights, name, &host::ShadedLight::name);
    if (named != shot.lights.end()) {
        return static_cast<std::size_t>(named - shot.lights.begin());
    }
    // glTF names the node that holds a light as well; lights are in the order of those nodes.
    std::size_t index = 0;
    for (const scene::Node& node : shot.state.nodes) {
        const bool from_file = !settings.placesLights();
        if (node.light != scene::kNone && from_file) {
            if (node.name == name) {
                return index;
            }
            ++index;
        }
    }
    return std::nullopt;
}

void noteSizesWithoutEffect(Shot& shot, const Settings& settings, std::span<const host::ShadedLight> lights)
{
    const auto tell = [&](std::string_view key, std::string_view which) {
        if (!settings.given.contains(key)) {
            return;
        }
        std::string sentence =
            fmt::format("{} has an effect only on a {}, and there is none", spelled(*findSetting(key)), which);
        if (settings.sweep && settings.sweep->key == key) {
            throw UsageError(sentence);
        }
        tellNoEffect(settings, shot.notices, std::move(sentence));
    };
    const auto has = [lights](LightType type) {
        return std::ranges::any_of(lights,
                                   [type](const host::ShadedLight& light) { return light.caster.type == type; });
    };
    const bool has_spot = has(LightType::spot);
    if (!has(LightType::directional)) {
        tell("sun-angle", "directional light");
    }
    if (!has_spot && !has(LightType::point)) {
        tell("light-size", "spot or point light");
    }
    for (const std::string_view key : {"spot.cone", "spot.near", "spot.range"}) {
        if (!has_spot) {
            tell(key, "spot light");
        }
    }
}

void chooseLights(Shot& shot, const Settings& settings)
{
    shot.lights_chosen = false;
    shot.lights_left_out = 0;
    if (shot.lights.size() <= host::kMaxLights) {
        return;
    }
    const Camera camera = host::cameraOf(shot.eye, settings.size_px.x, settings.size_px.y, shot.state.bounds_ws);
    const auto first = static_cast<std::uint32_t>(lightIndex(shot, settings));
    const host::LightsInSight in_sight = host::lightsInSight(shot.lights, camera, shot.state.bounds_ws, first);
    std::vector<host::ShadedLight> chosen;
    chosen.reserve(in_sight.lights.size());
    for (const std::uint32_t light : in_sight.lights) {
        chosen.push_back(shot.lights[light]);
    }
    shot.lights = std::move(chosen);
    shot.lights_chosen = true;
    shot.lights_left_out = in_sight.left_out;
}

std::string leftOutSentence(const Shot& shot)
{
    return fmt::format("{} lights are in sight, and {} is the most: {} that give the least here are left out",
                       shot.lights.size() + shot.lights_left_out, host::kMaxLights, shot.lights_left_out);
}

void requireInRange(const Shot& shot, const Settings& settings)
{
    const std::string tried = "drawing " + settings.scene;
    scene::requireInRange(shot.state, tried);
    const auto require = [&](const std::string& what, bool in_range) {
        if (!in_range) {
            throw Error(tried, fmt::format("{} is more than {} m", what, kFarthestPlace_m));
        }
    };
    require("the camera's distance from the origin", !isTooFar(shot.eye.position_ws));
    for (const host::ShadedLight& light : shot.lights) {
        const Light& caster = light.caster;
        if (caster.type != LightType::directional && caster.casts_shadow) {
            require(fmt::format("the distance of light {} from the origin", light.name), !isTooFar(caster.position_ws));
            require(fmt::format("the range of light {}", light.name), caster.range_m <= kFarthestPlace_m);
            require(fmt::format("the radius of light {}", light.name), caster.radius_m <= kFarthestPlace_m);
        }
    }
}

} // namespace gnomon::app
