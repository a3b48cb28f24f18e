// SPDX-License-Identifier: Apache-2.0
#include "auto/map_size.h"

#include "auto/map_error.h"

#include <cmath>

namespace gnomon {
namespace {

/// Coarser than this is too coarse, pixels.
constexpr double kTooCoarse_px = 1.0 / 6.0;
/// The size of the frame before is kept where its product is at most so many times the least.
constexpr double kKept = 1.1;

double maskPixel_ns(const DeviceRates& rates, const FilterTraits& filter)
{
    switch (filter.filter) {
    case Filter::raymarch:
        return rates.ray_ns;
    case Filter::pcss:
        return rates.search_ns;
    default:
        return rates.compare_ns;
    }
}

} // namespace

double frameTime_ms(const DeviceRates& rates, const FilterTraits& filter, const FrameWork& work)
{
    const double texel_ns = rates.texel_ns + (filter.filterable ? rates.moment_texel_ns : 0.0) +
                            (filter.integrates_light ? rates.block_texel_ns : 0.0);
    const double ns = (rates.rest_ns + maskPixel_ns(rates, filter)) * work.pixels + rates.caster_ns * work.casters +
                      texel_ns * work.texels;
    return ns * 1e-6;
}

std::uint32_t halvingsByTime(const BySize& shares, const BySize& times_ms, std::optional<std::uint32_t> before)
{
    const auto product = [&](std::uint32_t halvings) {
        return std::sqrt(shares[halvings]) * times_ms[halvings];
    };
    std::uint32_t best = 0;
    for (std::uint32_t halvings = 1; halvings <= kMostHalvings; ++halvings) {
        best = product(halvings) < product(best) ? halvings : best;
    }
    return before && product(*before) <= kKept * product(best) ? *before : best;
}

std::uint32_t halvingsFor(double coarsest_px, std::optional<std::uint32_t> before)
{
    std::uint32_t halvings = 0;
    while (halvings < kMostHalvings && std::ldexp(coarsest_px, static_cast<int>(halvings) + 1) <= kFineEnough_px) {
        ++halvings;
    }
    const bool keeps =
        before && *before > halvings && std::ldexp(coarsest_px, static_cast<int>(*before)) <= kTooCoarse_px;
    return keeps ? *before : halvings;
}

} // namespace gnomon
