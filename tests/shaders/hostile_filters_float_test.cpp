// SPDX-License-Identifier: Apache-2.0
// Compiled alone: in single precision, which its headers get from float_map.h.
// In the precision of the GPU, where huge numbers overflow earlier and small ones vanish.
#include "float_map.h"
#include "hostile_values.h"

#include <gtest/gtest.h>

#include <random>
#include <utility>

#include "hostile_filters.h"

namespace gnomon::shared {
namespace {

TEST(HostileMaps, giveVisibilityInSinglePrecision)
{
    test::float_texel = test::hostileTexel;
    test::float_layers = [](int) {
        return test::hostileTexel();
    };
    hostile::expectAllBounded();
    test::float_texel = nullptr;
    test::float_layers = nullptr;
}

} // namespace
} // namespace gnomon::shared
