// SPDX-License-Identifier: Apache-2.0

#include "worlds/worlds.h"

#include <gnomon/error.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace gnomon::worlds {
namespace {

TEST(Load, FindsWorldsByName)
{
    EXPECT_EQ(load("planes", 1).name, "planes");
}

TEST(Load, NamesTheWorldsWhenThereIsNeitherWorldNorFile)
{
    try {
        (void)load("no such thing", 1);
        FAIL() << "no error";
    } catch (const Error& error) {
        const std::string text = error.what();
        EXPECT_NE(text.find("no such thing"), std::string::npos) << text;
        for (const World& world : all()) {
            EXPECT_NE(text.find(world.name), std::string::npos) << text;
        }
    }
}

TEST(Load, RefusesADirectory)
{
    const std::string folder = std::filesystem::temp_directory_path().string();
    try {
        (void)load(folder, 1);
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("directory"), std::string::npos) << error.what();
    }
}

TEST(Load, SaysHowAModelOfAnotherFormatBecomesOne)
{
    const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "gnomon_load_test_model.OBJ";
    std::ofstream(file) << "v 0 0 0\n";
    std::string text;
    try {
        (void)load(file.string(), 1);
    } catch (const Error& error) {
        text = error.what();
    }
    std::filesystem::remove(file);
    EXPECT_NE(text.find("a .OBJ file is no glTF"), std::string::npos) << text;
    EXPECT_NE(text.find(".glb"), std::string::npos) << text;
}

} // namespace
} // namespace gnomon::worlds
