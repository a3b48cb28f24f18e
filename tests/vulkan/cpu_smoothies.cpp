// SPDX-License-Identifier: Apache-2.0
#define GNOMON_REAL double
#include "cpu_smoothies.h"

#include <gnomon/shared/smoothies.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <optional>

namespace gnomon::test {
namespace {

using shared::Smoothie;

class TileOfMap {
public:
    TileOfMap(const CpuMap& map, const Tile& tile) : map_(map), tile_(tile) {}

    [[nodiscard]] int width() const { return static_cast<int>(tile_.width); }
    [[nodiscard]] int height() const { return static_cast<int>(tile_.height); }
    [[nodiscard]] bool has(int x, int y) const { return x >= 0 && y >= 0 && x < width() && y < height(); }
    [[nodiscard]] double depth(int x, int y) const
    {
        return texelAt(map_, 0, tile_.x + std::clamp(x, 0, width() - 1), tile_.y + std::clamp(y, 0, height() - 1)).x;
    }
    [[nodiscard]] bool isEdge(int x, int y, double quantum) const
    {
        constexpr std::array kWays{std::array{1, 0}, std::array{0, 1}, std::array{-1, 0}, std::array{0, -1}};
        return std::ranges::any_of(kWays, [&](const std::array<int, 2>& way) {
            const auto at = [&](int steps) {
                return depth(x + steps * way[0], y + steps * way[1]);
            };
            return shared::isEdge(at(-1), at(0), at(1), at(2), quantum);
        });
    }

private:
    const CpuMap& map_;
    const Tile& tile_;
};

/// The edge of a row that is nearest to x; of two at one distance the one nearer to the light.
std::optional<Smoothie> nearestOf(const TileOfMap& tile, const std::vector<bool>& edges, int x, int y, int reach)
{
    std::optional<Smoothie> nearest;
    for (int at = x - reach; at <= x + reach; ++at) {
        if (!tile.has(at, y) || !edges[static_cast<std::size_t>(y * tile.width() + at)]) {
            continue;
        }
        const Smoothie found{tile.depth(at, y), static_cast<double>(std::abs(at - x))};
        if (!nearest || found.distance < nearest->distance ||
            (found.distance == nearest->distance && found.depth < nearest->depth)) {
            nearest = found;
        }
    }
    return nearest;
}

int smoothieAt(const TileOfMap& tile, const std::vector<std::optional<Smoothie>>& rows, int x, int y, int reach,
               double quantum)
{
    Smoothie chosen{1.0, -1.0};
    double fall = 0.0;
    for (int at = std::max(y - reach, 0); at <= std::min(y + reach, tile.height() - 1); ++at) {
        const std::optional<Smoothie>& edge = rows[static_cast<std::size_t>(at * tile.width() + x)];
        if (!edge) {
            continue;
        }
        const double dy = at - y;
        const double lower = tile.depth(x, y) - edge->depth;
        const double far = shared::edgeDistance(edge->distance, dy);
        const bool counts = edge->distance * edge->distance + dy * dy <= (reach + 0.5) * (reach + 0.5);
        if (counts && lower > 2.0 * quantum &&
            (chosen.distance < 0.0 || shared::outweighs(far, lower, chosen.distance, fall))) {
            chosen = {edge->depth, far};
            fall = lower;
        }
    }
    return shared::packSmoothie(chosen);
}

} // namespace

std::vector<int> smoothiesOf(const CpuMap& map, const Tile& tile, int reach, double quantum)
{
    const TileOfMap texels(map, tile);
    std::vector<bool> edges;
    std::vector<std::optional<Smoothie>> rows;
    std::vector<int> made;
    const auto forEach = [&](auto&& use) {
        for (int i = 0; i < texels.width() * texels.height(); ++i) {
            use(i % texels.width(), i / texels.width());
        }
    };
    forEach([&](int x, int y) { edges.push_back(texels.isEdge(x, y, quantum)); });
    forEach([&](int x, int y) {
        rows.push_back(nearestOf(texels, edges, x, y, reach));
        if (rows.back()) { // through the image between the passes
            rows.back() = shared::unpackSmoothie(shared::packSmoothie(*rows.back()));
        }
    });
    forEach([&](int x, int y) { made.push_back(smoothieAt(texels, rows, x, y, reach, quantum)); });
    return made;
}

} // namespace gnomon::test
