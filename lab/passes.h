// SPDX-License-Identifier: Apache-2.0
// A technique's frames pass by pass: what each took, what it worked, and the least that it has to move.
#pragma once

#include "host/frame_renderer.h"
#include "lab/score/traffic.h"
#include "lab/spread.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::lab {

// Passes of the library as it names them to the profiler.
inline constexpr std::string_view kMapsPass = "shadow maps";
inline constexpr std::string_view kFilterPass = "shadow filter";
inline constexpr std::string_view kMaskPass = "mask";
inline constexpr std::string_view kSoftenPass = "soften";

/// All passes of one name of a frame, added up.
struct PassWork {
    std::string name;
    std::optional<Spread> ms; // over the frames; of one that has no such pass: 0 ms. None without timestamps
    vulkan::PassRecord sum;   // counts of the last frame, without name and time
    std::optional<PassLeast> least;
};

/// Adds one part to a sum of milliseconds, which is none once a part is.
void addTime(std::optional<double>& sum_ms, const std::optional<double>& part_ms);

/// In the order of their first turn. `least` of the passes that it knows.
[[nodiscard]] std::vector<PassWork> passesOf(std::span<const host::FrameTimes> samples, const LeastByPass& least);

} // namespace gnomon::lab
