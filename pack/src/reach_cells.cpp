// SPDX-License-Identifier: Apache-2.0
#include "reach_cells.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace gnomon::pack {
namespace {

using Edges = std::array<std::uint32_t, ReachCells::kMostEdges>;

// Where bounds begin and end between `first` and `last`, ascending, each once.
template <class Begin, class End>
std::span<const std::uint32_t> edgesOf(const LayerReach& reach, std::uint32_t first, std::uint32_t last, Begin begin,
                                       End end, Edges& edges)
{
    std::size_t count = 0;
    edges[count++] = first;
    edges[count++] = last;
    for (const LayerReach::Reach& light : reach) {
        edges[count++] = std::clamp(begin(light.pixels), first, last);
        edges[count++] = std::clamp(end(light.pixels), first, last);
    }
    const auto all = std::span(edges).first(count);
    std::ranges::sort(all);
    // std::ranges::unique does not compile with Clang 14 beside libstdc++ 12.
    return {all.begin(), std::unique(all.begin(), all.end())};
}

// `cell` has no edge of any bounds inside.
bool holds(const ScreenBounds& bounds, const ScreenBounds& cell)
{
    return bounds.x0 <= cell.x0 && cell.x1 <= bounds.x1 && bounds.y0 <= cell.y0 && cell.y1 <= bounds.y1;
}

} // namespace

ScreenBounds litPixels(const Light& light, const Camera& camera, const Aabb& scene_ws, glm::uvec2 size_px)
{
    const bool ranged = light.range_m > 0.0 && std::isfinite(light.range_m);
    if (!ranged && (light.range_m != 0.0 || scene_ws.empty() || light.type == LightType::directional)) {
        return {0, 0, size_px.x, size_px.y};
    }
    const LightExtent extent = ranged ? LightExtent{0.0, light.range_m} : extentOf(light, scene_ws);
    return screenBounds(light, extent, camera, size_px);
}

void LayerReach::add(std::uint32_t channels, const ScreenBounds& pixels)
{
    const auto same = std::find_if(lights_.begin(), lights_.begin() + count_,
                                   [&](const Reach& light) { return light.channels == channels; });
    if (same != lights_.begin() + count_) {
        ScreenBounds& both = same->pixels;
        both = {std::min(both.x0, pixels.x0), std::min(both.y0, pixels.y0), std::max(both.x1, pixels.x1),
                std::max(both.y1, pixels.y1)};
    } else if (count_ < lights_.size()) {
        lights_[count_++] = {channels, pixels};
    }
}

ReachCells::ReachCells(const LayerReach& reach, const ScreenBounds& within)
{
    Edges x_room{};
    Edges y_room{};
    const auto x = edgesOf(
        reach, within.x0, within.x1, [](const ScreenBounds& b) { return b.x0; },
        [](const ScreenBounds& b) { return b.x1; }, x_room);
    const auto y = edgesOf(
        reach, within.y0, within.y1, [](const ScreenBounds& b) { return b.y0; },
        [](const ScreenBounds& b) { return b.y1; }, y_room);
    for (std::size_t row = 0; row + 1 < y.size(); ++row) {
        ReachCell run; // cells of one row, widened while the lights are the same
        for (std::size_t column = 0; column + 1 < x.size(); ++column) {
            ReachCell cell{{x[column], y[row], x[column + 1], y[row + 1]}, 0};
            for (const LayerReach::Reach& light : reach) {
                cell.channels |= holds(light.pixels, cell.pixels) ? light.channels : 0U;
            }
            if (cell.channels == run.channels) {
                run.pixels.x1 = cell.pixels.x1;
            } else {
                add(run);
                run = cell;
            }
        }
        add(run);
    }
}

// Where the row above has the same lights between the same columns, its cell is continued.
void ReachCells::add(const ReachCell& cell)
{
    if (cell.channels == 0) {
        return;
    }
    for (std::size_t i = count_; i > 0; --i) {
        ReachCell& above = cells_[i - 1];
        if (above.channels == cell.channels && above.pixels.y1 == cell.pixels.y0 && above.pixels.x0 == cell.pixels.x0 &&
            above.pixels.x1 == cell.pixels.x1) {
            above.pixels.y1 = cell.pixels.y1;
            return;
        }
    }
    cells_[count_++] = cell;
}

} // namespace gnomon::pack
