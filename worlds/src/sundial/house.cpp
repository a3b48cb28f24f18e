// SPDX-License-Identifier: Apache-2.0
#include "things.h"

#include "../mesh_maker.h"
#include "../rng.h"

#include <glm/geometric.hpp>

#include <array>
#include <cmath>

namespace gnomon::worlds {

namespace {

constexpr float kHalfLength_m = 6.0F; // along x
constexpr float kHalfDepth_m = 3.2F;  // along z
constexpr float kWall_m = 4.6F;
constexpr float kGable_m = 3.0F;
constexpr float kEaves_m = 0.9F; // how far the roof overhangs

constexpr int kBays = 5;
constexpr float kBay_m = 2.3F;
constexpr float kPier_m = 0.5F;
constexpr float kPierZ_m = 5.7F; // the middle of the row of piers
constexpr float kSpring_m = 1.75F;
constexpr float kArchTop_m = 3.05F;
constexpr float kLeanPitch = 0.30F;

constexpr std::uint32_t kLime = 0xE9DDC4;
constexpr std::uint32_t kTimber = 0x5A412B;

/// The upper face of the arcade's roof.
float leanTo(float z)
{
    return 3.95F - kLeanPitch * (z - kHalfDepth_m);
}

void addWalls(const SundialPalette& palette, MeshMaker& maker)
{
    Part& stone = maker.with(palette.common.stone);
    stone.uv_per_metre = 0.35F;
    stone.colour = rgb(0xA39A8B);
    const float w = kHalfLength_m;
    const float d = kHalfDepth_m;
    stone.box({-w - 0.1F, -1.2F, -d - 0.1F}, {w + 0.1F, 0.75F, d + 0.1F});
    Part& wall = maker.with(palette.plaster);
    wall.uv_per_metre = 0.3F;
    wall.colour = rgb(kLime);
    wall.box({-w, 0.75F, -d}, {w, kWall_m, d});
    wall.triangle({w, kWall_m, d}, {w, kWall_m, -d}, {w, kWall_m + kGable_m, 0});
    wall.triangle({-w, kWall_m, -d}, {-w, kWall_m, d}, {-w, kWall_m + kGable_m, 0});
    Part& wood = maker.with(palette.common.wood);
    wood.uv_per_metre = 0.5F;
    wood.colour = rgb(kTimber);
    for (const float x : {-w, w}) { // the gables' frame, and rafters' ends below the eaves
        wood.beam({x, kWall_m, -d}, {x, kWall_m, d}, 0.22F);
        wood.beam({x, kWall_m, 0}, {x, kWall_m + kGable_m - 0.2F, 0}, 0.18F);
        for (const float s : {-1.0F, 1.0F}) {
            wood.beam({x, kWall_m + 0.1F, s * 1.7F}, {x, kWall_m + 1.35F, 0}, 0.15F);
        }
    }
}

void addRoofs(const SundialPalette& palette, MeshMaker& maker)
{
    constexpr float kThick = 0.18F; // as Part::gable has it
    constexpr float kSlope = kGable_m / kHalfDepth_m;
    constexpr float kHalf = kHalfDepth_m + kEaves_m;
    Part& roof = maker.with(palette.common.shingle);
    roof.uv_per_metre = 0.42F;
    roof.colour = rgb(0xA8553C);
    // The underside lies two centimetres below the top of the walls, so that no light passes between.
    roof.frame = at({0, kWall_m - 0.02F + kThick - kSlope * kEaves_m, 0}) * turnedY(kPi * 0.5F);
    roof.gable(2.0F * kHalf, kSlope * kHalf, 2.0F * kHalfLength_m + 1.5F);
    roof.frame = glm::mat4(1.0F);
    const float x = kHalfLength_m + 0.35F;
    const float back = kHalfDepth_m;
    const float front = 6.6F;
    const auto top = [](float px, float z) {
        return glm::vec3(px, leanTo(z), z);
    };
    const auto bottom = [](float px, float z) {
        return glm::vec3(px, leanTo(z) - 0.14F, z);
    };
    roof.quad(top(-x, front), top(x, front), top(x, back), top(-x, back));
    roof.quad(bottom(-x, front), bottom(x, front), top(x, front), top(-x, front));
    roof.quad(bottom(x, front), bottom(x, back), top(x, back), top(x, front));
    roof.quad(bottom(-x, back), bottom(-x, front), top(-x, front), top(-x, back));
    Part& wood = maker.with(palette.common.wood);
    wood.colour = rgb(0x7A5C3E);
    wood.quad(bottom(-x, back), bottom(x, back), bottom(x, front), bottom(-x, front));
    wood.colour = rgb(kTimber);
    for (int i = 0; i <= 12; ++i) { // rafters of the lean-to
        const float rx = -x + 0.25F + (2.0F * x - 0.5F) * static_cast<float>(i) / 12.0F;
        wood.beam(bottom(rx, back) - glm::vec3(0, 0.05F, 0), bottom(rx, front - 0.08F) - glm::vec3(0, 0.05F, 0), 0.10F);
    }
}

/// Wall over arches from the spring line to the lean-to's roof, on piers.
void addArcade(const SundialPalette& palette, MeshMaker& maker)
{
    constexpr int kStones = 12; // stones of an arch
    const float first = -0.5F * kBays * kBay_m;
    const float radius = 0.5F * (kBay_m - kPier_m);
    const float front = kPierZ_m + 0.5F * kPier_m;
    const float back = kPierZ_m - 0.5F * kPier_m;
    Part& wall = maker.with(palette.plaster);
    wall.colour = rgb(kLime);
    const auto faces = [&](float x0, float y0, float x1, float y1) { // a strip of wall up to the roof, both sides
        wall.quad({x0, y0, front}, {x1, y1, front}, {x1, kArchTop_m, front}, {x0, kArchTop_m, front});
        const float top = leanTo(back) - 0.05F;
        wall.quad({x1, y1, back}, {x0, y0, back}, {x0, top, back}, {x1, top, back});
    };
    for (int bay = 0; bay < kBays; ++bay) {
        const float centre = first + (static_cast<float>(bay) + 0.5F) * kBay_m;
        const auto on = [&](int stone) {
            const float a = kPi * (1.0F - static_cast<float>(stone) / kStones);
            return glm::vec2(centre + radius * std::cos(a), kSpring_m + radius * std::sin(a));
        };
        for (int i = 0; i < kStones; ++i) {
            const glm::vec2 a = on(i);
            const glm::vec2 b = on(i + 1);
            faces(a.x, a.y, b.x, b.y);
            wall.quad({a.x, a.y, back}, {b.x, b.y, back}, {b.x, b.y, front}, {a.x, a.y, front}); // the arch from below
        }
    }
    Part& stone = maker.with(palette.pale_stone);
    stone.uv_per_metre = 0.5F;
    stone.colour = rgb(0xC9BFAC);
    for (int pier = 0; pier <= kBays; ++pier) {
        const float x = first + static_cast<float>(pier) * kBay_m;
        const float h = 0.5F * kPier_m;
        faces(x - h, kSpring_m, x + h, kSpring_m);
        stone.box({x - h, -0.6F, back}, {x + h, kSpring_m, front});
        stone.box({x - h - 0.06F, -0.6F, back - 0.06F}, {x + h + 0.06F, 0.34F, front + 0.06F});
        stone.box({x - h - 0.06F, kSpring_m - 0.14F, back - 0.06F}, {x + h + 0.06F, kSpring_m, front + 0.06F}, 1.0F,
                  true);
    }
    for (const float side : {-1.0F, 1.0F}) { // the ends: a beam from the last pier to the house
        const float outer = side * (0.5F * kBays * kBay_m + 0.5F * kPier_m);
        const float inner = outer - side * kPier_m;
        wall.box({std::min(outer, inner), 2.72F, kHalfDepth_m - 0.1F},
                 {std::max(outer, inner), leanTo(back) - 0.10F, back}, 1.0F, true);
        // The gap between the row of arches' front and the roof at the corner.
        const glm::vec3 low(outer, kSpring_m, front);
        const std::array<glm::vec3, 4> end{
            low, {outer, kSpring_m, back}, {outer, leanTo(back) - 0.05F, back}, {outer, kArchTop_m, front}};
        if (side > 0.0F) {
            wall.quad(end[0], end[1], end[2], end[3]);
        } else {
            wall.quad(end[1], end[0], end[3], end[2]);
        }
    }
    Part& floor = maker.with(palette.common.stone);
    floor.colour = rgb(0xB3A994);
    floor.box({-kHalfLength_m, -0.8F, kHalfDepth_m}, {kHalfLength_m, 0.18F, front + 0.25F});
}

/// A dark pane in a frame with a sill, and shutters, on a wall that faces `outward`.
void addWindow(const SundialPalette& palette, MeshMaker& maker, const glm::vec3& centre, float facing_rad)
{
    const glm::mat4 frame = at(centre) * turnedY(facing_rad); // outward is +z
    Part& pane = maker.with(palette.common.plain);
    pane.frame = frame;
    pane.colour = litByNight(rgb(0x39424B));
    pane.quad({-0.42F, -0.62F, 0.02F}, {0.42F, -0.62F, 0.02F}, {0.42F, 0.62F, 0.02F}, {-0.42F, 0.62F, 0.02F});
    Part& wood = maker.with(palette.common.wood);
    wood.frame = frame;
    wood.colour = rgb(0xDCD3C0);
    for (const float x : {-0.45F, 0.0F, 0.45F}) {
        const float h = x == 0.0F ? 0.022F : 0.05F;
        wood.box({x - h, -0.66F, -0.05F}, {x + h, 0.66F, 0.055F});
    }
    for (const float y : {-0.62F, 0.08F, 0.62F}) {
        const float h = y == 0.08F ? 0.022F : 0.05F;
        wood.box({-0.45F, y - h, -0.05F}, {0.45F, y + h, 0.05F}, 1.0F, true);
    }
    wood.box({-0.62F, -0.78F, -0.05F}, {0.62F, -0.68F, 0.14F}, 1.0F, true);
    wood.colour = rgb(0x47695E);
    for (const float x : {-0.80F, 0.80F}) {
        wood.box({x - 0.26F, -0.66F, 0.0F}, {x + 0.26F, 0.66F, 0.05F}, 1.0F, true);
        for (const float y : {-0.34F, 0.34F}) {
            wood.box({x - 0.22F, y - 0.06F, 0.05F}, {x + 0.22F, y + 0.06F, 0.07F}, 1.0F, true);
        }
    }
    wood.frame = pane.frame = glm::mat4(1.0F);
    pane.colour.a = 1.0F;
}

void addDoor(const SundialPalette& palette, MeshMaker& maker, const glm::vec3& foot)
{
    Part& wood = maker.with(palette.common.wood);
    wood.colour = rgb(kTimber);
    wood.box(foot + glm::vec3(-0.72F, 0, -0.1F), foot + glm::vec3(0.72F, 2.34F, 0.12F));
    wood.colour = rgb(0x7C4A35);
    wood.box(foot + glm::vec3(-0.6F, 0, 0), foot + glm::vec3(0.6F, 2.22F, 0.16F));
}

} // namespace

Mesh makeHouse(const SundialPalette& palette)
{
    MeshMaker maker;
    addWalls(palette, maker);
    addRoofs(palette, maker);
    addArcade(palette, maker);
    for (const float x : {-4.6F, -2.3F, 2.3F, 4.6F}) {
        addWindow(palette, maker, {x, 1.85F, kHalfDepth_m}, 0.0F);
    }
    for (const float x : {-3.6F, 0.0F, 3.6F}) {
        addWindow(palette, maker, {x, 2.3F, -kHalfDepth_m}, kPi);
    }
    for (const float side : {-1.0F, 1.0F}) {
        for (const float z : {-1.5F, 1.5F}) {
            addWindow(palette, maker, {side * kHalfLength_m, 2.2F, z}, side * kPi * 0.5F);
        }
    }
    addDoor(palette, maker, {0, 0.18F, kHalfDepth_m + 0.02F});
    Part& stone = maker.with(palette.common.stone);
    stone.colour = rgb(0x9A9186);
    stone.box({2.9F, 5.4F, -1.5F}, {3.8F, 8.7F, -0.6F}, 0.88F);
    stone.box({2.84F, 8.55F, -1.56F}, {3.86F, 8.8F, -0.54F}, 1.0F, true);
    return maker.take("house");
}

} // namespace gnomon::worlds
