// SPDX-License-Identifier: Apache-2.0
#include "box_scene.h"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include <array>
#include <cstdint>
#include <utility>

namespace gnomon::lab::test {
namespace {

/// A light shines along its node's -z.
glm::quat turnedTowards(const glm::vec3& direction)
{
    const glm::vec3 way = glm::normalize(direction);
    return way.z > 0.9999F ? glm::quat(0.0F, 0.0F, 1.0F, 0.0F) : glm::quat(glm::vec3(0.0F, 0.0F, -1.0F), way);
}

void addLight(scene::Scene& scene, scene::Light light, const scene::Transform& transform)
{
    scene::Node node;
    node.light = static_cast<std::uint32_t>(scene.lights.size());
    node.transform = transform;
    scene.lights.push_back(std::move(light));
    scene.nodes.push_back(std::move(node));
}

} // namespace

void addBox(scene::Scene& scene, const glm::vec3& low, const glm::vec3& high)
{
    scene::Primitive primitive;
    for (int axis = 0; axis < 3; ++axis) {
        const int u = (axis + 1) % 3;
        const int v = (axis + 2) % 3;
        if (low[u] == high[u] || low[v] == high[v]) {
            continue;
        }
        for (const bool far : {false, true}) {
            const auto first = static_cast<std::uint32_t>(primitive.positions.size());
            for (const std::array<bool, 2>& corner :
                 {std::array{false, false}, {true, false}, {true, true}, {false, true}}) {
                glm::vec3 p = far ? high : low;
                p[u] = (corner[0] ? high : low)[u];
                p[v] = (corner[1] ? high : low)[v];
                primitive.positions.push_back(p);
            }
            const std::array<std::uint32_t, 6> front{0, 1, 2, 0, 2, 3};
            for (std::size_t i = 0; i < front.size(); ++i) {
                primitive.indices.push_back(first + (far ? front[i] : front[front.size() - 1 - i]));
            }
        }
    }
    scene::Node node;
    node.mesh = static_cast<std::uint32_t>(scene.meshes.size());
    scene.meshes.push_back({.name = "box", .primitives = {std::move(primitive)}});
    scene.nodes.push_back(std::move(node));
}

void addSun(scene::Scene& scene, const glm::vec3& direction, float angular_diameter_rad)
{
    scene::Light sun;
    sun.name = "sun";
    sun.type = scene::LightType::directional;
    sun.angular_diameter_rad = angular_diameter_rad;
    addLight(scene, std::move(sun), {.rotation = turnedTowards(direction)});
}

void addLamp(scene::Scene& scene, const glm::vec3& place, float cone_deg)
{
    scene::Light lamp;
    lamp.name = "lamp";
    lamp.type = cone_deg > 0.0F ? scene::LightType::spot : scene::LightType::point;
    lamp.outer_cone_rad = glm::radians(cone_deg / 2.0F);
    lamp.intensity = 100.0F;
    addLight(scene, std::move(lamp), {.translation = place, .rotation = turnedTowards({0.0F, -1.0F, 0.0F})});
}

void addView(scene::Scene& scene, const glm::vec3& eye, const glm::vec3& target, float fov_y_rad)
{
    scene::NamedView view;
    view.name = "view";
    view.eye = eye;
    view.target = target;
    view.fov_y_rad = fov_y_rad;
    scene.views.push_back(std::move(view));
}

} // namespace gnomon::lab::test
