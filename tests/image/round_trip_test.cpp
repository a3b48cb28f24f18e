// SPDX-License-Identifier: Apache-2.0
#include "folder.h"

#include "image/image_io.h"

#include <gnomon/error.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

namespace gnomon {
namespace {

/// Values that differ at every pixel and channel, the extremes among them.
template <typename T>
ImageOf<T> pattern(std::uint32_t width, std::uint32_t height, std::uint32_t channels)
{
    ImageOf<T> image(width, height, channels);
    std::uint32_t value = 0;
    for (T& v : image.values) {
        v = static_cast<T>(value);
        value += 7919;
    }
    image.values.front() = std::numeric_limits<T>::max();
    image.values.back() = 0;
    return image;
}

class RoundTrip : public testing::TestWithParam<std::uint32_t> {};

TEST_P(RoundTrip, Png8KeepsEveryValue)
{
    const test::Folder folder;
    const Image8 written = pattern<std::uint8_t>(37, 11, GetParam());
    writePng(folder / "a.png", written);
    const ImageF read = readImage(folder / "a.png");
    ASSERT_EQ(read.width, 37U);
    ASSERT_EQ(read.height, 11U);
    ASSERT_EQ(read.channels, GetParam());
    for (std::size_t i = 0; i < written.values.size(); ++i) {
        ASSERT_EQ(read.values[i], static_cast<float>(written.values[i]) / 255.0F) << i;
    }
    EXPECT_EQ(folder.names(), std::vector<std::string>{"a.png"});
}

TEST_P(RoundTrip, Png16KeepsEveryValue)
{
    const test::Folder folder;
    const Image16 written = pattern<std::uint16_t>(19, 23, GetParam());
    writePng(folder / "a.png", written);
    const ImageF read = readImage(folder / "a.png");
    ASSERT_EQ(read.channels, GetParam());
    for (std::size_t i = 0; i < written.values.size(); ++i) {
        ASSERT_EQ(read.values[i], static_cast<float>(written.values[i]) / 65535.0F) << i;
    }
}

INSTANTIATE_TEST_SUITE_P(Channels, RoundTrip, testing::Values(1U, 2U, 3U, 4U));

TEST(Exr, FloatKeepsEveryBitNanAndInfinityToo)
{
    for (const std::uint32_t channels : {1U, 3U, 4U}) {
        const test::Folder folder;
        ImageF written(33, 18, channels);
        for (std::size_t i = 0; i < written.values.size(); ++i) {
            written.values[i] = std::sin(static_cast<float>(i)) * 1e6F;
        }
        written.values[1] = std::numeric_limits<float>::infinity();
        written.values[2] = -0.0F;
        written.values[3] = std::numeric_limits<float>::quiet_NaN();
        writeExr(folder / "a.exr", written);
        const ImageF read = readImage(folder / "a.exr");
        ASSERT_EQ(read.width, 33U);
        ASSERT_EQ(read.height, 18U);
        ASSERT_EQ(read.channels, channels);
        EXPECT_EQ(std::memcmp(read.values.data(), written.values.data(), written.values.size() * sizeof(float)), 0);
    }
}

TEST(Exr, HalfKeepsElevenBits)
{
    const test::Folder folder;
    ImageF written(16, 16, 3);
    for (std::size_t i = 0; i < written.values.size(); ++i) {
        written.values[i] = static_cast<float>(i) / 700.0F + 0.01F;
    }
    writeExr(folder / "a.exr", written, true);
    const ImageF read = readImage(folder / "a.exr");
    for (std::size_t i = 0; i < written.values.size(); ++i) {
        EXPECT_NEAR(read.values[i], written.values[i], written.values[i] / 2048.0F);
    }
}

TEST(Png, PicturesAreTaggedSrgbAndMasksLinear)
{
    const test::Folder folder;
    writePng(folder / "picture.png", pattern<std::uint8_t>(4, 4, 3));
    writePng(folder / "mask.png", pattern<std::uint16_t>(4, 4, 1));
    EXPECT_NE(test::slurp(folder / "picture.png").find("sRGB"), std::string::npos);
    EXPECT_EQ(encodePng(pattern<std::uint8_t>(4, 4, 3)), test::slurp(folder / "picture.png"));
    EXPECT_THROW((void)encodePng(Image8(4, 4, 5)), Error);
    const std::string mask = test::slurp(folder / "mask.png");
    EXPECT_EQ(mask.find("sRGB"), std::string::npos);
    const std::size_t gamma = mask.find("gAMA");
    ASSERT_NE(gamma, std::string::npos);
    EXPECT_EQ(mask.substr(gamma + 4, 4), std::string("\x00\x01\x86\xA0", 4)); // 100000: gamma 1
}

} // namespace
} // namespace gnomon
