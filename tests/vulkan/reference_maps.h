// SPDX-License-Identifier: Apache-2.0
// Filters' reads of maps on the CPU: the functions that the includer of lib/filter_types.glsl defines. Only
// reference.cpp includes this; it sets the maps, and defines GNOMON_REAL and GNOMON_SMOOTHIES before.
#pragma once

#include "cpu_map.h"

#include <gnomon/pack/depth_layers.h>
#include <gnomon/plan.h>

#include <gnomon/shared/discs.h>
#include <gnomon/shared/map_blocks.h>
#include <gnomon/shared/paired_depth.h>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <span>
#include <vector>

namespace gnomon::test {
namespace {
std::span<const CpuMap> current_maps;
std::span<const pack::DepthLayer> current_layers;
glm::dvec4 current_nudge(0.0);
glm::dvec4 current_relative_nudge(0.0);
bool current_poisson = false;
int current_taps = 0;

const CpuMap& mapOf(double layer)
{
    return current_maps[static_cast<std::size_t>(layer)];
}
std::vector<int> current_smoothies;
Tile smoothies_tile;
int current_holding = 0;
double texel(double layer, double x, double y, double part)
{
    return shared::pairedDepth(current_holding, texelAt(mapOf(layer), 0, x, y), part);
}

/// All levels of one layer's blocks, made here texel by texel: level L at L - 1.
struct Blocks {
    std::vector<std::vector<int>> levels;

    static std::size_t sideOf(std::size_t map_side, std::size_t level)
    {
        return std::size_t{1} << (std::bit_width(map_side - 1) - level);
    }
};
std::vector<Blocks> current_blocks;

Blocks blocksOf(const CpuMap& map)
{
    Blocks blocks;
    const std::size_t map_side = std::max(map.width, map.height);
    for (std::size_t level = 1; level <= std::size_t(std::bit_width(map_side - 1)); ++level) {
        const std::size_t side = Blocks::sideOf(map_side, level);
        const std::size_t texels = std::size_t{1} << level;
        std::vector<int>& made = blocks.levels.emplace_back(side * side);
        for (std::size_t i = 0; i < made.size(); ++i) {
            for (std::size_t t = 0; t < texels * texels; ++t) {
                const std::size_t x = i % side * texels + t % texels;
                const std::size_t y = i / side * texels + t / texels;
                const double depth = texelAt(map, 0, double(x), double(y)).x;
                // Texels that nobody drew hold anything, be it no number.
                const int block = shared::blockOf(depth, depth);
                made[i] = t == 0 ? block : shared::joinedBlocks(made[i], block);
            }
        }
    }
    return blocks;
}
} // namespace
} // namespace gnomon::test

GN_BEGIN
inline real mapTexel(real2 at, real layer, real part)
{
    return test::texel(layer, at.x, at.y, part);
}
inline real4 mapGather(real2 corner, real layer, real part)
{
    const real x = corner.x;
    const real y = corner.y;
    return {test::texel(layer, x - 1, y, part), test::texel(layer, x, y, part), test::texel(layer, x, y - 1, part),
            test::texel(layer, x - 1, y - 1, part)};
}
inline real2 mapBlock(real2 block, int level, real layer)
{
    const test::Blocks& blocks = test::current_blocks.at(std::size_t(layer));
    const std::size_t side =
        test::Blocks::sideOf(std::max(test::mapOf(layer).width, test::mapOf(layer).height), std::size_t(level));
    return blockDepths(blocks.levels.at(std::size_t(level) - 1).at(std::size_t(block.y) * side + std::size_t(block.x)));
}
inline int mapSmoothie(real2 texel, real)
{
    const Tile& tile = test::smoothies_tile;
    const double x = std::clamp(texel.x - tile.x, 0.0, tile.width - 1.0);
    const double y = std::clamp(texel.y - tile.y, 0.0, tile.height - 1.0);
    return test::current_smoothies[std::size_t(y) * tile.width + std::size_t(x)];
}
inline real4 mapMoments(real2 texel, real level, real layer)
{
    return test::sampleAt(test::mapOf(layer), texel, level) * (1.0 + test::current_relative_nudge) +
           test::current_nudge;
}
inline real4 mapDepthLayer(int, int i)
{
    const auto index = static_cast<std::size_t>(i);
    if (index >= test::current_layers.size()) {
        return {0.0, 1.0, 2.0, 0.0};
    }
    const pack::DepthLayer& layer = test::current_layers[index];
    return {layer.near, layer.far, layer.begins, 0.0};
}
inline real2 discPoint(int i)
{
    return test::current_poisson ? kPoissonPoints[i] : vogelPoint(i, test::current_taps);
}
GN_END
