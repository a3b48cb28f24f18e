// SPDX-License-Identifier: Apache-2.0
// The bounds of four moments against random distributions of depth, and what 16 bits leave of them.
#include "cpu_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>

namespace gnomon::shared {
namespace {

// The defaults of the renderer's options (pack/src/filter_rule.cpp).
constexpr double kBias16 = 4e-5;
constexpr double kBias32 = 3e-6;

MomentRule msmRule(int flags, double bias)
{
    MomentRule rule{};
    rule.flags = flags | kMomentRemap;
    rule.sampling = kSamplingBilinear;
    rule.moment_bias = bias;
    rule.power = 1.0;
    return rule;
}

glm::dvec4 encoded(double t, int flags)
{
    return encodeMsm({0.5 * t + 0.5, 0.0, glm::dvec4(0.0), glm::dvec4(0.0)}, msmRule(flags, 0.0));
}

struct Distribution {
    std::vector<double> depths; // -1 .. 1
    std::vector<double> weights;

    [[nodiscard]] double lit(double receiver) const
    {
        double sum = 0.0;
        for (std::size_t i = 0; i < depths.size(); ++i) {
            sum += depths[i] >= receiver ? weights[i] : 0.0;
        }
        return sum;
    }
    [[nodiscard]] glm::dvec4 mean(int flags) const
    {
        glm::dvec4 sum(0.0);
        for (std::size_t i = 0; i < depths.size(); ++i) {
            sum += encoded(depths[i], flags) * weights[i];
        }
        return sum;
    }
};

Distribution randomDistribution(std::mt19937& rng, int points)
{
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    Distribution d;
    double sum = 0.0;
    for (int i = 0; i < points; ++i) {
        d.depths.push_back(2.0 * unit(rng) - 1.0);
        d.weights.push_back(0.02 + unit(rng));
        sum += d.weights.back();
    }
    for (double& w : d.weights) {
        w /= sum;
    }
    return d;
}

double quantised16(double x)
{
    return std::round(std::clamp(x, 0.0, 1.0) * 65535.0) / 65535.0;
}

// Where a root is outside of the interval, distributions inside of it shadow more. The shader takes the smaller bound
// of both; here it is the second one, except for the errors of small pivots in double precision.
void expectEndpointBoundIsTighter(const glm::dvec4& b, double z)
{
    const Hankel h = factorise(b, kLeastLastPivot);
    if (h.d1 > 1e-4 && h.d2 > 1e-4 && !rootsInside(h, z, kernelAbout(h, z))) {
        EXPECT_LE(endpointVisibility(b, z), hamburgerVisibility(h, z, kernelAbout(h, z)) + 1e-9) << z;
    }
}

TEST(Msm, boundsAreAboveTheTruthAndHausdorffIsTighter)
{
    std::mt19937 rng(21);
    std::uniform_real_distribution<double> receiver(-1.0, 1.0);
    double hamburger_sum = 0.0;
    double hausdorff_sum = 0.0;
    double vsm_sum = 0.0;
    for (int round = 0; round < 10000; ++round) {
        const Distribution d = randomDistribution(rng, 4);
        const double t = receiver(rng);
        const glm::dvec4 b = d.mean(0);
        const double hamburger = msmVisibility(b, t, msmRule(0, 0.0));
        const double hausdorff = msmVisibility(b, t, msmRule(kMomentHausdorff, 0.0));
        EXPECT_GE(hausdorff, d.lit(t) - 1e-7);
        // Receivers beside an end are moved in first, from the far one towards the light: compared where they are then.
        const double moved = std::clamp(t, -kNearlyOne, kNearlyOne);
        EXPECT_LE(hausdorff, msmVisibility(b, moved, msmRule(0, 0.0)));
        expectEndpointBoundIsTighter(b, moved);
        EXPECT_LE(hamburger, chebyshevBound(b.x, b.y, t, 0.0) + 1e-9) << "two more moments make it no worse";
        hamburger_sum += hamburger - d.lit(t);
        hausdorff_sum += hausdorff - d.lit(t);
        vsm_sum += chebyshevBound(b.x, b.y, t, 0.0) - d.lit(t);
    }
    std::printf("mean light too much: vsm %.4f, hamburger %.4f, hausdorff %.4f\n", vsm_sum / 1e4, hamburger_sum / 1e4,
                hausdorff_sum / 1e4);
    EXPECT_LT(hausdorff_sum, 0.96 * hamburger_sum);
    EXPECT_LT(hamburger_sum, 0.7 * vsm_sum);
}

TEST(Msm, hausdorffIsMetByADistributionWithTheSameMoments)
{
    // -1, 1, the receiver and one more point: no bound can be below what such a distribution has at the receiver.
    std::mt19937 rng(22);
    std::uniform_real_distribution<double> place(-0.9, 0.9);
    for (int round = 0; round < 2000; ++round) {
        Distribution d = randomDistribution(rng, 4);
        d.depths = {-1.0, 1.0, place(rng), place(rng)};
        if (std::abs(d.depths[2] - d.depths[3]) < 0.05) {
            continue;
        }
        const double t = d.depths[2];
        EXPECT_NEAR(msmVisibility(d.mean(0), t, msmRule(kMomentHausdorff, 0.0)), d.lit(t), 1e-5);
    }
}

// Without bias; least pivots leave 1.4e-5 of light.
TEST(Msm, oneAndTwoDepthsAreExact)
{
    std::mt19937 rng(23);
    std::uniform_real_distribution<double> receiver(-1.0, 1.0);
    for (int round = 0; round < 20000; ++round) {
        const Distribution d = randomDistribution(rng, 1 + round % 2);
        const double t = receiver(rng);
        double margin = 2.0;
        for (const double z : d.depths) {
            margin = std::min(margin, std::abs(z - t));
        }
        if (margin < 0.02 || (round % 2 == 1 && std::abs(d.depths[0] - d.depths[1]) < 0.02)) {
            continue;
        }
        for (const int flags : {0, int(kMomentHausdorff)}) {
            EXPECT_NEAR(msmVisibility(d.mean(0), t, msmRule(flags, 0.0)), d.lit(t), round % 2 == 0 ? 5e-4 : 5e-5);
        }
    }
}

TEST(Msm, neverLighterFartherFromTheLight)
{
    std::mt19937 rng(24);
    for (int round = 0; round < 500; ++round) {
        const Distribution d = randomDistribution(rng, 2 + round % 5);
        for (const int flags : {0, int(kMomentHausdorff)}) {
            double last = 1.0;
            for (double t = -1.0; t <= 1.0; t += 0.01) {
                const double v = msmVisibility(d.mean(0), t, msmRule(flags, 1e-6));
                EXPECT_LE(v, last + 1e-6) << t;
                last = v;
            }
        }
    }
}

TEST(Msm, basisForSixteenBitsFitsAndRoundTrips)
{
    for (double t = -1.0; t <= 1.0; t += 0.001) {
        const glm::dvec4 q = encoded(t, kMomentQuantised);
        for (int c = 0; c < 4; ++c) {
            EXPECT_GE(q[c], -1e-12);
            EXPECT_LE(q[c], 1.0 + 1e-12);
        }
        const glm::dvec4 b = momentsOfQuantised(q);
        EXPECT_NEAR(glm::length(b - encoded(t, 0)), 0.0, 1e-14);
    }
    // An error of half a step in each channel, each way: rows of the inverse, sums of magnitudes.
    const double step = 0.5 / 65535.0;
    const glm::dvec4 limit = step * glm::dvec4(1.0 / 3.0 + std::sqrt(3.0), 1.125, 0.75 + 0.75 * std::sqrt(3.0), 1.125);
    std::mt19937 rng(25);
    glm::dvec4 largest(0.0);
    for (int round = 0; round < 20000; ++round) {
        const Distribution d = randomDistribution(rng, 4);
        glm::dvec4 q = d.mean(kMomentQuantised);
        for (int c = 0; c < 4; ++c) {
            q[c] = quantised16(q[c]);
        }
        const glm::dvec4 error = glm::abs(momentsOfQuantised(q) - d.mean(0));
        largest = glm::max(largest, error);
        for (int c = 0; c < 4; ++c) {
            EXPECT_LE(error[c], limit[c] * (1.0 + 1e-9));
        }
    }
    for (int c = 0; c < 4; ++c) {
        EXPECT_GT(largest[c], 0.9 * limit[c]) << "the limit is no larger than it must be";
    }
}

// A slanted receiver under a Gaussian of 9 x 9 texels, rounded after the first write and each pass of the blur,
// compared at its own depth less the least bias there is: how dark does it get?
double darkestLitPlane(int flags, double bias, bool sixteen_bits, std::mt19937& rng)
{
    std::uniform_real_distribution<double> depth(-0.97, 0.97);
    std::uniform_real_distribution<double> slope(0.0, 0.002);
    const auto stored = [&](glm::dvec4 m) {
        for (int c = 0; c < 4; ++c) {
            m[c] = sixteen_bits ? quantised16(m[c]) : static_cast<double>(static_cast<float>(m[c]));
        }
        return m;
    };
    double darkest = 1.0;
    for (int round = 0; round < 3000; ++round) {
        const double t = depth(rng);
        // Which of the two is drawn first is no compiler's choice. With the other order, the bounds by Hausdorff
        // in 16 bits ask for a bias of 1e-4.
        const double slope_y = slope(rng);
        const glm::dvec2 s(slope(rng), slope_y);
        glm::dvec4 sum(0.0);
        double weights = 0.0;
        for (int i = -4; i <= 4; ++i) {
            weights += std::exp(-0.32 * i * i);
        }
        for (int j = -4; j <= 4; ++j) {
            glm::dvec4 row(0.0);
            for (int i = -4; i <= 4; ++i) {
                row += stored(encoded(t + s.x * i + s.y * j, flags)) * (std::exp(-0.32 * i * i) / weights);
            }
            sum += stored(row) * (std::exp(-0.32 * j * j) / weights);
        }
        const double least_bias = 2.0 * (sixteen_bits ? 1.5 / 65535.0 + 4e-6 : 4e-6) + 0.3 * (s.x + s.y);
        darkest = std::min(darkest, msmVisibility(stored(sum), t - least_bias, msmRule(flags, bias)));
    }
    return darkest;
}

TEST(Msm, defaultBiasKeepsAQuantisedPlaneLit)
{
    for (const int solver : {0, int(kMomentHausdorff)}) {
        for (const bool sixteen_bits : {true, false}) {
            const int flags = solver | (sixteen_bits ? kMomentQuantised : 0);
            for (const double bias : {0.0, 1e-7, 3e-7, 1e-6, 3e-6, 1e-5, 3e-5, 6e-5, 1e-4}) {
                std::mt19937 rng(26);
                std::printf("%s %s bits, bias %.0e: darkest lit plane %.4f\n", solver == 0 ? "hamburger" : "hausdorff",
                            sixteen_bits ? "16" : "32", bias, darkestLitPlane(flags, bias, sixteen_bits, rng));
            }
            std::mt19937 rng(26);
            const double bias = !sixteen_bits ? kBias32 : kBias16;
            EXPECT_GT(darkestLitPlane(flags, bias, sixteen_bits, rng), 254.0 / 255.0);
            // For 32 bits this only tells that there must be some: how much is said by the bounds' own arithmetic,
            // which asks for more than rounding (single_precision_float_test.cpp). A later test has the need of 16
            // bits.
            EXPECT_TRUE(sixteen_bits || darkestLitPlane(flags, 0.0, false, rng) < 0.97);
        }
    }
}

/// The moments in 16 bits, after the first write and both passes of a Gaussian of 9 x 9 texels, of a plane through t
/// with slope s a texel. Everywhere the same share of it lies below an occluder.
glm::dvec4 roundedBelowAnOccluder(double t, glm::dvec2 s, double occluder, double share)
{
    const auto stored = [](glm::dvec4 m) {
        return glm::dvec4(quantised16(m.x), quantised16(m.y), quantised16(m.z), quantised16(m.w));
    };
    double weights = 0.0;
    for (int i = -4; i <= 4; ++i) {
        weights += std::exp(-0.32 * i * i);
    }
    glm::dvec4 sum(0.0);
    for (int j = -4; j <= 4; ++j) {
        glm::dvec4 row(0.0);
        for (int i = -4; i <= 4; ++i) {
            const glm::dvec4 texel =
                glm::mix(encoded(t + s.x * i + s.y * j, kMomentQuantised), encoded(occluder, kMomentQuantised), share);
            row += stored(texel) * (std::exp(-0.32 * i * i) / weights);
        }
        sum += stored(row) * (std::exp(-0.32 * j * j) / weights);
    }
    return stored(sum);
}

// Where a shadow ends softly: with the least pivot of exact moments such a receiver is black now and then, a speck.
TEST(Msm, sixteenBitsLeaveNoSpecksBelowALittleOfAnOccluder)
{
    for (const int solver : {0, int(kMomentHausdorff)}) {
        double darker = 0.0;
        double darker_by_noise = 0.0;
        double darker_by_bias = 0.0; // a quarter of the default
        for (const double most : {0.0, 0.003, 0.02, 0.1}) {
            for (const double steepest : {0.001, 0.01}) {
                std::mt19937 rng(5);
                std::uniform_real_distribution<double> unit(0.0, 1.0);
                for (int round = 0; round < 2000; ++round) {
                    const double t = 1.89 * unit(rng) - 0.9;
                    const double slope_x = steepest * unit(rng);
                    const glm::dvec2 slope(slope_x, steepest * unit(rng));
                    const double share = most * unit(rng);
                    const double above = 0.3 * std::pow(unit(rng), 3.0) + 1e-4;
                    const glm::dvec4 stored = roundedBelowAnOccluder(t, slope, std::max(t - above, -1.0), share);
                    // As filterMsm() moves it: by the plane's own deviation; and by the least bias.
                    const double deviation = std::sqrt(1.25 * 1.25 + 1.0 / 3.0) * glm::length(slope);
                    const double z = t - deviation - 2.0 * (1.5 / 65535.0 + 4e-6);
                    const MomentRule rule = msmRule(solver | kMomentQuantised, kBias16);
                    darker = std::max(darker, 1.0 - share - msmVisibility(stored, z, rule));
                    const MomentRule less = msmRule(rule.flags, kBias16 / 4.0);
                    darker_by_bias = std::max(darker_by_bias, 1.0 - share - msmVisibility(stored, z, less));
                    const glm::dvec4 b = biasedMoments(momentsOfQuantised(stored), rule);
                    const Hankel noisy = factorise(b, kLeastLastPivot);
                    const double by_noise = hamburgerVisibility(noisy, z, kernelAbout(noisy, z));
                    darker_by_noise = std::max(darker_by_noise, 1.0 - share - by_noise);
                }
            }
        }
        std::printf(
            "%s: darker by %.4f; with a quarter of the bias by %.4f, without a least pivot for 16 bits by %.4f\n",
            solver == 0 ? "hamburger" : "hausdorff", darker, darker_by_bias, darker_by_noise);
        EXPECT_LT(darker, 1.0 / 255.0);
        EXPECT_GT(darker_by_bias, 0.02);
        EXPECT_GT(darker_by_noise, 0.1);
    }
}

// The moments of a plane after a Gaussian blur and four samples; an occluder may be over part of the kernel.
glm::dvec4 blurredPlane(double t, glm::dvec2 slope, double sigma, int flags, double occluder = 1.0,
                        double covered = 0.0)
{
    const int radius = static_cast<int>(std::ceil(3.0 * sigma));
    glm::dvec4 sum(0.0);
    double weights = 0.0;
    for (int j = -radius; j <= radius; ++j) {
        for (int i = -radius; i <= radius; ++i) {
            const double weight = std::exp(-0.5 * (i * i + j * j) / (sigma * sigma));
            weights += weight;
            for (int s = 0; s < 4; ++s) {
                const glm::dvec2 at = glm::dvec2(i, j) + (glm::dvec2(s, s ^ 1) - 1.5) * 0.25;
                sum += encoded(t + glm::dot(slope, at), flags) * (0.25 * weight);
            }
        }
    }
    return (1.0 - covered) * sum / weights + covered * encoded(occluder, flags);
}

// As bright as what is parallel to the map, however steep it is, and as dark where all of it is in shadow.
TEST(Msm, slopesAreLitAndDarkAlike)
{
    double darkest_before = 1.0;
    for (const int flags : {0, int(kMomentHausdorff), int(kMomentQuantised), kMomentQuantised | kMomentHausdorff}) {
        for (const double sigma : {0.5, 1.25, 4.0}) {
            for (const double steep : {0.0, 0.001, 0.004, 0.02}) { // d' per texel
                FilterInput f{};
                f.moments = msmRule(flags, (flags & kMomentQuantised) != 0 ? kBias16 : kBias32);
                f.moments.min_variance_texels = sigma;
                f.tile = {0.0, 0.0, 64.0, 64.0};
                MapPoint point{};
                point.texel = {32.0, 32.0};
                point.depth = 0.6;
                point.depth_slope = glm::dvec2(0.8, 0.6) * steep;
                glm::dvec4 map = blurredPlane(0.2, 2.0 * point.depth_slope, sigma, flags);
                test::map_moments = [&](glm::dvec2, double, double) {
                    return map;
                };
                EXPECT_GT(filterMsm(point, f, mapReads(f), sampleMoments(point, f, f.layer)), 0.995)
                    << flags << ' ' << sigma << ' ' << steep;
                darkest_before = std::min(darkest_before, msmVisibility(map, 0.2, f.moments));
                map = blurredPlane(0.2, 2.0 * point.depth_slope, sigma, flags, -0.4, 1.0);
                EXPECT_LT(filterMsm(point, f, mapReads(f), sampleMoments(point, f, f.layer)), 0.005)
                    << flags << ' ' << sigma << ' ' << steep;
                if (steep * sigma <= 0.005) { // half of it below an occluder
                    map = blurredPlane(0.2, 2.0 * point.depth_slope, sigma, flags, -0.4, 0.5);
                    EXPECT_NEAR(filterMsm(point, f, mapReads(f), sampleMoments(point, f, f.layer)), 0.5, 0.02)
                        << flags << ' ' << sigma << ' ' << steep;
                }
            }
        }
    }
    EXPECT_LT(darkest_before, 0.84) << "5/6 at the mean of a Gaussian";
}

// A read of a coarser level, or several along a line, spread a slope by what they are far apart.
TEST(Msm, slopesAreLitAtCoarserLevelsToo)
{
    for (const int sampling : {kSamplingTrilinear, kSamplingTrilinear + 1}) {
        FilterInput f{};
        f.moments = msmRule(0, kBias32);
        f.moments.sampling = sampling;
        f.moments.anisotropy = 8.0;
        f.moments.min_variance_texels = 1.25;
        f.tile = {-1e4, -1e4, 1e4, 1e4};
        f.coarsest = 6.0;
        f.footprint_x = {16.0, 0.0};
        f.footprint_y = {0.0, 4.0};
        MapPoint point{};
        point.depth = 0.6;
        point.depth_slope = {0.008, 0.004};
        test::map_moments = [&](glm::dvec2 texel, double level, double) {
            const double side = std::exp2(level);
            const double sigma = std::sqrt(1.25 * 1.25 + side * side / 12.0);
            return blurredPlane(0.2 + 2.0 * glm::dot(point.depth_slope, texel), 2.0 * point.depth_slope, sigma, 0);
        };
        EXPECT_GT(filterMsm(point, f, mapReads(f), sampleMoments(point, f, f.layer)), 0.995) << sampling;
        const double of_finest = std::sqrt(1.25 * 1.25 + 1.0 / 3.0) * 2.0 * glm::length(point.depth_slope);
        EXPECT_LT(msmVisibility(sampleMoments(point, f, 0.0), 0.2 - of_finest, f.moments), 0.95) << sampling;
    }
}

TEST(Msm, anEmptyMapLightsEverything)
{
    for (const int flags : {0, int(kMomentHausdorff), int(kMomentQuantised), kMomentQuantised | kMomentHausdorff}) {
        const glm::dvec4 far = encoded(1.0, flags);
        for (double t = -1.0; t <= 1.0; t += 0.01) {
            EXPECT_GT(msmVisibility(far, t, msmRule(flags, kBias16)), 0.999) << t;
        }
    }
}

} // namespace
} // namespace gnomon::shared
