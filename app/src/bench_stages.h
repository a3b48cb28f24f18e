// SPDX-License-Identifier: Apache-2.0
// What is kept of a timed frame, and order statistics of many.
#pragma once

#include "host/renderer.h"

#include <cstdint>
#include <string>
#include <vector>

namespace gnomon::app {

/// Milliseconds of one frame by the stages that results name. `filter` is 0 for filters that need no pass of their own.
struct StageTimes {
    double plan = 0.0;
    double maps = 0.0;
    double filter = 0.0;
    double mask = 0.0;
    double frame = 0.0;
};
[[nodiscard]] StageTimes stagesOf(const host::FrameTimes& times);

/// Work that does not depend on the machine, of one frame.
struct Counters {
    std::uint64_t texels_rendered = 0; // of all tiles that were drawn
    std::uint64_t vertex_invocations = 0;
    std::uint64_t primitives = 0;
    std::uint64_t fragment_invocations = 0;
    std::uint64_t compute_invocations = 0;
    std::uint64_t draws = 0;
    std::uint64_t passes = 0;
};
[[nodiscard]] Counters countersOf(const host::FrameTimes& times, const Plan& plan, bool redraws_all);

struct Spread {
    double median = 0.0;
    double iqr = 0.0; // third quartile less the first
};
/// Quartiles by linear interpolation between order statistics (Hyndman & Fan 1996, type 7). Empty: zeros.
[[nodiscard]] Spread spreadOf(std::vector<double> values);

} // namespace gnomon::app
