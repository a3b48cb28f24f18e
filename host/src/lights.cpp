// SPDX-License-Identifier: Apache-2.0
// From the scene's model to the frame's: lights and object bounds.
#include "host/view.h"

#include "scene/pieces.h"

#include <algorithm>
#include <map>
#include <utility>

namespace gnomon::host {
namespace {

LightType typeOf(scene::LightType type)
{
    switch (type) {
    case scene::LightType::spot:
        return LightType::spot;
    case scene::LightType::point:
        return LightType::point;
    case scene::LightType::directional:
        break;
    }
    return LightType::directional;
}

} // namespace

void setBrightness(ShadedLight& light)
{
    const glm::vec3 gives = light.colour * light.strength;
    light.caster.brightness = glm::dot(glm::dvec3(gives), glm::dvec3(0.2126, 0.7152, 0.0722));
}

std::vector<ShadedLight> lightsOf(const scene::Scene& scene, const scene::State& state)
{
    std::vector<ShadedLight> lights;
    lights.reserve(state.lights.size());
    for (std::size_t i = 0; i < state.lights.size(); ++i) {
        const scene::PlacedLight& placed = state.lights[i];
        const scene::Light& source = scene.lights[placed.light];
        ShadedLight light;
        light.name = source.name;
        light.caster.key = static_cast<std::uint32_t>(i);
        light.caster.type = typeOf(source.type);
        light.caster.position_ws = placed.position_ws;
        light.caster.direction_ws = glm::normalize(glm::dvec3(placed.direction_ws));
        light.caster.outer_half_angle_rad = source.outer_cone_rad;
        light.caster.range_m = source.range_m;
        light.caster.angular_diameter_rad = source.angular_diameter_rad;
        light.caster.radius_m = source.radius_m;
        light.caster.groups = source.groups;
        light.caster.casts_shadow = source.casts_shadow && placed.strength != glm::vec3(0.0F);
        light.colour = source.colour * source.intensity;
        light.strength = placed.strength;
        light.inner_half_angle_rad = source.inner_cone_rad;
        light.up_ws = placed.up_ws;
        light.cookie = source.cookie;
        light.body = source.body;
        setBrightness(light);
        lights.push_back(light);
    }
    return lights;
}

std::vector<std::uint16_t> pieceCounts(const scene::Scene& scene, const scene::State& state)
{
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint16_t> known; // by mesh and primitive
    std::vector<std::uint16_t> counts;
    counts.reserve(state.objects.size());
    for (const scene::Object& object : state.objects) {
        const auto [found, fresh] = known.try_emplace({object.mesh, object.primitive}, std::uint16_t{0});
        if (fresh) {
            const scene::Primitive& primitive = scene.meshes[object.mesh].primitives[object.primitive];
            found->second = static_cast<std::uint16_t>(scene::piecesOf(primitive).count);
        }
        counts.push_back(found->second);
    }
    return counts;
}

void fillObjectSet(const scene::State& state, ObjectSet& objects, std::span<const std::uint8_t> closed,
                   std::span<const std::uint16_t> pieces, std::span<const std::uint8_t> joined)
{
    const std::uint32_t known = objects.size();
    for (std::uint32_t i = 0; i < state.objects.size(); ++i) {
        const scene::Object& object = state.objects[i];
        if (i >= known) {
            const bool is_closed = i < closed.size() && closed[i] != 0;
            const std::uint16_t count = i < pieces.size() ? pieces[i] : std::uint16_t{0};
            const bool is_joined = i < joined.size() && joined[i] != 0;
            objects.add(object.bounds_ws, {.casts = object.casts,
                                           .receives = object.receives,
                                           .dynamic = object.dynamic,
                                           .closed = is_closed,
                                           .pieces = count,
                                           .joined = is_joined,
                                           .groups = object.groups});
        } else if (object.dynamic) {
            (void)objects.update(objects.idAt(i), object.bounds_ws);
        }
    }
}

} // namespace gnomon::host
