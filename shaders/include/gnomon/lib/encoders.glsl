// SPDX-License-Identifier: Apache-2.0
// The table of what filterable maps store. A new one is a line here. An encoder is a function `real4 name(EncodeInput e, MomentRule rule)` whose result may be averaged over texels (averageOf()).
#ifndef GNOMON_ENCODERS_GLSL
#define GNOMON_ENCODERS_GLSL
#include "../shared/choice_numbers.h"
#include "../shared/exponential.h"
#include "../shared/moments.h"
#include "../shared/moments_four.h"
GN_BEGIN

// clang-format off
#define GN_ENCODERS(LINE)               \
    LINE(kFilterVsm, encodeVsm)         \
    LINE(kFilterLvsm, encodeLvsm)       \
    LINE(kFilterEsm, encodeEsm)         \
    LINE(kFilterEvsm, encodeEvsm)       \
    LINE(kFilterMsm, encodeMsm)
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
