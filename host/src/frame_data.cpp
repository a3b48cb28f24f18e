// SPDX-License-Identifier: Apache-2.0
#include "frame_data.h"

#include <gnomon/error.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace gnomon::host {
namespace {

void fillLight(LightData& out, const ShadedLight& light, const Sight& sight, const glm::dvec3& colour, int cookie_layer)
{
    const Light& caster = light.caster;
    const glm::dvec3 towards = -caster.direction_ws;
    const glm::dvec3 place = caster.position_ws - sight.eye_ws;
    const bool directional = caster.type == LightType::directional;
    const float type = directional ? 0.0F : (caster.type == LightType::spot ? 1.0F : 2.0F);
    out.place = glm::vec4(glm::vec3(directional ? towards : place), type);
    const double inverse_range = caster.range_m > 0.0 ? 1.0 / caster.range_m : 0.0;
    out.colour = glm::vec4(glm::vec3(colour), static_cast<float>(inverse_range));
    out.axis = glm::vec4(glm::vec3(caster.direction_ws), static_cast<float>(cookie_layer));
    // KHR_lights_punctual: (cos a - cos outer) / (cos inner - cos outer), clamped, squared.
    const double cos_outer = std::cos(caster.outer_half_angle_rad);
    const double cos_inner = std::cos(std::min(light.inner_half_angle_rad, caster.outer_half_angle_rad));
    const double cone = 1.0 / std::max(cos_inner - cos_outer, 1e-3);
    out.cone = {cone, -cos_outer * cone, 1.0 / std::tan(std::max(caster.outer_half_angle_rad, 1e-3)), 0.0};
    const glm::dvec3 right = glm::cross(caster.direction_ws, glm::dvec3(light.up_ws));
    const double length = glm::length(right);
    out.right = glm::vec4(glm::vec3(length > 0.0 ? right / length : glm::dvec3(1.0, 0.0, 0.0)), 0.0F);
}

void fillSkylight(FrameData& data, const FrameLight& light)
{
    for (std::size_t c = 0; c < 3; ++c) {
        data.skylight[c] = glm::vec4(light.skylight.linear[c]);
        data.skylight[3 + c] = glm::vec4(light.skylight.square[c]);
    }
    data.skylight[6] = glm::vec4(glm::vec3(light.skylight.across), static_cast<float>(light.emission));
}

/// As sky_numbers.glsl reads it.
void fillSky(FrameData& data, const FrameLight& light)
{
    data.sky = {};
    data.sky[0] = glm::vec4(glm::vec3(light.zenith), 0.0F);
    data.sky[1] = glm::vec4(glm::vec3(light.horizon), 0.0F);
    for (std::size_t i = 0; light.physical && i < kSkyBodies; ++i) {
        const SkyBody& body = light.bodies[i];
        data.sky[3 * i] = glm::vec4(glm::vec3(body.towards_ws), 0.0F);
        data.sky[3 * i + 1] = glm::vec4(glm::vec3(body.disc), static_cast<float>(body.cos_radius));
    }
    const auto times = [&](std::size_t i) {
        const SkyBody& body = light.bodies[i];
        return body.under != nullptr ? glm::vec3(body.times * body.under->largest) : glm::vec3(0.0F);
    };
    data.sky[6] = glm::vec4(times(0).x, times(1)); // the sun's are all one
    data.sky[2] = glm::vec4(glm::vec3(light.ground), static_cast<float>(light.stars));
    data.sky[5] = glm::vec4(glm::vec3(light.night), 0.0F);
}

} // namespace

Sight sightOf(const Eye& eye, std::uint32_t width, std::uint32_t height, const Aabb& bounds)
{
    constexpr const char* kTried = "placing the camera";
    Sight sight;
    sight.eye_ws = eye.position_ws;
    const glm::dvec3 look = eye.target_ws - eye.position_ws;
    const double distance = glm::length(look);
    if (!(distance > 0.0) || !std::isfinite(distance)) {
        throw Error(kTried, "the eye is at its target", "move one of them");
    }
    sight.orthographic = eye.height_m > 0.0;
    if (!sight.orthographic && !(eye.fov_y_rad > 0.0 && eye.fov_y_rad < std::numbers::pi)) {
        throw Error(kTried, "the vertical field of view is not between 0 and 180 degrees");
    }
    sight.forward_ws = look / distance;
    glm::dvec3 right = glm::cross(sight.forward_ws, eye.up_ws);
    if (glm::length(right) < 1e-9 * glm::length(eye.up_ws)) {
        // Straight up or down: any direction across will do, and this one is the same every time.
        right = glm::cross(sight.forward_ws,
                           std::abs(sight.forward_ws.x) < 0.5 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 0.0, 1.0));
    }
    sight.right_ws = glm::normalize(right);
    sight.up_ws = glm::cross(sight.right_ws, sight.forward_ws);
    sight.half_y = pictureHeight(eye, 1.0) * 0.5;
    sight.half_x = sight.half_y * static_cast<double>(width) / static_cast<double>(height);
    const double diagonal = bounds.empty() ? 1.0 : glm::length(glm::dvec3(bounds.extent()));
    // Between things far apart the diagonal says nothing of what is looked at.
    const double least_m = std::min(diagonal / 20000.0, distance / 100.0);
    sight.near_m = eye.near_m > 0.0 || sight.orthographic ? eye.near_m : least_m;
    sight.far_m = eye.far_m;
    if (!(sight.far_m > 0.0)) {
        double farthest = 0.0;
        for (int i = 0; i < 8 && !bounds.empty(); ++i) {
            farthest = std::max(farthest, glm::dot(glm::dvec3(bounds.corner(i)) - sight.eye_ws, sight.forward_ws));
        }
        sight.far_m = farthest * 1.01;
    }
    sight.far_m = std::max(sight.far_m, sight.near_m + (sight.orthographic ? least_m : sight.near_m));
    return sight;
}

glm::dmat4 clipFromEye(const Sight& s)
{
    if (s.orthographic) {
        // z_clip = (far - d) / (far - near).
        const glm::dvec3 across = s.right_ws / s.half_x;
        const glm::dvec3 down = -s.up_ws / s.half_y;
        const double scale = 1.0 / (s.far_m - s.near_m);
        const glm::dvec3 towards = -s.forward_ws * scale;
        return {glm::dvec4(across.x, down.x, towards.x, 0.0), glm::dvec4(across.y, down.y, towards.y, 0.0),
                glm::dvec4(across.z, down.z, towards.z, 0.0), glm::dvec4(s.jitter, s.far_m * scale, 1.0)};
    }
    const glm::dvec3 x = s.right_ws / s.half_x + s.forward_ws * s.jitter.x;
    const glm::dvec3 y = -s.up_ws / s.half_y + s.forward_ws * s.jitter.y;
    // z_clip = near (far - d) / (far - near) and w = d, d the view depth: 1 at the near plane, 0 at the far plane.
    const double k = s.near_m / (s.far_m - s.near_m);
    const glm::dvec3 z = -k * s.forward_ws;
    const glm::dvec3 w = s.forward_ws;
    return {glm::dvec4(x.x, y.x, z.x, w.x), glm::dvec4(x.y, y.y, z.y, w.y), glm::dvec4(x.z, y.z, z.z, w.z),
            glm::dvec4(0.0, 0.0, k * s.far_m, 0.0)};
}

Camera cameraOf(const Eye& eye, std::uint32_t width, std::uint32_t height, const Aabb& scene_bounds_ws)
{
    return cameraOf(sightOf(eye, width, height, scene_bounds_ws), {width, height});
}

Camera cameraOf(const Sight& sight, const glm::dvec2& drawn_px)
{
    Camera camera;
    camera.eye_ws = sight.eye_ws;
    camera.clip_from_world = clipFromEye(sight);
    camera.clip_from_world[3] += camera.clip_from_world * glm::dvec4(-sight.eye_ws, 0.0);
    camera.jitter_px = sight.jitter * 0.5 * drawn_px;
    return camera;
}

float maskSlot(std::uint32_t layer, std::uint32_t channel, bool coloured)
{
    return static_cast<float>(layer * 8 + (coloured ? 4 : 0) + channel);
}

void fillFrameData(FrameData& data, const Sight& sight, std::uint32_t width, std::uint32_t height,
                   std::span<const ShadedLight> lights, std::span<const int> cookie_layers, const FrameLight& light,
                   bool has_mask)
{
    data.clip_from_eye = glm::mat4(clipFromEye(sight));
    const glm::dvec3 step_x = sight.right_ws * (2.0 * sight.half_x / width);
    const glm::dvec3 step_y = sight.up_ws * (-2.0 * sight.half_y / height);
    const glm::dvec3 corner = (sight.orthographic ? glm::dvec3(0.0) : sight.forward_ws) -
                              sight.right_ws * (sight.half_x * (1.0 + sight.jitter.x)) +
                              sight.up_ws * (sight.half_y * (1.0 + sight.jitter.y));
    data.ray_x = glm::vec4(glm::vec3(step_x), 0.0F);
    data.ray_y = glm::vec4(glm::vec3(step_y), sight.orthographic ? sight.near_m - sight.far_m : 0.0);
    data.ray_0 = glm::vec4(glm::vec3(corner), sight.orthographic ? sight.far_m : 0.0);
    const double span = sight.orthographic ? 0.0 : (sight.far_m - sight.near_m) / (sight.near_m * sight.far_m);
    data.depth = {span, 1.0 / sight.far_m, has_mask ? 1.0 : 0.0, light.lamps};
    fillSkylight(data, light);
    fillSky(data, light);
    data.counts = {lights.size(), 0, 0, 0};
    for (std::size_t i = 0; i < lights.size(); ++i) {
        fillLight(data.lights[i], lights[i], sight, light.colours[i], cookie_layers[i]);
        const auto index = static_cast<std::uint32_t>(i);
        data.lights[i].right.w = maskSlot(index / 4, index % 4, false);
    }
}

} // namespace gnomon::host
