// SPDX-License-Identifier: Apache-2.0
#include "../mesh_maker.h"
#include "../rng.h"
#include "buildings.h"

#include <array>
#include <cmath>

namespace gnomon::worlds {

namespace {

constexpr std::uint32_t kTimber = 0x5F432B;
constexpr std::uint32_t kLime = 0xE3D3B0;

/// Walls of a house with a gabled end, posts and rails on them.
void timberedWalls(MeshMaker& maker, const Palette& palette, const glm::vec3& size, float gable_height)
{
    const float w = size.x * 0.5F;
    const float l = size.z * 0.5F;
    Part& stone = maker.with(palette.stone);
    stone.uv_per_metre = 0.35F;
    stone.colour = rgb(0x9C958A);
    stone.box({-w - 0.12F, -1.5F, -l - 0.12F}, {w + 0.12F, 0.7F, l + 0.12F});
    Part& wall = maker.with(palette.plain);
    wall.colour = rgb(kLime);
    wall.box({-w, 0.7F, -l}, {w, size.y, l});
    wall.triangle({-w, size.y, l}, {w, size.y, l}, {0, size.y + gable_height, l});
    wall.triangle({w, size.y, -l}, {-w, size.y, -l}, {0, size.y + gable_height, -l});
    Part& wood = maker.with(palette.wood);
    wood.uv_per_metre = 0.5F;
    wood.colour = rgb(kTimber);
    for (const float x : {-w, w}) {
        for (const float z : {-l, l}) {
            wood.box({x - 0.14F, 0.7F, z - 0.14F}, {x + 0.14F, size.y, z + 0.14F});
        }
    }
    for (const float z : {-l, l}) {
        wood.beam({-w, size.y, z}, {w, size.y, z}, 0.24F);
        wood.beam({0, size.y, z}, {0, size.y + gable_height - 0.2F, z}, 0.2F);
    }
}

void door(MeshMaker& maker, const Palette& palette, const glm::vec3& foot, float width, float height)
{
    Part& wood = maker.with(palette.wood);
    wood.colour = rgb(0x4A3220);
    const float w = width * 0.5F;
    wood.box({foot.x - w - 0.12F, foot.y, foot.z - 0.1F},
             {foot.x + w + 0.12F, foot.y + height + 0.15F, foot.z + 0.08F});
    wood.colour = rgb(0x8C5F36);
    wood.box({foot.x - w, foot.y, foot.z}, {foot.x + w, foot.y + height, foot.z + 0.14F});
}

/// A dark pane with a warm glow behind it, on a wall that faces `outward` (along x or z).
void window(MeshMaker& maker, const Palette& palette, const glm::vec3& centre, const glm::vec3& outward)
{
    const glm::vec3 side = glm::vec3(outward.z, 0, -outward.x) * 0.38F;
    const glm::vec3 up(0, 0.48F, 0);
    Part& pane = maker.with(palette.plain);
    pane.colour = litByNight(rgb(0x3C3A3A));
    const glm::vec3 c = centre + outward * 0.05F;
    pane.quad(c - side - up, c + side - up, c + side + up, c - side + up);
    pane.colour.a = 1.0F;
    Part& wood = maker.with(palette.wood);
    wood.colour = rgb(kTimber);
    wood.beam(c - side * 1.3F - up, c + side * 1.3F - up, 0.16F);
    wood.beam(c - side * 1.3F + up, c + side * 1.3F + up, 0.16F);
}

void chimney(MeshMaker& maker, const Palette& palette, const glm::vec3& foot, float height)
{
    Part& stone = maker.with(palette.stone);
    stone.uv_per_metre = 0.35F;
    stone.colour = rgb(0x8F8880);
    stone.box(foot - glm::vec3(0.45F, 0, 0.45F), foot + glm::vec3(0.45F, height, 0.45F), 0.85F);
    stone.box(foot + glm::vec3(-0.5F, height, -0.5F), foot + glm::vec3(0.5F, height + 0.25F, 0.5F));
}

} // namespace

Mesh makeBarracks(const Palette& palette)
{
    MeshMaker maker;
    timberedWalls(maker, palette, {6.4F, 3.6F, 12.0F}, 3.4F);
    Part& wood = maker.with(palette.wood);
    for (const float z : {-3.6F, 0.0F, 3.6F}) {
        for (const float x : {-3.2F, 3.2F}) {
            wood.box({x - 0.12F, 0.7F, z - 0.12F}, {x + 0.12F, 3.6F, z + 0.12F});
            window(maker, palette, {x, 2.2F, z + 1.8F}, {x > 0 ? 1.0F : -1.0F, 0, 0});
        }
    }
    door(maker, palette, {0, 0, 6.1F}, 1.7F, 2.6F);
    Part& roof = maker.with(palette.shingle);
    roof.uv_per_metre = 0.42F;
    roof.colour = rgb(0xA4523A);
    roof.frame = at({0, 3.45F, 0});
    roof.gable(8.0F, 4.1F, 13.2F);
    chimney(maker, palette, {1.7F, 4.2F, -3.0F}, 4.2F);
    Part& shield = maker.with(palette.plain);
    shield.colour = rgb(0x2F57A8);
    shield.frame = at({0, 4.9F, 6.05F}) * turnedX(kPi * 0.5F);
    shield.lathe({{0.75F, 0.0F}, {0.75F, 0.16F}, {0.0F, 0.32F}}, 8);
    return maker.take("barracks");
}

Mesh makeCottage(const Palette& palette, int variant)
{
    MeshMaker maker;
    const glm::vec3 size = variant == 0 ? glm::vec3(5.4F, 2.9F, 7.0F) : glm::vec3(4.8F, 2.5F, 6.2F);
    timberedWalls(maker, palette, size, variant == 0 ? 3.0F : 2.9F);
    const float w = size.x * 0.5F;
    const float l = size.z * 0.5F;
    door(maker, palette, {-0.6F, 0, l + 0.08F}, 1.1F, 2.1F);
    window(maker, palette, {1.4F, 1.8F, l}, {0, 0, 1});
    for (const float z : {-1.6F, 1.4F}) {
        window(maker, palette, {w, 1.8F, z}, {1, 0, 0});
        window(maker, palette, {-w, 1.8F, z}, {-1, 0, 0});
    }
    Part& roof = maker.with(variant == 0 ? palette.shingle : palette.thatch);
    roof.uv_per_metre = 0.42F;
    roof.colour = variant == 0 ? rgb(0x6E7F93) : rgb(0xC9A45A);
    roof.frame = at({0, size.y - 0.18F, 0});
    roof.gable(size.x + 1.5F, variant == 0 ? 3.7F : 3.6F, size.z + 1.2F);
    if (variant != 0) {
        roof.colour = rgb(0xA98543);
        roof.frame = glm::mat4(1.0F);
        roof.beam({0, size.y + 3.35F, -l - 0.7F}, {0, size.y + 3.35F, l + 0.7F}, 0.5F);
    }
    chimney(maker, palette, {w * 0.5F, size.y + 0.6F, -l * 0.5F}, 3.4F);
    return maker.take(variant == 0 ? "cottage, shingled" : "cottage, thatched");
}

Mesh makeRoundhouse(const Palette& palette)
{
    MeshMaker maker;
    Part& wall = maker.with(palette.plain);
    wall.colour = rgb(0xC7A67A);
    wall.lathe({{2.75F, -1.5F}, {2.75F, 0.4F}, {2.65F, 2.2F}}, 12);
    Part& roof = maker.with(palette.thatch);
    roof.uv_per_metre = 0.4F;
    roof.colour = rgb(0xBE9A52);
    roof.lathe({{0.5F, 1.75F}, {3.6F, 1.6F}, {3.55F, 1.9F}, {2.1F, 3.7F}, {0.45F, 5.3F}, {0.0F, 5.5F}}, 12);
    Part& wood = maker.with(palette.wood);
    wood.colour = rgb(kTimber);
    for (int i = 0; i < 8; ++i) {
        const float a = kTau * (static_cast<float>(i) + 0.5F) / 8.0F;
        wood.beam({2.72F * std::sin(a), -0.5F, 2.72F * std::cos(a)}, {2.68F * std::sin(a), 2.2F, 2.68F * std::cos(a)},
                  0.24F);
    }
    door(maker, palette, {0, 0, 2.68F}, 1.1F, 1.9F);
    return maker.take("roundhouse");
}

Mesh makePavilion(const Palette& palette, std::uint32_t srgb)
{
    MeshMaker maker;
    Part& cloth = maker.with(palette.cloth);
    constexpr int kSides = 12;
    const std::array<glm::vec4, 2> stripes{rgb(srgb), rgb(0xEFE6D2)};
    const auto corner = [](int side, float radius, float y) {
        const float a = kTau * static_cast<float>(side) / kSides;
        return glm::vec3(radius * std::sin(a), y, radius * std::cos(a));
    };
    for (int side = 0; side < kSides; ++side) {
        cloth.colour = stripes[static_cast<std::size_t>(side & 1)];
        if (side != 0) { // the entrance
            cloth.quad(corner(side, 2.5F, -0.4F), corner(side + 1, 2.5F, -0.4F), corner(side + 1, 2.4F, 1.8F),
                       corner(side, 2.4F, 1.8F));
        }
        cloth.quad(corner(side, 2.75F, 1.5F), corner(side + 1, 2.75F, 1.5F), corner(side + 1, 2.62F, 1.95F),
                   corner(side, 2.62F, 1.95F));
        cloth.quad(corner(side, 2.62F, 1.95F), corner(side + 1, 2.62F, 1.95F), corner(side + 1, 1.0F, 3.1F),
                   corner(side, 1.0F, 3.1F));
        cloth.triangle(corner(side, 1.0F, 3.1F), corner(side + 1, 1.0F, 3.1F), {0, 4.6F, 0});
    }
    Part& wood = maker.with(palette.wood);
    wood.colour = rgb(kTimber);
    wood.beam({0, 0, 0}, {0, 6.2F, 0}, 0.14F);
    Part& ball = maker.with(palette.plain);
    ball.colour = rgb(0xE0B84A);
    ball.frame = at({0, 6.3F, 0});
    ball.ball(0.16F, 0);
    return maker.take("pavilion");
}

Mesh makeWindmill(const Palette& palette)
{
    MeshMaker maker;
    Part& stone = maker.with(palette.stone);
    stone.uv_per_metre = 0.35F;
    stone.colour = rgb(0xB5AC9C);
    stone.lathe({{3.5F, -2.0F}, {3.2F, 2.4F}}, 8, false, true);
    Part& wall = maker.with(palette.plain);
    wall.colour = rgb(0xE6DAC0);
    wall.lathe({{3.1F, 2.4F}, {2.1F, 8.6F}}, 8, false, true);
    Part& wood = maker.with(palette.wood);
    wood.colour = rgb(kTimber);
    wood.uv_per_metre = 0.5F;
    wood.lathe({{2.2F, 2.35F}, {3.9F, 2.3F}, {3.9F, 2.5F}, {2.2F, 2.52F}}, 8, false, true); // the stage around it
    Part& roof = maker.with(palette.shingle);
    roof.uv_per_metre = 0.42F;
    roof.colour = rgb(0x8C4A36);
    roof.lathe({{1.5F, 8.5F}, {2.6F, 8.45F}, {2.35F, 9.4F}, {1.4F, 11.0F}, {0.0F, 12.0F}}, 8, false, true);
    wood.beam({0, kSailHub.y, 0}, kSailHub + glm::vec3(0, 0, 0.3F), 0.42F);
    door(maker, palette, {0, 0, 3.12F}, 1.3F, 2.1F);
    window(maker, palette, {0, 5.4F, 2.45F}, {0, 0, 1});
    window(maker, palette, {2.45F, 5.4F, 0}, {1, 0, 0});
    window(maker, palette, {-2.45F, 5.4F, 0}, {-1, 0, 0});
    return maker.take("windmill");
}

Mesh makeSails(const Palette& palette)
{
    MeshMaker maker;
    for (int i = 0; i < 4; ++i) {
        const glm::mat4 turn = turnedZ(kPi * 0.5F * static_cast<float>(i));
        Part& wood = maker.with(palette.wood);
        wood.frame = turn;
        wood.colour = rgb(kTimber);
        wood.beam({0, 0, 0.1F}, {0, 6.4F, 0.1F}, 0.2F);
        for (int k = 0; k < 4; ++k) {
            const float y = 1.6F + 1.5F * static_cast<float>(k);
            wood.beam({-0.1F, y, 0.12F}, {1.45F, y, 0.3F}, 0.1F);
        }
        Part& cloth = maker.with(palette.cloth);
        cloth.frame = turn;
        cloth.colour = rgb(0xEDE3CC);
        cloth.quad({0.05F, 1.5F, 0.16F}, {1.45F, 1.5F, 0.36F}, {1.45F, 6.2F, 0.36F}, {0.05F, 6.2F, 0.16F});
    }
    return maker.take("sails");
}

} // namespace gnomon::worlds
