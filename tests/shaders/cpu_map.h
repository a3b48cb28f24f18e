// SPDX-License-Identifier: Apache-2.0
// Lets shaders/lib compile as C++ in double precision, with a map in memory.
#pragma once
#define GNOMON_REAL double

#include <shared/discs.h>

#include <cstdint>
#include <functional>

namespace gnomon::test {
/// Stored depth of a texel, by its integer coordinates.
inline std::function<double(int x, int y)> map_texels;
} // namespace gnomon::test

GN_BEGIN
inline real mapTexel(real2 at, real)
{
    return test::map_texels(static_cast<int>(at.x), static_cast<int>(at.y));
}
inline real4 mapGather(real2 corner, real)
{
    const int x = static_cast<int>(corner.x);
    const int y = static_cast<int>(corner.y);
    return {test::map_texels(x - 1, y), test::map_texels(x, y), test::map_texels(x, y - 1),
            test::map_texels(x - 1, y - 1)};
}
inline real2 discPoint(int i)
{
    return kPoissonPoints[i];
}
GN_END

#include <lib/visibility.glsl>
