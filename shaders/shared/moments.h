// SPDX-License-Identifier: Apache-2.0
#ifndef GNOMON_MOMENTS_H
#define GNOMON_MOMENTS_H
#include "moment_rule.h"
GN_BEGIN

GN_FN real4 encodeVsm(EncodeInput e, MomentRule rule)
{
    return real4(e.depth + real(0.0) * rule.power);
}
GN_FN real4 encodeLvsm(EncodeInput e, MomentRule rule)
{
    return real4(e.depth + real(0.0) * rule.power);
}
GN_END
#endif
