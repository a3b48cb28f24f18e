// SPDX-License-Identifier: Apache-2.0
// The sky beyond the hull. It shines by itself and takes no part in shadows.
#include "../mesh_maker.h"
#include "../rng.h"
#include "../scene_maker.h"
#include "deck.h"

#include "worlds/ring.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <cmath>
#include <utility>

namespace gnomon::worlds {

namespace {

constexpr glm::vec3 kHub{0.0F, static_cast<float>(RingWorld::radius_m), 0.0F};
constexpr float kStars_m = 240.0F; // from the hub
constexpr int kStarCount = 1100;

Mesh makeStars(std::uint32_t material)
{
    Rng rng(2001, 9);
    MeshMaker maker;
    Part& part = maker.with(material);
    for (int i = 0; i < kStarCount; ++i) {
        const glm::vec3 out = rng.direction();
        const float size = rng.unit();
        const float tint = rng.unit();
        const float bright = 0.15F + 0.85F * size * size;
        part.colour =
            glm::vec4(glm::mix(glm::vec3(1.0F, 0.82F, 0.66F), glm::vec3(0.72F, 0.84F, 1.0F), tint) * bright, 1.0F);
        leafCard(part, out * kStars_m, -out, 0.16F + 0.24F * size * size, rng.range(0.0F, kTau), -out);
    }
    return maker.take("stars");
}

/// Banded, with a night side and a rim of air.
Mesh makePlanet(std::uint32_t material, const char* name, const glm::vec3& centre, float radius)
{
    const glm::vec3 sun = glm::normalize(glm::vec3(-0.35F, 0.75F, 0.15F));
    MeshMaker maker;
    Part& part = maker.with(material);
    part.ball(radius, 5);
    Mesh mesh = maker.take(name);
    Primitive& ball = mesh.primitives[0];
    const glm::vec3 view = glm::normalize(kHub - centre);
    for (std::size_t i = 0; i < ball.positions.size(); ++i) {
        const glm::vec3 n = ball.normals[i];
        const float bands =
            0.5F + 0.5F * std::sin(13.0F * n.y + 1.6F * fractal({n.x * 3.0F + 9.0F, n.z * 3.0F + 5.0F * n.y}, 4, 77));
        const glm::vec3 soil = glm::mix(glm::vec3(0.55F, 0.30F, 0.16F), glm::vec3(0.80F, 0.62F, 0.42F), bands);
        const float day = smoothstep(-0.12F, 0.75F, glm::dot(n, sun));
        const float rim = std::pow(1.0F - std::abs(glm::dot(n, view)), 3.0F);
        const glm::vec3 air = glm::vec3(0.30F, 0.50F, 0.90F) * (0.7F * rim * (0.10F + day));
        ball.colours[i] = glm::vec4(soil * (0.55F * day + 0.004F) + air, 1.0F);
    }
    return mesh;
}

} // namespace

void addSpace(Scene& scene)
{
    const std::uint32_t material = addMaterial(scene, "space", {});
    scene.materials[material].model = ShadingModel::unlit;
    const auto add = [&](const char* name, Mesh mesh, const glm::vec3& position) {
        const std::uint32_t node = addNode(scene, name, addMesh(scene, std::move(mesh)), standing(position));
        scene.nodes[node].casts = false;
        scene.nodes[node].receives = false;
    };
    add("space/stars", makeStars(material), kHub);
    const glm::vec3 planet = kHub + glm::vec3(150.0F, 22.0F, -105.0F);
    add("space/planet", makePlanet(material, "planet", planet, 42.0F), planet);
    const glm::vec3 moon = kHub + glm::vec3(-26.0F, -92.0F, -165.0F);
    add("space/moon", makePlanet(material, "moon", moon, 13.0F), moon);
}

} // namespace gnomon::worlds
