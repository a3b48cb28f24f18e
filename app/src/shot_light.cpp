// SPDX-License-Identifier: Apache-2.0
// Which of a shot's lights is meant, and whether what was said of lights applies to any.
#include "app/shot.h"

#include <fmt/format.h>

#include <algorithm>

namespace gnomon::app {

std::size_t lightIndex(const Shot& shot, const Settings& settings)
{
    if (settings.light.empty()) {
        return 0;
    }
    std::vector<std::string_view> names;
    for (std::size_t i = 0; i < shot.lights.size(); ++i) {
        if (shot.lights[i].name == settings.light) {
            return i;
        }
        names.push_back(shot.lights[i].name);
    }
    // glTF names the node that holds a light as well; lights are in the order of those nodes.
    std::size_t index = 0;
    for (const scene::Node& node : shot.state.nodes) {
        const bool from_file = !settings.placesLights();
        if (node.light != scene::kNone && from_file) {
            if (node.name == settings.light) {
                return index;
            }
            ++index;
        }
    }
    throw UsageError(fmt::format("--light: there is no light \"{}\"{}; the scene has {}", settings.light,
                                 suggestion(settings.light, names), listed(names)));
}

void requireSizedLights(const Settings& settings, std::span<const host::ShadedLight> lights)
{
    const auto sun = std::count_if(lights.begin(), lights.end(), [](const host::ShadedLight& light) {
        return light.caster.type == LightType::directional;
    });
    if (settings.given.contains("sun-angle") && sun == 0) {
        throw UsageError("--sun-angle has an effect only on a directional light, and there is none");
    }
    if (settings.given.contains("light-size") && sun == static_cast<std::ptrdiff_t>(lights.size())) {
        throw UsageError("--light-size has an effect only on a spot or point light, and there is none");
    }
    const bool spots = std::any_of(lights.begin(), lights.end(),
                                   [](const host::ShadedLight& light) { return light.caster.type == LightType::spot; });
    for (const char* const key : {"spot.cone", "spot.near", "spot.range"}) {
        if (settings.given.contains(key) && !spots) {
            throw UsageError(fmt::format("{} has an effect only on a spot light, and there is none", key));
        }
    }
}

} // namespace gnomon::app
