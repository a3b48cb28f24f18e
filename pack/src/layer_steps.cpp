// SPDX-License-Identifier: Apache-2.0
#include <gnomon/pack/filter_passes.h>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <gnomon/shared/moment_rule.h>

#include <algorithm>
#include <cassert>

namespace gnomon::pack {
namespace {

int depthFlags(const ResolvedOptions& options)
{
    return options.metric() == DepthMetricKind::z_over_w ? shared::kMomentZOverW : 0;
}

/// Takes depths of one metric to those of a view's, exactly in the middle of the view's map: both may measure along
/// slightly different directions. x: factor, y: summand.
glm::dvec2 carryOver(const DepthMetric& from, const View& view)
{
    const glm::dvec4& row = view.projection.metric.metric_ws;
    const glm::dvec3 axis = glm::dvec3(row) / glm::dot(glm::dvec3(row), glm::dvec3(row));
    const double start = glm::dot(row, glm::dvec4(view.projection.light_place_ws, 1.0));
    const glm::dvec3 middle_ws = view.projection.light_place_ws + axis * (0.5 - start);
    const double factor = (from.far_m - from.near_m) / (view.projection.metric.far_m - view.projection.metric.near_m);
    return {factor, 0.5 - factor * glm::dot(from.metric_ws, glm::dvec4(middle_ws, 1.0))};
}

// Layers that are new have all the steps that they need; those that were there go half way to where they would be in
// each of a few steps, so that what changes of a sudden does not show of a sudden. Where a motion holds maps still,
// they stay until they are off, because whatever light bleeds within a layer would follow them. Then they go all the
// way: such a map may not be drawn again for long.
constexpr int kFirstSteps = 256;
constexpr int kLaterSteps = 2;
constexpr float kLaterShare = 0.5F;

} // namespace

bool LayerSteps::finds() const
{
    return options_.filter() == Filter::lvsm && followsDepths(options_.moments().placement);
}

bool LayerSteps::areOfWorld() const
{
    return hasWorldLayers(options_.filter(), options_.moments());
}

bool LayerSteps::resize(std::uint32_t slots)
{
    const bool placed = (finds() || areOfWorld()) &&
                        std::any_of(slots_.begin(), slots_.end(), [](const Slot& slot) { return slot.metric; });
    slots_.resize(slots);
    return placed;
}

shared::GpuHistogramPush LayerSteps::histogram(const View& view) const
{
    const Tile& tile = view.place.tile;
    const auto side = static_cast<int>(std::max(tile.width, tile.height));
    shared::GpuHistogramPush push;
    push.tile = {0, 0, tile.width, tile.height};
    const MomentOptions& moments = options_.moments();
    const int most = moments.placement == LayerPlacement::gaps ? shared::kMostPairsAlong : shared::kMostSamplesAlong;
    const auto reach = static_cast<int>(blurRadius(moments)) / 2 + 1;
    push.more = {(side + most - 1) / most, depthFlags(options_), reach, 0};
    push.metric = {nearOverFar(view, view.projection.metric), 0.0F, 0.0F, 0.0F};
    return push;
}

shared::GpuPlacePush LayerSteps::place(const ResolvedOptions& now, const View& view, std::uint32_t index) const
{
    assert(index < slots_.size());
    const Slot& slot = slots_[index];
    const Technique& technique = now.technique();
    const bool held = technique.motion != Motion::free || technique.fit == Fit::scene;
    const bool anew = !slot.metric || slot.map != view.place.map || (!view.place.map && slot.light != view.light);
    const DepthMetric& before = anew ? view.projection.metric : *slot.metric;
    const glm::dvec2 carry = carryOver(before, view);
    shared::GpuPlacePush push;
    const bool to_rest = anew || held;
    push.slot = {index, options_.moments().layers, to_rest ? kFirstSteps : kLaterSteps, depthFlags(options_)};
    push.how = {options_.moments().layer_overlap, to_rest ? 1.0F : kLaterShare, anew ? 1.0F : 0.0F,
                held && !anew ? 1.0F : 0.0F};
    push.carry = {carry.x, carry.y, nearOverFar(view, before), nearOverFar(view, view.projection.metric)};
    return push;
}

void LayerSteps::note(const View& view, std::uint32_t slot)
{
    slots_[slot] = {view.place.map, view.light, view.projection.metric};
}

} // namespace gnomon::pack
