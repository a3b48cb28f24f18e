// SPDX-License-Identifier: Apache-2.0
// How long a device takes for the parts of a frame that the size of shadow maps changes: partition and map size `auto`
// weigh error against it.
#pragma once

#include <gnomon/export.h>

#include <cstdint>
#include <string_view>

namespace gnomon {

/// The origin of rates.
enum class RateSource : std::uint8_t {
    gpu,      // the table's, for a GPU
    software, // the table's, for a software rasteriser
    measured, // measured on the device itself
};
[[nodiscard]] GNOMON_API std::string_view nameOf(RateSource value);

/// Each is a time, a finite number >= 0. Only their ratios count. The pixels are those of the picture.
struct DeviceRates {
    double rest_ns = 0.0;                // a pixel of a frame without shadows
    double caster_ns = 0.0;              // a caster that is drawn into a map
    double texel_ns = 0.0;               // a texel of a map that compares depths
    double block_texel_ns = 0.0;         // as much more, where the filter looks around in blocks (pcss, raymarch)
    double moment_texel_ns = 0.0;        // as much more, of a filterable map
    double compare_ns = 0.0;             // a pixel of the mask by a filter of a few texels, and by a filterable one
    double search_ns = 0.0;              // a pixel of the mask of pcss
    double ray_ns = 0.0;                 // a pixel of the mask of raymarch
    RateSource source = RateSource::gpu; // their origin

    bool operator==(const DeviceRates&) const = default;
};

/// The table's rates; those of a GPU for `measured`, which no table has. docs/techniques/auto.md says which devices
/// they were measured on.
[[nodiscard]] GNOMON_API DeviceRates ratesOf(RateSource source);

} // namespace gnomon
