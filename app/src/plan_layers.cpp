// SPDX-License-Identifier: Apache-2.0
#include "plan_layers.h"

#include "app/visual.h"
#include "layer_depths.h"

#include <cassert>

namespace gnomon::app {

struct PlanLayers::Drawing {
    Drawing(const Settings& settings, const Shot& shot)
        : gpu(openGpu(settings)), scene(*gpu, shot.scene, shot.state), renderer(scene, renderOptions(settings))
    {
    }
    std::unique_ptr<host::Gpu> gpu;
    host::SceneOnGpu scene;
    host::FrameRenderer renderer;
};

PlanLayers::PlanLayers(const Settings& settings, const Shot& shot) : settings_(settings)
{
    const ShadowOptions& options = settings.shadow;
    if (options.technique.filter == Filter::lvsm && followsDepths(options.moments.placement)) {
        drawing_ = std::make_unique<Drawing>(settings, shot);
    }
}

PlanLayers::~PlanLayers() = default;

void PlanLayers::follow(const Shot& shot)
{
    if (drawing_ != nullptr) {
        drawing_->renderer.draw(shot.state, shot.eye, shot.lights);
        requireSilence(*drawing_->gpu);
    }
}

void PlanLayers::describe(const Plan& plan, Json& views) const
{
    if (settings_.shadow.technique.filter != Filter::lvsm) {
        return;
    }
    assert(views.size() == plan.views.size());
    const MomentOptions& options = settings_.shadow.moments;
    for (std::uint32_t i = 0; i < plan.views.size(); ++i) {
        const std::vector<pack::DepthLayer> layers =
            drawing_ != nullptr ? drawing_->renderer.depthLayers(i)
            : options.placement == LayerPlacement::world
                ? pack::describeLayers(pack::worldDepthLayers(plan.views[i], options), options)
                : pack::fixedDepthLayers(options);
        Json list = Json::array();
        for (const pack::DepthLayer& layer : layers) {
            const auto metres = [&](float stored) {
                return metresOf(plan.views[i], options, static_cast<double>(stored));
            };
            list.push_back({{"near", layer.near},
                            {"far", layer.far},
                            {"begins", layer.begins},
                            {"near_m", metres(layer.near)},
                            {"far_m", metres(layer.far)},
                            {"begins_m", metres(layer.begins)}});
        }
        views[i]["layers"] = std::move(list);
    }
}

} // namespace gnomon::app
