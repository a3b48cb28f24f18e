// SPDX-License-Identifier: Apache-2.0
#include "cpu_map.h"
#include "hostile_values.h"

#include <gtest/gtest.h>

#include <random>
#include <utility>

#include "hostile_filters.h"

namespace gnomon::shared {
namespace {

TEST(HostileMaps, giveVisibilityInDouble)
{
    test::map_moments = [](glm::dvec2, double, double) {
        return glm::dvec4(test::hostileTexel());
    };
    test::depth_layers = [](int, int) {
        return glm::dvec4(test::hostileTexel());
    };
    test::map_texels = [](int, int) {
        return double(test::hostileTexel().x);
    };
    test::map_block = [](int, int, int) {
        return glm::dvec2(test::hostileTexel());
    };
    hostile::expectAllBounded();
    test::map_texels = nullptr;
    test::map_block = nullptr;
    test::map_moments = nullptr;
    test::depth_layers = nullptr;
}

TEST(HostileMaps, visibilityIsBoundedWhateverAFilterSays)
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double inf = std::numeric_limits<double>::infinity();
    EXPECT_EQ(boundedVisibility(nan), 1.0) << "lit";
    EXPECT_EQ(boundedVisibility(inf), 1.0);
    EXPECT_EQ(boundedVisibility(-inf), 0.0);
    EXPECT_EQ(boundedVisibility(1.0 + 1e-9), 1.0);
    EXPECT_EQ(boundedVisibility(-1e-9), 0.0);
    EXPECT_EQ(boundedVisibility(0.25), 0.25);
}

} // namespace
} // namespace gnomon::shared
