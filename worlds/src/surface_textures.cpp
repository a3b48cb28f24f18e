// SPDX-License-Identifier: Apache-2.0
#include "rng.h"
#include "textures.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <cstddef>
#include <vector>

namespace gnomon::worlds {

namespace {

float fract(float v)
{
    return v - std::floor(v);
}

glm::vec4 grey(float v)
{
    return {v, v, v, 1.0F};
}

/// 0 on a joint between cells, 1 inside; `p` counts cells.
float insideCell(glm::vec2 p, glm::vec2 joint)
{
    const glm::vec2 f(fract(p.x), fract(p.y));
    const glm::vec2 edge(std::min(f.x, 1.0F - f.x), std::min(f.y, 1.0F - f.y));
    return smoothstep(0.3F, 1.0F, edge.x / joint.x) * smoothstep(0.3F, 1.0F, edge.y / joint.y);
}

/// How high a marble tile's surface stands, for its normals: flat with bevelled edges.
float tileHeight(glm::vec2 uv)
{
    const glm::vec2 p = uv * 4.0F;
    const glm::vec2 f(fract(p.x), fract(p.y));
    const float edge = std::min(std::min(f.x, 1.0F - f.x), std::min(f.y, 1.0F - f.y));
    return smoothstep(0.0F, 0.035F, edge) + 0.012F * fractal(uv * 24.0F, 3, 71, 24);
}

} // namespace

Image rulerTiles()
{
    return paint("ruler tiles", 512, [](glm::vec2 uv) {
        const glm::vec2 p = uv * 4.0F;
        const bool odd = ((static_cast<int>(p.x) + static_cast<int>(p.y)) & 1) != 0;
        const float tone = (odd ? 0.58F : 0.67F) + 0.02F * noise(uv * 64.0F, 3, 64);
        const float line = insideCell(p, glm::vec2(0.016F));
        const float tenth = insideCell(p * 10.0F, glm::vec2(0.09F));
        return glm::vec4(glm::vec3(0.98F, 1.0F, 1.02F) * tone * (0.55F + 0.45F * line) * (0.95F + 0.05F * tenth), 1.0F);
    });
}

Image groundDetail()
{
    return paint("ground detail", 512, [](glm::vec2 uv) {
        const float patches = fractal(uv * 6.0F, 3, 11, 6);
        const glm::vec2 bent = uv * glm::vec2(96.0F, 40.0F) + 1.5F * noise(uv * 12.0F, 5, 12);
        const float blades = noise(bent, 17, 0) * 0.5F + noise(uv * 128.0F, 19, 128) * 0.5F;
        const float pebble = smoothstep(0.62F, 0.78F, noise(uv * 40.0F, 23, 40));
        const float v = 0.82F + 0.09F * patches + 0.11F * blades + 0.10F * pebble;
        return glm::vec4(v + 0.02F * patches, v, v - 0.04F * patches - 0.02F * blades, 1.0F);
    });
}

Image stoneBlocks()
{
    return paint("stone blocks", 256, [](glm::vec2 uv) {
        const float course = uv.y * 8.0F;
        const auto row = static_cast<std::int32_t>(course);
        const float column =
            uv.x * 4.0F + 0.5F * static_cast<float>(row & 1) + 0.12F * std::sin(static_cast<float>(row) * 2.4F);
        const float inside = insideCell({column, course}, {0.045F, 0.09F});
        const auto which = static_cast<std::int32_t>(std::floor(column)) & 3;
        const float tone = 0.76F + 0.20F * hashUnit(which, row, 5);
        const float grain = 0.07F * fractal(uv * 24.0F, 3, 9, 24);
        return grey((tone + grain) * (0.55F + 0.45F * inside));
    });
}

Image planks()
{
    return paint("planks", 256, [](glm::vec2 uv) {
        const float board = uv.x * 6.0F;
        const auto which = static_cast<std::int32_t>(board);
        const float f = fract(board);
        const float seam = smoothstep(0.0F, 0.09F, std::min(f, 1.0F - f));
        const float tone = 0.74F + 0.20F * hashUnit(which, 3, 8);
        const float grain = 0.12F * noise({uv.x * 60.0F, uv.y * 5.0F}, 31 + static_cast<std::uint32_t>(which), 0);
        const float v = (tone + grain * smoothstep(0.0F, 0.08F, std::min(uv.y, 1.0F - uv.y))) * (0.5F + 0.5F * seam);
        return glm::vec4(v, v * 0.97F, v * 0.92F, 1.0F);
    });
}

Image shingles()
{
    return paint("shingles", 256, [](glm::vec2 uv) {
        const float row_at = uv.y * 8.0F;
        const auto row = static_cast<std::int32_t>(row_at);
        const float column = uv.x * 10.0F + 0.5F * static_cast<float>(row & 1);
        const auto which = static_cast<std::int32_t>(std::floor(column)) % 10;
        const glm::vec2 f(fract(column) - 0.5F, fract(row_at));
        const float lip = 0.80F + 0.17F * (1.0F - 4.0F * f.x * f.x); // rounded lower end
        const float under = smoothstep(lip, lip + 0.10F, f.y);       // the gap shows what lies below, darker
        const float tone = 0.74F + 0.24F * hashUnit(which, row, 12) + 0.05F * noise(uv * 60.0F, 4, 60);
        return grey(tone * (0.75F + 0.3F * f.y) * (1.0F - 0.5F * under));
    });
}

Image straw()
{
    return paint("straw", 256, [](glm::vec2 uv) {
        const float strand =
            noise({uv.x * 64.0F, uv.y * 6.0F}, 41, 0) * 0.5F + noise({uv.x * 28.0F, uv.y * 3.0F}, 43, 0);
        const float layer = fract(uv.y * 3.0F + 0.05F * noise({uv.x * 24.0F, 0.0F}, 47, 24));
        const float v = 0.82F + 0.12F * strand - 0.20F * smoothstep(0.86F, 1.0F, layer);
        return glm::vec4(v, v * 0.98F, v * 0.93F, 1.0F);
    });
}

Image marbleTiles()
{
    return paint("marble tiles", 512, [](glm::vec2 uv) {
        const glm::vec2 p = uv * 4.0F;
        const auto x = static_cast<std::int32_t>(p.x);
        const auto y = static_cast<std::int32_t>(p.y);
        const glm::vec2 shifted = uv + glm::vec2(hashUnit(x, y, 3), hashUnit(x, y, 4)) * 7.0F;
        const float warp = fractal(shifted * 5.0F, 4, 61);
        const float vein = 1.0F - smoothstep(0.0F, 0.10F, std::abs(noise(shifted * 3.0F + warp * 1.3F, 67)));
        const bool dark = ((x + y) & 1) != 0;
        const glm::vec3 stone = dark ? glm::vec3(0.36F, 0.34F, 0.35F) : glm::vec3(0.80F, 0.76F, 0.69F);
        const glm::vec3 colour = stone * (1.0F + 0.12F * warp) + (dark ? 0.16F : -0.14F) * vein;
        const float tone = 0.94F + 0.10F * hashUnit(x, y, 6);
        return glm::vec4(colour * tone * (0.45F + 0.55F * insideCell(p, glm::vec2(0.02F))), 1.0F);
    });
}

Image marbleTileNormals()
{
    constexpr std::uint32_t kSide = 512;
    std::vector<float> heights(std::size_t{kSide} * kSide); // each is wanted four times
    for (std::uint32_t y = 0; y < kSide; ++y) {
        for (std::uint32_t x = 0; x < kSide; ++x) {
            heights[std::size_t{y} * kSide + x] = tileHeight(
                (glm::vec2(static_cast<float>(x), static_cast<float>(y)) + 0.5F) / static_cast<float>(kSide));
        }
    }
    const auto height = [&](std::uint32_t x, std::uint32_t y) {
        return heights[std::size_t{y % kSide} * kSide + x % kSide];
    };
    return paint("marble tile normals", kSide, [&](glm::vec2 uv) {
        const auto x = static_cast<std::uint32_t>(uv.x * static_cast<float>(kSide));
        const auto y = static_cast<std::uint32_t>(uv.y * static_cast<float>(kSide));
        const float dx = height(x + 1, y) - height(x + kSide - 1, y);
        const float dy = height(x, y + 1) - height(x, y + kSide - 1);
        const glm::vec3 n = glm::normalize(glm::vec3(-dx, dy, 1.6F)); // green is up the image, as glTF has it
        return glm::vec4(n * 0.5F + 0.5F, 1.0F);
    });
}

Image plaster()
{
    return paint("plaster", 256, [](glm::vec2 uv) {
        const float v = 0.86F + 0.08F * fractal(uv * 5.0F, 5, 83, 5) + 0.03F * noise(uv * 90.0F, 89, 90);
        return glm::vec4(v, v * 0.985F, v * 0.96F, 1.0F);
    });
}

} // namespace gnomon::worlds
