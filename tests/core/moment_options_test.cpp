// SPDX-License-Identifier: Apache-2.0
#include <gnomon/moment_options.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace gnomon {
namespace {

using Change = std::function<void(MomentOptions&)>;

std::string reasonFor(Filter filter, MapFormat format, const Change& change)
{
    MomentOptions options;
    change(options);
    return refusal(filter, format, options).value_or("");
}
std::string vsmReason(const Change& change)
{
    return reasonFor(Filter::vsm, MapFormat::rg32f, change);
}

TEST(MomentOptions, WhatAFilterCannotStoreIsRefusedFirst)
{
    EXPECT_EQ(reasonFor(Filter::esm, MapFormat::rgba16, [](MomentOptions& o) { o.samples = 3; }),
              "esm stores one exponential, which only a float holds: r32f or r16f");
    EXPECT_EQ(reasonFor(Filter::id, MapFormat::d32f, [](MomentOptions&) {}),
              "id stores an object's id and nothing else: r16 or r8");
}

TEST(MomentOptions, PenumbraeOfALightNeedDepthsAlongIt)
{
    const Change light = [](MomentOptions& o) {
        o.penumbra = MomentPenumbra::light;
    };
    const Change over_w = [](MomentOptions& o) {
        o.penumbra = MomentPenumbra::light;
        o.metric = DepthMetricKind::z_over_w;
    };
    for (const auto& [filter, format] :
         {std::pair(Filter::vsm, MapFormat::rg32f), std::pair(Filter::msm, MapFormat::rgba16)}) {
        EXPECT_EQ(reasonFor(filter, format, light), "");
        EXPECT_EQ(reasonFor(filter, format, over_w),
                  "penumbra light takes the distance to an occluder from depths along the light: depth-metric linear");
    }
    EXPECT_EQ(reasonFor(Filter::esm, MapFormat::r32f, over_w), ""); // which has no such penumbrae
}

TEST(MomentOptions, FiltersThatCompareDepthsPassOverThem)
{
    EXPECT_EQ(reasonFor(Filter::pcf, MapFormat::d32f, [](MomentOptions& o) { o.samples = 3; }), "");
}

TEST(MomentOptions, CountsThatHaveNoRange)
{
    EXPECT_EQ(vsmReason([](MomentOptions& o) { o.blur_radius_texels = 31; }), "");
    EXPECT_EQ(vsmReason([](MomentOptions& o) { o.blur_radius_texels = 32; }),
              "blur.radius is 32; it can be 1 to 31 texels");
    for (const std::uint32_t samples : {1U, 4U}) {
        EXPECT_EQ(vsmReason([&](MomentOptions& o) { o.samples = samples; }), "");
    }
    for (const std::uint32_t samples : {0U, 2U, 8U}) {
        EXPECT_EQ(vsmReason([&](MomentOptions& o) { o.samples = samples; }),
                  "msaa is " + std::to_string(samples) + "; it can be 1 or 4");
    }
}

TEST(MomentOptions, UnormHoldsNoNegativeDepth)
{
    const Change remap = [](MomentOptions& o) {
        o.remap = true;
    };
    const std::vector<std::pair<Filter, MapFormat>> unorms{{Filter::vsm, MapFormat::rg16},
                                                           {Filter::lvsm, MapFormat::rgba16}};
    for (const auto& [filter, format] : unorms) {
        EXPECT_EQ(reasonFor(filter, format, remap),
                  std::string(nameOf(format)) +
                      " holds 0 to 1 only, so depth cannot be remapped to -1 to 1; floats can");
    }
    EXPECT_EQ(reasonFor(Filter::vsm, MapFormat::rg16f, remap), "");
    for (const MapFormat format : {MapFormat::rgba16, MapFormat::rgba32f}) { // to which it is nothing new
        EXPECT_EQ(reasonFor(Filter::msm, format, remap), "");
    }
}

TEST(MomentOptions, ExponentsEndWhereTheFormatDoes)
{
    const auto esm = [](MapFormat format, float exponent, bool log_space) {
        return reasonFor(Filter::esm, format, [&](MomentOptions& o) {
            o.esm_exponent = exponent;
            o.log_space = log_space;
        });
    };
    EXPECT_EQ(esm(MapFormat::r32f, 88.0F, false), "");
    EXPECT_EQ(esm(MapFormat::r32f, 88.5F, false),
              "exponent 88.5 would overflow r32f, which holds up to 88; in log space there is no such limit");
    EXPECT_EQ(esm(MapFormat::r16f, 11.0F, false), "");
    EXPECT_EQ(esm(MapFormat::r16f, 11.1F, false),
              "exponent 11.1 would overflow r16f, which holds up to 11; in log space there is no such limit");
    EXPECT_EQ(esm(MapFormat::r16f, 500.0F, true), "");
    EXPECT_EQ(esm(MapFormat::r32f, 0.0F, true), "esm.exponent is 0; it can be 0.01 to 10000");

    const auto evsm = [](MapFormat format, float positive, float negative) {
        return reasonFor(Filter::evsm, format, [&](MomentOptions& o) {
            o.evsm_positive = positive;
            o.evsm_negative = negative;
        });
    };
    EXPECT_EQ(evsm(MapFormat::rgba32f, 42.0F, 42.0F), "");
    EXPECT_EQ(evsm(MapFormat::rgba32f, 42.5F, 5.0F),
              "positive exponent 42.5 would overflow rgba32f, which holds up to 42; in log space there is no such "
              "limit");
    EXPECT_EQ(evsm(MapFormat::rgba16f, 5.54F, 5.54F), "");
    EXPECT_EQ(evsm(MapFormat::rgba16f, 5.0F, 5.6F),
              "negative exponent 5.6 would overflow rgba16f, which holds up to 5.54; in log space there is no such "
              "limit");
    EXPECT_EQ(evsm(MapFormat::rg16f, 5.0F, 5.6F), ""); // which stores the positive warp alone
}

TEST(MomentOptions, ExponentsThatNobodyChoseFit)
{
    const MomentOptions options;
    EXPECT_EQ(defaultExponent(Filter::esm, MapFormat::r32f, options, false), 80.0);
    EXPECT_EQ(defaultExponent(Filter::esm, MapFormat::r16f, options, false), 11.0);
    EXPECT_EQ(defaultExponent(Filter::evsm, MapFormat::rgba32f, options, false), 40.0);
    EXPECT_EQ(defaultExponent(Filter::evsm, MapFormat::rgba32f, options, true), 5.0);
    EXPECT_EQ(defaultExponent(Filter::evsm, MapFormat::rg32f, options, false), 5.0);
    EXPECT_EQ(defaultExponent(Filter::evsm, MapFormat::rgba16f, options, false), 5.54);
    EXPECT_EQ(defaultExponent(Filter::evsm, MapFormat::rgba16f, options, true), 5.0);
    const MomentOptions logs{.log_space = true};
    EXPECT_EQ(defaultExponent(Filter::esm, MapFormat::r16f, logs, false), 80.0);
    EXPECT_EQ(largestExponent(Filter::evsm, MapFormat::rg16f, logs), std::numeric_limits<double>::infinity());
    // A sum of a kernel's texels stays finite: e^c and e^2c themselves are below the largest number.
    EXPECT_LT(std::exp(largestExponent(Filter::esm, MapFormat::r16f, options)), 65504.0);
    EXPECT_LT(std::exp(largestExponent(Filter::esm, MapFormat::r32f, options)), 3.4e38);
    EXPECT_LT(std::exp(2.0 * largestExponent(Filter::evsm, MapFormat::rg16f, options)), 65504.0);
    EXPECT_LT(std::exp(2.0 * largestExponent(Filter::evsm, MapFormat::rg32f, options)), 3.4e38);
}

TEST(MomentOptions, LayersByHandMeetInOrder)
{
    const auto by_hand = [](std::uint32_t layers, std::vector<float> splits) {
        return reasonFor(Filter::lvsm, MapFormat::rgba16, [&](MomentOptions& o) {
            o.placement = LayerPlacement::by_hand;
            o.layers = layers;
            std::copy(splits.begin(), splits.end(), o.splits.begin());
        });
    };
    const std::string sentence =
        "layers placed by hand meet at ascending depths between 0 and 1, one fewer than there are layers";
    EXPECT_EQ(by_hand(2, {0.5F}), "");
    EXPECT_EQ(by_hand(8, {0.1F, 0.2F, 0.3F, 0.4F, 0.5F, 0.6F, 0.7F}), "");
    EXPECT_EQ(by_hand(2, {0.5F, 0.4F}), ""); // only the first counts
    EXPECT_EQ(by_hand(2, {}), sentence);
    EXPECT_EQ(by_hand(2, {1.0F}), sentence);
    EXPECT_EQ(by_hand(3, {0.5F, 0.5F}), sentence);
    EXPECT_EQ(by_hand(3, {0.5F, 0.4F}), sentence);
    EXPECT_EQ(by_hand(8, {0.1F, 0.2F, 0.3F, 0.4F, 0.5F, 0.6F}), sentence);
    EXPECT_EQ(reasonFor(Filter::lvsm, MapFormat::rgba16, [](MomentOptions& o) { o.splits[0] = 2.0F; }), "");
}

TEST(MomentOptions, BlurRadius)
{
    MomentOptions options;
    EXPECT_EQ(blurRadius(options), 4U); // 3.75
    options.blur_sigma_texels = 1.0F;
    EXPECT_EQ(blurRadius(options), 3U);
    options.blur_sigma_texels = 0.3F;
    EXPECT_EQ(blurRadius(options), 1U);
    options.blur_sigma_texels = 10.0F;
    EXPECT_EQ(blurRadius(options), 30U);
    options.blur_radius_texels = 31;
    EXPECT_EQ(blurRadius(options), 31U);
    options.blur = BlurKind::box;
    EXPECT_EQ(blurRadius(options), 31U);
    options.blur_radius_texels = 0;
    EXPECT_EQ(blurRadius(options), 2U);
    options.blur = BlurKind::none;
    options.blur_radius_texels = 5;
    EXPECT_EQ(blurRadius(options), 0U);
}

TEST(MomentOptions, PenumbraeThatFollowTheLightAreNotBlurredUnlessAskedFor)
{
    MomentOptions options;
    EXPECT_EQ(blurOf(options), BlurKind::gaussian);
    options.penumbra = MomentPenumbra::light;
    EXPECT_EQ(blurOf(options), BlurKind::none);
    EXPECT_EQ(blurRadius(options), 0U);
    options.blur = BlurKind::box;
    EXPECT_EQ(blurOf(options), BlurKind::box);
    EXPECT_EQ(blurRadius(options), 2U);
}

TEST(MomentOptions, TwoLayersOfDepthShareAnImageLayer)
{
    const std::uint32_t expected[] = {1, 2, 2, 3, 3, 4, 4}; // of 2 .. 8
    for (std::uint32_t layers = 2; layers <= kMaxDepthLayers; ++layers) {
        const MomentOptions options{.layers = layers};
        EXPECT_EQ(imageLayersPerMap(Filter::lvsm, options), expected[layers - 2]);
        for (const Filter filter : {Filter::hard, Filter::pcf, Filter::vsm, Filter::esm, Filter::evsm, Filter::msm}) {
            EXPECT_EQ(imageLayersPerMap(filter, options), 1U);
        }
    }
}

} // namespace
} // namespace gnomon
