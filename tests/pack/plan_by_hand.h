// SPDX-License-Identifier: Apache-2.0
// Plans of a few lights, without a planner.
#pragma once

#include <gnomon/frame.h>
#include <gnomon/plan.h>

#include <initializer_list>
#include <memory>
#include <vector>

namespace gnomon::test {

inline ShadowOptions filteredBy(Filter filter)
{
    ShadowOptions options{.technique = kPlainTechnique};
    options.technique.filter = filter;
    return options;
}

/// A planner's options, of which lights are added one by one.
struct PlanByHand {
    Plan plan;

    explicit PlanByHand(std::initializer_list<ShadowOptions> options)
    {
        std::vector<ResolvedOptions> resolved;
        for (const ShadowOptions& one : options) {
            resolved.push_back(resolvedOrThrow(one));
        }
        plan.pages.resize(resolved.size());
        plan.options = std::make_shared<const std::vector<ResolvedOptions>>(std::move(resolved));
    }
    /// Adds a sun with `views` views; without any it has no map.
    LightPlan& add(std::uint32_t options, std::uint32_t views)
    {
        Light light;
        light.direction_ws = {0.0, -1.0, 0.0};
        light.options = options;
        plan.made_for.lights.push_back(light);
        const auto index = static_cast<std::uint32_t>(plan.lights.size());
        LightPlan planned;
        planned.first_view = static_cast<std::uint32_t>(plan.views.size());
        planned.view_count = views;
        planned.mask_layer = index / 4;
        planned.mask_channel = index % 4;
        planned.options = options;
        planned.outcome.kind = views > 0 ? OutcomeKind::ok : OutcomeKind::no_caster;
        plan.lights.push_back(planned);
        for (std::uint32_t i = 0; i < views; ++i) {
            View view;
            view.light = index;
            view.place.tile = {static_cast<std::uint32_t>(plan.views.size()), 0, 0, 256, 256};
            plan.views.push_back(view);
        }
        plan.mask_layers = index / 4 + 1;
        return plan.lights.back();
    }
};

} // namespace gnomon::test
