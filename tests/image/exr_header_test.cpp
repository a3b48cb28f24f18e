// SPDX-License-Identifier: Apache-2.0
// Headers that make OpenEXR take memory before anything of the image is looked at.
#include "folder.h"

#include "image/image_io.h"

#include <gnomon/error.h>

#include <gtest/gtest.h>

namespace gnomon {
namespace {

std::string little(std::uint32_t value)
{
    return {static_cast<char>(value), static_cast<char>(value >> 8U), static_cast<char>(value >> 16U),
            static_cast<char>(value >> 24U)};
}

std::string attribute(const std::string& name, const std::string& type, const std::string& value)
{
    return name + '\0' + type + '\0' + little(static_cast<std::uint32_t>(value.size())) + value;
}

struct ExrParts {
    std::uint32_t version = 2;
    std::string first; // further attributes
    std::uint32_t right = 3;
    std::uint32_t bottom = 3;
    std::string channels = std::string("Y\0", 2) + little(2) + std::string(4, '\0') + little(1) + little(1);
};

std::string exrOf(const ExrParts& parts)
{
    return "\x76\x2f\x31\x01" + little(parts.version) + parts.first +
           attribute("channels", "chlist", parts.channels + '\0') + attribute("compression", "compression", "\x03") +
           attribute("dataWindow", "box2i", little(0) + little(0) + little(parts.right) + little(parts.bottom)) +
           attribute("displayWindow", "box2i", little(0) + little(0) + little(3) + little(3)) +
           attribute("lineOrder", "lineOrder", std::string(1, '\0')) +
           attribute("pixelAspectRatio", "float", little(0x3F800000)) +
           attribute("screenWindowCenter", "v2f", little(0) + little(0)) +
           attribute("screenWindowWidth", "float", little(0x3F800000)) + std::string(1, '\0') + std::string(200, '\0');
}

std::string refusalOf(const ExrParts& parts)
{
    const test::Folder folder;
    test::spill(folder / "a.exr", exrOf(parts));
    try {
        static_cast<void>(readImage(folder / "a.exr"));
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

void expectRefusal(const ExrParts& parts, const std::string& why)
{
    const std::string message = refusalOf(parts);
    EXPECT_NE(message.find(why), std::string::npos) << message;
}

TEST(ExrHeader, AttributesEndWithTheFile)
{
    const std::string said = std::string("note\0string\0", 12) + little(0x7FFFFF00);
    expectRefusal({.first = said + "x"}, "beyond the file");
    expectRefusal({.first = attribute("note", "no such type", "") + said}, "beyond the file");
    // OpenEXR goes by the type and would read on in the middle of what follows.
    expectRefusal({.first = attribute("corner", "box2i", "abcd")}, "wrong size");
    expectRefusal({.first = attribute("others", "chlist", std::string(18, '\0'))}, "wrong size");
    expectRefusal({.first = attribute("preview", "preview", little(0xFFFF) + little(0xFFFF))}, "wrong size");
    expectRefusal({.first = attribute("names", "stringvector", little(0x7FFFFFFF))}, "beyond the file");
    expectRefusal({.first = attribute("ids", "idmanifest", std::string(19, '\0'))}, "ID manifest");
}

TEST(ExrHeader, SidesAreCheckedBeforeTheTableOfLinesIsMade)
{
    expectRefusal({.right = 0x7FFFFFF0, .bottom = 3}, "limit of 16384");
    expectRefusal({.right = 3, .bottom = 0x7FFFFFF0}, "limit of 16384");
    expectRefusal({.right = 3, .bottom = 0xFFFFFFF0}, "limit of 16384");
}

TEST(ExrHeader, WhatIsUnpackedIsInProportionToTheFile)
{
    expectRefusal({.right = 16383, .bottom = 16383}, "too few bytes");
    ExrParts wide{.right = 16383, .bottom = 0};
    for (char c = 'a'; c <= 'z'; ++c) { // many channels, each of which a block of lines has
        wide.channels += std::string(1, c) + '\0' + little(2) + std::string(4, '\0') + little(1) + little(1);
    }
    expectRefusal(wide, "too few bytes");
    const std::string tiles = little(16384) + little(16384) + std::string(1, '\0');
    expectRefusal({.version = 0x202, .first = attribute("tiles", "tiledesc", tiles)}, "too few bytes");
    const std::string huge = little(0x7FFFFFFF) + little(0x7FFFFFFF) + std::string(1, '\0');
    expectRefusal({.version = 0x202, .first = attribute("tiles", "tiledesc", huge)}, "limit of 16384");
    expectRefusal({.first = attribute("chunkCount", "int", little(0x7FFFFFFF))}, "fewer chunks");
    expectRefusal({.version = 0x802}, "deep");
}

} // namespace
} // namespace gnomon
