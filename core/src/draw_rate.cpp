// SPDX-License-Identifier: Apache-2.0
#include <gnomon/draw_rate.h>

#include <algorithm>
#include <cmath>

namespace gnomon {
namespace {

/// The weight of a frame relative to the one after it: 0.5 after eight frames.
constexpr double kKept = 0.9170040432046712; // 2^(-1/8)
constexpr double kMostTimes = 4.0;

} // namespace

void DrawRate::take(std::uint64_t texels, double ms)
{
    if (texels == 0 || !std::isfinite(ms) || !(ms > 0.0)) {
        return;
    }
    const auto drawn = static_cast<double>(texels);
    double believed_ms = ms;
    if (texels_ > 0.0) {
        const double expected_ms = drawn * msPerTexel();
        believed_ms = std::clamp(ms, expected_ms / kMostTimes, expected_ms * kMostTimes);
    }
    texels_ = kKept * texels_ + drawn;
    ms_ = kKept * ms_ + believed_ms;
}

} // namespace gnomon
