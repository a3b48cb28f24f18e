// SPDX-License-Identifier: Apache-2.0
// How large the maps of a light should be where that is the planner's choice: predicted error against predicted time.
#pragma once

#include <gnomon/choices.h>
#include <gnomon/device_rates.h>

#include <array>
#include <cstdint>
#include <optional>

namespace gnomon {

/// A side is halved so many times at most.
inline constexpr std::uint32_t kMostHalvings = 3;

/// By how many times the largest side is halved: 0 .. kMostHalvings.
using BySize = std::array<double, kMostHalvings + 1>;

/// A frame with one light, as far as its time depends on the light's maps.
struct FrameWork {
    double pixels = 0.0;  // of the picture
    double casters = 0.0; // drawn, in all maps together
    double texels = 0.0;  // of all maps together
};
/// Predicted, milliseconds.
[[nodiscard]] double frameTime_ms(const DeviceRates& rates, const FilterTraits& filter, const FrameWork& work);

/// The size with the least product of rmse and time: a finer one takes a larger share more of time than it takes off
/// the error. `shares`: of wrong pixels, whose root is as rmse. `before`: of the frame before, which is kept while
/// another gains less than a tenth, for each change draws the map anew; nothing: there was none.
[[nodiscard]] std::uint32_t halvingsByTime(const BySize& shares, const BySize& times_ms,
                                           std::optional<std::uint32_t> before);

/// How many times to halve the side of a map whose coarsest texel is this many pixels (> 0), to an eighth of a pixel:
/// finer is of no use. `before`: as above, and kept up to a sixth.
[[nodiscard]] std::uint32_t halvingsFor(double coarsest_px, std::optional<std::uint32_t> before);

} // namespace gnomon
