// SPDX-License-Identifier: Apache-2.0
#include <gnomon/pack/frame_passes.h>
#include <gnomon/pack/soften_draws.h>

#include <algorithm>

namespace gnomon::pack {

bool has(const std::vector<FramePass>& passes, FramePassKind kind)
{
    return std::ranges::find(passes, kind, &FramePass::kind) != passes.end();
}

bool hasLights(const Plan& plan, std::uint32_t options)
{
    return plan.lights.empty() ? options == 0
                               : std::ranges::find(plan.lights, options, &LightPlan::options) != plan.lights.end();
}

bool takesTurns(const LightPlan& light)
{
    return light.outcome.hasMap() && light.steps.paired && light.steps.alternate;
}

bool halvesMask(const Plan& plan, const LightPlan& light)
{
    return light.outcome.hasMap() && (*plan.options)[light.options].halvesMask();
}

bool joinsFrames(const LightPlan& light)
{
    return light.outcome.hasMap() && light.sample.joined;
}

void listFramePasses(const Plan& plan, std::vector<FramePass>& out)
{
    out.clear();
    if (std::ranges::any_of(plan.views, [](const View& view) { return view.projection.gpu_cascade != kNoIndex; })) {
        out.push_back({FramePassKind::bounds});
    }
    for (std::uint32_t i = 0; i < plan.options->size(); ++i) {
        if ((*plan.options)[i].hasMaps() && hasLights(plan, i)) {
            out.push_back({FramePassKind::maps, i});
        }
    }
    out.push_back({FramePassKind::mask});
    if (std::ranges::any_of(plan.lights, [&](const LightPlan& light) { return halvesMask(plan, light); })) {
        out.push_back({FramePassKind::spread});
    }
    if (std::ranges::any_of(plan.lights, [](const LightPlan& light) { return light.volume_count > 0; })) {
        out.push_back({FramePassKind::volumes});
    }
    if (std::ranges::any_of(plan.lights, takesTurns)) {
        out.push_back({FramePassKind::history});
    }
    if (std::ranges::any_of(plan.lights, joinsFrames)) {
        out.push_back({FramePassKind::converge});
    }
    if (std::ranges::any_of(plan.lights, [&](const LightPlan& light) { return softens(plan, light); })) {
        out.push_back({FramePassKind::blur});
    }
}

} // namespace gnomon::pack
