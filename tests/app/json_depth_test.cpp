// SPDX-License-Identifier: Apache-2.0
// Nesting that would overrun the stack, in every kind of document that the program reads as JSON. glTF files are held
// to the same limit by tests/gltf/hostile_test.cpp.
#include "app/keyframes.h"
#include "app/preset.h"
#include "app/settings.h"
#include "scene/json.h"

#include <gnomon/error.h>

#include <gtest/gtest.h>

#include <string>

namespace gnomon::app {
namespace {

std::string arrays(std::size_t depth)
{
    return std::string(depth, '[') + std::string(depth, ']');
}

std::string objects(std::size_t depth)
{
    std::string text;
    for (std::size_t i = 0; i < depth; ++i) {
        text += R"({"a":)";
    }
    return text + "0" + std::string(depth, '}');
}

std::string presetRefusal(const std::string& text)
{
    try {
        Settings settings;
        applyPresetText(settings, "deep.json", text, kRender);
    } catch (const UsageError& error) {
        return error.what();
    }
    return {};
}

std::string pathRefusal(const std::string& text)
{
    try {
        static_cast<void>(parseKeyframes(text, "deep.json"));
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

TEST(JsonDepth, OfPresetsAndResults)
{
    constexpr std::size_t kInside = scene::kMaxJsonDepth; // and one around them
    for (const std::size_t depth : {kInside, std::size_t{10'000}, std::size_t{1'000'000}}) {
        for (const std::string& inner : {arrays(depth), objects(depth)}) {
            for (const std::string& text :
                 {R"({"eye":)" + inner + "}", R"({"settings":)" + inner + "}", R"({"scene":)" + inner + "}"}) {
                const std::string message = presetRefusal(text);
                EXPECT_NE(message.find("nested deeper than 128"), std::string::npos) << message.substr(0, 300);
                EXPECT_LT(message.size(), 2000U);
                EXPECT_EQ(message.find('\n'), std::string::npos);
            }
        }
    }
    EXPECT_EQ(presetRefusal(R"({"eye":)" + arrays(kInside - 1) + "}").find("nested"), std::string::npos);
}

TEST(JsonDepth, OfPaths)
{
    for (const std::size_t depth : {scene::kMaxJsonDepth, std::size_t{10'000}, std::size_t{1'000'000}}) {
        for (const std::string& inner : {arrays(depth), objects(depth)}) {
            const std::string message = pathRefusal(R"({"keys":)" + inner + "}");
            EXPECT_NE(message.find("nested deeper than 128"), std::string::npos) << message.substr(0, 300);
        }
    }
    EXPECT_EQ(pathRefusal(R"({"keys":)" + arrays(scene::kMaxJsonDepth - 1) + "}").find("nested"), std::string::npos);
}

TEST(JsonDepth, ManyKeysTakeTimeInProportion)
{
    std::string text = "{"; // each is looked for among those before it: where that takes a walk, this ends in a timeout
    for (int i = 0; i < 400'000; ++i) {
        text += "\"k" + std::to_string(i) + "\":0,";
    }
    EXPECT_NE(presetRefusal(text + "\"k0\":0}").find("same key twice"), std::string::npos);
}

} // namespace
} // namespace gnomon::app
