// SPDX-License-Identifier: Apache-2.0
// The table of filters. A new one is a file in this folder, its include, and a line here; the number is that of
// gnomon::Filter (core/include/gnomon/choices.h).
#ifndef GNOMON_FILTERS_GLSL
#define GNOMON_FILTERS_GLSL
#include "esm.glsl"
#include "evsm.glsl"
#include "hard.glsl"
#include "lvsm.glsl"
#include "msm.glsl"
#include "pcf.glsl"
#include "vsm.glsl"
GN_BEGIN

// clang-format off
#define GN_FILTERS(LINE) \
    LINE(0, filterHard)  \
    LINE(1, filterPcf)   \
    LINE(3, filterVsm)   \
    LINE(4, filterLvsm)  \
    LINE(5, filterEsm)   \
    LINE(6, filterEvsm)  \
    LINE(7, filterMsm)
// clang-format on

GN_FN real applyFilter(int filter_number, MapPoint point, FilterInput f)
{
#define GN_LINE(number, function)                                                                                      \
    if (filter_number == number)                                                                                       \
        return function(point, f);
    GN_FILTERS(GN_LINE)
#undef GN_LINE
    return real(1.0);
}

GN_END
#endif
