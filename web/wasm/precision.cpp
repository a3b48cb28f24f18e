// SPDX-License-Identifier: Apache-2.0
// Bounds on the errors of a host's normals (gnomon/pack/filter_rule.h), for src/recorder.ts: the C interface takes them
// as numbers.
#include <gnomon/pack/filter_rule.h>

extern "C" {

double gnomonWebNormalError(double rounding)
{
    return gnomon::pack::normalError(static_cast<float>(rounding));
}

double gnomonWebNormalErrorFromDepth(unsigned sub_pixel_bits)
{
    return gnomon::pack::normalErrorFromDepth(sub_pixel_bits);
}

} // extern "C"
