// SPDX-License-Identifier: Apache-2.0
#include "things.h"

#include "../rng.h"
#include "../scene_maker.h"
#include "../textures.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <utility>
#include <vector>

namespace gnomon::worlds {

namespace {

struct Flower {
    glm::vec2 root;
    glm::vec2 blossom;
    float radius;
    glm::vec3 petals;
};

/// Stems from the bottom edge with a blossom each: white, yellow and red.
Image flowerTuft()
{
    constexpr int kFlowers = 9;
    std::vector<Flower> flowers;
    Rng rng(2010, 1);
    for (int i = 0; i < kFlowers; ++i) {
        const float x = 0.14F + 0.72F * (static_cast<float>(i) + 0.5F) / kFlowers;
        const int kind = i % 3;
        flowers.push_back({{0.5F + (x - 0.5F) * 0.6F, 1.0F},
                           {x, rng.range(0.10F, 0.45F)},
                           rng.range(0.050F, 0.068F),
                           kind == 0   ? glm::vec3(0.97F, 0.96F, 0.92F)
                           : kind == 1 ? glm::vec3(0.96F, 0.80F, 0.22F)
                                       : glm::vec3(0.86F, 0.22F, 0.14F)});
    }
    const glm::vec3 green(0.45F, 0.56F, 0.26F);
    return paint("flower tuft", 128, [&](glm::vec2 uv) {
        glm::vec4 colour(green, 0.0F);
        for (const Flower& flower : flowers) {
            const float t = (1.0F - uv.y) / (1.0F - flower.blossom.y);
            const float stem_x = flower.root.x + (flower.blossom.x - flower.root.x) * t * t;
            if (t <= 1.0F && std::abs(uv.x - stem_x) < 0.011F + 0.010F * (1.0F - t)) {
                colour = glm::vec4(green * (0.75F + 0.25F * t), 1.0F);
            }
        }
        for (const Flower& flower : flowers) {
            const glm::vec2 d = uv - flower.blossom;
            const float r = glm::length(d);
            const float edge = flower.radius * (0.86F + 0.14F * std::cos(7.0F * std::atan2(d.y, d.x)));
            if (r < edge) {
                const bool heart = r < 0.33F * flower.radius;
                colour = glm::vec4(heart ? glm::vec3(0.80F, 0.58F, 0.16F) : flower.petals * (0.82F + 0.18F * r / edge),
                                   1.0F);
            }
        }
        return colour;
    });
}

} // namespace

SundialPalette addSundialPalette(Scene& scene)
{
    SundialPalette palette;
    palette.common = addPalette(scene);
    const std::uint32_t wall = addTexture(scene, plaster());
    palette.plaster = addMaterial(scene, "plaster", {.roughness = 0.95F, .texture = wall});
    palette.pale_stone = addMaterial(scene, "pale stone", {.roughness = 0.8F, .texture = wall});
    palette.bronze = addMaterial(scene, "bronze", {.roughness = 0.42F, .metallic = 0.55F});
    palette.flowers = addMaterial(scene, "flowers",
                                  {.roughness = 0.9F,
                                   .texture = addTexture(scene, flowerTuft(), Wrap::clamp_to_edge),
                                   .alpha_mode = AlphaMode::mask});
    return palette;
}

} // namespace gnomon::worlds
