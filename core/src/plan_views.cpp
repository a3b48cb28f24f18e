// SPDX-License-Identifier: Apache-2.0
#define GNOMON_REAL double
#include <gnomon/plan_views.h>

#include <sun_steps.h>

#include <algorithm>
#include <cassert>

namespace gnomon {

SunPosition strongerPosition(const SunSteps& steps)
{
    if (!steps.paired)
        return SunPosition::only;
    if (steps.alternate)
        return steps.read;
    return steps.share > 0.5 ? SunPosition::later : SunPosition::earlier;
}

double laterWeight(const SunSteps& steps, double x)
{
    assert(steps.paired);
    const double per_band = steps.band > 0.0 ? 1.0 / steps.band : 0.0;
    return shared::stepWeight({steps.share, steps.edge, per_band, steps.smooth ? 1.0 : 0.0}, x);
}

std::span<const View> viewsOf(const Plan& plan, std::uint32_t light, SunPosition sun)
{
    const LightPlan& planned = plan.lights[light];
    if (!planned.outcome.hasMap())
        return {};
    const std::span<const View> all = std::span(plan.views).subspan(planned.first_view, planned.view_count);
    const auto first = std::ranges::find(all, sun, &View::sun);
    const auto end = std::find_if(first, all.end(), [&](const View& view) { return view.sun != sun; });
    return {first, end};
}

} // namespace gnomon
