// SPDX-License-Identifier: Apache-2.0
#include "stage_props.h"

#include "mesh_maker.h"
#include "rng.h"

#include <glm/geometric.hpp>

#include <array>
#include <cmath>
#include <vector>

namespace gnomon::worlds {

Mesh makeColumn(const StagePalette& palette, float height_m)
{
    MeshMaker maker;
    Part& marble = maker.with(palette.marble);
    marble.uv_per_metre = 0.6F;
    marble.box({-0.42F, 0.0F, -0.42F}, {0.42F, 0.16F, 0.42F});
    const float h = height_m;
    marble.lathe({{0.40F, 0.16F}, {0.43F, 0.22F}, {0.40F, 0.28F}, {0.33F, 0.32F}, {0.35F, 0.37F}, {0.29F, 0.42F}}, 28,
                 true);
    marble.lathe({{0.29F, 0.42F}, {0.29F, 0.42F + 0.4F * (h - 0.8F)}, {0.25F, h - 0.38F}}, 28, true);
    marble.lathe({{0.28F, h - 0.38F}, {0.28F, h - 0.34F}, {0.25F, h - 0.32F}, {0.29F, h - 0.24F}, {0.40F, h - 0.14F}},
                 28, true);
    marble.box({-0.42F, h - 0.14F, -0.42F}, {0.42F, h, 0.42F}, 1.0F, true);
    return maker.take("column");
}

Mesh makeArch(const StagePalette& palette, float span_m)
{
    MeshMaker maker;
    Part& marble = maker.with(palette.marble);
    marble.uv_per_metre = 0.6F;
    constexpr int kStones = 15;
    const float inner = span_m * 0.5F - 0.36F;
    const float outer = span_m * 0.5F - 0.002F; // neighbours touch without sharing a plane
    constexpr float kDepth = 0.34F;
    const auto on = [](float radius, int stone, float z) {
        const float a = kPi * static_cast<float>(stone) / kStones;
        return glm::vec3(-radius * std::cos(a), radius * std::sin(a), z);
    };
    for (int i = 0; i < kStones; ++i) {
        const bool key = i == kStones / 2;
        const float out = key ? outer + 0.10F : outer;
        const float in = key ? inner - 0.06F : inner;
        const float d = key ? kDepth + 0.05F : kDepth;
        marble.quad(on(in, i + 1, d), on(out, i + 1, d), on(out, i, d), on(in, i, d));
        marble.quad(on(in, i, -d), on(out, i, -d), on(out, i + 1, -d), on(in, i + 1, -d));
        marble.quad(on(in, i, -d), on(in, i + 1, -d), on(in, i + 1, d), on(in, i, d));
        marble.quad(on(out, i, d), on(out, i + 1, d), on(out, i + 1, -d), on(out, i, -d));
        if (key) {
            marble.quad(on(in, i, d), on(out, i, d), on(out, i, -d), on(in, i, -d));
            marble.quad(on(in, i + 1, -d), on(out, i + 1, -d), on(out, i + 1, d), on(in, i + 1, d));
        }
    }
    return maker.take("arch");
}

Mesh makePedestal(const StagePalette& palette, float half_width_m, float height_m)
{
    MeshMaker maker;
    Part& marble = maker.with(palette.marble);
    marble.uv_per_metre = 0.6F;
    const float w = half_width_m;
    const auto slab = [&](float half, float low, float high) {
        marble.box({-half, low, -half}, {half, high, half}, 1.0F, true);
    };
    slab(w, 0.0F, 0.14F);
    slab(w * 0.9F, 0.14F, 0.2F);
    slab(w * 0.8F, 0.2F, height_m - 0.14F);
    slab(w * 0.95F, height_m - 0.14F, height_m);
    return maker.take("pedestal");
}

Mesh makeFigure(const StagePalette& palette)
{
    MeshMaker maker;
    Part& bronze = maker.with(palette.bronze);
    bronze.lathe({{0.44F, 0.0F},
                  {0.40F, 0.05F},
                  {0.33F, 0.35F},
                  {0.25F, 0.75F},
                  {0.19F, 1.02F},
                  {0.22F, 1.22F},
                  {0.245F, 1.36F},
                  {0.20F, 1.47F},
                  {0.085F, 1.53F},
                  {0.075F, 1.62F}},
                 26, true);
    // Folds of the robe.
    for (int i = 0; i < 9; ++i) {
        const float a = kTau * (static_cast<float>(i) + 0.3F * std::sin(static_cast<float>(i) * 2.1F)) / 9.0F;
        const auto on = [a](float r, float y, float twist) {
            return glm::vec3(r * std::sin(a + twist), y, r * std::cos(a + twist));
        };
        const std::array<glm::vec3, 4> fold{on(0.19F, 1.0F, 0.25F), on(0.25F, 0.72F, 0.1F), on(0.34F, 0.35F, 0.0F),
                                            on(0.44F, 0.02F, -0.05F)};
        const std::array<float, 4> radii{0.012F, 0.03F, 0.042F, 0.055F};
        bronze.tube(fold, radii, 6);
    }
    bronze.frame = at({0.0F, 1.74F, 0.015F}) * scaled({0.85F, 1.08F, 0.95F});
    bronze.ball(0.145F, 3);
    bronze.frame = at({0.0F, 1.78F, -0.06F});
    bronze.ball(0.125F, 2); // hair
    bronze.frame = glm::mat4(1.0F);
    const std::array<float, 4> arm{0.085F, 0.065F, 0.052F, 0.045F};
    const std::array<glm::vec3, 4> raised{
        glm::vec3(-0.20F, 1.40F, 0.0F), {-0.37F, 1.58F, 0.07F}, {-0.36F, 1.84F, 0.12F}, {-0.29F, 2.08F, 0.14F}};
    bronze.tube(raised, arm, 10);
    const std::array<glm::vec3, 4> lowered{
        glm::vec3(0.20F, 1.40F, 0.0F), {0.33F, 1.18F, 0.0F}, {0.33F, 0.98F, 0.10F}, {0.22F, 0.90F, 0.26F}};
    bronze.tube(lowered, arm, 10);
    Part& globe = maker.with(palette.brass);
    globe.frame = at({-0.27F, 2.23F, 0.15F});
    globe.ball(0.16F, 3);
    return maker.take("figure");
}

Mesh makeTeapot(const StagePalette& palette)
{
    MeshMaker maker;
    Part& glaze = maker.with(palette.glaze);
    glaze.lathe({{0.30F, 0.0F},
                 {0.33F, 0.04F},
                 {0.30F, 0.07F},
                 {0.45F, 0.17F},
                 {0.56F, 0.36F},
                 {0.55F, 0.52F},
                 {0.45F, 0.68F},
                 {0.33F, 0.76F},
                 {0.35F, 0.79F},
                 {0.34F, 0.82F}},
                36, true);
    glaze.lathe({{0.33F, 0.81F}, {0.24F, 0.88F}, {0.10F, 0.93F}, {0.05F, 0.96F}}, 32, true);
    glaze.lathe({{0.04F, 0.95F}, {0.045F, 0.98F}, {0.09F, 1.03F}, {0.07F, 1.09F}, {0.0F, 1.11F}}, 20, true);
    const std::array<glm::vec3, 6> spout{glm::vec3(0.42F, 0.30F, 0), {0.58F, 0.34F, 0}, {0.72F, 0.45F, 0},
                                         {0.80F, 0.60F, 0},          {0.87F, 0.72F, 0}, {0.95F, 0.79F, 0}};
    const std::array<float, 6> narrowing{0.15F, 0.125F, 0.095F, 0.075F, 0.065F, 0.07F};
    glaze.tube(spout, narrowing, 14);
    std::vector<glm::vec3> handle;
    for (int i = 0; i <= 10; ++i) {
        const float a = kPi * (0.5F + static_cast<float>(i) / 10.0F);
        handle.emplace_back(-0.46F + 0.38F * std::cos(a), 0.45F + 0.23F * std::sin(a), 0.0F);
    }
    const std::vector<float> thick(handle.size(), 0.045F);
    glaze.tube(handle, thick, 12);
    return maker.take("teapot");
}

Mesh makeUrn(const StagePalette& palette)
{
    MeshMaker maker;
    Part& marble = maker.with(palette.marble);
    marble.uv_per_metre = 0.6F;
    marble.lathe({{0.30F, 0.0F},
                  {0.32F, 0.05F},
                  {0.20F, 0.14F},
                  {0.12F, 0.22F},
                  {0.16F, 0.28F},
                  {0.36F, 0.52F},
                  {0.46F, 0.82F},
                  {0.44F, 1.05F},
                  {0.27F, 1.28F},
                  {0.22F, 1.40F},
                  {0.33F, 1.50F},
                  {0.36F, 1.53F},
                  {0.30F, 1.53F},
                  {0.18F, 1.40F}},
                 36, true);
    for (const float side : {-1.0F, 1.0F}) {
        std::vector<glm::vec3> handle;
        for (int i = 0; i <= 8; ++i) {
            const float a = kPi * (-0.45F + 0.95F * static_cast<float>(i) / 8.0F);
            handle.emplace_back(side * (0.36F + 0.19F * std::cos(a)), 1.17F + 0.22F * std::sin(a), 0.0F);
        }
        const std::vector<float> thick(handle.size(), 0.035F);
        marble.tube(handle, thick, 10);
    }
    return maker.take("urn");
}

Mesh makeChessPiece(const StagePalette& palette)
{
    MeshMaker maker;
    Part& pearl = maker.with(palette.pearl);
    pearl.lathe({{0.22F, 0.0F},
                 {0.23F, 0.05F},
                 {0.20F, 0.10F},
                 {0.13F, 0.15F},
                 {0.09F, 0.36F},
                 {0.08F, 0.48F},
                 {0.15F, 0.52F},
                 {0.09F, 0.56F}},
                24, true);
    pearl.frame = at({0, 0.66F, 0});
    pearl.ball(0.135F, 3);
    return maker.take("piece");
}

Mesh makeCrateStack(const StagePalette& palette)
{
    MeshMaker maker;
    Part& wood = maker.with(palette.wood);
    wood.uv_per_metre = 0.7F;
    const std::array<glm::vec4, 3> places{
        glm::vec4(0, 0, 0, 0.12F), {1.15F, 0, 0.35F, -0.25F}, {0.35F, 1.0F, 0.08F, 0.5F}};
    for (const glm::vec4& p : places) {
        wood.frame = at(glm::vec3(p)) * turnedY(p.w) * scaled(glm::vec3(p.y > 0.0F ? 0.8F : 1.0F));
        wood.colour = rgb(0xB5894F);
        wood.box({-0.46F, 0.04F, -0.46F}, {0.46F, 0.96F, 0.46F});
        wood.colour = rgb(0x7C5730);
        for (const float a : {-0.45F, 0.45F}) {
            for (const float b : {-0.45F, 0.45F}) {
                wood.beam({a, 0.0F, b}, {a, 1.0F, b}, 0.1F);
                wood.beam({-0.5F, b + 0.5F, a}, {0.5F, b + 0.5F, a}, 0.1F);
                wood.beam({a, b + 0.5F, -0.5F}, {a, b + 0.5F, 0.5F}, 0.1F);
            }
        }
        wood.beam({-0.42F, 0.06F, 0.47F}, {0.42F, 0.94F, 0.47F}, 0.09F);
        wood.beam({0.47F, 0.06F, 0.42F}, {0.47F, 0.94F, -0.42F}, 0.09F);
    }
    return maker.take("crates");
}

Mesh makeRing(const StagePalette& palette, float radius_m, float thickness_m)
{
    MeshMaker maker;
    constexpr int kCorners = 40;
    std::vector<glm::vec3> path;
    for (int i = 0; i < kCorners; ++i) {
        const float a = kTau * static_cast<float>(i) / kCorners;
        path.emplace_back(radius_m * std::cos(a), radius_m * std::sin(a), 0.0F);
    }
    const std::vector<float> radii(path.size(), thickness_m);
    maker.with(palette.brass).tube(path, radii, 10, true);
    return maker.take("ring");
}

Mesh makeLampHousing(const StagePalette& palette)
{
    MeshMaker maker;
    maker.setFrame(turnedX(kPi * 0.5F)); // the lathe's axis, +y, becomes +z: behind the light
    Part& iron = maker.with(palette.iron);
    iron.lathe({{0.26F, -0.25F}, {0.24F, 0.25F}, {0.14F, 0.45F}, {0.0F, 0.5F}}, 20);
    iron.lathe({{0.21F, 0.05F}, {0.24F, -0.25F}}, 20); // inside
    Part& glow = maker.with(palette.glow);
    glow.lathe({{0.0F, -0.02F}, {0.21F, -0.02F}}, 20);
    return maker.take("lamp housing");
}

} // namespace gnomon::worlds
