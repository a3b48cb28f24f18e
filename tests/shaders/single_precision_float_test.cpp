// SPDX-License-Identifier: Apache-2.0
// Compiled alone: in single precision, which its headers get from float_map.h.
// How much the GPU's precision changes of a visibility: the filters' own arithmetic in single and in double precision,
// on the same texels.
#include "float_map.h"
#include "single_values.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <vector>

#include "single_precision.h"

namespace gnomon::test {
namespace {

constexpr int kDraws = 40000;
constexpr int kRemap = shared::kMomentRemap;
constexpr int kHausdorff = shared::kMomentHausdorff;
constexpr double kStep = 1.0 / 255.0;
constexpr double kDefaultBias = 3e-6; // of 32 bits (vulkan/src/moment_rule_of.cpp)

/// Every other one is a surface that bends within a fiftieth of the range; the others lie anywhere.
DepthDraw randomDraw(std::mt19937& rng, int round)
{
    const auto uniform = [&](double a, double b) {
        return std::uniform_real_distribution<double>(a, b)(rng);
    };
    const bool narrow = round % 2 == 0;
    const double middle = uniform(0.05, 0.95);
    const auto depth = [&] {
        return static_cast<float>(narrow ? middle + uniform(-0.02, 0.02) : uniform(0.0, 1.0));
    };
    DepthDraw draw;
    draw.points = 1 + round / 2 % 4;
    double sum = 0.0;
    double weights[4]{};
    for (int i = 0; i < draw.points; ++i) {
        draw.depths[i] = depth();
        sum += weights[i] = 0.02 + uniform(0.0, 1.0);
    }
    for (int i = 0; i < draw.points; ++i) {
        draw.weights[i] = static_cast<float>(weights[i] / sum);
    }
    draw.receiver = depth();
    draw.texel_depth = static_cast<float>(uniform(0.0, 1e-3));
    return draw;
}

double visibilityInSingle(const glm::vec4& stored, const DepthDraw& draw, const SingleOptions& options)
{
    float_texel = [&] {
        return stored;
    };
    float_layers = [](int i) {
        return i == 0   ? glm::vec4(0.0F, 0.6F, 0.0F, 0.0F)
               : i == 1 ? glm::vec4(0.4F, 1.0F, 0.5F, 0.0F)
                        : glm::vec4(0.0F, 1.0F, 2.0F, 0.0F);
    };
    const auto v = static_cast<double>(shared::single::visibilityOf(draw, options));
    float_texel = nullptr;
    float_layers = nullptr;
    return v;
}

struct Difference {
    double most = 0.0;
    double mostly = 0.0; // in 99.9 % of draws
};
Difference differenceOf(const SingleOptions& options)
{
    std::mt19937 rng(31);
    std::vector<double> all;
    for (int round = 0; round < kDraws; ++round) {
        const DepthDraw draw = randomDraw(rng, round);
        const glm::vec4 stored = storedInDouble(draw, options);
        all.push_back(std::abs(visibilityInSingle(stored, draw, options) - visibilityInDouble(stored, draw, options)));
    }
    std::sort(all.begin(), all.end());
    return {all.back(), all[all.size() * 999 / 1000]};
}

struct Case {
    const char* name;
    SingleOptions options;
    double most;
    double mostly;
};

TEST(SinglePrecision, changesLittleOfAnyFilter)
{
    constexpr int kFour = shared::kMomentFourChannels;
    constexpr int kLog = shared::kMomentLogSpace;
    constexpr double kVariance = 1.27e-6; // automatic, for 32 bits
    constexpr double kOfPowers = 1.54e-6; // and evsm's shares of what it stores
    constexpr double kOfLogs = 1.69e-6;   // times the exponent
    // Measured, and half as much again. Where moments are subtracted, digits go: two roundings of 2^-24 in a variance
    // of no less than 1.3e-6 change v / (v + d^2), whose slope in log v is 1/4 at most, by up to 2.3 %.
    const Case cases[] = {
        {"vsm", {GNOMON_FILTER_VSM, 0, 0.0, 0.0, kVariance}, 0.0045, 0.0008},
        {"vsm, remapped", {GNOMON_FILTER_VSM, kRemap, 0.0, 0.0, kVariance / 4.0}, 0.002, 0.0003},
        {"lvsm", {GNOMON_FILTER_LVSM, 0, 0.0, 0.0, kVariance}, 0.0026, 0.0004},
        {"esm", {GNOMON_FILTER_ESM, 0, 80.0, 0.0, 0.0}, 2e-5, 1e-5},
        {"esm, logarithms", {GNOMON_FILTER_ESM, kLog, 300.0, 0.0, 0.0}, 2e-5, 1e-5},
        {"evsm of two", {GNOMON_FILTER_EVSM, 0, 40.0, 0.0, 0.0, kOfPowers}, 3e-4, 2e-5},
        {"evsm of four", {GNOMON_FILTER_EVSM, kFour, 40.0, 0.0, 0.0, kOfPowers, kOfPowers}, 0.002, 2e-4},
        {"evsm of four, logarithms",
         {GNOMON_FILTER_EVSM, kFour | kLog, 40.0, 0.0, 0.0, 40.0 * kOfLogs, 5.0 * kOfLogs},
         8e-4,
         5e-5},
        {"msm, hamburger", {GNOMON_FILTER_MSM, kRemap, 0.0, kDefaultBias, 0.0}, 0.04, kStep},
        {"msm, hausdorff", {GNOMON_FILTER_MSM, kRemap | kHausdorff, 0.0, kDefaultBias, 0.0}, 0.04, kStep},
    };
    for (const Case& c : cases) {
        const Difference off = differenceOf(c.options);
        std::printf("%-26s single precision differs by %.5f at most, %.5f in 99.9 %%\n", c.name, off.most, off.mostly);
        EXPECT_LE(off.most, c.most) << c.name;
        EXPECT_LE(off.mostly, c.mostly) << c.name;
    }
}

// On exact numbers it never is (msm_test.cpp).
double hausdorffAboveHamburger(double bias)
{
    std::mt19937 rng(32);
    double most = 0.0;
    for (int round = 0; round < kDraws; ++round) {
        const DepthDraw draw = randomDraw(rng, round);
        const SingleOptions line{GNOMON_FILTER_MSM, kRemap, 0.0, bias, 0.0};
        const SingleOptions interval{GNOMON_FILTER_MSM, kRemap | kHausdorff, 0.0, bias, 0.0};
        const glm::vec4 stored = storedInDouble(draw, line);
        most = std::max(most, visibilityInSingle(stored, draw, interval) - visibilityInSingle(stored, draw, line));
    }
    return most;
}

TEST(SinglePrecision, isWhatTheDefaultBiasOfFourMomentsIsFor)
{
    for (const double bias : {3e-7, 1e-6, 3e-6, 1e-5}) {
        const Difference line = differenceOf({GNOMON_FILTER_MSM, kRemap, 0.0, bias, 0.0});
        const Difference interval = differenceOf({GNOMON_FILTER_MSM, kRemap | kHausdorff, 0.0, bias, 0.0});
        const double above = hausdorffAboveHamburger(bias);
        std::printf("bias %.0e: hamburger off by %.4f, in 99.9 %% by %.4f; hausdorff %.4f, %.4f, above it by %.4f\n",
                    bias, line.most, line.mostly, interval.most, interval.mostly, above);
        if (bias < kDefaultBias) {
            EXPECT_GT(line.mostly, kStep) << "less is too little";
            EXPECT_GT(above, kStep);
        } else {
            EXPECT_LE(std::max(line.mostly, interval.mostly), kStep);
            EXPECT_LE(above, 1e-4) << "the tighter bound is the tighter one";
        }
    }
}

} // namespace
} // namespace gnomon::test
