// SPDX-License-Identifier: Apache-2.0
#include "lab/timing.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <memory>
#include <numeric>
#include <string_view>

namespace gnomon::lab {
namespace {

double quantile(const std::vector<double>& sorted, double share)
{
    const double place = share * static_cast<double>(sorted.size() - 1);
    const auto low = static_cast<std::size_t>(std::floor(place));
    const std::size_t high = std::min(low + 1, sorted.size() - 1);
    return sorted[low] + (sorted[high] - sorted[low]) * (place - static_cast<double>(low));
}

std::uint64_t totalBytes(const host::Renderer& renderer)
{
    std::uint64_t total = 0;
    for (const vulkan::MemoryUse& use : renderer.memory()) {
        total += use.bytes;
    }
    return total;
}

/// What one technique needs beyond the frame without shadows, by purpose.
std::vector<std::pair<std::string, std::uint64_t>> addedMemory(const host::Renderer& technique,
                                                               const host::Renderer& baseline)
{
    std::vector<std::pair<std::string, std::uint64_t>> added;
    for (const vulkan::MemoryUse& use : technique.memory()) {
        std::uint64_t before = 0;
        for (const vulkan::MemoryUse& other : baseline.memory()) {
            before += std::string_view(other.purpose) == use.purpose ? other.bytes : 0;
        }
        if (use.bytes > before) {
            added.emplace_back(use.purpose, use.bytes - before);
        }
    }
    return added;
}

struct Turn {
    std::unique_ptr<host::Renderer> renderer;
    bool redraws_all = true;
    Timed timed;
};

/// The first draws without shadows, the others one technique each.
std::vector<Turn> makeTurns(host::Gpu& gpu, const Subject& subject, const std::vector<Contestant>& contestants,
                            const TimingOptions& options)
{
    std::vector<Turn> turns(contestants.size() + 1);
    for (std::size_t i = 0; i < turns.size(); ++i) {
        host::RenderOptions wish = contestants[i == 0 ? 0 : i - 1].options;
        wish.shadows = i != 0;
        wish.reuse_maps = wish.reuse_maps && options.reuse_maps;
        turns[i].redraws_all = !wish.reuse_maps;
        turns[i].renderer = std::make_unique<host::Renderer>(gpu, *subject.scene, *subject.state, wish);
    }
    return turns;
}

double medianFrame(const Timed& timed)
{
    std::vector<double> frames;
    for (const host::FrameTimes& sample : timed.samples) {
        frames.push_back(sample.frame_ms);
    }
    return spreadOf(std::move(frames)).median;
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

std::vector<std::size_t> turnsOf(std::uint32_t round, std::size_t count)
{
    std::vector<std::size_t> places(count);
    std::iota(places.begin(), places.end(), std::size_t{0});
    if (round % 2 == 1) {
        std::reverse(places.begin(), places.end());
    }
    return places;
}

TimingResult timeInTurn(host::Gpu& gpu, const Subject& subject, const std::vector<Contestant>& contestants,
                        const TimingOptions& options, const std::function<void()>& step)
{
    assert(subject.scene != nullptr && subject.state != nullptr && !contestants.empty() && options.repetitions > 0);
    std::vector<Turn> turns = makeTurns(gpu, subject, contestants, options);
    for (std::uint32_t round = 0; round < options.warmup + options.repetitions; ++round) {
        for (const std::size_t place : turnsOf(round, turns.size())) {
            Turn& turn = turns[place];
            const host::FrameTimes times = turn.renderer->draw(*subject.state, subject.eye, subject.lights);
            if (step) {
                step();
            }
            if (round >= options.warmup) {
                turn.timed.samples.push_back(times);
            }
        }
    }
    TimingResult result;
    for (Turn& turn : turns) {
        Timed& timed = turn.timed;
        timed.plan = turn.renderer->plan();
        timed.atlas = timed.plan.atlas;
        timed.counters = countersOf(timed.samples.back(), timed.plan, turn.redraws_all);
        timed.added_memory = addedMemory(*turn.renderer, *turns.front().renderer);
    }
    result.baseline_bytes = totalBytes(*turns.front().renderer);
    result.baseline = std::move(turns.front().timed);
    for (std::size_t i = 1; i < turns.size(); ++i) {
        result.techniques.push_back(std::move(turns[i].timed));
    }
    return result;
}

double frameRatio(const Timed& technique, const Timed& baseline)
{
    const double without = medianFrame(baseline);
    return without > 0.0 ? medianFrame(technique) / without : 0.0;
}

} // namespace gnomon::lab
