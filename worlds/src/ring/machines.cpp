// SPDX-License-Identifier: Apache-2.0
#include "../mesh_maker.h"
#include "../rng.h"
#include "furniture.h"

#include <array>
#include <cmath>
#include <vector>

namespace gnomon::worlds {

namespace {

/// A hoop about +z.
void hoop(Part& part, const glm::vec3& centre, float radius, float thick, int pieces, float from = 0.0F,
          float to = kTau)
{
    std::vector<glm::vec3> path;
    const bool whole = to - from >= kTau;
    for (int i = 0; i < (whole ? pieces : pieces + 1); ++i) {
        const float a = from + (to - from) * static_cast<float>(i) / static_cast<float>(pieces);
        path.push_back(centre + glm::vec3(radius * std::cos(a), radius * std::sin(a), 0.0F));
    }
    const std::vector<float> radii(path.size(), thick);
    part.tube(path, radii, 8, whole);
}

void pipe(Part& part, std::initializer_list<glm::vec3> corners, float thick)
{
    const std::vector<glm::vec3> path(corners);
    const std::vector<float> radii(path.size(), thick);
    part.tube(path, radii, 9);
}

} // namespace

Mesh makeCrate(const RingPalette& palette, std::uint32_t srgb)
{
    MeshMaker maker;
    Part& paint = maker.with(palette.common.plain);
    paint.colour = rgb(srgb);
    paint.box({-0.44F, 0.03F, -0.44F}, {0.44F, 0.85F, 0.44F}, 1.0F, true);
    paint.colour = rgb(0x4A4E57);
    for (const float x : {-0.43F, 0.43F}) {
        for (const float z : {-0.43F, 0.43F}) {
            paint.box({x - 0.07F, -0.02F, z - 0.07F}, {x + 0.07F, 0.90F, z + 0.07F}, 0.9F, true);
        }
    }
    paint.colour = rgb(srgb) * glm::vec4(0.7F, 0.7F, 0.7F, 1.0F);
    for (const float y : {0.24F, 0.58F}) {
        paint.box({-0.465F, y, -0.465F}, {0.465F, y + 0.07F, 0.465F}, 1.0F, true);
    }
    paint.colour = rgb(0xE9E2D0);
    paint.box({-0.16F, 0.36F, 0.40F}, {0.16F, 0.54F, 0.452F}, 1.0F, true);
    return maker.take("crate");
}

Mesh makeDrum(const RingPalette& palette, std::uint32_t srgb)
{
    MeshMaker maker;
    Part& gloss = maker.with(palette.gloss);
    gloss.colour = rgb(srgb);
    gloss.lathe({{0.29F, -0.02F},
                 {0.31F, 0.02F},
                 {0.30F, 0.05F},
                 {0.30F, 0.28F},
                 {0.325F, 0.31F},
                 {0.30F, 0.34F},
                 {0.30F, 0.56F},
                 {0.325F, 0.59F},
                 {0.30F, 0.62F},
                 {0.30F, 0.83F},
                 {0.315F, 0.86F},
                 {0.29F, 0.89F},
                 {0.27F, 0.86F},
                 {0.0F, 0.86F}},
                18);
    return maker.take("drum");
}

Mesh makeConsole(const RingPalette& palette, Hue screen)
{
    MeshMaker maker;
    Part& metal = maker.with(palette.metal);
    metal.colour = rgb(0x6C7686);
    metal.box({-0.7F, -0.06F, -0.30F}, {0.7F, 0.72F, 0.20F}, 0.94F);
    metal.colour = rgb(0x8E98A8);
    metal.frame = at({0, 0.72F, 0.0F}) * turnedX(0.32F);
    metal.box({-0.74F, -0.04F, -0.36F}, {0.74F, 0.04F, 0.36F}, 1.0F, true);
    metal.frame = at({0, 0.98F, -0.30F}) * turnedX(-0.18F);
    metal.colour = rgb(0x4C5462);
    metal.box({-0.56F, 0.0F, -0.06F}, {0.56F, 0.62F, 0.04F}, 0.95F, true);
    metal.frame = glm::mat4(1.0F);
    metal.beam({0, 0.7F, -0.26F}, {0, 1.06F, -0.32F}, 0.12F);
    Part& glow = maker.with(palette.neonOf(screen));
    glow.frame = at({0, 0.98F, -0.30F}) * turnedX(-0.18F);
    glow.box({-0.48F, 0.08F, 0.03F}, {0.48F, 0.54F, 0.055F}, 1.0F, true);
    glow.frame = at({0, 0.72F, 0.0F}) * turnedX(0.32F);
    for (int i = 0; i < 6; ++i) {
        const float x = -0.55F + 0.2F * static_cast<float>(i);
        glow.box({x, 0.03F, 0.02F + 0.1F * static_cast<float>(i & 1)},
                 {x + 0.09F, 0.06F, 0.09F + 0.1F * static_cast<float>(i & 1)});
    }
    return maker.take("console");
}

Mesh makeScanner(const RingPalette& palette)
{
    MeshMaker maker;
    Part& paint = maker.with(palette.gloss);
    paint.colour = rgb(0xE4EAE8);
    paint.box({-0.36F, -0.06F, -0.9F}, {0.36F, 0.35F, 0.9F}, 0.8F);
    paint.colour = rgb(0xBFD8D2);
    paint.box({-0.42F, 0.60F, -1.1F}, {0.42F, 0.72F, 1.1F}, 0.94F, true);
    paint.colour = rgb(0xE4EAE8);
    paint.box({-0.16F, 0.35F, -0.5F}, {0.16F, 0.60F, 0.5F});
    hoop(paint, {0, 0.95F, -0.2F}, 0.95F, 0.15F, 24, -0.9F, kPi + 0.9F);
    Part& glow = maker.with(palette.neonOf(Hue::cyan));
    hoop(glow, {0, 0.95F, 0.0F}, 0.90F, 0.025F, 24, -0.6F, kPi + 0.6F);
    return maker.take("scanner");
}

Mesh makeWorkbench(const RingPalette& palette)
{
    MeshMaker maker;
    Part& wood = maker.with(palette.common.wood);
    wood.colour = rgb(0x9C7448);
    wood.box({-1.0F, 0.82F, -0.40F}, {1.0F, 0.92F, 0.40F}, 1.0F, true);
    Part& metal = maker.with(palette.metal);
    metal.colour = rgb(0x5F6672);
    for (const float x : {-0.88F, 0.88F}) {
        for (const float z : {-0.3F, 0.3F}) {
            metal.beam({x, -0.06F, z}, {x, 0.83F, z}, 0.10F);
        }
    }
    metal.box({-0.9F, 0.2F, -0.32F}, {0.9F, 0.26F, 0.32F}, 1.0F, true);
    metal.colour = rgb(0xC0622E);
    metal.frame = at({-0.55F, 0.92F, -0.05F});
    metal.lathe({{0.16F, 0.0F}, {0.14F, 0.10F}, {0.07F, 0.16F}}, 12);
    metal.frame = glm::mat4(1.0F);
    pipe(metal, {{-0.55F, 1.0F, -0.05F}, {-0.55F, 1.35F, -0.10F}, {-0.35F, 1.62F, -0.05F}, {0.05F, 1.60F, 0.05F}},
         0.055F);
    pipe(metal, {{0.05F, 1.62F, 0.05F}, {0.16F, 1.42F, 0.08F}, {0.18F, 1.25F, 0.08F}}, 0.035F);
    metal.colour = rgb(0x8E98A8);
    metal.box({0.42F, 0.92F, -0.22F}, {0.78F, 1.14F, 0.14F}, 0.85F);
    metal.frame = at({0.15F, 0.97F, 0.1F});
    metal.ball(0.1F, 2);
    return maker.take("workbench");
}

Mesh makeTurbine(const RingPalette& palette)
{
    MeshMaker maker;
    Part& metal = maker.with(palette.metal);
    metal.colour = rgb(0x5A606A);
    for (const float x : {-1.15F, 0.0F, 1.15F}) {
        metal.box({x - 0.16F, -0.1F, -0.75F}, {x + 0.16F, 0.75F, 0.75F}, 0.75F);
    }
    metal.frame = at({-1.8F, 1.15F, 0}) * turnedZ(-kPi * 0.5F);
    metal.colour = rgb(0xA7ADB6);
    metal.lathe({{0.0F, -0.12F}, {0.30F, -0.10F}, {0.34F, 0.0F}, {0.34F, 0.3F}, {0.72F, 0.6F}, {0.78F, 0.8F}}, 24,
                true);
    metal.lathe({{0.74F, 0.8F}, {0.74F, 2.5F}}, 24);
    metal.lathe({{0.78F, 2.5F}, {0.72F, 2.8F}, {0.45F, 3.1F}, {0.40F, 3.6F}, {0.30F, 3.6F}, {0.0F, 3.2F}}, 24, true);
    metal.colour = rgb(0xB4532F);
    for (const float y : {0.8F, 1.3F, 1.9F, 2.42F}) {
        metal.lathe({{0.74F, y}, {0.84F, y}, {0.84F, y + 0.12F}, {0.74F, y + 0.12F}}, 24);
    }
    metal.frame = glm::mat4(1.0F);
    metal.colour = rgb(0xC59A4A);
    pipe(metal,
         {{-0.6F, 1.8F, 0.0F},
          {-0.6F, 2.25F, 0.0F},
          {-0.3F, 2.45F, 0.0F},
          {0.5F, 2.45F, 0.0F},
          {0.75F, 2.25F, 0.0F},
          {0.75F, 1.8F, 0.0F}},
         0.09F);
    return maker.take("turbine");
}

Mesh makeBoiler(const RingPalette& palette)
{
    MeshMaker maker;
    Part& gloss = maker.with(palette.gloss);
    gloss.colour = rgb(0x9E4A38);
    gloss.lathe({{0.55F, -0.06F},
                 {0.62F, 0.05F},
                 {0.62F, 0.2F},
                 {0.55F, 0.25F},
                 {0.55F, 1.5F},
                 {0.5F, 1.75F},
                 {0.32F, 1.95F},
                 {0.12F, 2.02F},
                 {0.10F, 2.25F},
                 {0.16F, 2.32F},
                 {0.0F, 2.34F}},
                22, true);
    Part& metal = maker.with(palette.metal);
    metal.colour = rgb(0xC9A24E);
    for (const float y : {0.55F, 1.15F}) {
        metal.lathe({{0.55F, y}, {0.585F, y}, {0.585F, y + 0.07F}, {0.55F, y + 0.07F}}, 22);
    }
    hoop(metal, {0, 1.45F, 0.52F}, 0.16F, 0.025F, 14);
    metal.beam({-0.16F, 1.45F, 0.52F}, {0.16F, 1.45F, 0.52F}, 0.03F, false);
    pipe(metal,
         {{0.45F, 0.5F, 0.2F},
          {0.8F, 0.5F, 0.2F},
          {0.85F, 0.7F, 0.2F},
          {0.85F, 2.0F, 0.0F},
          {0.6F, 2.2F, 0.0F},
          {0.1F, 2.15F, 0.0F}},
         0.06F);
    return maker.take("boiler");
}

Mesh makeStall(const RingPalette& palette, std::uint32_t srgb)
{
    MeshMaker maker;
    Part& wood = maker.with(palette.common.wood);
    wood.colour = rgb(0xA0744A);
    wood.box({-1.1F, -0.08F, -0.35F}, {1.1F, 0.85F, 0.35F}, 0.98F);
    wood.colour = rgb(0x7C5534);
    wood.box({-1.2F, 0.85F, -0.45F}, {1.2F, 0.92F, 0.48F}, 1.0F, true);
    for (const float x : {-1.1F, 1.1F}) {
        wood.beam({x, -0.08F, -0.55F}, {x, 2.45F, -0.55F}, 0.09F);
        wood.beam({x, -0.08F, 0.55F}, {x, 2.05F, 0.55F}, 0.09F);
    }
    Part& cloth = maker.with(palette.common.cloth);
    constexpr int kStripes = 9;
    for (int i = 0; i < kStripes; ++i) {
        const float a = -1.3F + 2.6F * static_cast<float>(i) / kStripes;
        const float b = -1.3F + 2.6F * static_cast<float>(i + 1) / kStripes;
        cloth.colour = (i & 1) == 0 ? rgb(srgb) : rgb(0xEFE7D6);
        cloth.quad({a, 2.08F, 0.75F}, {b, 2.08F, 0.75F}, {b, 2.48F, -0.65F}, {a, 2.48F, -0.65F});
        cloth.triangle({a, 2.08F, 0.75F}, {0.5F * (a + b), 1.86F, 0.78F}, {b, 2.08F, 0.75F});
    }
    return maker.take("stall");
}

Mesh makeWares(const RingPalette& palette)
{
    MeshMaker maker;
    Part& gloss = maker.with(palette.gloss);
    constexpr std::array<std::uint32_t, 5> kTints{0xD8452E, 0xE9A12B, 0x6FA83A, 0xB04A8E, 0xE9D25A};
    Rng rng(502, 1);
    for (int basket = 0; basket < 3; ++basket) {
        const float x = -0.75F + 0.75F * static_cast<float>(basket);
        gloss.frame = at({x, 0, 0});
        gloss.colour = rgb(0x8A6238);
        gloss.lathe({{0.20F, 0.0F}, {0.30F, 0.13F}, {0.27F, 0.13F}, {0.0F, 0.05F}}, 14);
        gloss.colour = rgb(kTints[static_cast<std::size_t>(basket) + rng.below(3)]);
        for (int i = 0; i < 8; ++i) {
            const float a = kTau * static_cast<float>(i) / 7.0F;
            const float r = i == 7 ? 0.0F : 0.155F;
            gloss.frame = at({x + r * std::sin(a), i == 7 ? 0.22F : 0.13F, r * std::cos(a)});
            gloss.ball(0.085F, 1);
        }
    }
    return maker.take("wares");
}

} // namespace gnomon::worlds
