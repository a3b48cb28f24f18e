// SPDX-License-Identifier: Apache-2.0
#include "things.h"

#include "../mesh_maker.h"
#include "../rng.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace gnomon::worlds {

namespace {

/// One mass of leaves at the end of a bough.
struct Cloud {
    glm::vec3 centre;
    glm::vec3 radii;
    int cards;
};

/// Cards over a cloud's surface and, fewer, inside. They are lit as the whole crown is, rounded by their own cloud, so
/// that light and shade lie in masses.
void addLeaves(Part& leaves, Rng& rng, const Cloud& cloud, const glm::vec3& middle, const glm::vec4& low,
               const glm::vec4& high, float half_m)
{
    for (int i = 0; i < cloud.cards; ++i) {
        const float y = 1.0F - 2.0F * (static_cast<float>(i) + 0.5F) / static_cast<float>(cloud.cards);
        const float turn = 2.3999632F * static_cast<float>(i) + rng.range(-0.4F, 0.4F); // the golden angle
        const float r = std::sqrt(1.0F - y * y);
        const glm::vec3 out(r * std::cos(turn), y, r * std::sin(turn));
        // Deep enough that none hangs in the air by itself; at the top, where few are, deeper.
        const glm::vec3 place =
            cloud.centre + out * cloud.radii * (rng.range(0.50F, 0.90F) - 0.22F * std::max(y, 0.0F));
        const glm::vec3 facing = glm::normalize(out + glm::vec3(0, 0.35F, 0) + rng.direction() * 0.6F);
        const glm::vec3 normal =
            glm::normalize(out * 0.6F + glm::normalize(place - middle) * 0.7F + glm::vec3(0, 0.2F, 0));
        const float light =
            glm::clamp(0.45F + 0.35F * y + 0.12F * (place.y - middle.y) + rng.range(-0.22F, 0.22F), 0.0F, 1.0F);
        leaves.colour = glm::mix(low, high, light);
        leafCard(leaves, place, facing, half_m * rng.range(0.85F, 1.15F), rng.range(0.0F, kTau), normal);
    }
}

void addTrunk(Part& wood, Rng& rng, std::span<const Cloud> clouds)
{
    wood.uv_per_metre = 0.6F;
    wood.colour = rgb(0x64503C);
    wood.lathe({{0.95F, -0.6F}, {0.62F, 0.05F}, {0.46F, 0.6F}, {0.38F, 1.8F}, {0.33F, 3.0F}, {0.20F, 4.6F}}, 9, true);
    for (const Cloud& cloud : clouds) {
        const glm::vec3 end = cloud.centre - glm::vec3(0, 0.15F * cloud.radii.y, 0);
        const float from = glm::clamp(cloud.centre.y * 0.5F, 1.9F, 3.9F);
        const glm::vec3 knee = glm::mix(glm::vec3(0, from, 0), end, 0.5F) +
                               glm::vec3(rng.range(-0.25F, 0.25F), -0.25F, rng.range(-0.25F, 0.25F));
        const std::array<glm::vec3, 3> path{glm::vec3(0, from, 0), knee, end};
        constexpr std::array<float, 3> kRadii{0.20F, 0.13F, 0.05F};
        wood.tube(path, kRadii, 6);
    }
}

void addTuft(Part& part, Rng& rng, float half_m, float height_m, int cards)
{
    const float a = rng.range(0.0F, kTau);
    const float r = 1.5F * std::sqrt(rng.unit());
    const glm::vec3 foot(r * std::cos(a), -0.04F, r * std::sin(a));
    const glm::vec3 lean(0.2F * height_m * rng.range(-1.0F, 1.0F), height_m, 0.2F * height_m * rng.range(-1.0F, 1.0F));
    const float turn = rng.range(0.0F, kPi);
    for (int i = 0; i < cards; ++i) {
        const float b = turn + kPi * static_cast<float>(i) / static_cast<float>(cards);
        const glm::vec3 side(half_m * std::cos(b), 0, half_m * std::sin(b));
        // Lit much as the ground is, from either side: two cards, because a back's normal would be turned down. Their
        // normals lean forwards, so that a card that itself leans backwards still shows its front.
        const glm::vec3 front = glm::normalize(glm::cross(side, lean)) * 0.33F;
        part.card(foot - side, foot + side, foot + lean + side, foot + lean - side, glm::vec3(0, 1, 0) + front);
        part.card(foot + side, foot - side, foot + lean - side, foot + lean + side, glm::vec3(0, 1, 0) - front);
    }
}

} // namespace

Mesh makeOak(const SundialPalette& palette, std::uint32_t variant, bool near)
{
    Rng rng(90, variant);
    MeshMaker maker;
    std::array<Cloud, 9> clouds{};
    clouds[0] = {{rng.range(-0.4F, 0.4F), 7.2F, rng.range(-0.4F, 0.4F)}, {2.5F, 1.8F, 2.5F}, near ? 44 : 16};
    clouds[1] = {{0.0F, 5.0F, 0.0F}, {2.4F, 1.6F, 2.4F}, near ? 26 : 10};
    for (std::size_t i = 2; i < clouds.size(); ++i) {
        const float a =
            kTau * (static_cast<float>(i) + rng.range(-0.22F, 0.22F)) / static_cast<float>(clouds.size() - 2);
        const float reach = rng.range(2.0F, 2.8F);
        const float size = rng.range(0.9F, 1.2F);
        clouds[i] = {{reach * std::cos(a), rng.range(3.7F, 5.7F), reach * std::sin(a)},
                     glm::vec3(1.9F, 1.35F, 1.9F) * size,
                     near ? 30 : 9};
    }
    addTrunk(maker.with(palette.common.wood), rng, near ? std::span<const Cloud>(clouds) : std::span<const Cloud>{});
    const glm::vec4 low = rgb(variant == 0 ? 0x38562C : 0x435E2C);
    const glm::vec4 high = rgb(variant == 0 ? 0x8CA84C : 0xA3AE54);
    Part& leaves = maker.with(palette.common.leaves);
    for (const Cloud& cloud : clouds) {
        addLeaves(leaves, rng, cloud, {0, 5.0F, 0}, low, high, near ? 0.60F : 1.0F);
    }
    return maker.take((near ? "oak " : "far oak ") + std::to_string(variant));
}

Mesh makeGrassPatch(const SundialPalette& palette)
{
    Rng rng(91, 0);
    MeshMaker maker;
    Part& grass = maker.with(palette.common.grass);
    for (int i = 0; i < 12; ++i) {
        grass.colour = glm::mix(rgb(0x88994C), rgb(0xB0AC62), rng.unit());
        addTuft(grass, rng, rng.range(0.20F, 0.34F), rng.range(0.16F, 0.36F), 2);
    }
    return maker.take("grass patch");
}

Mesh makeFlowerPatch(const SundialPalette& palette)
{
    Rng rng(92, 0);
    MeshMaker maker;
    Part& flowers = maker.with(palette.flowers);
    for (int i = 0; i < 9; ++i) {
        addTuft(flowers, rng, rng.range(0.20F, 0.28F), rng.range(0.26F, 0.38F), 2);
    }
    return maker.take("flower patch");
}

} // namespace gnomon::worlds
