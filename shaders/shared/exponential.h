// SPDX-License-Identifier: Apache-2.0
#ifndef GNOMON_EXPONENTIAL_H
#define GNOMON_EXPONENTIAL_H
#include "moment_rule.h"
GN_BEGIN

GN_FN real4 encodeEsm(EncodeInput e, MomentRule rule)
{
    return real4(e.depth + real(0.0) * rule.power);
}
GN_FN real4 encodeEvsm(EncodeInput e, MomentRule rule)
{
    return real4(e.depth + real(0.0) * rule.power);
}
GN_END
#endif
