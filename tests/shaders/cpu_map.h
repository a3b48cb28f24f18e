// SPDX-License-Identifier: Apache-2.0
// Lets gnomon/lib compile as C++ in double precision, with maps in memory.
#pragma once
#define GNOMON_REAL double
#define GNOMON_SMOOTHIES

#include <gnomon/shared/discs.h>
#include <gnomon/shared/smoothies.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace gnomon::test {
/// Stored depth of a texel, by its integer coordinates.
inline std::function<double(int x, int y)> map_texels;
/// The second channel of a texel, where a filter reads it.
inline std::function<double(int x, int y)> map_seconds;
/// Nearest and farthest depth of a block (gnomon/shared/map_blocks.h). makeBlocks() is one way to have them.
inline std::function<glm::dvec2(int x, int y, int level)> map_block;
/// Makes the blocks of map_texels from 0 to `side`, a power of two.
inline void makeBlocks(int side)
{
    std::vector<std::vector<glm::dvec2>> levels(1);
    for (int i = 0; i < side * side; ++i) {
        levels[0].emplace_back(map_texels(i % side, i / side));
    }
    for (int size = side / 2; size > 0; size /= 2) {
        const std::vector<glm::dvec2> finer = levels.back();
        std::vector<glm::dvec2>& made = levels.emplace_back();
        for (int i = 0; i < size * size; ++i) {
            glm::dvec2 range(1.0, 0.0);
            for (int part = 0; part < 4; ++part) {
                const int x = 2 * (i % size) + part % 2;
                const int y = 2 * (i / size) + part / 2;
                const glm::dvec2 of_part = finer[static_cast<std::size_t>(y * 2 * size + x)];
                range = {std::min(range.x, of_part.x), std::max(range.y, of_part.y)};
            }
            made.push_back(range);
        }
    }
    map_block = [levels, side](int x, int y, int level) {
        return levels.at(static_cast<std::size_t>(level)).at(static_cast<std::size_t>(y * (side >> level) + x));
    };
}
/// The smoothie beside a texel, packed (gnomon/shared/smoothies.h).
inline std::function<int(int x, int y)> map_smoothie;
/// A read of a filterable map; `texel` in texels of the finest level. MomentImage is one way to have it.
inline std::function<glm::dvec4(glm::dvec2 texel, double level, double layer)> map_moments;
/// GpuDepthLayers::layer of a view.
inline std::function<glm::dvec4(int slot, int i)> depth_layers;

/// An array image with mip levels, read as a GPU's sampler reads it: bilinear between the centres of texels, clamped to
/// the edge, linear between two levels.
class MomentImage {
public:
    MomentImage(int width, int height, int layers = 1, glm::dvec4 value = glm::dvec4(0.0)) : layers_(layers)
    {
        addLevel(width, height, value);
    }

    [[nodiscard]] glm::dvec4& at(int x, int y, int layer = 0, int level = 0)
    {
        Level& l = levels_.at(static_cast<std::size_t>(level));
        return l.texels.at(index(l, x, y, layer));
    }
    /// `levels` in all; each texel is the mean of four.
    void makeMips(int levels)
    {
        for (int k = 1; k < levels; ++k) {
            const Level& finer = levels_.back();
            addLevel(std::max(finer.width / 2, 1), std::max(finer.height / 2, 1), glm::dvec4(0.0));
            const Level& from = levels_[levels_.size() - 2];
            Level& to = levels_.back();
            for (int layer = 0; layer < layers_; ++layer) {
                for (int y = 0; y < to.height; ++y) {
                    for (int x = 0; x < to.width; ++x) {
                        to.texels[index(to, x, y, layer)] = meanOfFour(from, 2 * x, 2 * y, layer);
                    }
                }
            }
        }
    }
    [[nodiscard]] glm::dvec4 read(glm::dvec2 texel, double level, double layer) const
    {
        const double last = static_cast<double>(levels_.size() - 1);
        const double l = std::clamp(std::isfinite(level) ? level : last, 0.0, last);
        const auto finer = static_cast<std::size_t>(l);
        const std::size_t coarser = std::min(finer + 1, levels_.size() - 1);
        const double part = l - static_cast<double>(finer);
        const int k = std::clamp(static_cast<int>(layer), 0, layers_ - 1);
        return bilinear(levels_[finer], texel, k) * (1.0 - part) + bilinear(levels_[coarser], texel, k) * part;
    }

private:
    struct Level {
        int width;
        int height;
        std::vector<glm::dvec4> texels;
    };

    void addLevel(int width, int height, glm::dvec4 value)
    {
        levels_.push_back(
            {width, height, std::vector<glm::dvec4>(static_cast<std::size_t>(width * height * layers_), value)});
    }
    static std::size_t index(const Level& l, int x, int y, int layer)
    {
        return static_cast<std::size_t>((layer * l.height + y) * l.width + x);
    }
    static glm::dvec4 clamped(const Level& l, int x, int y, int layer)
    {
        return l.texels[index(l, std::clamp(x, 0, l.width - 1), std::clamp(y, 0, l.height - 1), layer)];
    }
    static glm::dvec4 meanOfFour(const Level& l, int x, int y, int layer)
    {
        return (clamped(l, x, y, layer) + clamped(l, x + 1, y, layer) + clamped(l, x, y + 1, layer) +
                clamped(l, x + 1, y + 1, layer)) *
               0.25;
    }
    [[nodiscard]] glm::dvec4 bilinear(const Level& l, glm::dvec2 texel, int layer) const
    {
        const double x = place(texel.x, levels_[0].width, l.width);
        const double y = place(texel.y, levels_[0].height, l.height);
        const int i = static_cast<int>(std::floor(x));
        const int j = static_cast<int>(std::floor(y));
        const double u = x - i;
        const double v = y - j;
        return (clamped(l, i, j, layer) * (1.0 - u) + clamped(l, i + 1, j, layer) * u) * (1.0 - v) +
               (clamped(l, i, j + 1, layer) * (1.0 - u) + clamped(l, i + 1, j + 1, layer) * u) * v;
    }
    static double place(double texel, int finest, int size)
    {
        const double at = texel * size / finest - 0.5;
        return std::isfinite(at) ? std::clamp(at, -1.0, static_cast<double>(size)) : 0.0;
    }

    int layers_;
    std::vector<Level> levels_;
};
} // namespace gnomon::test

GN_BEGIN
inline real mapTexel(real2 at, real, real)
{
    return test::map_texels(static_cast<int>(at.x), static_cast<int>(at.y));
}
inline real4 mapGather(real2 corner, real, real part)
{
    const int x = static_cast<int>(corner.x);
    const int y = static_cast<int>(corner.y);
    const auto& texels = part > 0.5 && test::map_seconds ? test::map_seconds : test::map_texels;
    return {texels(x - 1, y), texels(x, y), texels(x, y - 1), texels(x - 1, y - 1)};
}
inline real2 mapBlock(real2 block, int level, real)
{
    return test::map_block(static_cast<int>(block.x), static_cast<int>(block.y), level);
}
inline int mapSmoothie(real2 texel, real)
{
    return test::map_smoothie(static_cast<int>(texel.x), static_cast<int>(texel.y));
}
inline real4 mapMoments(real2 texel, real level, real layer)
{
    return test::map_moments(texel, level, layer);
}
inline real4 mapDepthLayer(int slot, int i)
{
    return test::depth_layers(slot, i);
}
inline real2 discPoint(int i)
{
    return kPoissonPoints[i];
}
GN_END

#include <gnomon/lib/visibility.glsl>
