// SPDX-License-Identifier: Apache-2.0
#include "lab/score/texel_density.h"

#include "lab/metrics/same_shape.h"
#include "pixel_rays.h"

#include <gnomon/plan_views.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <utility>
#include <vector>

namespace gnomon::lab {
namespace {

/// Which texels of one tile are read: a bit each, because maps may have 16384 on a side.
class ReadTexels {
public:
    explicit ReadTexels(const Tile& tile)
        : width_(tile.width), height_(tile.height), words_per_row_((tile.width + 63) / 64),
          words_(static_cast<std::size_t>(words_per_row_) * tile.height)
    {
    }
    /// Every texel whose centre is within `reach` of `texel`. A centre exactly that far counts on the far side only, so
    /// that a reach of 0.5 is the texel itself, and n / 2 always n texels.
    void add(glm::dvec2 texel, double reach)
    {
        const auto [x0, x1] = range(texel.x, reach, width_);
        const auto [y0, y1] = range(texel.y, reach, height_);
        for (std::int64_t y = y0; y < y1 && x0 < x1; ++y) {
            addRun(static_cast<std::size_t>(y) * words_per_row_, static_cast<std::size_t>(x0),
                   static_cast<std::size_t>(x1));
        }
    }
    [[nodiscard]] std::uint64_t count() const
    {
        std::uint64_t sum = 0;
        for (const std::uint64_t word : words_) {
            sum += static_cast<std::uint64_t>(std::popcount(word));
        }
        return sum;
    }

private:
    static std::pair<std::int64_t, std::int64_t> range(double place, double reach, std::uint32_t size)
    {
        const auto first = static_cast<std::int64_t>(std::floor(place - reach + 0.5));
        const auto end = static_cast<std::int64_t>(std::floor(place + reach + 0.5));
        return {std::max<std::int64_t>(first, 0), std::min<std::int64_t>(end, size)};
    }
    /// Sets bits [first, end) of a row, a word at a time.
    void addRun(std::size_t row, std::size_t first, std::size_t end)
    {
        for (std::size_t word = first / 64; word * 64 < end; ++word) {
            std::uint64_t bits = ~std::uint64_t{0};
            if (word * 64 < first) {
                bits &= ~std::uint64_t{0} << (first - word * 64);
            }
            if (end - word * 64 < 64) {
                bits &= ~(~std::uint64_t{0} << (end - word * 64));
            }
            words_[row + word] |= bits;
        }
    }

    std::uint32_t width_;
    std::uint32_t height_;
    std::size_t words_per_row_;
    std::vector<std::uint64_t> words_;
};

/// Does the mask read this position's maps at `x` of the picture, 0 .. 1? Where a position's weight is nothing it need
/// not.
bool isRead(const SunSteps& steps, SunPosition sun, double x)
{
    if (steps.alternate) {
        return sun == steps.read;
    }
    if (!steps.paired) {
        return true;
    }
    const double later = laterWeight(steps, x);
    return sun == SunPosition::later ? later > 0.0 : later < 1.0;
}

/// By pixels in the columns that `reads` says.
template <class Reads>
std::uint64_t texelsRead(const Sight& seen, const Counted& counted, std::span<const View> views, double reach_texels,
                         const Reads& reads)
{
    const PixelRays rays(seen);
    std::vector<ReadTexels> read;
    for (const View& view : views) {
        read.emplace_back(view.place.tile);
    }
    for (std::uint32_t y = 0; y < counted.height && !views.empty(); ++y) {
        for (std::uint32_t x = 0; x < counted.width; ++x) {
            const bool counts = *counted.pixel(x, y) != 0 && reads(x);
            const auto surface = counts ? rays.surfaceAt(x, y) : std::nullopt;
            // The mask pass reads the first view that has the pixel, and one that fades over into it.
            bool found = false;
            for (std::size_t v = 0; surface && v < views.size(); ++v) {
                const auto texel = texelOf(views[v], surface->point_ws);
                const bool serving = !found || views[v].serves.slice.blend_m > 0.0 || views[v].serves.faded_in < 1.0 ||
                                     views[v].serves.rim > 0.0;
                if (serving && texel && serves(views[v], surface->point_ws, *texel, reach_texels)) {
                    read[v].add(*texel, reach_texels);
                    found = true;
                }
            }
        }
    }
    std::uint64_t texels = 0;
    for (const ReadTexels& tile : read) {
        texels += tile.count();
    }
    return texels;
}

} // namespace

TexelUse texelUse(const Sight& seen, const Counted& counted, const Plan& plan, std::uint32_t light, double reach_texels)
{
    assert(areMasksOfOneSize(counted, seen.depth) && seen.normals.channels == 3);
    assert(light < plan.lights.size());
    const SunSteps& steps = plan.lights[light].steps;
    TexelUse use;
    for (const SunPosition sun : {SunPosition::only, SunPosition::earlier, SunPosition::later}) {
        const std::span<const View> views = viewsOf(plan, light, sun);
        for (const View& view : views) {
            use.held += std::uint64_t{view.place.tile.width} * view.place.tile.height;
        }
        use.read += texelsRead(seen, counted, views, reach_texels,
                               [&](std::uint32_t x) { return isRead(steps, sun, (x + 0.5) / counted.width); });
    }
    return use;
}

double fitEfficiency(const TexelUse& use)
{
    return use.held > 0 ? static_cast<double>(use.read) / static_cast<double>(use.held) : 0.0;
}

} // namespace gnomon::lab
