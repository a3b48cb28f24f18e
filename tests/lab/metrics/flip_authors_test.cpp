// SPDX-License-Identifier: Apache-2.0
// FLIP against its authors' own implementation (github.com/NVlabs/flip), in two ways.
//
// Their published example is 0.159691, the mean of LDR-FLIP between images/reference.png and images/test.png of their
// repository at 0.7 x 3840 / 0.7 x pi / 180 pixels per degree; they compare means up to six decimals, and their Python
// of version 1.2 gave 0.159693. The two pictures are not part of this project: FlipExample runs where somebody has put
// them, and says so where not.
//
// FlipAuthors needs no file. Its pictures are made by formula (flip_images.h), and what is expected of them was given
// by the authors' C++ for CPUs of version 1.5 (FLIP.h, commit c9d0dd1), fed with the same linear light:
// - `mean` and `pixels` by that code with its floats replaced by doubles, which is the method without rounding. Its
// two-
//   dimensional filters of version 1.1 (image.h, commit 0436d0b), treated alike, give the same to 1e-8.
// - `published_mean` by that code as published, in single precision. Where a picture is flat, the rounding of its
//   feature filters passes through a square root, so that it strays by up to 4e-5 from the mean without rounding, and
//   the two versions by up to 6e-6 from each other.
#include "flip_images.h"
#include "image/image_io.h"
#include "lab/metrics/flip.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

namespace gnomon::lab {
namespace {

namespace fs = std::filesystem;

constexpr double kPublishedExample = 0.159691;
constexpr double kMeanTolerance = 1e-6;        // six decimals, as the authors compare means
constexpr double kPublishedTolerance = 2e-6;   // between the authors' own implementations of the example
constexpr double kPixelTolerance = 2e-6;       // of the pixels' difference
constexpr double kSinglePrecisionNoise = 4e-5; // of the published code on flat pictures

struct Pixel {
    std::uint32_t x;
    std::uint32_t y;
    double difference;
};

struct Case {
    const char* name;
    flip_images::Pair (*make)();
    double pixels_per_degree;
    double mean;
    double published_mean;
    std::vector<Pixel> pixels;
};

const std::vector<Case>& cases()
{
    using namespace flip_images;
    static const std::vector<Case> all{
        {"RampWithStep",
         rampWithStep,
         67,
         0.2096827,
         0.2097108,
         {{0, 0, 0}, {114, 0, 0.3677889}, {76, 0, 0.4257096}, {65, 0, 0.6008608}}},
        {"ColouredTiles",
         colouredTiles,
         67,
         0.4977508,
         0.4977509,
         {{92, 16, 0.2168349}, {16, 49, 0.6859888}, {31, 44, 0.9730913}, {93, 71, 0.9873278}}},
        {"SaturatedTiles",
         saturatedTiles,
         67,
         0.8564501,
         0.8564501,
         {{9, 41, 0.9712785}, {55, 56, 0.9817784}, {27, 58, 0.9930483}, {21, 52, 0.9995598}}},
        {"ColouredNoise",
         colouredNoise,
         67,
         0.3847267,
         0.3847267,
         {{35, 67, 0.3249611}, {78, 49, 0.4064241}, {76, 67, 0.5610044}, {100, 0, 0.9472571}}},
        {"LinesAndDots",
         linesAndDots,
         67,
         0.0348038,
         0.0348043,
         {{0, 0, 0}, {47, 24, 0.0000086}, {78, 16, 0.1321093}, {20, 30, 0.5381318}}},
        {"ShadowOfDisc",
         shadowOfDisc,
         67,
         0.1225604,
         0.1225624,
         {{0, 0, 0}, {42, 89, 0}, {92, 48, 0.5746075}, {38, 30, 0.9805820}}},
        {"Tiny",
         tiny,
         67,
         0.6084103,
         0.6084104,
         {{2, 1, 0.5360627}, {0, 3, 0.5890247}, {0, 2, 0.7525693}, {0, 0, 0.9233163}}},
        {"ColouredTilesFromNear",
         colouredTiles,
         20,
         0.4399911,
         0.4399963,
         {{45, 80, 0.0036293}, {113, 67, 0.6757094}, {115, 35, 0.9733084}, {16, 35, 0.9894610}}},
        {"ShadowOfDiscFromNear",
         shadowOfDisc,
         20,
         0.1224385,
         0.1224386,
         {{0, 0, 0}, {42, 75, 0.6214584}, {36, 28, 0.9907908}}},
        {"ColouredTilesFromFar",
         colouredTiles,
         110,
         0.5270190,
         0.5270191,
         {{12, 4, 0.3149665}, {127, 47, 0.6705175}, {26, 77, 0.9719635}, {19, 40, 0.9857041}}},
        {"ShadowOfDiscFromFar",
         shadowOfDisc,
         110,
         0.1124134,
         0.1124164,
         {{95, 89, 0}, {52, 64, 0.0002942}, {85, 49, 0.4776326}, {52, 24, 0.9714341}}},
    };
    return all;
}

double meanOf(const ImageF& map)
{
    return std::accumulate(map.values.begin(), map.values.end(), 0.0) / static_cast<double>(map.values.size());
}

class FlipAuthors : public testing::TestWithParam<Case> {};

TEST_P(FlipAuthors, GivesTheirNumbers)
{
    const Case& expected = GetParam();
    const flip_images::Pair pair = expected.make();
    const ImageF map = flipMap(pair.test, pair.reference, expected.pixels_per_degree);
    EXPECT_NEAR(meanOf(map), expected.mean, kMeanTolerance);
    EXPECT_NEAR(meanOf(map), expected.published_mean, kSinglePrecisionNoise);
    for (const Pixel& pixel : expected.pixels) {
        EXPECT_NEAR(*map.pixel(pixel.x, pixel.y), pixel.difference, kPixelTolerance) << pixel.x << ", " << pixel.y;
    }
}

INSTANTIATE_TEST_SUITE_P(Pictures, FlipAuthors, testing::ValuesIn(cases()),
                         [](const auto& made) { return std::string(made.param.name); });

/// A colour picture in linear light.
ImageF readLinear(const fs::path& file)
{
    const ImageF encoded = readImage(file);
    ImageF linear(encoded.width, encoded.height, 3);
    for (std::uint32_t y = 0; y < encoded.height; ++y) {
        for (std::uint32_t x = 0; x < encoded.width; ++x) {
            for (std::uint32_t channel = 0; channel < 3; ++channel) {
                const double value = encoded.pixel(x, y)[encoded.channels >= 3 ? channel : 0];
                linear.pixel(x, y)[channel] =
                    static_cast<float>(value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4));
            }
        }
    }
    return linear;
}

TEST(FlipExample, GivesThePublishedMean)
{
    const char* shared = std::getenv("GNOMON_SHARED");
    const fs::path folder = fs::path(shared != nullptr ? shared : "") / "flip";
    if (!fs::exists(folder / "reference.png") || !fs::exists(folder / "test.png")) {
        GTEST_SKIP()
            << "NO EXAMPLE: set GNOMON_SHARED to the folder that has flip/reference.png and flip/test.png, the "
               "pictures of the authors' repository";
    }
    const ImageF reference = readLinear(folder / "reference.png");
    const ImageF test = readLinear(folder / "test.png");
    ASSERT_EQ(test.width, reference.width);
    ASSERT_EQ(test.height, reference.height);
    const double pixels_per_degree = 0.7 * (3840.0 / 0.7) * std::numbers::pi / 180.0;
    EXPECT_NEAR(meanOf(flipMap(test, reference, pixels_per_degree)), kPublishedExample, kPublishedTolerance);
}

} // namespace
} // namespace gnomon::lab
