// SPDX-License-Identifier: Apache-2.0
#include "wrong_usage.h"

#include "folder.h"
#include "lights_and_cameras.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace gnomon::test {

void PrintTo(const Wrong& wrong, std::ostream* out)
{
    for (const std::string& argument : wrong.arguments) {
        *out << argument << ' ';
    }
}

void expectOneLine(const Ran& ran, int status, const std::string& says)
{
    EXPECT_EQ(ran.status, status) << ran.err;
    EXPECT_EQ(ran.out, "");
    const auto lines = ran.errorLines();
    ASSERT_EQ(lines.size(), 1U) << ran.err;
    EXPECT_TRUE(lines[0].starts_with("gnomon: ")) << lines[0];
    EXPECT_NE(lines[0].find(says), std::string::npos) << lines[0];
}

void expectOneLineAndNothingLeft(const Wrong& wrong, bool in_process)
{
    const Folder folder;
    std::filesystem::create_directory(folder / "a_folder");
    spill(folder / "broken.gltf", "{ not json");
    spill(folder / "broken.json", "[1, 2");
    spill(folder / "wrong.json", R"({"filtre": "hard"})");
    spill(folder / "strict.json", R"({"strict": true})");
    spill(folder / "contradiction.json", R"({"filter": "hard", "technique": "pcf"})");
    spill(folder / "lights.gltf", kLightsAndCameras);
    const std::size_t before = folder.names().size();
    expectOneLine(gnomon(wrong.arguments, {.folder = folder.path(), .in_process = in_process}), wrong.status,
                  wrong.says);
    EXPECT_EQ(folder.names().size(), before);
}

} // namespace gnomon::test
