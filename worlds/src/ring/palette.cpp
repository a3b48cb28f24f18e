// SPDX-License-Identifier: Apache-2.0
#include "palette.h"

#include "../mesh_maker.h"
#include "../rng.h"
#include "../scene_maker.h"
#include "../textures.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace gnomon::worlds {

namespace {

constexpr std::uint32_t kSide = 512;

constexpr std::array<std::uint32_t, kHues> kHueColours{0xFFCB98, 0xFFAA60, 0xFFEBD2, 0x63C9FF,
                                                       0xFF86AE, 0xB49AFF, 0xC4F09C, 0xFF6A50};

float ownFract(float v)
{
    return v - std::floor(v);
}

/// Distance to the border of the unit cell that holds `f`.
float toBorder(glm::vec2 f)
{
    return std::min(std::min(f.x, 1.0F - f.x), std::min(f.y, 1.0F - f.y));
}

/// 1 on a round head at one of the four corners of a cell, `inset` from both its borders.
float rivet(glm::vec2 f, float inset, float radius)
{
    const glm::vec2 folded(std::min(f.x, 1.0F - f.x), std::min(f.y, 1.0F - f.y));
    return 1.0F - smoothstep(radius * 0.6F, radius, glm::length(folded - inset));
}

/// Four tiles with seams between, each of another make: framed, quartered, with a tread, with rivets.
float deckHeight(glm::vec2 uv)
{
    const glm::vec2 p = uv * 2.0F;
    const glm::vec2 f(ownFract(p.x), ownFract(p.y));
    const int make = static_cast<int>(p.x) + 2 * static_cast<int>(p.y);
    const float d = toBorder(f);
    float h = smoothstep(0.004F, 0.022F, d);
    if (make == 0 || make == 3) {
        h -= 0.35F * (1.0F - smoothstep(0.006F, 0.016F, std::abs(d - 0.10F)));
    } else if (make == 1) {
        const glm::vec2 half(std::abs(f.x - 0.5F), std::abs(f.y - 0.5F));
        h -= 0.6F * (1.0F - smoothstep(0.005F, 0.016F, std::min(half.x, half.y)));
    } else if (d > 0.09F) {
        const glm::vec2 g = f * 14.0F;
        const bool odd = ((static_cast<int>(g.x) + static_cast<int>(g.y)) & 1) != 0;
        const glm::vec2 q = glm::vec2(ownFract(g.x), ownFract(g.y)) - 0.5F;
        const glm::vec2 e = odd ? glm::vec2(q.x + q.y, (q.x - q.y) * 2.6F) : glm::vec2((q.x + q.y) * 2.6F, q.x - q.y);
        h += 0.22F * (1.0F - smoothstep(0.35F, 0.60F, glm::length(e)));
    }
    h += 0.25F * rivet(f, 0.055F, 0.020F);
    return h;
}

Image deckPlates()
{
    return paint("deck plates", kSide, [](glm::vec2 uv) {
        const glm::vec2 p = uv * 2.0F;
        const float tone = 0.80F + 0.12F * hashUnit(static_cast<int>(p.x), static_cast<int>(p.y), 91);
        const float worn = 0.07F * fractal(uv * 7.0F, 4, 92, 7) + 0.04F * noise(uv * 70.0F, 93, 70);
        const float v = (tone + worn) * (0.55F + 0.45F * std::min(deckHeight(uv), 1.0F));
        return glm::vec4(v, v * 0.99F, v * 0.97F, 1.0F);
    });
}

/// One panel, as wide as a tile and 3 m high: a band along the foot, a field in a frame, a band on top.
float wallHeight(glm::vec2 uv)
{
    const float along = std::min(uv.x, 1.0F - uv.x);
    float h = smoothstep(0.003F, 0.012F, along);
    for (const float y : {0.04F, 0.13F, 0.66F, 0.97F}) { // v grows downwards, and 1 is the floor
        h -= 0.6F * (1.0F - smoothstep(0.004F, 0.009F, std::abs(uv.y - y)));
    }
    const glm::vec2 field(std::abs(uv.x - 0.5F) - 0.40F, std::abs(uv.y - 0.395F) - 0.225F);
    const float outside = std::max(field.x, field.y * 1.5F);
    h -= 0.45F * (1.0F - smoothstep(-0.014F, 0.006F, outside));
    if (uv.y > 0.70F && uv.y < 0.93F && along > 0.06F) { // louvres
        h -= 0.70F * smoothstep(0.20F, 0.42F, std::abs(ownFract(uv.y * 22.0F) - 0.5F));
    }
    return h + 0.3F * rivet({uv.x, ownFract(uv.y * 3.0F)}, 0.035F, 0.016F);
}

Image wallPanels()
{
    return paint("wall panels", kSide, [](glm::vec2 uv) {
        const float worn = 0.03F * fractal(uv * 5.0F, 4, 94, 5);
        const float v = (0.88F + worn + 0.03F * fractal(uv * 8.0F, 3, 95, 8)) *
                        (0.45F + 0.55F * std::clamp(wallHeight(uv), 0.0F, 1.0F));
        return glm::vec4(v, v, v, 1.0F);
    });
}

/// `strength`: height in texels.
template <typename Height>
Image normalsOf(const std::string& name, Height height, float strength)
{
    std::vector<float> heights(std::size_t{kSide} * kSide);
    for (std::uint32_t y = 0; y < kSide; ++y) {
        for (std::uint32_t x = 0; x < kSide; ++x) {
            heights[std::size_t{y} * kSide + x] =
                height((glm::vec2(static_cast<float>(x), static_cast<float>(y)) + 0.5F) / static_cast<float>(kSide));
        }
    }
    const auto at = [&](std::uint32_t x, std::uint32_t y) {
        return heights[std::size_t{y % kSide} * kSide + x % kSide];
    };
    return paint(name, kSide, [&](glm::vec2 uv) {
        const auto x = static_cast<std::uint32_t>(uv.x * static_cast<float>(kSide));
        const auto y = static_cast<std::uint32_t>(uv.y * static_cast<float>(kSide));
        const float dx = at(x + 1, y) - at(x + kSide - 1, y);
        const float dy = at(x, y + 1) - at(x, y + kSide - 1);
        const glm::vec3 n = glm::normalize(glm::vec3(-dx, dy, 2.0F / strength));
        return glm::vec4(n * 0.5F + 0.5F, 1.0F);
    });
}

} // namespace

glm::vec3 colourOf(Hue hue)
{
    const glm::vec3 c(rgb(kHueColours[static_cast<std::size_t>(hue)]));
    return c / glm::dot(c, glm::vec3(0.2126F, 0.7152F, 0.0722F));
}

RingPalette addRingPalette(Scene& scene)
{
    RingPalette palette;
    palette.common = addPalette(scene);
    palette.deck = addMaterial(scene, "deck",
                               {.roughness = 0.46F,
                                .texture = addTexture(scene, deckPlates()),
                                .normal_texture = addTexture(scene, normalsOf("deck normals", deckHeight, 2.2F))});
    palette.wall = addMaterial(scene, "wall",
                               {.roughness = 0.6F,
                                .texture = addTexture(scene, wallPanels()),
                                .normal_texture = addTexture(scene, normalsOf("wall normals", wallHeight, 2.2F))});
    palette.metal = addMaterial(scene, "metal", {.roughness = 0.36F, .metallic = 0.35F});
    palette.gloss = addMaterial(scene, "gloss", {.phong_exponent = 60.0F});
    palette.shade =
        addMaterial(scene, "shade", {.roughness = 0.9F, .double_sided = true, .emissive = {0.50F, 0.27F, 0.10F}});
    palette.pane_warm = addMaterial(
        scene, "warm pane", {.base_colour = rgb(0x6A5038), .roughness = 0.3F, .emissive = {0.75F, 0.42F, 0.16F}});
    palette.pane_cold = addMaterial(
        scene, "cold pane", {.base_colour = rgb(0x34505E), .roughness = 0.3F, .emissive = {0.07F, 0.26F, 0.36F}});
    constexpr std::array<const char*, kHues> kNames{"warm", "amber", "white", "cyan", "rose", "violet", "lime", "red"};
    for (std::size_t i = 0; i < kHues; ++i) {
        const glm::vec3 c(rgb(kHueColours[i]));
        palette.glow[i] = addMaterial(scene, std::string("glow ") + kNames[i],
                                      {.base_colour = glm::vec4(c * 0.5F, 1.0F), .emissive = c * 3.0F});
        palette.neon[i] = addMaterial(scene, std::string("neon ") + kNames[i],
                                      {.base_colour = glm::vec4(c * 0.3F, 1.0F), .emissive = c * c * 0.9F});
    }
    return palette;
}

} // namespace gnomon::worlds
