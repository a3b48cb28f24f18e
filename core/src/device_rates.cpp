// SPDX-License-Identifier: Apache-2.0
#include <gnomon/device_rates.h>

namespace gnomon {
namespace {

// NVIDIA H200, 1280x720 and maps of 2048 (docs/gpus/h200.json). It was not measured with maps of other sizes: a texel
// counts as 16 bytes of a GPU with 800 GB/s.
constexpr DeviceRates kGpu{.rest_ns = 2.0,
                           .caster_ns = 1000.0,
                           .texel_ns = 0.02,
                           .block_texel_ns = 0.017,
                           .moment_texel_ns = 1.8,
                           .compare_ns = 0.6,
                           .search_ns = 4.7,
                           .ray_ns = 26.0,
                           .source = RateSource::gpu};
// llvmpipe of Mesa 22.3 on two quiet cores: `gnomon bench` of kenney_city at 1280x720 with maps of 2048 and 4096.
constexpr DeviceRates kSoftware{.rest_ns = 85.0,
                                .caster_ns = 40000.0,
                                .texel_ns = 2.3,
                                .block_texel_ns = 1.4,
                                .moment_texel_ns = 40.0,
                                .compare_ns = 24.0,
                                .search_ns = 78.0,
                                .ray_ns = 84.0,
                                .source = RateSource::software};

} // namespace

DeviceRates ratesOf(RateSource source)
{
    return source == RateSource::software ? kSoftware : kGpu;
}

std::string_view nameOf(RateSource value)
{
    switch (value) {
    case RateSource::gpu:
        return "gpu";
    case RateSource::software:
        return "software";
    case RateSource::measured:
        return "measured";
    }
    return {};
}

} // namespace gnomon
