// SPDX-License-Identifier: Apache-2.0
// Unit vectors in two numbers.
// Based on: Z. Cigolle, S. Donow, D. Evangelakos, M. Mara, M. McGuire, Q. Meyer, "A Survey of Efficient Representations
// for Independent Unit Vectors", JCGT 2014 (oct).
#ifndef GNOMON_OCTAHEDRAL_H
#define GNOMON_OCTAHEDRAL_H
#include "portability.h"
GN_BEGIN

// sign() with sign(0) = 1, or vectors in a coordinate plane would fold to the centre.
GN_FN real signNotZero(real x)
{
    return x >= real(0.0) ? real(1.0) : real(-1.0);
}

// A vector turns by at most this angle, radians, for each unit by which both of its numbers are off: 3 sqrt(2). That is
// in the middle of a face, which is nearest to the octahedron's centre, along the line on which the third number
// changes by twice as much.
GN_CONST real kOctahedralStretch = real(4.2426407);

// Unit vector to [-1, 1]^2.
GN_FN real2 octahedralEncode(real3 n)
{
    real scale = real(1.0) / (abs(n.x) + abs(n.y) + abs(n.z));
    real2 p = real2(n.x * scale, n.y * scale);
    if (n.z < real(0.0)) {
        p = real2((real(1.0) - abs(p.y)) * signNotZero(p.x), (real(1.0) - abs(p.x)) * signNotZero(p.y));
    }
    return p;
}

// The inverse; always of unit length.
GN_FN real3 octahedralDecode(real2 e)
{
    real3 n = real3(e.x, e.y, real(1.0) - abs(e.x) - abs(e.y));
    real fold = max(-n.z, real(0.0));
    n = real3(n.x - signNotZero(n.x) * fold, n.y - signNotZero(n.y) * fold, n.z);
    return normalize(n);
}

GN_END
#endif
