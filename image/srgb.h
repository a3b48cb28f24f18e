// SPDX-License-Identifier: Apache-2.0
// Based on: IEC 61966-2-1:1999, the transfer function of sRGB, and its inverse.
#pragma once

#include <cmath>

namespace gnomon {

/// Linear light of an encoded value. Both are 0 at 0 and 1 at 1; values outside [0, 1] continue the same curve, below 0
/// its straight part. NaN stays NaN.
[[nodiscard]] inline double decodeSrgb(double encoded)
{
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

/// The encoded value of linear light. It inverts decodeSrgb() within 1e-7, because the standard's two pieces do not
/// quite meet.
[[nodiscard]] inline double encodeSrgb(double linear)
{
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

} // namespace gnomon
