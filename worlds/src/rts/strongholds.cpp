// SPDX-License-Identifier: Apache-2.0
#include "../mesh_maker.h"
#include "../rng.h"
#include "buildings.h"

#include <array>
#include <cmath>

namespace gnomon::worlds {

namespace {

constexpr std::uint32_t kTimber = 0x6B4A2E;

void merlons(Part& stone, float half_x, float half_z, float y)
{
    const auto row = [&](bool along_x, float across) {
        const float half = along_x ? half_x : half_z;
        const int count = static_cast<int>(half * 2.0F / 2.6F);
        for (int i = 0; i <= count; ++i) {
            const float at_m = -half + 2.0F * half * static_cast<float>(i) / static_cast<float>(count);
            const glm::vec3 c = along_x ? glm::vec3(at_m, y, across) : glm::vec3(across, y, at_m);
            stone.box(c - glm::vec3(0.42F, 0, 0.42F), c + glm::vec3(0.42F, 0.85F, 0.42F));
        }
    };
    row(true, half_z);
    row(true, -half_z);
    row(false, half_x);
    row(false, -half_x);
}

void slit(Part& plain, const glm::vec3& centre, const glm::vec3& outward)
{
    const glm::vec3 side = glm::vec3(outward.z, 0, -outward.x) * 0.22F;
    const glm::vec3 up(0, 0.75F, 0);
    const glm::vec3 c = centre + outward * 0.04F;
    plain.quad(c - side - up, c + side - up, c + side + up, c - side + up);
}

} // namespace

Mesh makeKeep(const Palette& palette)
{
    MeshMaker maker;
    Part& stone = maker.with(palette.stone);
    stone.uv_per_metre = 0.25F;
    stone.colour = rgb(0xA9A193);
    stone.box({-7.6F, -2.0F, -6.6F}, {7.6F, 1.4F, 6.6F}, 0.93F);
    stone.colour = rgb(0xC4BBA9);
    stone.box({-6.8F, 1.3F, -5.8F}, {6.8F, 9.0F, 5.8F}, 0.97F);
    stone.box({-3.4F, 9.0F, -3.4F}, {3.4F, 13.4F, 3.4F}, 0.95F);
    stone.colour = rgb(0xB4AB9B);
    stone.box({-6.95F, 8.6F, -5.95F}, {6.95F, 9.3F, 5.95F});
    merlons(stone, 6.5F, 5.5F, 9.3F);
    Part& roof = maker.with(palette.shingle);
    roof.uv_per_metre = 0.42F;
    for (const float x : {-6.7F, 6.7F}) {
        for (const float z : {-5.7F, 5.7F}) {
            stone.frame = at({x, 0, z});
            stone.colour = rgb(0xBDB4A3);
            stone.lathe({{2.5F, -2.0F}, {2.1F, 1.5F}, {2.0F, 10.6F}, {2.4F, 11.2F}, {2.4F, 12.0F}}, 8);
            roof.frame = at({x, 0, z});
            roof.colour = rgb(0x39589C);
            roof.lathe({{2.0F, 11.9F}, {2.85F, 11.8F}, {1.3F, 14.4F}, {0.0F, 17.0F}}, 8);
        }
    }
    stone.frame = glm::mat4(1.0F);
    roof.frame = at({0, 13.3F, 0});
    roof.lathe({{2.0F, -0.1F}, {5.4F, -0.1F}, {2.4F, 2.2F}, {0.0F, 3.8F}}, 4, false, true);
    Part& dark = maker.with(palette.plain);
    dark.colour = rgb(0x35302E);
    for (const float x : {-3.4F, 3.4F}) {
        slit(dark, {x, 6.0F, 5.72F}, {0, 0, 1});
        slit(dark, {x, 6.0F, -5.72F}, {0, 0, -1});
    }
    for (const float z : {-2.6F, 2.6F}) {
        slit(dark, {6.73F, 6.0F, z}, {1, 0, 0});
        slit(dark, {-6.73F, 6.0F, z}, {-1, 0, 0});
    }
    Part& wood = maker.with(palette.wood);
    wood.colour = rgb(0x55391F);
    wood.box({-1.7F, 1.2F, 5.0F}, {1.7F, 4.8F, 6.05F});
    stone.colour = rgb(0x98907F);
    for (int i = 0; i < 3; ++i) { // steps to the door
        const auto s = static_cast<float>(i);
        stone.box({-2.6F, -0.5F, 6.0F}, {2.6F, 1.35F - 0.42F * s, 7.2F + 0.7F * s});
    }
    wood.beam({0, 16.0F, 0}, {0, kKeepFlag_m + 1.8F, 0}, 0.16F);
    return maker.take("keep");
}

Mesh makeGatehouse(const Palette& palette)
{
    MeshMaker maker;
    Part& wood = maker.with(palette.wood);
    wood.uv_per_metre = 0.5F;
    Part& stone = maker.with(palette.stone);
    stone.uv_per_metre = 0.3F;
    Part& roof = maker.with(palette.shingle);
    roof.uv_per_metre = 0.42F;
    for (const float x : {-4.6F, 4.6F}) {
        stone.colour = rgb(0xA59C8D);
        stone.box({x - 1.9F, -2.0F, -1.9F}, {x + 1.9F, 3.2F, 1.9F}, 0.9F);
        wood.colour = rgb(0x7C5735);
        wood.box({x - 1.7F, 3.1F, -1.7F}, {x + 1.7F, 6.4F, 1.7F}, 0.95F);
        wood.colour = rgb(kTimber);
        wood.box({x - 2.0F, 6.3F, -2.0F}, {x + 2.0F, 6.6F, 2.0F}, 1.0F, true);
        for (const float dx : {-1.8F, 1.8F}) {
            for (const float dz : {-1.8F, 1.8F}) {
                wood.beam({x + dx, 6.5F, dz}, {x + dx, 8.5F, dz}, 0.24F);
            }
        }
        roof.frame = at({x, 8.4F, 0});
        roof.colour = rgb(0x39589C);
        roof.lathe({{1.5F, -0.1F}, {3.4F, 0.0F}, {0.0F, 3.2F}}, 4, false, true);
    }
    wood.colour = rgb(kTimber);
    wood.box({-3.0F, 4.2F, -0.6F}, {3.0F, 5.0F, 0.6F}, 1.0F, true);
    wood.box({-3.0F, 5.6F, -0.7F}, {3.0F, 5.85F, 0.7F}, 1.0F, true);
    for (const float z : {-0.6F, 0.6F}) {
        wood.beam({-3.0F, 6.6F, z}, {3.0F, 6.6F, z}, 0.16F);
    }
    for (const float side : {-1.0F, 1.0F}) { // leaves of the gate, open inwards
        wood.box({side * 2.72F - 0.12F, 0.0F, -3.0F}, {side * 2.72F + 0.12F, 4.0F, -0.4F});
    }
    return maker.take("gatehouse");
}

Mesh makeWatchtower(const Palette& palette)
{
    MeshMaker maker;
    Part& wood = maker.with(palette.wood);
    wood.uv_per_metre = 0.5F;
    wood.colour = rgb(kTimber);
    const auto leg = [](float x, float z, float y) {
        const float spread = 2.0F - 0.07F * y;
        return glm::vec3(x * spread, y, z * spread);
    };
    const std::array<glm::vec2, 4> corners{glm::vec2(-1, -1), {1, -1}, {1, 1}, {-1, 1}};
    for (std::size_t i = 0; i < 4; ++i) {
        const glm::vec2 a = corners[i];
        const glm::vec2 b = corners[(i + 1) % 4];
        wood.beam(leg(a.x, a.y, -1.5F), leg(a.x, a.y, 7.4F), 0.34F);
        wood.beam(leg(a.x, a.y, 0.6F), leg(b.x, b.y, 3.4F), 0.18F);
        wood.beam(leg(a.x, a.y, 6.2F), leg(b.x, b.y, 3.4F), 0.18F);
        wood.beam(leg(a.x, a.y, 3.4F), leg(b.x, b.y, 3.4F), 0.2F);
        wood.beam({a.x * 1.7F, 7.4F, a.y * 1.7F}, {a.x * 1.7F, 10.2F, a.y * 1.7F}, 0.22F);
    }
    wood.colour = rgb(0x8A6440);
    wood.box({-2.1F, 7.2F, -2.1F}, {2.1F, 7.5F, 2.1F}, 1.0F, true);
    for (const float s : {-1.0F, 1.0F}) {
        wood.box({-2.0F, 7.5F, s * 1.9F - 0.1F}, {2.0F, 8.5F, s * 1.9F + 0.1F});
        wood.box({s * 1.9F - 0.1F, 7.5F, -1.8F}, {s * 1.9F + 0.1F, 8.5F, 1.8F});
    }
    Part& roof = maker.with(palette.shingle);
    roof.uv_per_metre = 0.42F;
    roof.colour = rgb(0xA4523A);
    roof.frame = at({0, 10.0F, 0}) * turnedY(kPi * 0.25F);
    roof.lathe({{1.0F, -0.1F}, {3.7F, 0.0F}, {0.0F, 2.9F}}, 4, false, true);
    return maker.take("watchtower");
}

Mesh makePalisade(const Palette& palette, float length_m)
{
    MeshMaker maker;
    Part& wood = maker.with(palette.wood);
    wood.uv_per_metre = 0.6F;
    const int logs = static_cast<int>(length_m / 0.78F);
    for (int i = 0; i < logs; ++i) {
        const float x = length_m * ((static_cast<float>(i) + 0.5F) / static_cast<float>(logs) - 0.5F);
        const float tall = 3.5F + 0.5F * hashUnit(i, 3, 77);
        wood.frame = at({x, 0, 0.08F * (hashUnit(i, 4, 77) - 0.5F)});
        const float tone = 0.8F + 0.4F * hashUnit(i, 5, 77);
        wood.colour = rgb(0x7A5534) * glm::vec4(tone, tone, tone, 1.0F);
        wood.lathe({{0.40F, -2.0F}, {0.37F, tall}, {0.0F, tall + 0.75F}}, 5);
    }
    wood.frame = glm::mat4(1.0F);
    wood.colour = rgb(kTimber);
    for (const float y : {1.1F, 2.8F}) {
        wood.beam({-length_m * 0.5F, y, -0.42F}, {length_m * 0.5F, y, -0.42F}, 0.22F);
    }
    return maker.take("palisade");
}

Mesh makeFlag(const Palette& palette, std::uint32_t srgb)
{
    MeshMaker maker;
    Part& cloth = maker.with(palette.cloth);
    constexpr int kStrips = 5;
    const auto point = [](int i, float y) {
        const float x = static_cast<float>(i) / kStrips;
        const float tip = y > 0.0F ? 1.0F - 0.18F * x : -1.0F + 0.18F * x;
        return glm::vec3(0.06F + 2.3F * x, 0.62F * tip, 0.16F * std::sin(x * 7.0F) * x);
    };
    for (int i = 0; i < kStrips; ++i) {
        cloth.colour = i == 1 || i == 2 ? rgb(0xF0DFA8) : rgb(srgb);
        cloth.quad(point(i, -1), point(i + 1, -1), point(i + 1, 1), point(i, 1));
    }
    return maker.take("flag");
}

Mesh makeFlagpole(const Palette& palette, float height_m)
{
    MeshMaker maker;
    Part& wood = maker.with(palette.wood);
    wood.colour = rgb(kTimber);
    wood.lathe({{0.11F, -0.5F}, {0.07F, height_m}}, 5);
    Part& ball = maker.with(palette.plain);
    ball.colour = rgb(0xE0B84A);
    ball.frame = at({0, height_m + 0.1F, 0});
    ball.ball(0.15F, 0);
    return maker.take("flagpole");
}

} // namespace gnomon::worlds
