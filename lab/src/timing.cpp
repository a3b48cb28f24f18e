// SPDX-License-Identifier: Apache-2.0
#include "lab/timing.h"

#include "lab/passes.h"
#include "lab/score/traffic.h"
#include "lab/traffic.h"

#include <algorithm>
#include <cassert>
#include <iterator>
#include <memory>
#include <numeric>
#include <span>
#include <string_view>

namespace gnomon::lab {
namespace {

struct Turn {
    host::RenderOptions options;
    std::unique_ptr<host::FrameRenderer> renderer;
    Timed timed;
};

/// The first draws without shadows, the others one technique each.
std::vector<Turn> makeTurns(const host::SceneOnGpu& scene, std::span<const Contestant> contestants,
                            const TimingOptions& options)
{
    std::vector<Turn> turns(contestants.size() + 1);
    for (std::size_t i = 0; i < turns.size(); ++i) {
        host::RenderOptions& wish = turns[i].options;
        wish = contestants[i == 0 ? 0 : i - 1].options;
        wish.shadows = i != 0;
        wish.reuse_maps = wish.reuse_maps && options.reuse_maps;
        wish.reuse_masks = wish.reuse_masks && options.reuse_maps; // shadow volumes have no map to be drawn anew
        turns[i].renderer = std::make_unique<host::FrameRenderer>(scene, wish);
    }
    return turns;
}

/// How many times the four bytes of a plain depth map one texel of this filter's map takes, with all that it is made
/// from.
std::uint64_t weightOf(const ShadowOptions& options)
{
    const FilterTraits* traits = filterTraits(filterOf(options));
    const std::uint64_t map =
        std::uint64_t{texelBytes(formatOf(options))} * imageLayersPerMap(filterOf(options), options.moments);
    const bool filterable = traits != nullptr && traits->filterable;
    const std::uint64_t made_from = filterable ? map + 4 * options.moments.samples : 0; // scratch and depth
    return std::max<std::uint64_t>(1, (map + made_from + 3) / 4);
}

void drawInTurn(std::vector<Turn>& turns, const SubjectAt& subject_at, const TimingOptions& options,
                const std::function<void()>& step)
{
    for (std::uint32_t round = 0; round < options.warmup + options.repetitions; ++round) {
        const Subject& subject = subject_at(round);
        for (const std::size_t place : turnsOf(round, turns.size())) {
            Turn& turn = turns[place];
            const host::FrameTimes times = turn.renderer->draw(*subject.state, subject.eye, subject.lights);
            if (step) {
                step();
            }
            if (round >= options.warmup) {
                turn.timed.samples.push_back(times);
                addTexels(turn.timed, countersOf(times, turn.renderer->plan(), !turn.options.reuse_maps));
                turn.timed.waits.take(turn.renderer->plan());
            }
        }
    }
}

/// Adds what was timed to `result`; the images are gone afterwards.
void timeGroup(const host::SceneOnGpu& scene, const SubjectAt& subject_at, std::span<const Contestant> contestants,
               const TimingOptions& options, const std::function<void()>& step, TimingResult& result)
{
    const Subject* subject = nullptr; // the subject of the round that is on
    const SubjectAt remembering = [&](std::uint32_t round) -> const Subject& {
        subject = &subject_at(round);
        return *subject;
    };
    std::vector<Turn> turns = makeTurns(scene, contestants, options);
    drawInTurn(turns, remembering, options, step);
    const double baseline_ms = medianFrame(turns.front().timed);
    for (Turn& turn : turns) {
        Timed& timed = turn.timed;
        timed.plan = turn.renderer->plan();
        timed.atlas = timed.plan.pages[0];
        timed.counters = countersOf(timed.samples.back(), timed.plan, !turn.options.reuse_maps);
        timed.counters.filter = turn.renderer->filterCost();
        timed.least = leastByPass(*turn.renderer, turn.options);
        timed.added_memory = addedMemory(*turn.renderer, *turns.front().renderer);
        timed.baseline_ms = baseline_ms;
    }
    result.baseline_bytes = totalBytes(*turns.front().renderer);
    for (Turn& turn : turns) { // after all memory was counted, because reading back takes some
        turn.timed.counters.bytes_minimum = leastBytes(geometryOf(scene, *turn.renderer, *subject, turn.options),
                                                       *turn.renderer, *subject, turn.options);
    }
    Timed& baseline = turns.front().timed;
    baseline.samples.insert(baseline.samples.begin(), std::make_move_iterator(result.baseline.samples.begin()),
                            std::make_move_iterator(result.baseline.samples.end()));
    result.baseline = std::move(baseline);
    for (std::size_t i = 1; i < turns.size(); ++i) {
        result.techniques.push_back(std::move(turns[i].timed));
    }
}

} // namespace

std::uint64_t totalBytes(const host::FrameRenderer& renderer)
{
    std::uint64_t total = 0;
    for (const vulkan::MemoryUse& use : renderer.memory()) {
        total += use.bytes;
    }
    return total;
}

std::vector<std::pair<std::string, std::uint64_t>> addedMemory(const host::FrameRenderer& technique,
                                                               const host::FrameRenderer& baseline)
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

double medianFrame(const Timed& timed)
{
    std::vector<double> frames;
    for (const host::FrameTimes& sample : timed.samples) {
        frames.push_back(sample.frame_ms);
    }
    return spreadOf(std::move(frames)).median;
}

void addTexels(Timed& timed, const Counters& frame)
{
    const auto count = static_cast<double>(timed.samples.size()); // the frame's is among them
    timed.mean_texels_rendered += (static_cast<double>(frame.texels_rendered) - timed.mean_texels_rendered) / count;
}

StageTimes stagesOf(const host::FrameTimes& times)
{
    StageTimes stages;
    stages.plan = times.plan_ms;
    stages.frame = times.frame_ms;
    for (const vulkan::PassRecord& pass : times.passes) {
        const std::string_view name = pass.name;
        if (name == kMapsPass) {
            addTime(stages.maps, pass.milliseconds);
        } else if (name == kFilterPass) {
            addTime(stages.filter, pass.milliseconds);
        } else if (name == kMaskPass || name == kSoftenPass) {
            addTime(stages.mask, pass.milliseconds);
        }
    }
    return stages;
}

Counters countersOf(const host::FrameTimes& times, const Plan& plan, bool redraws_all)
{
    Counters counters;
    for (const View& view : plan.views) {
        counters.texels_rendered += texelsRendered(view, redraws_all);
    }
    for (const vulkan::PassRecord& pass : times.passes) {
        counters.has_statistics = counters.has_statistics || pass.has_statistics;
        counters.vertex_invocations += pass.vertex_invocations;
        counters.primitives += pass.primitives;
        counters.fragment_invocations += pass.fragment_invocations;
        counters.compute_invocations += pass.compute_invocations;
        counters.draws += pass.draws;
        ++counters.passes;
    }
    return counters;
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

std::vector<std::size_t> timingGroups(const std::vector<Contestant>& contestants, std::size_t lights)
{
    std::vector<std::size_t> groups;
    std::uint64_t texels = 0;
    for (const Contestant& contestant : contestants) {
        const std::uint64_t side = largestSide(contestant.options.shadow);
        const std::uint64_t needs = side * side * lights * weightOf(contestant.options.shadow);
        if (groups.empty() || groups.back() == kMaxTogether || texels + needs > kMaxTexelsTogether) {
            groups.push_back(0);
            texels = 0;
        }
        ++groups.back();
        texels += needs;
    }
    return groups;
}

TimingResult timeInTurn(const host::SceneOnGpu& scene, const Subject& subject,
                        const std::vector<Contestant>& contestants, const TimingOptions& options,
                        const std::function<void()>& step)
{
    const SubjectAt always = [&](std::uint32_t /*round*/) -> const Subject& {
        return subject;
    };
    return timeInTurn(scene, always, contestants, options, step);
}

TimingResult timeInTurn(const host::SceneOnGpu& scene, const SubjectAt& subject_at,
                        const std::vector<Contestant>& contestants, const TimingOptions& options,
                        const std::function<void()>& step)
{
    const std::size_t lights = subject_at(0).lights.size();
    assert(!contestants.empty() && options.repetitions > 0);
    TimingResult result;
    std::span<const Contestant> rest = contestants;
    for (const std::size_t count : timingGroups(contestants, lights)) {
        timeGroup(scene, subject_at, rest.first(count), options, step, result);
        rest = rest.subspan(count);
    }
    return result;
}

std::uint64_t timingSteps(const Subject& subject, const std::vector<Contestant>& contestants,
                          const TimingOptions& options)
{
    const std::uint64_t turns = contestants.size() + timingGroups(contestants, subject.lights.size()).size();
    return turns * (std::uint64_t{options.warmup} + options.repetitions);
}

double frameRatio(const Timed& technique)
{
    return technique.baseline_ms > 0.0 ? medianFrame(technique) / technique.baseline_ms : 0.0;
}

} // namespace gnomon::lab
