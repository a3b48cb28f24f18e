// SPDX-License-Identifier: Apache-2.0
// Textures that say they are far larger than their bytes can hold take no memory for it.
#include "gltf/decode.h"
#include "scene/model.h"

#include <gtest/gtest.h>

#include <span>
#include <string>
#include <string_view>

namespace gnomon::scene {
namespace {

using namespace std::string_view_literals;

std::string bigEndian(std::uint32_t value, int bytes)
{
    std::string text;
    for (int shift = 8 * (bytes - 1); shift >= 0; shift -= 8) {
        text += static_cast<char>(value >> shift & 0xFFU);
    }
    return text;
}

/// ISO 3309, as PNG's chunks have it.
std::uint32_t crcOf(std::string_view bytes)
{
    std::uint32_t crc = 0xFFFFFFFFU;
    for (const char byte : bytes) {
        crc ^= static_cast<unsigned char>(byte);
        for (int bit = 0; bit < 8; ++bit) {
            crc = (crc & 1U) != 0 ? crc >> 1U ^ 0xEDB88320U : crc >> 1U;
        }
    }
    return ~crc;
}

std::string pngOf(std::uint32_t side, std::size_t data_bytes)
{
    const auto chunk = [](std::string_view type, std::string_view data) {
        const std::string body = std::string(type) + std::string(data);
        return bigEndian(static_cast<std::uint32_t>(data.size()), 4) + body + bigEndian(crcOf(body), 4);
    };
    return std::string("\x89PNG\r\n\x1a\n"sv) +
           chunk("IHDR", bigEndian(side, 4) + bigEndian(side, 4) + std::string("\x01\0\0\0\0"sv)) +
           chunk("IDAT", std::string(data_bytes, '\0')) + chunk("IEND", "");
}

/// Up to where the first scan's data would begin.
std::string jpegOf(std::uint32_t side, std::size_t data_bytes)
{
    return std::string("\xFF\xD8\xFF\xC0\x00\x0B\x08"sv) + bigEndian(side, 2) + bigEndian(side, 2) +
           std::string("\x01\x01\x11\x00\xFF\xDA\x00\x08\x01\x01\x00\x00\x3F\x00"sv) + std::string(data_bytes, '\0');
}

std::span<const std::byte> bytesOf(const std::string& text)
{
    return std::as_bytes(std::span(text));
}

TEST(TextureSize, IsHeldAgainstTheBytesOfItsFile)
{
    constexpr std::uint32_t kSide = 60000;
    const gltf::SizeCheck any = [](std::uint32_t, std::uint32_t) {
    };
    Image image;
    EXPECT_NE(gltf::decodePng(bytesOf(pngOf(kSide, 100)), any, image).find("too few bytes"), std::string::npos);
    EXPECT_TRUE(image.rgba.empty());
    EXPECT_NE(gltf::decodeJpeg(bytesOf(jpegOf(kSide, 100)), any, image).find("too few bytes"), std::string::npos);
    EXPECT_TRUE(image.rgba.empty());
}

TEST(TextureSize, ThatItsBytesMayHoldIsNotWhatIsWrong)
{
    constexpr std::uint32_t kSide = 64;
    const gltf::SizeCheck any = [](std::uint32_t, std::uint32_t) {
    };
    Image image;
    for (const std::string& wrong : {gltf::decodePng(bytesOf(pngOf(kSide, 100)), any, image),
                                     gltf::decodeJpeg(bytesOf(jpegOf(kSide, 100)), any, image)}) {
        EXPECT_EQ(wrong.find("too few bytes"), std::string::npos) << wrong;
    }
}

} // namespace
} // namespace gnomon::scene
