// SPDX-License-Identifier: Apache-2.0
// Based on: A. Marinescu, "Achieving real-time soft shadows using LVSM in an RTS game", 2011, section 4 (a layer around
// the ground, one for what floats above it); A. Lauritzen, M. McCool, "Layered Variance Shadow Maps", 2008 (Lloyd
// relaxation). Departure: the published layers were set by hand.
#include "scene_memory.h"

#include <gnomon/shared/depth_layers.h>

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace gnomon {
namespace {

constexpr float kRoom = 1.0F / 16.0F;
constexpr int kBins = 1024;
constexpr int kSteps = 64;
constexpr double kTrimmed = 0.02; // share of a layer's objects, at each end
constexpr double kLeastDepth_m = 0.01;

struct HeightRange {
    double low_m = 0.0;
    double high_m = 0.0;

    [[nodiscard]] double middle_m() const { return 0.5 * low_m + 0.5 * high_m; }
};

std::vector<HeightRange> heightsOf(const ObjectSet& objects)
{
    std::vector<HeightRange> heights;
    for (const Aabb& box : objects.allBounds()) {
        if (!box.empty()) {
            heights.push_back({static_cast<double>(box.min.y), static_cast<double>(box.max.y)});
        }
    }
    return heights;
}

/// Where layers meet, as shares of the way from the lowest middle to the highest; ends included.
std::vector<float> splitsOf(const std::vector<HeightRange>& heights, double low_m, double range_m, int count)
{
    std::array<float, kBins> bins{};
    for (const HeightRange& range : heights) {
        bins[static_cast<std::size_t>(
            shared::binOf(static_cast<float>((range.middle_m() - low_m) / range_m), kBins))] += 1.0F;
    }
    std::vector<float> means;
    means.reserve(static_cast<std::size_t>(count));
    std::vector<float> begins(static_cast<std::size_t>(count) + 1, 0.0F);
    begins.back() = shared::kNoLayerBegins;
    for (int i = 0; i < count; ++i) {
        means.push_back(shared::lloydStart(i, count, 0.0F, 1.0F));
    }
    for (int step = 0; step < kSteps; ++step) {
        for (std::size_t i = 1; i < means.size(); ++i) {
            begins[i] = shared::lloydSplit(static_cast<int>(i), count, means[i - 1], means[i], begins[i - 1]);
        }
        for (std::size_t i = 0; i < means.size(); ++i) {
            float sum = 0.0F;
            float objects = 0.0F;
            for (int bin = 0; bin < kBins; ++bin) {
                if (shared::layerHoldsBin(bin, kBins, begins[i], begins[i + 1])) {
                    const float held = bins[static_cast<std::size_t>(bin)];
                    objects += held;
                    sum += held * shared::binCentre(bin, kBins);
                }
            }
            means[i] = shared::lloydMean(objects, sum, means[i]);
        }
    }
    return begins;
}

double quantile(std::vector<double>& values, double share)
{
    const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), values.begin() + at, values.end());
    return values[static_cast<std::size_t>(at)];
}

} // namespace

std::vector<WorldLayer> findLayers(const ObjectSet& objects, std::uint32_t count)
{
    const std::vector<HeightRange> heights = heightsOf(objects);
    if (heights.empty()) {
        return {};
    }
    double low_m = heights.front().middle_m();
    double high_m = low_m;
    for (const HeightRange& range : heights) {
        low_m = std::min(low_m, range.middle_m());
        high_m = std::max(high_m, range.middle_m());
    }
    const double range_m = std::max(high_m - low_m, kLeastDepth_m);
    const std::vector<float> begins = splitsOf(heights, low_m, range_m, static_cast<int>(count));
    std::vector<WorldLayer> layers;
    for (std::size_t i = 0; i < count; ++i) {
        const double begins_m = low_m + range_m * static_cast<double>(begins[i]);
        const double ends_m = low_m + range_m * std::min(static_cast<double>(begins[i + 1]), 1.0);
        std::vector<double> lows;
        std::vector<double> highs;
        for (const HeightRange& range : heights) {
            const double middle_m = range.middle_m();
            if ((i == 0 || middle_m >= begins_m) && (i + 1 == count || middle_m < ends_m)) {
                lows.push_back(range.low_m);
                highs.push_back(range.high_m);
            }
        }
        WorldLayer layer{begins_m, ends_m};
        if (!lows.empty()) {
            layer = {quantile(lows, kTrimmed), quantile(highs, 1.0 - kTrimmed)};
        }
        if (i > 0) { // from low to high, both ends
            layer.low_m = std::max(layer.low_m, layers.back().low_m + kLeastDepth_m);
            layer.high_m = std::max(layer.high_m, layers.back().high_m + kLeastDepth_m);
        }
        layer.high_m = std::max(layer.high_m, layer.low_m + kLeastDepth_m);
        layers.push_back(layer);
    }
    return layers;
}

void SceneMemory::follow(const ObjectSet& objects)
{
    const Aabb now_ws = objects.bounds();
    if (objects.identity() != objects_) {
        forget();
        objects_ = objects.identity();
        box_ws_ = now_ws;
        return;
    }
    if (now_ws.empty() || box_ws_.contains(now_ws)) {
        return;
    }
    if (box_ws_.empty()) {
        box_ws_ = now_ws;
        return;
    }
    const glm::vec3 low = glm::min(box_ws_.min, now_ws.min);
    const glm::vec3 high = glm::max(box_ws_.max, now_ws.max);
    const glm::vec3 room = (high - low) * kRoom;
    for (int axis = 0; axis < 3; ++axis) {
        box_ws_.min[axis] = now_ws.min[axis] < box_ws_.min[axis] ? low[axis] - room[axis] : box_ws_.min[axis];
        box_ws_.max[axis] = now_ws.max[axis] > box_ws_.max[axis] ? high[axis] + room[axis] : box_ws_.max[axis];
    }
}

void SceneMemory::forget()
{
    *this = {};
}

std::span<const WorldLayer> SceneMemory::layers(const ObjectSet& objects, std::uint32_t count)
{
    layers_.resize(kMaxDepthLayers);
    std::vector<WorldLayer>& found = layers_[count - 1];
    if (found.empty()) {
        found = findLayers(objects, count);
    }
    return found;
}

} // namespace gnomon
