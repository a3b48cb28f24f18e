// SPDX-License-Identifier: Apache-2.0
#define GNOMON_REAL double
#include <gnomon/shared/paired_depth.h>

#include <gtest/gtest.h>

#include <cmath>

namespace gnomon::shared {
namespace {

// A number as an image of 8 bits a channel stores it.
double stored(double channel)
{
    return std::round(channel * 255.0) / 255.0;
}

double roundTrip(double depth)
{
    const auto bytes = depthToBytes(depth);
    return depthFromBytes(stored(bytes.x), stored(bytes.y));
}

TEST(PairedDepth, everyCodeIsADepthOfItsOwn)
{
    for (int code = 0; code <= 65535; ++code) {
        const double depth = code / 65535.0;
        const auto bytes = depthToBytes(depth);
        EXPECT_EQ(std::lround(bytes.x * 255.0), code / 256) << code;
        EXPECT_EQ(std::lround(bytes.y * 255.0), code % 256) << code;
        EXPECT_NEAR(roundTrip(depth), depth, 1e-12) << code;
    }
}

TEST(PairedDepth, roundTripIsHalfACodeOffAtMostAndKeepsTheOrder)
{
    double before = -1.0;
    constexpr int kSteps = 1000003; // no multiple of the codes
    for (int i = 0; i <= kSteps; ++i) {
        const double depth = double(i) / kSteps;
        const double back = roundTrip(depth);
        ASSERT_LE(std::abs(back - depth), 0.5 / 65535.0 + 1e-12) << depth;
        ASSERT_GE(back, before) << depth;
        before = back;
    }
    EXPECT_EQ(roundTrip(0.0), 0.0);
    EXPECT_EQ(roundTrip(1.0), 1.0) << "what is empty stays lit";
}

// Why it is not done as the article does it.
TEST(PairedDepth, theArticlesCodesMeet)
{
    const auto decode = [](int high, int low) {
        return high / 255.0 + low / 255.0 / 255.0;
    };
    EXPECT_DOUBLE_EQ(decode(10, 255), decode(11, 0));
    EXPECT_NE(depthFromBytes(10 / 255.0, 1.0), depthFromBytes(11 / 255.0, 0.0));
}

TEST(PairedDepth, partsAreReadAsTheyWereWritten)
{
    for (const int holding : {kDepthAlone, kDepthChannel, kDepthBytes}) {
        const auto first = pairedTexel(holding, 0.3);
        const auto second = pairedTexel(holding, 0.7);
        auto texel = first; // then the second map's part is written over it
        if (holding == kDepthChannel) {
            texel.y = second.y;
        } else if (holding == kDepthBytes) {
            texel.z = second.z;
            texel.w = second.w;
        }
        const double code = holding == kDepthBytes ? 0.5 / 65535.0 : 0.0;
        EXPECT_NEAR(pairedDepth(holding, texel, 0.0), 0.3, code);
        EXPECT_NEAR(pairedDepth(holding, texel, 1.0), holding == kDepthAlone ? 0.3 : 0.7, code);
    }
}

} // namespace
} // namespace gnomon::shared
