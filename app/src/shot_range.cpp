// SPDX-License-Identifier: Apache-2.0
#include "shot_range.h"

#include "scene/range.h"

#include <gnomon/error.h>
#include <gnomon/world_range.h>

#include <fmt/format.h>

namespace gnomon::app {

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
