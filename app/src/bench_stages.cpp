// SPDX-License-Identifier: Apache-2.0
#include "bench_stages.h"

#include <algorithm>
#include <cmath>
#include <string_view>

namespace gnomon::app {
namespace {

double quantile(const std::vector<double>& sorted, double share)
{
    const double place = share * static_cast<double>(sorted.size() - 1);
    const auto low = static_cast<std::size_t>(std::floor(place));
    const std::size_t high = std::min(low + 1, sorted.size() - 1);
    return sorted[low] + (sorted[high] - sorted[low]) * (place - static_cast<double>(low));
}

} // namespace

StageTimes stagesOf(const host::FrameTimes& times)
{
    StageTimes stages;
    stages.plan = times.plan_ms;
    stages.frame = times.frame_ms;
    for (const vulkan::PassRecord& pass : times.passes) {
        const std::string_view name = pass.name;
        if (name == "shadow maps") {
            stages.maps += pass.milliseconds;
        } else if (name == "shadow filter") {
            stages.filter += pass.milliseconds;
        } else if (name == "mask") {
            stages.mask += pass.milliseconds;
        }
    }
    return stages;
}

Counters countersOf(const host::FrameTimes& times, const Plan& plan, bool redraws_all)
{
    Counters counters;
    for (const View& view : plan.views) {
        if (view.redraw || redraws_all) {
            counters.texels_rendered += std::uint64_t{view.tile.width} * view.tile.height;
        }
    }
    for (const vulkan::PassRecord& pass : times.passes) {
        counters.vertex_invocations += pass.vertex_invocations;
        counters.primitives += pass.primitives;
        counters.fragment_invocations += pass.fragment_invocations;
        counters.compute_invocations += pass.compute_invocations;
        counters.draws += pass.draws;
        ++counters.passes;
    }
    return counters;
}

Spread spreadOf(std::vector<double> values)
{
    if (values.empty()) {
        return {};
    }
    std::sort(values.begin(), values.end());
    return {quantile(values, 0.5), quantile(values, 0.75) - quantile(values, 0.25)};
}

} // namespace gnomon::app
