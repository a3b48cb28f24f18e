// SPDX-License-Identifier: Apache-2.0
// A light that has no maps: whose shadow volumes are to be counted (filter volumes).
// Based on: M. McGuire, J. F. Hughes, K. T. Egan, M. J. Kilgard, C. Everitt, "Fast, Practical and Robust Shadows",
// 2003, section 2.4 (which casters count for a view).
#include "plan/views.h"

#include <algorithm>

namespace gnomon {
namespace {

constexpr Outcome kOpenCaster{
    OutcomeKind::refused,
    "filter volumes counts faces of closed casters, and one that may shade here is none (ObjectFlags::closed); close "
    "it, or leave such casters out by volumes.open=skip"};

} // namespace

void Views::listVolumes(const Results& from, std::uint32_t index)
{
    std::vector<std::uint32_t>& casters = from.plan.casters;
    LightPlan& planned = from.plan.lights[index];
    planned.first_volume = static_cast<std::uint32_t>(casters.size());
    if (planned.outcome.kind == OutcomeKind::ok) {
        planned.outcome = prospect(from, index);
    }
    if (planned.outcome.kind == OutcomeKind::ok) {
        planned.outcome = listClosed(from, index);
    }
    if (!planned.outcome.hasMap()) {
        casters.resize(planned.first_volume);
    }
    planned.volume_count = static_cast<std::uint32_t>(casters.size()) - planned.first_volume;
}

Outcome Views::listClosed(const Results& from, std::uint32_t index)
{
    std::vector<std::uint32_t>& casters = from.plan.casters;
    LightPlan& planned = from.plan.lights[index];
    const Setup& setup = from.setupOf(index);
    const Frame& frame = from.sights.frame();
    const Light& light = frame.lights[index];
    const Slice all = wholeSlice(light);
    const std::span<const std::uint32_t> receivers = from.sights.receiversOf(index);
    const Outcome found =
        planner_.listCasters({frame, setup.recipe, setup.camera, receivers, receivers, light, all}, casters);
    if (found.kind != OutcomeKind::ok) {
        return found;
    }
    const auto first = casters.begin() + planned.first_volume;
    const auto open = std::remove_if(first, casters.end(),
                                     [&](std::uint32_t object) { return !frame.objects->flags(object).closed; });
    planned.left_out = static_cast<std::uint32_t>(casters.end() - open);
    if (planned.left_out > 0 && setup.recipe.options().volumes.open == OpenCasters::refuse) {
        return kOpenCaster;
    }
    casters.erase(open, casters.end());
    return casters.size() == planned.first_volume
               ? Outcome{OutcomeKind::no_caster,
                         "every caster that could shade what is seen is left out: none is closed"}
               : Outcome{};
}

} // namespace gnomon
