// SPDX-License-Identifier: Apache-2.0
#include "lab/map_picture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

namespace gnomon {
namespace {

lab::MapPanel panelOf(std::uint32_t side, float value)
{
    lab::MapPanel panel{"a map", ImageF(side, side, 1)};
    std::ranges::fill(panel.values.values, value);
    return panel;
}

lab::MapLegend legendOf()
{
    return {"Maps", "of a test", "near", "far", [](double value) {
                return std::to_string(value);
            }};
}

/// The same value is the same grey in each map, whatever else is in it.
TEST(MapPicture, HasOneScaleForAllMaps)
{
    std::vector<lab::MapPanel> panels{panelOf(170, 2.0F), panelOf(170, 6.0F), panelOf(170, 4.0F)};
    *panels[2].values.pixel(5, 5) = std::numeric_limits<float>::quiet_NaN();
    const lab::ValueRange range = lab::rangeOf(panels);
    EXPECT_EQ(range.least, 2.0F);
    EXPECT_EQ(range.greatest, 6.0F);
    const Image8 picture = lab::mapPicture(panels, legendOf());
    ASSERT_EQ(picture.width, 2U * 170 + 4);
    ASSERT_GT(picture.height, 2U * (170 + 18) + 4);
    EXPECT_EQ(*picture.pixel(100, 18 + 100), 0);
    EXPECT_EQ(*picture.pixel(174 + 100, 18 + 100), 255);
    EXPECT_EQ(*picture.pixel(100, 192 + 18 + 100), 128);
    EXPECT_EQ(*picture.pixel(5, 192 + 18 + 5), 0) << "not a number";
}

TEST(MapPicture, OfOneValueOrNoneIsBlack)
{
    for (const float value : {3.0F, std::numeric_limits<float>::infinity()}) {
        const std::vector<lab::MapPanel> panels{panelOf(320, value)};
        const Image8 picture = lab::mapPicture(panels, legendOf());
        EXPECT_EQ(picture.width, 320U);
        EXPECT_GT(picture.height, 360U);
        EXPECT_EQ(*picture.pixel(160, 160), 0);
    }
}

} // namespace
} // namespace gnomon
