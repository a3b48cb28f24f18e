// SPDX-License-Identifier: Apache-2.0
#include "things.h"

#include "../mesh_maker.h"
#include "../rng.h"

#include "worlds/sundial.h"

#include <glm/geometric.hpp>

#include <array>
#include <cmath>
#include <string_view>

namespace gnomon::worlds {

namespace {

constexpr float kY = SundialWorld::dial_y;
constexpr float kR = SundialWorld::dial_radius_m;

/// A level ring, or a disc when `inner` is 0, with texture coordinates as seen from above.
void addRing(Part& part, float inner, float outer, float y, int sides)
{
    for (int i = 0; i < sides; ++i) {
        const auto on = [&](float radius, int side) {
            const float a = kTau * static_cast<float>(side) / static_cast<float>(sides);
            return glm::vec3(radius * std::sin(a), y, radius * std::cos(a));
        };
        if (inner > 0.0F) {
            part.quad(on(outer, i), on(outer, i + 1), on(inner, i + 1), on(inner, i));
        } else {
            part.triangle(on(outer, i), on(outer, i + 1), {0, y, 0});
        }
    }
}

void addPlinth(const SundialPalette& palette, MeshMaker& maker)
{
    Part& stone = maker.with(palette.common.stone);
    stone.uv_per_metre = 0.4F;
    stone.colour = rgb(0xB4AA98);
    // Three steps, each an eight-sided slab; the lowest reaches into the ground.
    stone.lathe({{3.6F, -0.4F}, {3.6F, 0.16F}}, 8, false, true);
    stone.lathe({{3.05F, 0.16F}, {3.05F, 0.33F}}, 8, false, true);
    stone.lathe({{2.5F, 0.33F}, {2.5F, 0.50F}}, 8, false, true);
    Part& pale = maker.with(palette.pale_stone);
    pale.uv_per_metre = 0.5F;
    pale.colour = rgb(0xCFC6B4);
    addRing(pale, 3.05F, 3.6F, 0.16F, 8);
    addRing(pale, 2.5F, 3.05F, 0.33F, 8);
    addRing(pale, 1.2F, 2.5F, 0.50F, 8);
    pale.lathe({{1.36F, 0.50F}, {1.30F, 0.60F}, {1.10F, 0.68F}, {1.04F, 0.98F}, {1.10F, 1.04F}, {1.32F, kY - 0.12F}}, 8,
               false, true);
    pale.colour = rgb(0xE2DACA);
    pale.lathe({{1.32F, kY - 0.12F}, {kR - 0.03F, kY - 0.12F}, {kR, kY - 0.09F}, {kR, kY - 0.02F}, {kR - 0.02F, kY}},
               64);
    addRing(pale, 0.0F, kR - 0.02F, kY, 64);
}

constexpr float kProud = 0.004F; // bronze is let into the stone, and stands out of it by this

/// Where numerals stand, from the dial's middle: at their feet, which are turned to it, and at their heads.
constexpr float kNumeralFoot_m = kR - 0.40F;
constexpr float kNumeralHead_m = kR - 0.20F;

/// The hours of a face, from 1 to 12.
constexpr std::array<std::string_view, 12> kNumerals{"I",   "II",   "III", "IV", "V",  "VI",
                                                     "VII", "VIII", "IX",  "X",  "XI", "XII"};

/// One stroke, level, from a to b, which are to the right of the numeral's middle and outward from the dial's.
void addStroke(Part& bronze, const glm::vec2& a, const glm::vec2& b, float width)
{
    const glm::vec2 along = glm::normalize(b - a);
    const glm::vec2 side = glm::vec2(along.y, -along.x) * (0.5F * width);
    const auto on = [](const glm::vec2& p) {
        return glm::vec3(p.x, kProud, -p.y);
    };
    bronze.quad(on(a + side), on(b + side), on(b - side), on(a - side));
}

/// A numeral of thick and thin strokes, as they are cut: its middle is on the frame's -z axis.
void addNumeral(Part& bronze, std::string_view numeral)
{
    constexpr float kThick = 0.026F;
    constexpr float kThin = 0.014F;
    constexpr float kWide = 0.100F;    // the width of V and X
    constexpr float kUpright = 0.026F; // the width of I
    constexpr float kGap = 0.020F;
    const auto widthOf = [](char letter) {
        return letter == 'I' ? kUpright : kWide;
    };
    float x = 0.5F * kGap;
    for (const char letter : numeral) {
        x -= 0.5F * (widthOf(letter) + kGap);
    }
    for (const char letter : numeral) {
        const float end = x + widthOf(letter);
        const float middle = 0.5F * (x + end);
        if (letter == 'I') {
            addStroke(bronze, {middle, kNumeralFoot_m}, {middle, kNumeralHead_m}, kThick);
        } else if (letter == 'V') {
            addStroke(bronze, {middle, kNumeralFoot_m}, {x, kNumeralHead_m}, kThick);
            addStroke(bronze, {middle, kNumeralFoot_m}, {end, kNumeralHead_m}, kThin);
        } else {
            addStroke(bronze, {end, kNumeralFoot_m}, {x, kNumeralHead_m}, kThick);
            addStroke(bronze, {x, kNumeralFoot_m}, {end, kNumeralHead_m}, kThin);
        }
        x = end + kGap;
    }
}

/// The lines of the hours with their numerals, and a ring.
void addLines(const SundialPalette& palette, MeshMaker& maker)
{
    Part& bronze = maker.with(palette.bronze);
    bronze.colour = rgb(0x5A4A30);
    for (int hour = 5; hour <= 19; ++hour) {
        const bool main = hour % 3 == 0;
        const float half = main ? 0.022F : 0.012F;
        const float inner = main ? 0.30F : 0.55F;
        const auto azimuth = static_cast<float>(SundialWorld::hourLineAzimuth(hour));
        bronze.frame = at({0.0F, kY, 0.0F}) * turnedY(-azimuth); // -z turns to (sin a, 0, -cos a)
        bronze.box({-half, -0.01F, -(kNumeralFoot_m - 0.04F)}, {half, kProud, -inner});
        addNumeral(bronze, kNumerals[static_cast<std::size_t>((hour + 11) % 12)]);
        bronze.box({-0.055F, -0.01F, -(kR - 0.04F)}, {0.055F, kProud, -(kR - 0.12F)});
    }
    bronze.frame = at({0.0F, kY, 0.0F});
    bronze.lathe({{kR - 0.13F, 0.0F}, {kR - 0.13F, kProud}, {kR - 0.155F, kProud}, {kR - 0.155F, 0.0F}}, 64);
    bronze.frame = glm::mat4(1.0F);
}

/// A plate in the plane x = 0 whose upper edge is the style; its back is cut out in a curve.
void addGnomon(const SundialPalette& palette, MeshMaker& maker)
{
    constexpr float kHalfThickness = 0.022F;
    const auto latitude = static_cast<float>(SundialWorld::latitude_rad);
    const glm::vec2 along(std::cos(latitude), std::sin(latitude)); // north and up
    const glm::vec2 tip = along * SundialWorld::style_length_m;
    constexpr int kPieces = 10;
    std::array<glm::vec2, kPieces + 1> upper{};
    std::array<glm::vec2, kPieces + 1> lower{};
    const glm::vec2 heel(0.62F, 0.0F);
    for (int i = 0; i <= kPieces; ++i) {
        const float t = static_cast<float>(i) / kPieces;
        upper[static_cast<std::size_t>(i)] = tip * t;
        // The foot runs along the dial to the heel; from there a curve swings up to the tip.
        const float foot = 0.4F;
        const float s = (t - foot) / (1.0F - foot);
        const glm::vec2 bend = heel + glm::vec2(0.04F, 0.42F);
        lower[static_cast<std::size_t>(i)] =
            t <= foot ? heel * (t / foot)
                      : heel * ((1.0F - s) * (1.0F - s)) + bend * (2.0F * s * (1.0F - s)) + tip * (s * s);
    }
    Part& bronze = maker.with(palette.bronze);
    bronze.colour = rgb(0x9A7440);
    bronze.frame = at({0.0F, kY, 0.0F});
    const auto point = [](const glm::vec2& p, float x) {
        return glm::vec3(x, p.y, -p.x);
    };
    for (std::size_t i = 0; i < kPieces; ++i) {
        const float h = kHalfThickness;
        bronze.quad(point(lower[i], h), point(lower[i + 1], h), point(upper[i + 1], h), point(upper[i], h));
        bronze.quad(point(upper[i], -h), point(upper[i + 1], -h), point(lower[i + 1], -h), point(lower[i], -h));
        bronze.quad(point(upper[i], h), point(upper[i + 1], h), point(upper[i + 1], -h), point(upper[i], -h));
        bronze.quad(point(lower[i], -h), point(lower[i + 1], -h), point(lower[i + 1], h), point(lower[i], h));
    }
    bronze.frame = glm::mat4(1.0F);
}

} // namespace

Mesh makeDial(const SundialPalette& palette)
{
    MeshMaker maker;
    addPlinth(palette, maker);
    addLines(palette, maker);
    addGnomon(palette, maker);
    return maker.take("sundial");
}

Mesh makeBench(const SundialPalette& palette)
{
    MeshMaker maker;
    Part& stone = maker.with(palette.pale_stone);
    stone.uv_per_metre = 0.5F;
    stone.colour = rgb(0xC2B9A7);
    for (const float x : {-0.62F, 0.62F}) {
        stone.box({x - 0.12F, -0.2F, -0.19F}, {x + 0.12F, 0.40F, 0.19F}, 0.9F);
    }
    stone.colour = rgb(0xD3CAB8);
    stone.box({-0.95F, 0.40F, -0.25F}, {0.95F, 0.50F, 0.25F}, 0.985F, true);
    return maker.take("bench");
}

} // namespace gnomon::worlds
