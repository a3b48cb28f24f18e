// SPDX-License-Identifier: Apache-2.0
#include "../mesh_maker.h"
#include "../rng.h"
#include "furniture.h"

#include <array>
#include <cmath>
#include <vector>

namespace gnomon::worlds {

namespace {

/// A box whose upper edges are bevelled.
void cushion(Part& part, const glm::vec3& min, const glm::vec3& max, float bevel)
{
    part.box(min, {max.x, max.y - bevel, max.z}, 1.0F, true);
    const float taper = 1.0F - 2.0F * bevel / std::min(max.x - min.x, max.z - min.z);
    part.box({min.x, max.y - bevel, min.z}, max, taper);
}

/// A pipe along an arc about +y, from `from` to `to` radians (0 is +z).
void arc(Part& part, float radius, float y, float thick, float from, float to, int pieces, int sides)
{
    std::vector<glm::vec3> path;
    for (int i = 0; i <= pieces; ++i) {
        const float a = from + (to - from) * static_cast<float>(i) / static_cast<float>(pieces);
        path.emplace_back(radius * std::sin(a), y, radius * std::cos(a));
    }
    const std::vector<float> radii(path.size(), thick);
    part.tube(path, radii, sides);
}

/// The back and arms of a tub chair: a bent board, highest behind (-z).
void tub(Part& part)
{
    constexpr int kPieces = 16;
    constexpr float kReach = 2.05F; // radians to either side of the back
    const auto at = [](int i, bool outer, bool top) {
        const float a = kReach * (2.0F * static_cast<float>(i) / kPieces - 1.0F);
        const float high = 0.56F + 0.32F * smoothstep(kReach, 0.6F, std::abs(a));
        const float r = (outer ? 0.40F : 0.32F) + (top ? 0.05F : 0.0F);
        return glm::vec3(-r * std::sin(a), top ? high : 0.36F, -r * std::cos(a));
    };
    for (int i = 0; i < kPieces; ++i) {
        part.quad(at(i, true, false), at(i + 1, true, false), at(i + 1, true, true), at(i, true, true));
        part.quad(at(i + 1, false, false), at(i, false, false), at(i, false, true), at(i + 1, false, true));
        part.quad(at(i, true, true), at(i + 1, true, true), at(i + 1, false, true), at(i, false, true));
    }
    part.quad(at(0, false, false), at(0, true, false), at(0, true, true), at(0, false, true));
    part.quad(at(kPieces, true, false), at(kPieces, false, false), at(kPieces, false, true), at(kPieces, true, true));
}

void bottle(Part& glass, const glm::vec3& foot, float size, std::uint32_t srgb)
{
    const glm::mat4 before = glass.frame;
    glass.frame = before * at(foot) * scaled(glm::vec3(size));
    glass.colour = rgb(srgb);
    glass.lathe({{0.045F, 0.0F}, {0.05F, 0.02F}, {0.05F, 0.16F}, {0.018F, 0.22F}, {0.018F, 0.29F}, {0.0F, 0.295F}}, 8,
                true);
    glass.frame = before;
}

} // namespace

Mesh makeStool(const RingPalette& palette)
{
    MeshMaker maker;
    Part& metal = maker.with(palette.metal);
    metal.colour = rgb(0xB9BEC6);
    metal.lathe({{0.22F, -0.04F}, {0.22F, 0.015F}, {0.05F, 0.05F}, {0.035F, 0.10F}, {0.035F, 0.66F}, {0.12F, 0.70F}},
                14);
    arc(metal, 0.17F, 0.26F, 0.013F, 0.0F, kTau, 14, 5);
    metal.beam({-0.17F, 0.26F, 0}, {0.17F, 0.26F, 0}, 0.02F, false);
    Part& gloss = maker.with(palette.gloss);
    gloss.colour = rgb(0xB8352E);
    gloss.lathe({{0.12F, 0.68F}, {0.20F, 0.70F}, {0.215F, 0.735F}, {0.19F, 0.775F}, {0.0F, 0.79F}}, 16, true);
    return maker.take("stool");
}

Mesh makeTable(const RingPalette& palette)
{
    MeshMaker maker;
    Part& metal = maker.with(palette.metal);
    metal.colour = rgb(0x5E646E);
    metal.lathe({{0.30F, -0.05F}, {0.30F, 0.015F}, {0.07F, 0.07F}, {0.05F, 0.15F}, {0.05F, 0.60F}, {0.20F, 0.70F}}, 16);
    Part& wood = maker.with(palette.common.wood);
    wood.uv_per_metre = 0.9F;
    wood.colour = rgb(0xB27B4B);
    wood.lathe({{0.50F, 0.70F}, {0.535F, 0.715F}, {0.535F, 0.745F}, {0.51F, 0.76F}, {0.0F, 0.762F}}, 22);
    wood.lathe({{0.0F, 0.70F}, {0.50F, 0.70F}}, 22);
    return maker.take("table");
}

Mesh makeTubChair(const RingPalette& palette, std::uint32_t srgb)
{
    MeshMaker maker;
    Part& cloth = maker.with(palette.common.plain);
    cloth.colour = rgb(0x3C4048);
    cloth.lathe({{0.24F, -0.05F}, {0.24F, 0.02F}, {0.06F, 0.06F}, {0.06F, 0.24F}, {0.26F, 0.28F}}, 14);
    cloth.colour = rgb(srgb) * glm::vec4(0.82F, 0.82F, 0.82F, 1.0F);
    cloth.lathe({{0.26F, 0.28F}, {0.36F, 0.33F}, {0.37F, 0.42F}, {0.33F, 0.46F}, {0.0F, 0.47F}}, 18, true);
    cloth.colour = rgb(srgb);
    tub(cloth);
    return maker.take("tub chair");
}

Mesh makeSofa(const RingPalette& palette, std::uint32_t srgb)
{
    MeshMaker maker;
    Part& cloth = maker.with(palette.common.plain);
    cloth.colour = rgb(0x30343C);
    cloth.box({-0.95F, -0.06F, -0.36F}, {0.95F, 0.14F, 0.36F});
    cloth.colour = rgb(srgb) * glm::vec4(0.8F, 0.8F, 0.8F, 1.0F);
    cushion(cloth, {-1.0F, 0.12F, -0.42F}, {1.0F, 0.34F, 0.42F}, 0.03F);
    cloth.colour = rgb(srgb);
    for (const float x : {-0.41F, 0.41F}) {
        cushion(cloth, {x - 0.40F, 0.34F, -0.25F}, {x + 0.40F, 0.50F, 0.44F}, 0.05F);
        cloth.frame = at({x, 0.46F, -0.30F}) * turnedX(-0.16F);
        cushion(cloth, {-0.40F, 0.0F, -0.12F}, {0.40F, 0.46F, 0.10F}, 0.06F);
        cloth.frame = glm::mat4(1.0F);
    }
    for (const float x : {-0.96F, 0.96F}) {
        const std::array<glm::vec3, 4> arm{
            glm::vec3(x, 0.52F, -0.40F), {x, 0.58F, -0.1F}, {x, 0.56F, 0.25F}, {x, 0.50F, 0.43F}};
        constexpr std::array<float, 4> kRadii{0.10F, 0.13F, 0.13F, 0.10F};
        cloth.tube(arm, kRadii, 10);
        cloth.box({x - 0.1F, 0.1F, -0.40F}, {x + 0.1F, 0.56F, 0.42F});
    }
    return maker.take("sofa");
}

Mesh makeBottleShelf(const RingPalette& palette)
{
    MeshMaker maker;
    Part& wood = maker.with(palette.common.wood);
    wood.uv_per_metre = 0.8F;
    wood.colour = rgb(0x6E4630);
    wood.box({-0.96F, -0.08F, -0.32F}, {0.96F, 0.9F, 0.12F});
    wood.box({-0.96F, 0.9F, -0.32F}, {0.96F, 2.2F, -0.26F}, 1.0F, true);
    wood.colour = rgb(0x8E5E3E);
    for (const float y : {0.9F, 1.30F, 1.70F, 2.10F}) {
        wood.box({-0.99F, y, -0.30F}, {0.99F, y + 0.04F, y < 1.0F ? 0.18F : 0.04F}, 1.0F, true);
    }
    for (const float x : {-0.97F, 0.97F}) {
        wood.box({x - 0.03F, 0.9F, -0.33F}, {x + 0.03F, 2.18F, 0.06F}, 1.0F, true);
    }
    Part& glass = maker.with(palette.gloss);
    constexpr std::array<std::uint32_t, 7> kTints{0x3F8F5A, 0xC9772B, 0x2F6FA8, 0xB3352F, 0xD8C46A, 0x7D4FA0, 0xCFE3E8};
    Rng rng(501, 1);
    for (int row = 0; row < 3; ++row) {
        for (int i = 0; i < 9; ++i) {
            const float x = -0.84F + 0.21F * static_cast<float>(i) + rng.range(-0.03F, 0.03F);
            bottle(glass, {x, 0.94F + 0.40F * static_cast<float>(row), -0.12F + rng.range(-0.05F, 0.05F)},
                   rng.range(0.85F, 1.12F), kTints[rng.below(7)]);
        }
    }
    return maker.take("bottle shelf");
}

Mesh makeGlasses(const RingPalette& palette)
{
    MeshMaker maker;
    Part& glass = maker.with(palette.gloss);
    glass.colour = rgb(0xC9DDE4);
    for (const glm::vec2 p : {glm::vec2(-0.13F, 0.05F), glm::vec2(0.10F, -0.06F)}) {
        glass.frame = at({p.x, 0, p.y});
        glass.lathe({{0.04F, 0.0F}, {0.008F, 0.012F}, {0.008F, 0.08F}, {0.06F, 0.15F}, {0.055F, 0.15F}, {0.0F, 0.10F}},
                    10);
    }
    glass.frame = at({0.03F, 0, 0.14F});
    glass.colour = rgb(0xB9BEC6);
    glass.lathe({{0.045F, 0.0F}, {0.06F, 0.14F}, {0.05F, 0.17F}, {0.025F, 0.20F}, {0.025F, 0.23F}, {0.0F, 0.24F}}, 10);
    return maker.take("glasses");
}

Mesh makeJukebox(const RingPalette& palette)
{
    MeshMaker maker;
    Part& wood = maker.with(palette.common.wood);
    wood.colour = rgb(0x7A4428);
    wood.uv_per_metre = 0.8F;
    wood.box({-0.45F, -0.06F, -0.34F}, {0.45F, 1.05F, 0.30F});
    wood.frame = at({0, 1.05F, -0.34F}) * turnedX(kPi * 0.5F);
    wood.lathe({{0.45F, 0.0F}, {0.45F, 0.64F}, {0.0F, 0.64F}}, 24); // its lower half is inside the box
    Part& glow = maker.with(palette.neonOf(Hue::rose));
    std::vector<glm::vec3> path{{-0.36F, 0.15F, 0.33F}};
    for (int i = 0; i <= 12; ++i) {
        const float a = kPi * static_cast<float>(i) / 12.0F;
        path.emplace_back(-0.36F * std::cos(a), 1.05F + 0.36F * std::sin(a), 0.33F);
    }
    path.emplace_back(0.36F, 0.15F, 0.33F);
    const std::vector<float> radii(path.size(), 0.035F);
    glow.tube(path, radii, 7);
    Part& metal = maker.with(palette.metal);
    metal.colour = rgb(0xE0C27A);
    metal.box({-0.24F, 0.70F, 0.28F}, {0.24F, 1.20F, 0.34F}, 1.0F, true);
    for (int i = 0; i < 5; ++i) {
        const float y = 0.16F + 0.09F * static_cast<float>(i);
        metal.box({-0.26F, y, 0.29F}, {0.26F, y + 0.04F, 0.35F}, 1.0F, true);
    }
    return maker.take("jukebox");
}

Mesh makeBench(const RingPalette& palette)
{
    MeshMaker maker;
    Part& metal = maker.with(palette.metal);
    metal.colour = rgb(0x7C8492);
    for (const float x : {-0.62F, 0.62F}) {
        metal.box({x - 0.05F, -0.06F, -0.20F}, {x + 0.05F, 0.40F, 0.20F}, 0.7F);
    }
    Part& wood = maker.with(palette.common.wood);
    wood.colour = rgb(0xB9824F);
    for (int i = 0; i < 4; ++i) {
        const float z = -0.24F + 0.13F * static_cast<float>(i);
        wood.box({-0.85F, 0.40F, z}, {0.85F, 0.45F, z + 0.095F}, 1.0F, true);
    }
    return maker.take("bench");
}

Mesh makeBed(const RingPalette& palette, std::uint32_t srgb)
{
    MeshMaker maker;
    Part& part = maker.with(palette.common.plain);
    part.colour = rgb(0xD9D4CB);
    part.box({-0.52F, -0.08F, -1.05F}, {0.52F, 0.30F, 1.05F});
    part.box({-0.58F, -0.08F, -1.14F}, {0.58F, 0.95F, -1.02F}, 0.92F);
    part.box({-0.56F, -0.08F, 1.02F}, {0.56F, 0.45F, 1.10F}, 0.94F);
    part.colour = rgb(0xF0ECE4);
    cushion(part, {-0.49F, 0.30F, -1.0F}, {0.49F, 0.46F, 1.0F}, 0.05F);
    part.colour = rgb(srgb);
    cushion(part, {-0.54F, 0.24F, -0.35F}, {0.54F, 0.51F, 1.03F}, 0.06F);
    part.colour = rgb(0xFFFFFF);
    part.frame = at({0, 0.50F, -0.74F}) * scaled({0.36F, 0.11F, 0.20F});
    part.ball(1.0F, 2);
    return maker.take("bed");
}

Mesh makeNightstand(const RingPalette& palette)
{
    MeshMaker maker;
    Part& wood = maker.with(palette.common.wood);
    wood.colour = rgb(0xA0744A);
    wood.uv_per_metre = 0.9F;
    wood.box({-0.24F, -0.06F, -0.24F}, {0.24F, 0.52F, 0.24F});
    wood.colour = rgb(0x7C5534);
    wood.box({-0.28F, 0.50F, -0.28F}, {0.28F, 0.55F, 0.28F}, 1.0F, true);
    return maker.take("nightstand");
}

Mesh makeLocker(const RingPalette& palette, std::uint32_t srgb)
{
    MeshMaker maker;
    Part& metal = maker.with(palette.metal);
    for (const float x : {-0.36F, 0.36F}) {
        metal.colour = rgb(srgb);
        metal.box({x - 0.34F, -0.08F, -0.30F}, {x + 0.34F, 1.95F, 0.28F});
        metal.colour = rgb(srgb) * glm::vec4(1.15F, 1.15F, 1.15F, 1.0F);
        metal.box({x - 0.29F, 0.10F, 0.26F}, {x + 0.29F, 1.88F, 0.31F}, 1.0F, true);
        metal.colour = rgb(0xD9DCE0);
        metal.box({x + 0.18F, 0.95F, 0.30F}, {x + 0.22F, 1.15F, 0.35F}, 1.0F, true);
    }
    return maker.take("locker");
}

} // namespace gnomon::worlds
