// SPDX-License-Identifier: Apache-2.0
// Names of files as users have them: of any bytes, length and case; and what is no plain file.
#include "folder.h"
#include "lights_and_cameras.h"
#include "process.h"

#include "image/image_io.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <sys/stat.h>

namespace gnomon {
namespace {

constexpr const char* kNotUtf8 = "caf\xE9\x01.gltf";

class Names : public testing::Test {
protected:
    Names() { test::spill(folder / "lights.gltf", test::kLightsAndCameras); }
    [[nodiscard]] test::Ran run(const std::vector<std::string>& arguments) const
    {
        return test::gnomon(arguments, {.folder = folder.path()});
    }
    /// Its line.
    [[nodiscard]] std::string refused(const std::vector<std::string>& arguments, int status) const
    {
        const test::Ran ran = run(arguments);
        EXPECT_EQ(ran.status, status) << ran.err;
        const auto lines = ran.errorLines();
        EXPECT_EQ(lines.size(), 1U) << ran.err;
        EXPECT_TRUE(!lines.empty() && lines[0].starts_with("gnomon: "));
        EXPECT_EQ(ran.err.find("filesystem error"), std::string::npos) << ran.err;
        EXPECT_EQ(ran.err.find("json.exception"), std::string::npos) << ran.err;
        return lines.empty() ? "" : lines[0];
    }

    test::Folder folder;
};

TEST_F(Names, ThatAreNoUtf8AreReplacedInJsonAndPages)
{
    test::spill(folder / kNotUtf8, test::kLightsAndCameras);
    const test::Ran plan = run({"plan", kNotUtf8, "--json", "--draw", "a.svg"});
    ASSERT_EQ(plan.status, 0) << plan.err;
    EXPECT_NE(nlohmann::json::parse(plan.out)["scene"].get<std::string>().find("\xEF\xBF\xBD"), std::string::npos);
    EXPECT_EQ(test::slurp(folder / "a.svg").find('\xE9'), std::string::npos);
    const test::Ran compare =
        run({"compare", kNotUtf8, "--sun", "1,-1,0", "--size", "8x8", "--map-size", "16", "--truth", "hard",
             "--no-cache", "--repetitions", "1", "--warmup", "0", "--techniques", "hard", "--report", "report"});
    ASSERT_EQ(compare.status, 0) << compare.err;
    for (const char* file : {"report/index.html", "report/result.json"}) {
        EXPECT_EQ(test::slurp(folder / file).find('\xE9'), std::string::npos) << file;
    }
    writePng(folder / "caf\xE9.png", Image8(2, 2, 1));
    EXPECT_TRUE(nlohmann::json::accept(run({"metrics", "caf\xE9.png", "caf\xE9.png", "--json"}).out));
}

TEST_F(Names, ThatAreTooLongAreRefusedBeforeTheWork)
{
    const std::string name(300, 'n');
    EXPECT_NE(refused({"render", "planes", "-o", name + ".png"}, 1).find("too long"), std::string::npos);
    EXPECT_NE(refused({"render", "planes", "--frames", "0-1", "-o", name}, 1).find("too long"), std::string::npos);
    EXPECT_NE(refused({"compare", "planes", "--report", name}, 1).find("too long"), std::string::npos);
    EXPECT_NE(refused({"bench", "planes", "--json=" + name}, 1).find("too long"), std::string::npos);
    (void)refused({"plan", name + ".gltf"}, 1);
    (void)refused({"plan", "--preset", name}, 2);
    (void)refused({"plan", "planes", "--frames", "0-1", "--path", name + ".json"}, 2);
    EXPECT_EQ(folder.names().size(), 1U);
}

TEST_F(Names, AreOfAnyCase)
{
    std::filesystem::copy(folder / "lights.gltf", folder / "L.GLTF");
    EXPECT_EQ(run({"plan", "--json", "L.GLTF"}).status, 0);
    EXPECT_EQ(run({"plan", "planes", "--json", "P.JSON", "--draw", "P.SVG"}).status, 0);
    const std::vector<std::string> mask{"render", "planes", "--size", "8x8", "--truth", "hard", "--mask", "--no-cache"};
    for (const char* name : {"a.PNG", "a.Exr"}) {
        std::vector<std::string> arguments = mask;
        arguments.insert(arguments.end(), {"-o", name});
        EXPECT_EQ(run(arguments).status, 0);
        EXPECT_EQ(readImage(folder / name).width, 8U);
        EXPECT_EQ(run({"metrics", "--json", name, name}).status, 0);
    }
    EXPECT_TRUE(test::slurp(folder / "a.Exr").starts_with("\x76\x2f\x31\x01"));
}

TEST_F(Names, AfterTwoDashesAreNoOptions)
{
    test::spill(folder / "--x.gltf", test::kLightsAndCameras);
    EXPECT_EQ(run({"plan", "--", "planes"}).status, 0);
    EXPECT_EQ(run({"plan", "--size", "8x8", "--json", "--", "--x.gltf"}).status, 0);
    EXPECT_EQ(run({"list", "--"}).status, 0);
    EXPECT_NE(refused({"plan", "planes", "--", "rts"}, 2).find("one argument too many"), std::string::npos);
    EXPECT_NE(refused({"list", "--", "--json"}, 2).find("nothing called \"--json\""), std::string::npos);
    EXPECT_NE(refused({"man", "--", "rts"}, 2).find("takes no argument"), std::string::npos);
    EXPECT_NE(refused({"metrics", "--", "--json", "-o"}, 1).find("--json"), std::string::npos);
}

TEST_F(Names, OfGlbFilesWithAnotherStartAreNoJson)
{
    test::spill(folder / "a.glb", std::string("glTG\2\0\0\0", 8));
    test::spill(folder / "B.GLB", "x");
    EXPECT_NE(refused({"plan", "a.glb"}, 1).find("a GLB container begins with \"glTF\""), std::string::npos);
    EXPECT_NE(refused({"plan", "B.GLB"}, 1).find("a GLB container begins with \"glTF\""), std::string::npos);
    std::filesystem::copy(folder / "lights.gltf", folder / "json.glb");
    EXPECT_EQ(run({"plan", "json.glb"}).status, 0);
}

/// A pipe without a writer: each of these ends at once, or the test does not.
TEST_F(Names, OfPipesAndDevicesAreRefusedAtOnce)
{
    ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
    const std::string pipe = "it is a pipe; a plain file is needed";
    EXPECT_NE(refused({"plan", "pipe"}, 1).find(pipe), std::string::npos);
    EXPECT_NE(refused({"metrics", "pipe", "pipe"}, 1).find(pipe), std::string::npos);
    EXPECT_NE(refused({"plan", "--preset", "pipe"}, 1).find(pipe), std::string::npos);
    EXPECT_NE(refused({"plan", "planes", "--frames", "0-1", "--path", "pipe"}, 1).find(pipe), std::string::npos);
    EXPECT_NE(refused({"plan", "/dev/zero"}, 1).find("it is a device"), std::string::npos);
    EXPECT_NE(refused({"plan", "--preset", "/dev/zero"}, 1).find("it is a device"), std::string::npos);
}

TEST_F(Names, AndOtherValuesOfPresetsHaveTheirTypes)
{
    for (const char* preset :
         {R"({"scene": []})", R"({"scene": null})", R"({"scene": 1})", R"({"scene_hash": {}})", R"({"filter": []})",
          R"({"filter": true})", R"({"map-size": true})", R"({"map-size": [64]})", R"({"fov": {}})", R"({"mask": []})",
          R"({"size": [64, 64]})", R"({"eye": []})", R"({"eye": [[1], 2, 3]})", R"({"eye": ["1", 2, 3]})",
          R"({"camera": true})", R"({"camera": 1})", R"({"techniques": [["pcf"]]})", R"({"techniques": [null]})"}) {
        test::spill(folder / "preset.json", preset);
        EXPECT_NE(refused({"compare", "planes", "--preset", "preset.json"}, 2).find("takes "), std::string::npos)
            << preset;
    }
    test::spill(folder / "preset.json", R"({"sun": [1, -1, 0], "map-size": "64", "fov": 40, "scene": "planes"})");
    EXPECT_EQ(run({"plan", "--preset", "preset.json"}).status, 0);
}

} // namespace
} // namespace gnomon
