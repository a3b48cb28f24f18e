// SPDX-License-Identifier: Apache-2.0
#include "lab/metrics/error.h"

#include "masks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::lab {
namespace {

using test::constantMask;
using test::countSome;
using test::noiseMask;

constexpr double kC1 = 0.0001;
constexpr double kC2 = 0.0009;

/// Equation 13 written out, with all 121 weights and moments about the means: the other way to the same number.
double directSsim(const ImageF& test, const ImageF& truth, const Counted& counted, int x, int y)
{
    const auto eachPixel = [&](auto&& visit) {
        for (int v = std::max(y - 5, 0); v <= std::min(y + 5, static_cast<int>(test.height) - 1); ++v) {
            for (int u = std::max(x - 5, 0); u <= std::min(x + 5, static_cast<int>(test.width) - 1); ++u) {
                const double b = *truth.pixel(u, v);
                const double a = *counted.pixel(u, v) != 0 ? *test.pixel(u, v) : b;
                visit(std::exp(-((u - x) * (u - x) + (v - y) * (v - y)) / 4.5), a, b);
            }
        }
    };
    double weights = 0.0;
    double mean_a = 0.0;
    double mean_b = 0.0;
    eachPixel([&](double weight, double a, double b) {
        weights += weight;
        mean_a += weight * a;
        mean_b += weight * b;
    });
    mean_a /= weights;
    mean_b /= weights;
    double variance_a = 0.0;
    double variance_b = 0.0;
    double covariance = 0.0;
    eachPixel([&](double weight, double a, double b) {
        variance_a += weight / weights * (a - mean_a) * (a - mean_a);
        variance_b += weight / weights * (b - mean_b) * (b - mean_b);
        covariance += weight / weights * (a - mean_a) * (b - mean_b);
    });
    const double luminance = (2.0 * mean_a * mean_b + kC1) / (mean_a * mean_a + mean_b * mean_b + kC1);
    return luminance * (2.0 * covariance + kC2) / (variance_a + variance_b + kC2);
}

double directMeanSsim(const ImageF& test, const ImageF& truth, const Counted& counted)
{
    double sum = 0.0;
    int count = 0;
    for (int y = 0; y < static_cast<int>(test.height); ++y) {
        for (int x = 0; x < static_cast<int>(test.width); ++x) {
            if (*counted.pixel(x, y) != 0) {
                sum += directSsim(test, truth, counted, x, y);
                ++count;
            }
        }
    }
    return sum / count;
}

TEST(Ssim, MeetsTheEquationWrittenOut)
{
    struct Size {
        std::uint32_t width;
        std::uint32_t height;
    };
    // Wider and lower than the window, and the reverse, so that an axis taken for the other shows.
    for (const Size& s : {Size{33, 27}, Size{40, 3}, Size{3, 40}, Size{6, 9}}) {
        const ImageF truth = noiseMask(s.width, s.height, 4);
        ImageF test = noiseMask(s.width, s.height, 5);
        for (std::size_t i = 0; i < test.values.size(); ++i) {
            test.values[i] = 0.6F * truth.values[i] + 0.4F * test.values[i]; // like the truth, but not much
        }
        const Counted all = countAll(s.width, s.height);
        const double value = ssim(test, truth, all).value();
        EXPECT_NEAR(value, directMeanSsim(test, truth, all), 1e-12) << s.width << "x" << s.height;
        EXPECT_GT(value, 0.2);
        EXPECT_LT(value, 0.95);
        const Counted some = countSome(s.width, s.height, 0.4, 6);
        EXPECT_NEAR(ssim(test, truth, some).value(), directMeanSsim(test, truth, some), 1e-12);
    }
}

TEST(Ssim, PixelsThatDoNotCountHoldTheTruth)
{
    const ImageF truth = noiseMask(30, 30, 13);
    ImageF test = truth;
    Counted counted = countAll(30, 30);
    for (std::uint32_t y = 0; y < 30; ++y) {
        for (std::uint32_t x = 12; x < 17; ++x) {
            *counted.pixel(x, y) = 0;
            *test.pixel(x, y) = (x + y) % 2 == 0 ? std::numeric_limits<float>::quiet_NaN() : 1.0F;
        }
    }
    EXPECT_NEAR(ssim(test, truth, counted).value(), 1.0, 1e-12);
    // And errors at counted pixels are not thinned by those that do not count.
    EXPECT_LT(ssim(noiseMask(30, 30, 14), truth, counted).value(), 0.7);
}

TEST(Ssim, NothingWhenNoPixelCounts)
{
    const ImageF mask = constantMask(12, 12, 0.5F);
    EXPECT_FALSE(ssim(mask, mask, Counted(12, 12, 1)));
    EXPECT_FALSE(ssim(ImageF(0, 0, 1), ImageF(0, 0, 1), countAll(0, 0)));
}

TEST(Ssim, NanIsNeverHidden)
{
    ImageF test = constantMask(40, 40, 0.5F);
    *test.pixel(20, 20) = std::numeric_limits<float>::quiet_NaN();
    EXPECT_TRUE(std::isnan(ssim(test, constantMask(40, 40, 0.5F), countAll(40, 40)).value()));
}

} // namespace
} // namespace gnomon::lab
