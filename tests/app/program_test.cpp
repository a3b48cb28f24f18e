// SPDX-License-Identifier: Apache-2.0
// The program's work when it is used rightly.
#include "folder.h"
#include "lights_and_cameras.h"
#include "process.h"

#include "app/command_line.h"
#include "app/preset.h"
#include "app/shot.h"
#include "image/image_io.h"
#include "report_pages.h"

#include <gnomon/choice_rules.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace gnomon {
namespace {

using nlohmann::json;

test::Ran inFolder(const test::Folder& folder, const std::vector<std::string>& arguments)
{
    return test::gnomon(arguments, {.folder = folder.path()});
}

TEST(Help, NamesEveryOptionOfItsSubcommand)
{
    for (const app::Subcommand& subcommand : app::subcommands()) {
        const std::string text = app::helpText(&subcommand);
        for (const app::Setting& setting : app::settingTable()) {
            const bool named = text.find("--" + std::string(setting.key)) != std::string::npos;
            EXPECT_TRUE(named || !setting.own_option || (setting.subcommands & subcommand.bit) == 0)
                << subcommand.name << " " << setting.key;
        }
    }
}

TEST(List, JsonNamesEveryChoiceAndSettingWithItsRange)
{
    const test::Folder folder;
    const test::Ran ran = inFolder(folder, {"list", "--json"});
    ASSERT_EQ(ran.status, 0);
    EXPECT_EQ(ran.err, "");
    const json list = json::parse(ran.out);
    ASSERT_EQ(list["choices"].size(), 6U);
    EXPECT_GE(list["settings"].size(), 30U);
    bool vsm_is_there = false;
    bool id_is_known = false;
    bool point_is_known = false;
    for (const auto& choice : list["choices"]) {
        for (const auto& value : choice["values"]) {
            vsm_is_there |= value["name"] == "vsm";
            id_is_known |= value["name"] == "id";
            point_is_known |= value["name"] == "point";
            EXPECT_FALSE(value["source"].get<std::string>().empty());
        }
    }
    EXPECT_TRUE(vsm_is_there);
    EXPECT_TRUE(id_is_known);
    EXPECT_TRUE(point_is_known);
    bool sdsm_held_still = false;
    bool vsm_in_depth = false;
    for (const auto& refused : list["refused"]) {
        const std::string technique = refused["technique"];
        sdsm_held_still |= technique == "partition sdsm with every motion but free";
        vsm_in_depth |= technique.starts_with("vsm+map-format=d16|d32f|r32f|");
        EXPECT_GT(refused["reason"].get<std::string>().size(), 20U);
    }
    EXPECT_TRUE(sdsm_held_still && vsm_in_depth);
    // Rules, not all that they forbid one by one.
    EXPECT_LE(list["refused"].size(), choiceRules().size() + 22);
    for (const auto& setting : list["settings"]) {
        EXPECT_FALSE(setting["doc"].get<std::string>().empty());
        const std::string type = setting["type"];
        EXPECT_EQ(setting.contains("min"),
                  type == "integer" || type == "real" || type == "numbers" || type == "size" || type == "range")
            << setting;
    }
}

TEST(List, JsonGoesToAFileAndOnlyThere)
{
    const test::Folder folder;
    const test::Ran ran = inFolder(folder, {"list", "--json", "all.json"});
    EXPECT_EQ(ran.status, 0);
    EXPECT_EQ(ran.out, "");
    EXPECT_TRUE(json::accept(test::slurp(folder / "all.json")));
}

TEST(Plan, IsTheSameBytesEveryTime)
{
    const test::Folder folder;
    for (const char* world : {"planes", "rts", "ring", "spotlit", "canopies", "sundial"}) {
        const test::Ran first = inFolder(folder, {"plan", world, "--time", "1.5"});
        const test::Ran second = inFolder(folder, {"plan", world, "--time", "1.5"});
        ASSERT_EQ(first.status, 0) << first.err;
        EXPECT_EQ(first.out, second.out) << world;
        const json plan = json::parse(first.out);
        for (const char* key : {"views", "lights", "objects", "pages", "technique", "settings"}) {
            EXPECT_TRUE(plan.contains(key)) << world << " " << key;
        }
        EXPECT_FALSE(plan["views"].empty()) << world;
        EXPECT_FALSE(plan["objects"].empty()) << world;
    }
}

TEST(Plan, NeedsNoVulkanDriver)
{
    const test::Folder folder;
    const test::Ran ran =
        test::gnomon({"plan", "planes"},
                     {.folder = folder.path(),
                      .environment = {{"VK_ICD_FILENAMES", "/nonexistent"}, {"VK_DRIVER_FILES", "/nonexistent"}}});
    EXPECT_EQ(ran.status, 0) << ran.err;
}

TEST(Render, WritesAPictureOfTheSizeAsked)
{
    const test::Folder folder;
    const test::Ran ran = inFolder(folder, {"render", "planes", "--size", "161x90", "--validate"});
    ASSERT_EQ(ran.status, 0) << ran.err;
    EXPECT_NE(ran.out.find("gnomon.png"), std::string::npos);
    EXPECT_EQ(folder.names(), std::vector<std::string>{"gnomon.png"});
    const ImageF picture = readImage(folder / "gnomon.png");
    EXPECT_EQ(picture.width, 161U);
    EXPECT_EQ(picture.height, 90U);
    EXPECT_EQ(picture.channels, 3U);
}

TEST(Render, WritesExrAndMasks)
{
    const test::Folder folder;
    ASSERT_EQ(inFolder(folder, {"render", "planes", "--size", "64x48", "-o", "a.exr"}).status, 0);
    EXPECT_EQ(readImage(folder / "a.exr").channels, 3U);
    for (const char* name : {"m.png", "m.exr"}) {
        const test::Ran ran =
            inFolder(folder, {"render", "planes", "--size", "64x48", "--mask", "--light", "sun", "--out", name});
        ASSERT_EQ(ran.status, 0) << ran.err;
        const ImageF mask = readImage(folder / name);
        EXPECT_EQ(mask.channels, 1U);
        EXPECT_EQ(*std::min_element(mask.values.begin(), mask.values.end()), 0.0F);
        EXPECT_EQ(*std::max_element(mask.values.begin(), mask.values.end()), 1.0F);
    }
}

TEST(Render, WritesFramesIntoAFolder)
{
    const test::Folder folder;
    const test::Ran ran =
        inFolder(folder, {"render", "planes", "--size", "32x32", "--frames", "1-3", "--fps", "10", "-o", "out"});
    ASSERT_EQ(ran.status, 0) << ran.err;
    for (const char* name : {"frame_0001.png", "frame_0002.png", "frame_0003.png"}) {
        EXPECT_TRUE(std::filesystem::exists(folder / "out" / name)) << name;
    }
}

TEST(Bench, JsonHasWhatScriptsRelyOn)
{
    const test::Folder folder;
    const test::Ran ran =
        inFolder(folder, {"bench", "planes", "--sun", "1,-2,1", "--size", "64x64", "--map-size", "256", "--repetitions",
                          "2", "--warmup", "1", "--techniques", "hard,pcf+pcf.kernel=5x5", "--json", "--validate"});
    ASSERT_EQ(ran.status, 0) << ran.err;
    const json bench = json::parse(ran.out);
    for (const char* key : {"version", "scene", "scene_hash", "camera", "light", "device", "driver", "settings"}) {
        EXPECT_TRUE(bench.contains(key)) << key;
    }
    ASSERT_EQ(bench["results"].size(), 2U);
    EXPECT_EQ(bench["results"][0]["technique"].get<std::string>().substr(0, 4), "hard");
    for (const auto& result : bench["results"]) {
        for (const char* stage : {"plan", "maps", "filter", "mask", "frame"}) {
            EXPECT_TRUE(result["time_ms"].contains(stage)) << stage;
        }
        EXPECT_GT(result["time_ms"]["frame"].get<double>(), 0.0);
        EXPECT_GT(result["time_ms"]["maps"].get<double>(), 0.0);
        EXPECT_GT(result["time_ms"]["mask"].get<double>(), 0.0);
        EXPECT_GT(result["frame_ratio"].get<double>(), 0.0);
        EXPECT_GE(result["memory_bytes"].get<std::uint64_t>(), 256U * 256U * 4U);
        EXPECT_EQ(result["map"]["texels"], 256 * 256);
        EXPECT_EQ(result["counters"]["texels_rendered"], 256 * 256);
        EXPECT_GT(result["counters"]["draws"].get<int>(), 0);
        EXPECT_GT(result["texel_density"]["p50"].get<double>(), 0.0);
        EXPECT_LE(result["texel_density"]["p01"].get<double>(), result["texel_density"]["p99"].get<double>());
        EXPECT_GT(result["fit_efficiency"].get<double>(), 0.0);
        EXPECT_LE(result["fit_efficiency"].get<double>(), 1.0);
    }
}

TEST(Bench, ReportIsAPageMadeOfItsJson)
{
    const test::Folder folder;
    const std::vector<std::string> words{"bench",         "planes", "--size",   "16x16", "--map-size", "64",
                                         "--repetitions", "1",      "--warmup", "0",     "--report",   "out"};
    const test::Ran ran = inFolder(folder, words);
    ASSERT_EQ(ran.status, 0) << ran.err;
    EXPECT_NE(ran.out.find("no shadows"), std::string::npos); // the table is told all the same
    const app::Json result = app::Json::parse(test::slurp(folder / "out/result.json"));
    EXPECT_EQ(result["report_files"], (std::vector<std::string>{"index.html", "result.json"}));
    EXPECT_EQ(test::slurp(folder / "out/index.html"), app::benchPage(result));
    std::vector<std::string> again = words;
    again.insert(again.end(), {"--preset", "out/result.json", "--json"}); // renews it
    const test::Ran repeated = inFolder(folder, again);
    ASSERT_EQ(repeated.status, 0) << repeated.err;
    EXPECT_EQ(json::parse(repeated.out), json::parse(test::slurp(folder / "out/result.json")));
}

/// A technique without shadows would seem the cheapest of all.
TEST(Bench, SaysWhoseLightsHaveNoShadow)
{
    const test::Folder folder;
    const test::Ran ran = inFolder(folder, {"bench", "planes", "--sun", "1,-2,1", "--size", "16x16", "--map-size", "64",
                                            "--repetitions", "1", "--warmup", "0", "--techniques", "hard,cube+pcf"});
    ASSERT_EQ(ran.status, 0) << ran.err;
    EXPECT_NE(ran.err.find("gnomon: pcf+cube+map-size=64+pcf.kernel=3x3: 1 of 1 lights without a shadow: refused: "),
              std::string::npos)
        << ran.err;
    EXPECT_EQ(ran.err.find("gnomon: hard"), std::string::npos) << ran.err;
}

TEST(Bench, TimesWhatIsAskedFor)
{
    const test::Folder folder;
    test::spill(folder / "kernel.json", R"({"filter": "pcf", "pcf.kernel": "5x5"})");
    test::spill(folder / "list.json", R"({"techniques": ["pcf", "hard"]})");
    struct Asked {
        std::vector<std::string> arguments;
        std::vector<std::string> techniques; // how the results' names begin
    };
    const std::vector<Asked> all{
        {{"--filter", "hard"}, {"hard"}},
        {{"--filter", "pcf", "--set", "pcf.kernel=2x2"}, {"pcf+map-size=64+pcf.kernel=2x2"}},
        {{"--preset", "kernel.json"}, {"pcf+map-size=64+pcf.kernel=5x5"}},
        {{"--techniques", "hard", "--techniques", "pcf"}, {"hard", "pcf"}},
        {{"--preset", "list.json"}, {"pcf", "hard"}},
        {{"--preset", "list.json", "--techniques", "hard"}, {"hard"}},
    };
    for (const Asked& asked : all) {
        std::vector<std::string> arguments{"bench",         "planes", "--size",   "16x16", "--map-size", "64",
                                           "--repetitions", "1",      "--warmup", "0",     "--json"};
        arguments.insert(arguments.end(), asked.arguments.begin(), asked.arguments.end());
        const test::Ran ran = inFolder(folder, arguments);
        ASSERT_EQ(ran.status, 0) << ran.err;
        const json bench = json::parse(ran.out);
        ASSERT_EQ(bench["results"].size(), asked.techniques.size()) << asked.arguments[1];
        for (std::size_t i = 0; i < asked.techniques.size(); ++i) {
            EXPECT_TRUE(bench["results"][i]["technique"].get<std::string>().starts_with(asked.techniques[i]))
                << bench["results"][i]["technique"];
        }
        if (asked.techniques.size() == 2) {
            EXPECT_EQ(bench["settings"]["techniques"], asked.techniques[0] + "," + asked.techniques[1]);
        }
    }
}

TEST(Camera, OfAFileIsFoundByEitherNameWithItsPlanes)
{
    const test::Folder folder;
    test::spill(folder / "a.gltf", test::kLightsAndCameras);
    app::Settings settings = app::defaultSettings();
    settings.scene = (folder / "a.gltf").string();
    for (const char* name : {"", "camera1", "Eye"}) {
        settings.camera = name;
        const app::Shot shot = app::makeShot(settings);
        EXPECT_EQ(shot.camera, *name == '\0' ? "camera1" : name);
        EXPECT_EQ(shot.eye.near_m, 0.25);
        EXPECT_EQ(shot.eye.far_m, 80.0);
        ASSERT_EQ(shot.lights.size(), 1U);
        EXPECT_EQ(shot.lights[0].name, "light0");
    }
}

TEST(Program, SaysItsVersion)
{
    const test::Folder folder;
    EXPECT_EQ(inFolder(folder, {"--version"}).out.substr(0, 7), "gnomon ");
}

TEST(Technique, TextAndSettingsAgreeBothWays)
{
    const app::Settings base = app::defaultSettings();
    for (const char* text : {"hard", "pcf+pcf.kernel=3x3", "hard+map-size=512+map-format=r32f",
                             "pcf+bias=none+pcf.kernel=vogel+pcf.taps=32", "hard+bias.constant=-0.1"}) {
        const app::Settings once = app::parseTechnique(base, text);
        const std::string described = app::describeTechnique(once);
        const app::Settings twice = app::parseTechnique(base, described);
        EXPECT_EQ(once.values, twice.values) << text << " | " << described;
    }
    const app::Settings settings = app::parseTechnique(base, "map-size=64+uniform+hard+free");
    EXPECT_EQ(settings.shadow.technique.filter, Filter::hard);
    EXPECT_EQ(settings.shadow.map_size, 64U);
}

TEST(Bias, TheListSetsItsParts)
{
    app::Settings settings = app::defaultSettings();
    EXPECT_TRUE(settings.shadow.bias.automatic);
    app::applySetting(settings, "bias", "constant=0.5,slope=2,normal=1.5,receiver-plane=1");
    EXPECT_FALSE(settings.shadow.bias.automatic);
    EXPECT_EQ(settings.shadow.bias.constant_m, 0.5F);
    EXPECT_EQ(settings.shadow.bias.slope, 2.0F);
    EXPECT_EQ(settings.shadow.bias.normal_texels, 1.5F);
    EXPECT_TRUE(settings.shadow.bias.receiver_plane);
    app::applySetting(settings, "bias", "auto");
    EXPECT_TRUE(settings.shadow.bias.automatic);
    EXPECT_FALSE(settings.values.contains("bias.slope"));
}

TEST(Presets, AllAreValidAndShastryIsAsPublished)
{
    for (const app::Preset& preset : app::presets()) {
        app::Settings settings = app::defaultSettings();
        app::applyPreset(settings, preset.name, app::kRender);
        EXPECT_NO_THROW(app::completeTechnique(settings)) << preset.name;
    }
    app::Settings settings = app::defaultSettings();
    app::applyPreset(settings, "shastry-2005", app::kRender);
    app::completeTechnique(settings);
    EXPECT_EQ(settings.shadow.map_size, 1024U);
    EXPECT_EQ(formatOf(settings.shadow), MapFormat::r32f);
    EXPECT_EQ(settings.shadow.bias.constant_m, 0.1F);
    EXPECT_EQ(settings.scene, "spotlit");
    EXPECT_EQ(settings.shadow.pcf.kernel, PcfKernel::projected_3x3);
    EXPECT_EQ(settings.shadow.technique.soften, Soften::blur);
    EXPECT_EQ(settings.shadow.screen_blur.taps, ScreenTaps::published);
    EXPECT_EQ(settings.shadow.screen_blur.edges, ScreenEdges::plain);
    EXPECT_EQ(settings.reflection, host::Reflection::phong_2005);
    const app::Shot shot = app::makeShot(settings);
    ASSERT_EQ(shot.lights.size(), 3U);
    for (const host::ShadedLight& light : shot.lights) {
        EXPECT_NEAR(light.caster.outer_half_angle_rad, 0.261799, 1e-6) << "a cone of 30 degrees";
        EXPECT_LT(light.inner_half_angle_rad, light.caster.outer_half_angle_rad);
        EXPECT_EQ(light.caster.near_m, 1.0);
        EXPECT_EQ(light.caster.range_m, 1024.0);
        EXPECT_NE(light.cookie, scene::kNone);
    }
}

TEST(Presets, StartopiaHasFrustumsForEachOfManyLampsAndHoldsThem)
{
    app::Settings settings = app::defaultSettings();
    app::applyPreset(settings, "startopia-2006", app::kRender);
    app::completeTechnique(settings);
    EXPECT_EQ(settings.scene, "ring");
    EXPECT_EQ(settings.shadow.technique.partition, Partition::multi);
    EXPECT_EQ(settings.shadow.technique.motion, Motion::snap); // "can pan by whole texels"
    EXPECT_EQ(settings.shadow.technique.fit, Fit::uniform);    // which no warp can
    EXPECT_EQ(settings.shadow.technique.filter, Filter::pcf);
    EXPECT_EQ(settings.shadow.pcf.kernel, PcfKernel::bilinear_2x2);
    EXPECT_EQ(settings.shadow.multi.texels_per_pixel, 2.0);
    EXPECT_EQ(settings.shadow.multi.most_times, 4.0); // "heuristic factor of ~4x allowed"
    EXPECT_EQ(formatOf(settings.shadow), MapFormat::d32f);
    EXPECT_TRUE(settings.shadow.bias.automatic);
}

app::Settings settingsOf(const std::vector<std::string>& arguments)
{
    return app::parseCommandLine(arguments).settings;
}

TEST(Presets, TheirCameraGivesWayToOptions)
{
    const app::Settings eye = settingsOf({"plan", "--preset", "demo", "--eye", "1,2,3", "--target", "0,0,0"});
    EXPECT_EQ(eye.camera, "");
    EXPECT_FALSE(eye.values.contains("camera"));
    EXPECT_TRUE(eye.eye_ws.has_value());
    const test::Folder folder;
    test::spill(folder / "eye.json", R"({"eye": [1, 2, 3], "target": [0, 0, 0]})");
    const std::string file = (folder / "eye.json").string();
    const app::Settings camera = settingsOf({"plan", "--preset", file, "--camera", "camp"});
    EXPECT_EQ(camera.camera, "camp");
    EXPECT_FALSE(camera.eye_ws.has_value());
    EXPECT_FALSE(camera.values.contains("target"));
    EXPECT_EQ(settingsOf({"plan", "--preset", "demo", "--preset", file}).camera, "");
    EXPECT_FALSE(settingsOf({"plan", "--preset", file, "--preset", "demo"}).eye_ws.has_value());
    EXPECT_THROW((void)settingsOf({"plan", "--target", "0,0,0", "--camera", "camp"}), app::UsageError);
}

} // namespace
} // namespace gnomon
