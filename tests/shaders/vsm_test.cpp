// SPDX-License-Identifier: Apache-2.0
// Two moments: what they bound, what rounding does to them, and what is made of the bound.
#include "cpu_map.h"

#include <gnomon/lib/encoders.glsl>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace gnomon::shared {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
class Vsm : public testing::Test {
protected:
    Vsm()
    {
        input.tile = {0.0, 0.0, 8.0, 8.0};
        input.moments.sampling = 1;
        input.moments.power = 1.0;
        input.near_over_far = 0.1;
        point.texel = {4.0, 4.0};
        test::map_moments = [this](glm::dvec2, double, double) {
            return stored;
        };
    }
    /// Moments of one depth in the view's metric.
    [[nodiscard]] glm::dvec4 encode(double m, double variance = 0.0) const
    {
        EncodeInput e{};
        e.depth = momentDepth(m, input.moments.flags, input.near_over_far);
        e.variance = variance;
        return encodeVsm(e, input.moments);
    }
    double visibility(double m)
    {
        point.depth = m;
        return filterVsm(point, input, sampleMoments(point, input, input.layer));
    }

    FilterInput input{};
    MapPoint point{};
    glm::dvec4 stored{0.0};
};

TEST_F(Vsm, isExactForAParallelOccluderAndReceiver)
{
    for (const int flags : {0, kMomentRemap, kMomentZOverW, kMomentRemap | kMomentZOverW}) {
        input.moments.flags = flags;
        for (const double occluder : {0.0, 0.2, 0.55}) {
            for (const double receiver : {0.6, 0.9, 1.0}) {
                for (int k = 0; k < 100; ++k) { // every weight of a filter
                    const double covered = k / 100.0;
                    stored = encode(occluder) * covered + encode(receiver) * (1.0 - covered);
                    EXPECT_NEAR(visibility(receiver), 1.0 - covered, 1e-6)
                        << flags << ' ' << occluder << ' ' << receiver;
                    EXPECT_EQ(visibility(occluder - 1e-9), 1.0) << "the occluder itself is lit";
                }
            }
        }
    }
}

TEST_F(Vsm, fullCoverageLeavesTheLeastVarianceOnly)
{
    input.moments.min_variance = 0.0004;
    stored = encode(0.2);
    EXPECT_NEAR(visibility(0.6), 0.0004 / (0.0004 + 0.16), 1e-12);
    input.moments.min_variance_texels = 0.5;
    point.texel_depth = 0.1;
    EXPECT_NEAR(visibility(0.6), 0.0025 / (0.0025 + 0.16), 1e-12) << "half a texel is the larger one";
    input.moments.flags = kMomentRemap;
    stored = encode(0.2);
    EXPECT_NEAR(visibility(0.6), 0.0025 / (0.0025 + 0.16), 1e-12) << "remapping changes no visibility";
}

TEST_F(Vsm, leastVarianceFollowsTheStretchOfZOverW)
{
    MomentRule rule{};
    rule.min_variance_texels = 0.5;
    for (const double m : {0.0, 0.1, 0.5, 1.0}) {
        const double h = 1e-7;
        const double slope = (zOverW(m + h, 0.1) - zOverW(m - h, 0.1)) / (2.0 * h);
        EXPECT_NEAR(metricStretch(m, kMomentZOverW, 0.1), slope, 1e-5 * slope);
        EXPECT_EQ(metricStretch(m, 0, 0.1), 1.0);
        const double deviation = 0.5 * 0.001 * slope;
        EXPECT_NEAR(leastVariance(rule, 0.001, metricStretch(m, kMomentZOverW, 0.1)), deviation * deviation,
                    1e-4 * deviation * deviation);
    }
}

TEST_F(Vsm, boundsEveryDistributionFromAbove)
{
    std::mt19937 rng(21);
    std::uniform_real_distribution<double> u(0.0, 1.0);
    double tightest = 1.0;
    for (int round = 0; round < 10000; ++round) {
        input.moments.flags = round % 2 == 0 ? 0 : kMomentRemap;
        const int count = 1 + round % 16;
        std::vector<double> depths;
        stored = glm::dvec4(0.0);
        for (int i = 0; i < count; ++i) {
            const double d = round % 3 == 0 && i % 2 == 0 ? 0.3 : u(rng);
            depths.push_back(d);
            stored += encode(d, round % 5 == 0 ? 0.001 * u(rng) : 0.0) / static_cast<double>(count);
        }
        const double t = round % 4 == 0 ? depths.back() : u(rng);
        double lit = 0.0;
        for (const double d : depths) {
            lit += d >= t ? 1.0 / count : 0.0;
        }
        const double v = visibility(t);
        // A depth at t exactly is lit; its moments may be rounded to just before t.
        EXPECT_GE(v, lit - 1e-4) << round;
        EXPECT_LE(v, 1.0);
        if (lit < 1.0) {
            tightest = std::min(tightest, v - lit);
        }
    }
    EXPECT_LT(tightest, 0.001) << "no distribution comes near to the bound: is it one?";
}

TEST_F(Vsm, aFilteredSlopeDoesNotShadeItself)
{
    test::MomentImage image(32, 32);
    for (const int flags : {0, kMomentRemap}) {
        input.moments.flags = flags;
        for (int y = 0; y < 32; ++y) {
            for (int x = 0; x < 32; ++x) {
                glm::dvec4 sum(0.0);
                for (int k = -2; k <= 2; ++k) {
                    sum += encode(0.2 + 0.01 * (x + k + 0.5)) * 0.2;
                }
                image.at(x, y) = sum;
            }
        }
        test::map_moments = [&](glm::dvec2 texel, double level, double layer) {
            return image.read(texel, level, layer);
        };
        input.tile = {0.0, 0.0, 32.0, 32.0};
        for (double x = 6.0; x < 26.0; x += 0.13) {
            point.texel = {x, 16.0};
            EXPECT_NEAR(visibility(0.2 + 0.01 * x), 1.0, 1e-9);
            EXPECT_LT(visibility(0.3 + 0.01 * x), 0.05);
        }
    }
}

TEST_F(Vsm, derivativesAddToTheSecondMomentOnly)
{
    for (const int flags : {0, kMomentRemap}) {
        input.moments.flags = flags;
        const double scale = momentScale(flags);
        const glm::dvec4 added = encode(0.4, 0.003) - encode(0.4);
        EXPECT_LT(glm::length(added - glm::dvec4(0.0, 0.003 * scale * scale, 0.0, 0.0)), 1e-15);
        EXPECT_EQ(encode(0.4, -1.0), encode(0.4));
        EXPECT_EQ(encode(0.4, kNan), encode(0.4));
    }
}

TEST_F(Vsm, shapingHasClosedForms)
{
    MomentRule rule{};
    rule.power = 1.0;
    for (int i = 0; i <= 20; ++i) {
        EXPECT_EQ(shapeVisibility(i / 20.0, rule), i / 20.0) << "nothing asked, nothing done";
    }
    rule.linstep = 0.2;
    EXPECT_EQ(shapeVisibility(0.1, rule), 0.0);
    EXPECT_NEAR(shapeVisibility(0.6, rule), 0.5, 1e-15);
    EXPECT_EQ(shapeVisibility(1.0, rule), 1.0);
    rule.power = 3.0;
    EXPECT_NEAR(shapeVisibility(0.6, rule), 0.125, 1e-15);
    EXPECT_NEAR(shapeVisibility(0.6, rule), 0.125, 1e-15) << "in this order";
    EXPECT_EQ(shapeVisibility(1.0, rule), 1.0);
    EXPECT_EQ(shapeVisibility(kNan, rule), 1.0);
    EXPECT_EQ(shapeVisibility(-kInfinity, rule), 0.0);
    rule.power = 0.1;
    EXPECT_EQ(shapeVisibility(0.0, rule), 0.0) << "full shadow stays full";
}

TEST_F(Vsm, lighteningHasClosedForms)
{
    MomentRule rule{};
    for (int i = 0; i <= 20; ++i) {
        EXPECT_EQ(lightenedVisibility(i / 20.0, rule.lighten, rule.lighten_cut), i / 20.0)
            << "nothing asked, nothing done";
    }
    rule.lighten = 0.65;
    rule.lighten_cut = 0.65; // mapped to [b, 1]
    EXPECT_NEAR(lightenedVisibility(0.0, rule.lighten, rule.lighten_cut), 0.65, 1e-15);
    EXPECT_NEAR(lightenedVisibility(0.125, rule.lighten, rule.lighten_cut), 0.125 * 0.35 + 0.65, 1e-15);
    EXPECT_NEAR(lightenedVisibility(1.0, rule.lighten, rule.lighten_cut), 1.0, 1e-15);
    rule.lighten_cut = 0.0; // saturate(P + b), Marinescu 2011
    EXPECT_NEAR(lightenedVisibility(0.0, rule.lighten, rule.lighten_cut), 0.65, 1e-15);
    EXPECT_NEAR(lightenedVisibility(0.125, rule.lighten, rule.lighten_cut), 0.775, 1e-15);
    EXPECT_EQ(lightenedVisibility(0.35001, rule.lighten, rule.lighten_cut), 1.0) << "from 1 - b on all is lit";
    EXPECT_EQ(lightenedVisibility(1.0, rule.lighten, rule.lighten_cut), 1.0);
}

// Rounding to the nearest multiple, or towards zero.
double storeUnorm(double x)
{
    return std::round(std::clamp(x, 0.0, 1.0) * 65535.0) / 65535.0;
}
double storeHalf(double x, bool truncate)
{
    const double ulp = std::ldexp(1.0, std::max(std::ilogb(x == 0.0 ? 1e-9 : x), -14) - 10);
    return (truncate ? std::trunc(x / ulp) : std::nearbyint(x / ulp)) * ulp;
}

// The stated errors: a moment is off by half a step (towards zero: one); after the map's three roundings the variance
// has lost no more than varianceOfRounding(), and gained no more than 4/3 of it.
TEST_F(Vsm, roundingStaysWithinTheLeastVariance)
{
    struct Storage {
        double step;
        int kind;
        int flags;
    };
    const Storage storages[] = {{1.0 / 65535.0, 0, 0},
                                {1.0 / 2048.0, 1, 0},
                                {1.0 / 2048.0, 1, kMomentRemap},
                                {1.0 / 2048.0, 2, 0},
                                {1.0 / 2048.0, 2, kMomentRemap}};
    std::mt19937 rng(4);
    std::uniform_real_distribution<double> u(0.0, 1.0);
    for (const Storage& s : storages) {
        const auto store = [&](double x) {
            return s.kind == 0 ? storeUnorm(x) : storeHalf(x, s.kind == 2);
        };
        input.moments.flags = s.flags;
        const double bound = varianceOfRounding(s.step);
        double most_lost = 0.0;
        for (int round = 0; round < 4000; ++round) {
            const double centre = u(rng);
            const double width = std::pow(10.0, -4.0 * u(rng));
            glm::dvec2 exact(0.0);
            glm::dvec2 rounded(0.0);
            for (int row = 0; row < 4; ++row) {
                glm::dvec2 of_row(0.0);
                for (int i = 0; i < 4; ++i) {
                    const glm::dvec2 m(encode(centre + width * (u(rng) - 0.5)));
                    const glm::dvec2 kept(store(m.x), store(m.y));
                    EXPECT_LE(std::abs(kept.x - m.x), s.step * (s.kind == 2 ? 1.0 : 0.5) + 1e-15);
                    exact += m / 16.0;
                    of_row += kept / 4.0;
                }
                rounded += glm::dvec2(store(of_row.x), store(of_row.y)) / 4.0;
            }
            rounded = {store(rounded.x), store(rounded.y)};
            const double v = exact.y - exact.x * exact.x;
            const double error = rounded.y - rounded.x * rounded.x - v;
            EXPECT_GE(error, -bound);
            EXPECT_LE(error, 4.0 / 3.0 * bound);
            EXPECT_GE(std::max(v + error, bound), 0.5 * v);
            most_lost = std::max(most_lost, -error);
        }
        EXPECT_GT(most_lost, 0.1 * bound) << "the bound is not idle";
    }
}

TEST_F(Vsm, roundingOfWarpsTakesNoMoreThanTheirShare)
{
    const double step = 1.0 / 2048.0;
    std::mt19937 rng(6);
    std::uniform_real_distribution<double> u(0.0, 1.0);
    for (const double c : {1.0, 5.54}) {
        double most_lost = 0.0;
        double most_lost_logs = 0.0;
        for (int round = 0; round < 4000; ++round) {
            const bool truncate = round % 2 == 0;
            const double a = u(rng);
            const double b = a + (1.0 - a) * u(rng) * 0.1;
            const double m1 = 0.5 * (std::exp(c * a) + std::exp(c * b));
            const double m2 = 0.5 * (std::exp(2.0 * c * a) + std::exp(2.0 * c * b));
            const double v = m2 - m1 * m1;
            const double kept1 = storeHalf(m1, truncate);
            const double lost = v - (storeHalf(m2, truncate) - kept1 * kept1);
            most_lost = std::max(most_lost, lost / m2);
            const double log1 = storeHalf(std::log(m1) / c, truncate);
            const double log2 = storeHalf(std::log(m2) / (2.0 * c), truncate);
            const double lost_logs = v - (std::exp(2.0 * c * log2) - std::exp(2.0 * c * log1));
            most_lost_logs = std::max(most_lost_logs, lost_logs / m2);
        }
        EXPECT_LE(most_lost, shareOfWarpRounding(step) / kMomentRoundings);
        EXPECT_GT(most_lost, 0.3 * shareOfWarpRounding(step) / kMomentRoundings);
        EXPECT_LE(most_lost_logs, shareOfLogRounding(step, c) / kMomentRoundings);
        EXPECT_GT(most_lost_logs, 0.3 * shareOfLogRounding(step, c) / kMomentRoundings);
    }
}

TEST_F(Vsm, numbersInTheTablesAreThoseOfTheEnum)
{
    stored = {0.5, 0.3, 0.0, 0.0};
    point.depth = 0.7;
    EXPECT_EQ(applyFilter(GNOMON_FILTER_VSM, point, input),
              filterVsm(point, input, sampleMoments(point, input, input.layer)));
    EXPECT_LT(filterVsm(point, input, sampleMoments(point, input, input.layer)), 1.0);
    EncodeInput e{};
    e.depth = 0.3;
    EXPECT_EQ(encodeDepth(GNOMON_FILTER_VSM, e, input.moments), glm::dvec4(0.3, 0.3 * 0.3, 0.0, 0.0));
}

} // namespace
} // namespace gnomon::shared
