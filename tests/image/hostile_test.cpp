// SPDX-License-Identifier: Apache-2.0
// Files that lie. Each must be refused by an Error; under the sanitizers nothing else may be said.
#include "folder.h"

#include "image/image_io.h"

#include <gnomon/error.h>

#include <gtest/gtest.h>

#include <random>
#include <zlib.h>

namespace gnomon {
namespace {

std::string bigEndian(std::uint32_t value)
{
    return {static_cast<char>(value >> 24U), static_cast<char>(value >> 16U), static_cast<char>(value >> 8U),
            static_cast<char>(value)};
}

std::string chunk(const std::string& type, const std::string& data)
{
    const std::string body = type + data;
    const uLong crc = crc32(0, reinterpret_cast<const Bytef*>(body.data()), static_cast<uInt>(body.size()));
    return bigEndian(static_cast<std::uint32_t>(data.size())) + body + bigEndian(static_cast<std::uint32_t>(crc));
}

/// A PNG that says it is so big and has hardly any data.
std::string emptyPng(std::uint32_t width, std::uint32_t height)
{
    return std::string("\x89PNG\r\n\x1a\n", 8) +
           chunk("IHDR", bigEndian(width) + bigEndian(height) + std::string("\x08\x06\x00\x00\x00", 5)) +
           chunk("IDAT", "x") + chunk("IEND", "");
}

std::string whyRefused(const std::filesystem::path& file, std::uint32_t max_side = 16384)
{
    try {
        (void)readImage(file, max_side);
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

std::string goodPng(const test::Folder& folder)
{
    Image8 image(31, 17, 3);
    for (std::size_t i = 0; i < image.values.size(); ++i) {
        image.values[i] = static_cast<std::uint8_t>(i * 31);
    }
    writePng(folder / "good.png", image);
    return test::slurp(folder / "good.png");
}

std::string goodExr(const test::Folder& folder)
{
    ImageF image(31, 17, 3);
    for (std::size_t i = 0; i < image.values.size(); ++i) {
        image.values[i] = static_cast<float>(i);
    }
    writeExr(folder / "good.exr", image);
    return test::slurp(folder / "good.exr");
}

TEST(Hostile, HugeSidesAreRefusedByTheLimitsName)
{
    const test::Folder folder;
    test::spill(folder / "a.png", emptyPng(0x7FFFFFFFU, 0x7FFFFFFFU));
    EXPECT_NE(whyRefused(folder / "a.png").find("limit of 16384"), std::string::npos) << whyRefused(folder / "a.png");
    test::spill(folder / "a.png", emptyPng(300, 10));
    EXPECT_NE(whyRefused(folder / "a.png", 256).find("limit of 256"), std::string::npos);
}

TEST(Hostile, MemoryIsNotTakenForWhatAFileCannotHold)
{
    const test::Folder folder;
    test::spill(folder / "a.png", emptyPng(16384, 16384)); // would be 1 GiB
    EXPECT_NE(whyRefused(folder / "a.png").find("too few bytes"), std::string::npos) << whyRefused(folder / "a.png");
}

TEST(Hostile, ZeroSidesAreRefused)
{
    const test::Folder folder;
    test::spill(folder / "a.png", emptyPng(0, 5));
    EXPECT_FALSE(whyRefused(folder / "a.png").empty());
}

TEST(Hostile, EveryTruncationIsRefused)
{
    const test::Folder folder;
    const std::string png = goodPng(folder);
    const std::string exr = goodExr(folder);
    for (std::size_t length = 0; length < png.size() - 12; length += 5) { // the end chunk itself may be missing
        test::spill(folder / "cut", std::string_view(png).substr(0, length));
        EXPECT_FALSE(whyRefused(folder / "cut").empty()) << length;
    }
    for (std::size_t length = 0; length < exr.size(); length += 7) {
        test::spill(folder / "cut", std::string_view(exr).substr(0, length));
        EXPECT_FALSE(whyRefused(folder / "cut").empty()) << length;
    }
}

TEST(Hostile, FlippedBytesNeverDoMoreThanThrow)
{
    const test::Folder folder;
    std::mt19937 random(1);
    int refused = 0;
    for (const std::string& good : {goodPng(folder), goodExr(folder)}) {
        for (int round = 0; round < 400; ++round) {
            std::string bad = good;
            for (int flips = 0; flips < 3; ++flips) {
                bad[random() % bad.size()] = static_cast<char>(random());
            }
            test::spill(folder / "bad", bad);
            const std::string why = whyRefused(folder / "bad");
            refused += why.empty() ? 0 : 1;
            EXPECT_EQ(why.find('\n'), std::string::npos);
        }
    }
    EXPECT_GT(refused, 400); // most flips must be noticed: PNG has checksums
}

TEST(Hostile, WhatIsNoImageIsSaidToBeNone)
{
    const test::Folder folder;
    test::spill(folder / "a.png", "hello");
    EXPECT_NE(whyRefused(folder / "a.png").find("neither a PNG nor an EXR"), std::string::npos);
    test::spill(folder / "empty.png", "");
    EXPECT_NE(whyRefused(folder / "empty.png").find("empty"), std::string::npos);
    EXPECT_NE(whyRefused(folder / "missing.png").find("No such file"), std::string::npos);
    EXPECT_NE(whyRefused(folder.path()).find("directory"), std::string::npos);
    EXPECT_NE(whyRefused("/dev/zero").find("it is a device; a plain file is needed"), std::string::npos);
}

} // namespace
} // namespace gnomon
