// SPDX-License-Identifier: Apache-2.0
#include "cascade_choice.h"

#include "renderer_impl.h"

#include <gnomon/plan_views.h>

#include <algorithm>
#include <array>
#include <limits>
#include <string_view>

namespace gnomon::host {
namespace {

using vulkan::CascadePass;

constexpr std::array kWays{CascadePass::each, CascadePass::layered};
constexpr int kTurns = 3; // of each way; what the first ones make is not counted, because the shortest turn counts

/// How many views of the plan were drawn that one pass could have drawn with others.
std::uint32_t viewsThatGoTogether(const Plan& plan)
{
    std::uint32_t views = 0;
    for (std::uint32_t i = 0; i < plan.views.size();) {
        const std::uint32_t count = viewsTogether(plan, i);
        views += count > 1 ? count : 0;
        i += count;
    }
    return views;
}

double mapMilliseconds(std::span<const vulkan::PassRecord> passes)
{
    double sum = 0.0;
    for (const vulkan::PassRecord& pass : passes) {
        sum += std::string_view(pass.name) == "shadow maps" ? pass.milliseconds : 0.0;
    }
    return sum;
}

} // namespace

CascadePass CascadeChoices::settle(const Drawn& drawn, const TimeOf& time)
{
    const auto found =
        std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) { return entry.drawn == drawn; });
    if (found != entries_.end()) {
        return found->pass;
    }
    std::array<double, kWays.size()> best{};
    best.fill(std::numeric_limits<double>::infinity());
    for (int turn = 0; turn < kTurns; ++turn) {
        for (std::size_t i = 0; i < kWays.size(); ++i) {
            best[i] = std::min(best[i], time(kWays[i]));
        }
    }
    const bool timed = best[0] > 0.0 && best[1] > 0.0;
    const CascadePass pass = timed && best[1] < best[0] ? CascadePass::layered : CascadePass::each;
    entries_.push_back({drawn, pass});
    return pass;
}

void Renderer::Impl::setCascadePass(CascadePass pass)
{
    shadows->setCascadePass(pass);
    casters->setCascadePass(pass);
}

/// Draws the last frame's maps once more, which leaves them as they are.
double Renderer::Impl::timeCascadePass(CascadePass pass, vulkan::Profiler& timer)
{
    setCascadePass(pass);
    (void)shadows->prepare(*plan, targets.drawn);
    VkCommandBuffer cmd = commands.begin();
    timer.beginFrame(cmd, 0);
    casters->beginFrame(0, *plan, draws.casterGeometry(), draws.transforms());
    shadows->recordMaps(
        cmd, 0, frame, *plan, [this](const vulkan::MapPass& maps) { (void)casters->draw(maps); }, &timer);
    commands.finish();
    return mapMilliseconds(timer.results(0));
}

/// By the last frame, once there was one that tells: a single picture is not kept waiting.
void Renderer::Impl::chooseCascadePass()
{
    if (options.cascade_pass != CascadePass::automatic || cascade_pass || plan == nullptr ||
        !shadows->canDrawTogether()) {
        return;
    }
    const std::uint32_t views = viewsThatGoTogether(*plan);
    if (views == 0) {
        return;
    }
    vulkan::Profiler timer(gpu.view(), 1, 4);
    const CascadeChoices::TimeOf time = [&](CascadePass pass) {
        return timeCascadePass(pass, timer);
    };
    cascade_pass =
        gpu.cascadeChoices().settle({options.filter.format, options.plan.map_size, views, casters->triangles()}, time);
    setCascadePass(*cascade_pass);
}

} // namespace gnomon::host
