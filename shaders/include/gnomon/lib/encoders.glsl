// SPDX-License-Identifier: Apache-2.0
// The table of what filterable maps store. A new one is a line here. An encoder is a function `real4 name(EncodeInput e, MomentRule rule)` whose result may be averaged over texels (averageOf()).
#ifndef GNOMON_ENCODERS_GLSL
#define GNOMON_ENCODERS_GLSL
#include "../shared/filter_numbers.h"
#include "../shared/exponential.h"
#include "../shared/moments.h"
#include "../shared/moments_four.h"
GN_BEGIN

// clang-format off
#define GN_ENCODERS(LINE)               \
    LINE(GNOMON_FILTER_VSM, encodeVsm)         \
    LINE(GNOMON_FILTER_LVSM, encodeLvsm)       \
    LINE(GNOMON_FILTER_ESM, encodeEsm)         \
    LINE(GNOMON_FILTER_EVSM, encodeEvsm)       \
    LINE(GNOMON_FILTER_MSM, encodeMsm)
// clang-format on

GN_FN real4 encodeDepth(int filter_number, EncodeInput e, MomentRule rule)
{
#define GN_LINE(number, function)                                                                                      \
    if (filter_number == number)                                                                                       \
        return function(e, rule);
    GN_ENCODERS(GN_LINE)
#undef GN_LINE
    return real4(real(0.0));
}

GN_END
#endif
