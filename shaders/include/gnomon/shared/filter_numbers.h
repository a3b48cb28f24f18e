// SPDX-License-Identifier: Apache-2.0
// All filters, for C++, GLSL and CMake. Filters that read maps in the mask pass have a number as a macro, because the
// preprocessor chooses by it; CMake makes modules by these. First are filters that compare the depths of a map, then
// those that average texels, then those that compare ids. A new one goes to its kind, and those after it move up.
#ifndef GNOMON_FILTER_NUMBERS_H
#define GNOMON_FILTER_NUMBERS_H
#define GNOMON_FILTER_HARD 0
#define GNOMON_FILTER_PCF 1
#define GNOMON_FILTER_PCSS 2
#define GNOMON_FILTER_RAYMARCH 3
#define GNOMON_FILTER_VSM 4
#define GNOMON_FILTER_LVSM 5
#define GNOMON_FILTER_ESM 6
#define GNOMON_FILTER_EVSM 7
#define GNOMON_FILTER_MSM 8
#define GNOMON_FILTER_ID 9
#define GNOMON_FILTER_DEPTH_ID 10
#define GNOMON_FILTER_COUNT 11

#ifdef __cplusplus
#include <cstdint>

namespace gnomon {

/// The value that a texel stores, and the test that reads it: docs/which-technique.md.
enum class Filter : std::uint8_t {
    hard = GNOMON_FILTER_HARD,
    pcf = GNOMON_FILTER_PCF,
    pcss = GNOMON_FILTER_PCSS,
    raymarch = GNOMON_FILTER_RAYMARCH,
    vsm = GNOMON_FILTER_VSM,
    lvsm = GNOMON_FILTER_LVSM,
    esm = GNOMON_FILTER_ESM,
    evsm = GNOMON_FILTER_EVSM,
    msm = GNOMON_FILTER_MSM,
    id = GNOMON_FILTER_ID,
    depth_id = GNOMON_FILTER_DEPTH_ID,
    volumes = GNOMON_FILTER_COUNT, // from here on filters have no shader of their own
    smoothies,
    automatic
};

} // namespace gnomon
#endif
#endif
