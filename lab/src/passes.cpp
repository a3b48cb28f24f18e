// SPDX-License-Identifier: Apache-2.0
#include "lab/passes.h"

#include <algorithm>
#include <cstddef>
#include <map>

namespace gnomon::lab {
namespace {

void addCounts(vulkan::PassRecord& sum, const vulkan::PassRecord& pass)
{
    sum.has_statistics = pass.has_statistics;
    sum.vertex_invocations += pass.vertex_invocations;
    sum.primitives += pass.primitives;
    sum.fragment_invocations += pass.fragment_invocations;
    sum.compute_invocations += pass.compute_invocations;
    sum.draws += pass.draws;
}

std::optional<PassLeast> leastOf(std::string_view name, const LeastByPass& least)
{
    if (name == kMapsPass) {
        return least.maps;
    }
    if (name == kFilterPass) {
        return least.filter;
    }
    return name == kMaskPass ? least.mask : std::nullopt;
}

} // namespace

void addTime(std::optional<double>& sum_ms, const std::optional<double>& part_ms)
{
    sum_ms = sum_ms && part_ms ? std::optional(*sum_ms + *part_ms) : std::nullopt;
}

std::vector<PassWork> passesOf(std::span<const host::FrameTimes> samples, const LeastByPass& least)
{
    std::vector<PassWork> passes;
    std::vector<std::vector<std::optional<double>>> times; // times of each pass, by frame
    for (std::size_t frame = 0; frame < samples.size(); ++frame) {
        for (const vulkan::PassRecord& record : samples[frame].passes) {
            const auto found =
                std::ranges::find_if(passes, [&](const PassWork& pass) { return pass.name == record.name; });
            const auto place = static_cast<std::size_t>(found - passes.begin());
            if (found == passes.end()) {
                passes.push_back({.name = record.name, .ms = {}, .sum = {}, .least = leastOf(record.name, least)});
                times.emplace_back(samples.size(), 0.0);
            }
            addTime(times[place][frame], record.milliseconds);
            if (frame + 1 == samples.size()) {
                addCounts(passes[place].sum, record);
            }
        }
    }
    for (std::size_t i = 0; i < passes.size(); ++i) {
        passes[i].ms = spreadOfMeasured(times[i]);
    }
    return passes;
}

} // namespace gnomon::lab
