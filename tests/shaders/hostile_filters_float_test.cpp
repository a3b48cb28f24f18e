// SPDX-License-Identifier: Apache-2.0
// In the precision of the GPU, where huge numbers overflow earlier and small ones vanish.
#define GNOMON_REAL float
#include "hostile_values.h"

#include <shared/discs.h>

GN_BEGIN
inline real mapTexel(real2, real)
{
    return test::hostileTexel().x;
}
inline real4 mapGather(real2, real)
{
    return test::hostileTexel();
}
inline real4 mapMoments(real2, real, real)
{
    return test::hostileTexel();
}
inline real4 mapDepthLayer(int, int)
{
    return test::hostileTexel();
}
inline real2 discPoint(int i)
{
    return kPoissonPoints[i];
}
GN_END

#include <lib/visibility.glsl>

#include <gtest/gtest.h>

#include <random>
#include <utility>

#include "hostile_filters.h"

namespace gnomon::shared {
namespace {

TEST(HostileMaps, giveVisibilityInSinglePrecision)
{
    hostile::expectAllBounded();
}

} // namespace
} // namespace gnomon::shared
