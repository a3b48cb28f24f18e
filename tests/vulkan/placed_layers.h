// SPDX-License-Identifier: Apache-2.0
// Layers of depth placed for maps whose depths a test makes up.
#pragma once

#include "fixture.h"

#include "layer_placer.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <vector>

namespace gnomon::test {

constexpr std::uint32_t kSide = 256;

class LayersOfDepth : public testing::Test {
protected:
    void TearDown() override { expectSilence(gpu()); }
};

inline ShadowOptions lvsm(LayerPlacement placement, std::uint32_t layers)
{
    ShadowOptions filter{.technique = kPlainTechnique};
    filter.technique.filter = Filter::lvsm;
    filter.format = MapFormat::rgba16;
    filter.moments.placement = placement;
    filter.moments.layers = layers;
    filter.moments.samples = 1;
    return filter;
}

/// Looks down an axis from a place; 100 m deep.
inline View viewOf(const Tile& tile, const glm::dvec3& direction_ws = {0.0, -1.0, 0.0}, double backed_out_m = 0.0)
{
    View view;
    view.place.tile = tile;
    view.projection.light_place_ws = -direction_ws * (100.0 + backed_out_m);
    view.projection.metric.near_m = 0.0;
    view.projection.metric.far_m = 100.0;
    view.projection.metric.metric_ws =
        glm::dvec4(direction_ws, -glm::dot(direction_ws, view.projection.light_place_ws)) / 100.0;
    return view;
}

inline Plan planOf(const std::vector<View>& views)
{
    Plan plan;
    plan.lights.resize(4);
    plan.views = views;
    return plan;
}

class Placed {
public:
    explicit Placed(const ShadowOptions& filter)
        : device_(gpu().view()), filter_(filter), placer_(device_, resolvedOrThrow(filter), VK_NULL_HANDLE)
    {
    }
    std::vector<pack::DepthLayer> place(const View& view, const std::vector<float>& depths,
                                        Motion motion = Motion::free)
    {
        const TestImage image = gpu().makeImage(VK_FORMAT_R32_SFLOAT, {kSide, kSide}, std::as_bytes(std::span(depths)));
        Plan plan = planOf({view});
        filter_.technique.motion = motion;
        plan.options = planOptions(filter_);
        (void)placer_.prepare(plan);
        placer_.setDepth(image.view);
        gpu().run([&](VkCommandBuffer commands) { placer_.record(commands, plan, 0); });
        return placer_.read(0);
    }
    vulkan::LayerPlacer& placer() { return placer_; }

private:
    vulkan::Device device_;
    ShadowOptions filter_{.technique = kPlainTechnique};
    vulkan::LayerPlacer placer_;
};

constexpr Tile kWhole{0, 0, 0, kSide, kSide};

} // namespace gnomon::test
