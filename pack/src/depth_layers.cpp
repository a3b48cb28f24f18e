// SPDX-License-Identifier: Apache-2.0
#include <gnomon/pack/depth_layers.h>

#include <gnomon/shared/depth_layers.h>

#include <algorithm>

namespace gnomon::pack {

shared::GpuDepthLayers firstDepthLayers(const MomentOptions& options)
{
    const auto count = static_cast<int>(options.layers);
    shared::GpuDepthLayers layers{};
    for (int i = 0; i < shared::kDepthLayers; ++i) {
        const auto split = [&](int after) {
            return after > 0 && after < count ? options.splits[static_cast<std::size_t>(after) - 1] : 0.0F;
        };
        layers.layer[i] = i >= count ? shared::noLayer()
                          : options.placement == LayerPlacement::by_hand
                              ? shared::layerByHand(i, count, split(i), split(i + 1), options.layer_overlap)
                              : shared::uniformLayer(i, count, options.layer_overlap);
    }
    return layers;
}

std::vector<DepthLayer> describeLayers(const shared::GpuDepthLayers& layers, const MomentOptions& options)
{
    std::vector<DepthLayer> described;
    for (std::uint32_t i = 0; i < options.layers; ++i) {
        const glm::vec4& layer = layers.layer[i];
        described.push_back({layer.x, layer.y, layer.z});
    }
    return described;
}

std::vector<DepthLayer> fixedDepthLayers(const MomentOptions& options)
{
    const bool depends = followsDepths(options.placement) || options.placement == LayerPlacement::world;
    return depends ? std::vector<DepthLayer>{} : describeLayers(firstDepthLayers(options), options);
}

shared::GpuDepthLayers worldDepthLayers(const View& view, const MomentOptions& options)
{
    shared::GpuDepthLayers layers{};
    for (std::uint32_t i = 0; i < shared::kDepthLayers; ++i) {
        const double far_before = i > 0 ? view.serves.layers[i - 1].far : 0.0;
        layers.layer[i] = i < options.layers ? shared::layerOfWorld(i == 0, static_cast<float>(far_before),
                                                                    static_cast<float>(view.serves.layers[i].near),
                                                                    static_cast<float>(view.serves.layers[i].far))
                                             : shared::noLayer();
    }
    return layers;
}

std::uint32_t depthLayersSlot(const Plan& plan, std::uint32_t view)
{
    const MapId map = plan.views[view].place.map;
    return map ? map.index : view;
}

std::uint32_t depthLayersCount(const Plan& plan)
{
    std::uint32_t count = std::max(plan.map_count, 1U);
    for (std::uint32_t i = 0; i < plan.views.size(); ++i) {
        count = std::max(count, depthLayersSlot(plan, i) + 1);
    }
    return count;
}

} // namespace gnomon::pack
