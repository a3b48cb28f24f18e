// SPDX-License-Identifier: Apache-2.0
#include "plants.h"

#include "../mesh_maker.h"
#include "../rng.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <array>

namespace gnomon::worlds {

namespace {

void crown(Part& leaves, Rng& rng, const glm::vec3& centre, const glm::vec3& radii, int cards, float half,
           const glm::vec4& low, const glm::vec4& high)
{
    for (int i = 0; i < cards; ++i) {
        // Evenly over the sphere (a spiral), so that no hole shows the sky through the crown.
        const float y = 1.0F - 2.0F * (static_cast<float>(i) + 0.5F) / static_cast<float>(cards);
        const float turn = 2.3999632F * static_cast<float>(i) + rng.range(-0.3F, 0.3F);
        const float r = std::sqrt(1.0F - y * y);
        const glm::vec3 out(r * std::cos(turn), y, r * std::sin(turn));
        const glm::vec3 place = centre + out * radii * rng.range(0.62F, 0.86F);
        // Backs are shaded with their normals turned; looked at from above, most cards must show their fronts.
        const glm::vec3 facing = glm::normalize(out + glm::vec3(0, 0.45F, 0) + rng.direction() * 0.35F);
        leaves.colour = glm::mix(low, high, glm::clamp(0.5F + 0.5F * y + rng.range(-0.2F, 0.2F), 0.0F, 1.0F));
        leafCard(leaves, place, facing, half * rng.range(0.85F, 1.1F), rng.range(0.0F, kTau),
                 glm::normalize(out + glm::vec3(0, 0.25F, 0)));
    }
}

} // namespace

Mesh makeBroadTree(const Palette& palette, std::uint32_t variant)
{
    Rng rng(77, variant);
    MeshMaker maker;
    Part& trunk = maker.with(palette.wood);
    trunk.uv_per_metre = 0.7F;
    trunk.colour = rgb(0x6A523C);
    trunk.lathe({{0.55F, -0.5F}, {0.30F, 0.6F}, {0.22F, 2.6F}, {0.10F, 4.6F}}, 6);
    for (int i = 0; i < 3; ++i) {
        const float a = kTau * (static_cast<float>(i) + rng.unit() * 0.5F) / 3.0F;
        trunk.beam({0, 2.0F + 0.3F * static_cast<float>(i), 0}, {1.5F * std::cos(a), 4.0F, 1.5F * std::sin(a)}, 0.17F);
    }
    constexpr std::array<std::array<std::uint32_t, 2>, kTreeVariants> kTints{
        {{{0x3F6B2A, 0x9DBE4E}}, {{0x4B7431, 0xB9C358}}, {{0x9A5B22, 0xE2B04A}}}};
    const glm::vec4 low = rgb(kTints[variant % kTreeVariants][0]);
    const glm::vec4 high = rgb(kTints[variant % kTreeVariants][1]);
    Part& leaves = maker.with(palette.leaves);
    crown(leaves, rng, {0, 4.9F, 0}, {2.5F, 2.1F, 2.5F}, 28, 1.35F, low, high);
    crown(leaves, rng, {rng.range(-1.3F, 1.3F), 3.9F, rng.range(-1.3F, 1.3F)}, {1.9F, 1.2F, 1.9F}, 10, 1.15F, low,
          high);
    return maker.take("broad tree " + std::to_string(variant));
}

Mesh makeFir(const Palette& palette, std::uint32_t variant)
{
    Rng rng(78, variant);
    MeshMaker maker;
    Part& trunk = maker.with(palette.wood);
    trunk.uv_per_metre = 0.7F;
    trunk.colour = rgb(0x5B4636);
    trunk.lathe({{0.42F, -0.5F}, {0.26F, 0.5F}, {0.0F, 8.6F}}, 5);
    Part& needles = maker.with(palette.needles);
    constexpr std::array<std::uint32_t, kTreeVariants> kTints{0x3E6B4A, 0x4F7A48, 0x35604F};
    const glm::vec4 tint = rgb(kTints[variant % kTreeVariants]);
    constexpr int kTiers = 7;
    for (int tier = 0; tier < kTiers; ++tier) {
        const float up = static_cast<float>(tier) / (kTiers - 1);
        const int boughs = tier < 4 ? 7 : 5;
        const float reach = 2.7F * (1.0F - up) + 0.55F;
        const float y = 1.7F + 6.7F * up;
        for (int i = 0; i < boughs; ++i) {
            const float a = kTau *
                            (static_cast<float>(i) + 0.5F * static_cast<float>(tier & 1) + rng.range(-0.1F, 0.1F)) /
                            static_cast<float>(boughs);
            const glm::vec3 out(std::sin(a), 0, std::cos(a));
            const glm::vec3 side(out.z, 0, -out.x);
            const glm::vec3 top = glm::vec3(0, y + 0.45F, 0) + out * 0.05F;
            const glm::vec3 tip = glm::vec3(0, y - 0.28F * reach - 0.15F, 0) + out * reach;
            const float half = reach * 0.52F;
            const float tone = 0.75F + 0.45F * up + rng.range(-0.12F, 0.12F);
            needles.colour = tint * glm::vec4(tone, tone, tone, 1.0F);
            needles.card(tip - side * half, tip + side * half, top + side * half, top - side * half,
                         glm::normalize(out + glm::vec3(0, 0.9F, 0)));
        }
    }
    return maker.take("fir " + std::to_string(variant));
}

Mesh makeBush(const Palette& palette)
{
    Rng rng(79, 0);
    MeshMaker maker;
    crown(maker.with(palette.leaves), rng, {0, 0.5F, 0}, {0.9F, 0.6F, 0.9F}, 11, 0.75F, rgb(0x42692C), rgb(0x93B04C));
    return maker.take("bush");
}

Mesh makeGrassTuft(const Palette& palette)
{
    MeshMaker maker;
    Part& grass = maker.with(palette.grass);
    grass.colour = rgb(0x9CB052);
    for (int i = 0; i < 3; ++i) {
        const float a = kPi * static_cast<float>(i) / 3.0F;
        const glm::vec3 side(0.45F * std::cos(a), 0, 0.45F * std::sin(a));
        const glm::vec3 foot(0, -0.05F, 0);
        const glm::vec3 top(0, 0.6F, 0);
        // Lit as the ground is, from either side: two cards, because a back's normal would be turned down.
        grass.card(foot - side, foot + side, top + side, top - side, {0, 1, 0});
        grass.card(foot + side, foot - side, top - side, top + side, {0, 1, 0});
    }
    return maker.take("grass tuft");
}

Mesh makeRock(const Palette& palette, std::uint32_t variant)
{
    MeshMaker maker;
    Part& rock = maker.with(palette.rock);
    rock.uv_per_metre = 0.35F;
    rock.colour = rgb(variant == 0 ? 0x9A8F82U : 0x8A8278U);
    rock.frame = scaled({1.0F + 0.3F * static_cast<float>(variant), 0.75F, 1.0F});
    rock.ball(1.0F, 1, 0.20F, 40 + variant);
    return maker.take("rock " + std::to_string(variant));
}

} // namespace gnomon::worlds
