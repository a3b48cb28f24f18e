// SPDX-License-Identifier: Apache-2.0
// `gnomon compare`: what its JSON, table and report hold, and what it says where there is nothing to compare.
#include "folder.h"
#include "lights_and_cameras.h"
#include "process.h"

#include "image/image_io.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <map>

namespace gnomon {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

/// Small and quick; `more` adds to it.
std::vector<std::string> compareOf(const char* scene, const std::vector<std::string>& more)
{
    std::vector<std::string> arguments{"compare", scene,      "--size", "160x90",        "--map-size",
                                       "256",     "--warmup", "0",      "--repetitions", "1"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

/// A cache of the test's own, so that every first trace is one.
struct Place {
    test::Folder folder;
    test::Folder cache;

    [[nodiscard]] test::Ran run(const std::vector<std::string>& arguments) const
    {
        return test::gnomon(arguments, how());
    }
    [[nodiscard]] test::How how() const
    {
        return {.folder = folder.path(), .environment = {{"XDG_CACHE_HOME", cache.path().string()}}};
    }
};

/// In alphabetical order.
std::vector<std::string> namesIn(const fs::path& folder)
{
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder)) {
        names.push_back(entry.path().filename().string());
    }
    std::sort(names.begin(), names.end());
    return names;
}

bool says(const std::string& text, const std::string& part)
{
    return text.find(part) != std::string::npos;
}

void expectKeys(const json& object, const std::vector<const char*>& keys)
{
    for (const char* key : keys) {
        EXPECT_TRUE(object.contains(key)) << key;
    }
}

TEST(Compare, JsonHasWhatScriptsRelyOn)
{
    const Place place;
    const test::Ran ran = place.run(
        compareOf("planes", {"--samples", "16", "--techniques", "hard,pcf+pcf.kernel=5x5", "--json", "--validate"}));
    ASSERT_EQ(ran.status, 0) << ran.err;
    EXPECT_FALSE(says(ran.out, "nan")) << ran.out;
    const json result = json::parse(ran.out);
    expectKeys(result, {"version", "scene", "scene_hash", "camera", "light", "device", "driver", "size_px", "eye",
                        "light_source", "truth", "results", "pixels", "baseline", "settings", "units"});
    EXPECT_EQ(result["truth"]["kind"], "area");
    EXPECT_EQ(result["truth"]["samples"], 16);
    EXPECT_GT(result["truth"]["standard_error"].get<double>(), 0.0);
    EXPECT_LT(result["truth"]["standard_error"].get<double>(), 0.05);
    EXPECT_GE(result["truth"]["rays"].get<std::uint64_t>(), 16U);
    EXPECT_EQ(result["light_source"]["type"], "directional");
    EXPECT_EQ(result["light_source"]["direction_ws"].size(), 3U);
    EXPECT_EQ(result["pixels"]["counted"].get<int>() + result["pixels"]["left_out"].get<int>(), 160 * 90);
    ASSERT_EQ(result["results"].size(), 2U);
    for (const json& one : result["results"]) {
        expectKeys(one, {"technique", "choices", "map", "error", "time_ms", "iqr_ms", "frame_ratio", "memory_bytes",
                         "texel_density", "fit_efficiency", "outcome", "counters", "settings"});
        const json& error = one["error"];
        expectKeys(error, {"rmse", "mae", "bias", "p99", "ssim", "flip", "edge", "acne", "detached", "bleeding",
                           "terminator"});
        const double rmse = error["rmse"];
        EXPECT_GT(rmse, 0.0);
        EXPECT_LT(rmse, 0.2);
        const double parts = error["edge"].get<double>() + error["acne"].get<double>() +
                             error["detached"].get<double>() + error["bleeding"].get<double>() +
                             error["terminator"].get<double>();
        EXPECT_NEAR(parts, rmse * rmse, 1e-12);
        EXPECT_GT(error["edge"].get<double>(), 0.5 * rmse * rmse); // a box over a plane has little else
        for (const char* stage : {"plan", "maps", "filter", "mask", "frame"}) {
            EXPECT_TRUE(one["time_ms"].contains(stage)) << stage;
        }
        EXPECT_GT(one["time_ms"]["frame"].get<double>(), 0.0);
        EXPECT_EQ(one["map"]["texels"], 256 * 256);
        EXPECT_EQ(one["map"]["bytes"], 256 * 256 * 4);
        EXPECT_GE(one["memory_bytes"].get<std::uint64_t>(), 256U * 256U * 4U);
        EXPECT_GT(one["texel_density"]["p50"].get<double>(), 0.0);
        EXPECT_GT(one["fit_efficiency"].get<double>(), 0.0);
        EXPECT_LE(one["fit_efficiency"].get<double>(), 1.0);
        EXPECT_EQ(one["outcome"]["kind"], "ok");
    }
    EXPECT_LE(result["results"][0]["error"]["rmse"], result["results"][1]["error"]["rmse"]);
}

// Bars of a cage that are a hundredth of the way from the lamp to what it shines on: their penumbra is all of the
// picture, and rays that ended a twentieth before the lamp missed them.
TEST(Compare, RaysFindWhatIsRightBeforeTheLamp)
{
    const Place place;
    const test::Ran ran = place.run(compareOf("ring", {"--camera", "deck", "--light", "caged 20", "--samples", "32",
                                                       "--techniques", "raymarch+cube,pcss+cube", "--json"}));
    ASSERT_EQ(ran.status, 0) << ran.err;
    const json results = json::parse(ran.out)["results"];
    ASSERT_EQ(results.size(), 2U);
    EXPECT_EQ(results[0]["choices"]["filter"], "raymarch");
    EXPECT_LT(results[0]["error"]["rmse"].get<double>(), 0.16); // 0.37 before; pcss 0.154
    EXPECT_LT(std::abs(results[0]["error"]["bias"].get<double>()), 0.02);
}

TEST(Compare, ItsOwnSettingsRepeatIt)
{
    const Place place;
    const test::Ran first =
        place.run(compareOf("planes", {"--samples", "16", "--techniques", "pcf+pcf.kernel=vogel+pcf.radius=9",
                                       "--light", "spot", "--light-size", "0.2", "--json=a.json"}));
    ASSERT_EQ(first.status, 0) << first.err;
    EXPECT_EQ(first.out, "");
    const json a = json::parse(test::slurp(place.folder / "a.json"));
    EXPECT_EQ(a["truth"]["from_cache"], false);
    EXPECT_EQ(a["light_source"]["radius_m"], 0.1);
    test::spill(place.folder / "again.json", a["settings"].dump());
    const test::Ran second =
        place.run({"compare", a["scene"].get<std::string>(), "--preset", "again.json", "--json", "b.json"});
    ASSERT_EQ(second.status, 0) << second.err;
    const json b = json::parse(test::slurp(place.folder / "b.json"));
    EXPECT_EQ(b["truth"]["from_cache"], true);
    EXPECT_EQ(b["truth"]["rays"], a["truth"]["rays"]);
    EXPECT_EQ(b["results"][0]["error"], a["results"][0]["error"]);
    EXPECT_EQ(b["results"][0]["settings"]["border"], 10.0); // the room that a disc of 9 texels needs
    EXPECT_EQ(b["scene_hash"], a["scene_hash"]);
    EXPECT_EQ(b["settings"], a["settings"]);
    EXPECT_EQ(b["light_source"], a["light_source"]);
}

/// A sharp shadow errs less beside sharp truth, a blurred one less beside the truth of a wide sun.
TEST(Compare, TruthOfTheWrongKindRanksTheOtherWay)
{
    const Place place;
    const auto best = [&](const std::vector<std::string>& more) {
        std::vector<std::string> arguments{"--map-size", "1024", "--techniques", "hard,pcf+pcf.kernel=7x7", "--json"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const test::Ran ran = place.run(compareOf("planes", arguments));
        EXPECT_EQ(ran.status, 0) << ran.err;
        return json::parse(ran.out);
    };
    const json hard = best({"--truth", "hard"});
    EXPECT_TRUE(hard["results"][0]["technique"].get<std::string>().starts_with("hard"));
    EXPECT_EQ(hard["truth"]["samples"], 1);
    EXPECT_EQ(hard["truth"]["standard_error"], 0.0);
    const json area = best({"--truth", "area", "--sun-angle", "6", "--samples", "64"});
    EXPECT_TRUE(area["results"][0]["technique"].get<std::string>().starts_with("pcf"));
    EXPECT_GT(area["results"][0]["error"]["rmse"].get<double>(), hard["results"][0]["error"]["rmse"].get<double>());
}

TEST(Compare, ReportIsCompleteAndReadable)
{
    const Place place;
    const test::Ran ran =
        place.run(compareOf("planes", {"--samples", "16", "--techniques", "hard,pcf", "--report", "out"}));
    ASSERT_EQ(ran.status, 0) << ran.err;
    EXPECT_EQ(readImage(place.folder / "out/truth.png").width, 160U);
    for (const char* number : {"01", "02"}) {
        for (const char* what : {"mask", "error", "classes", "density"}) {
            const std::string name = std::string(number) + "_" + what + ".png";
            if (name == "02_density.png") { // both have the same map, which is shown once
                EXPECT_FALSE(fs::exists(place.folder / ("out/" + name)));
                continue;
            }
            const ImageF picture = readImage(place.folder / ("out/" + name));
            EXPECT_GE(picture.width, 160U) << name;
            EXPECT_GE(picture.height, 90U) << name;
            EXPECT_NE(*std::min_element(picture.values.begin(), picture.values.end()),
                      *std::max_element(picture.values.begin(), picture.values.end()))
                << name << " is blank";
        }
    }
    const json result = json::parse(test::slurp(place.folder / "out/result.json"));
    const std::string page = test::slurp(place.folder / "out/index.html");
    for (const json& one : result["results"]) {
        EXPECT_TRUE(says(page, one["technique"].get<std::string>()));
    }
    for (const auto& entry : fs::directory_iterator(place.folder / "out")) {
        const std::string name = entry.path().filename().string();
        EXPECT_TRUE(says(page, name) || name == "index.html") << name << " is not on the page";
    }
    std::vector<std::string> listed = result["report_files"];
    std::sort(listed.begin(), listed.end());
    EXPECT_EQ(namesIn(place.folder / "out"), listed);
    // A shorter report leaves nothing of the longer one, and what is not a report's is left alone.
    test::spill(place.folder / "out/mine.txt", "keep me");
    test::spill(place.folder / "out/2024_mask.png", "keep me");
    ASSERT_EQ(place.run(compareOf("planes", {"--samples", "16", "--techniques", "hard", "--report", "out/"})).status,
              0);
    EXPECT_EQ(namesIn(place.folder / "out"),
              (std::vector<std::string>{"01_classes.png", "01_density.png", "01_error.png", "01_mask.png",
                                        "2024_mask.png", "index.html", "mine.txt", "result.json", "truth.png"}));
}

/// Names and bytes of all files.
std::map<std::string, std::string> contentsOf(const fs::path& folder)
{
    std::map<std::string, std::string> contents;
    for (const std::string& name : namesIn(folder)) {
        contents[name] = test::slurp(folder / name);
    }
    return contents;
}

TEST(Compare, AReportThatCannotBeRenewedStaysAsItWas)
{
    const Place place;
    ASSERT_EQ(place.run(compareOf("planes", {"--samples", "16", "--techniques", "hard", "--report", "out"})).status, 0);
    const auto before = contentsOf(place.folder / "out");
    test::How how = place.how();
    how.max_file_bytes = 2000; // enough for some of the pictures
    const test::Ran failed = test::gnomon(compareOf("planes", {"--no-cache", "--samples", "4", "--sun", "1,-1,0.2",
                                                               "--techniques", "hard,pcf", "--report", "out"}),
                                          how);
    EXPECT_EQ(failed.status, 1);
    EXPECT_TRUE(says(failed.err, "too large")) << failed.err;
    EXPECT_EQ(contentsOf(place.folder / "out"), before);
    EXPECT_EQ(namesIn(place.folder.path()), std::vector<std::string>{"out"});
}

TEST(Compare, WritesOverNoFileThatIsNotAReports)
{
    const Place place;
    for (const char* name : {"index.html", "result.json", "truth.png", "01_mask.png"}) {
        const fs::path folder = place.folder / name;
        fs::create_directory(folder);
        test::spill(folder / name, R"({"report_files": "none"})");
        const test::Ran ran = place.run(compareOf("planes", {"--samples", "4", "--report", name}));
        EXPECT_EQ(ran.status, 1) << name;
        EXPECT_TRUE(says(ran.err, std::string(name) + " is there already and of no earlier report")) << ran.err;
        EXPECT_EQ(contentsOf(folder), (std::map<std::string, std::string>{{name, R"({"report_files": "none"})"}}));
    }
}

TEST(Compare, SaysWhenNoPixelCounts)
{
    const Place place;
    struct Case {
        const char* name;
        std::vector<std::string> light;
        const char* reason;
    };
    const std::vector<Case> cases{
        {"light from below", {"--sun", "0,1,0"}, "facing away"},
        {"light that shines past all", {"--spot", "0,1,0,0,5,0,30"}, "outside the light's reach"}};
    for (const Case& one : cases) {
        std::vector<std::string> more{"--samples", "16", "--techniques", "hard", "--report", "out", "--json"};
        more.insert(more.end(), one.light.begin(), one.light.end());
        const test::Ran ran = place.run(compareOf("planes", more));
        ASSERT_EQ(ran.status, 0) << one.name << ": " << ran.err;
        EXPECT_TRUE(says(ran.err, "no pixel counts, so there are no error numbers")) << ran.err;
        EXPECT_TRUE(says(ran.err, one.reason)) << ran.err;
        const json result = json::parse(ran.out); // NaN would not parse
        EXPECT_EQ(result["pixels"]["counted"], 0);
        EXPECT_TRUE(result["truth"]["standard_error"].is_null());
        for (const auto& [key, value] : result["results"][0]["error"].items()) {
            EXPECT_TRUE(value.is_null()) << one.name << " " << key;
        }
        EXPECT_TRUE(result["results"][0]["texel_density"]["p50"].is_null());
        EXPECT_EQ(result["notes"].size() >= 1, true);
        EXPECT_TRUE(says(test::slurp(place.folder / "out/index.html"), "no pixel counts"));
    }
}

TEST(Compare, CameraInsideAWallStillGivesNumbers)
{
    const Place place;
    const test::Ran ran = place.run(compareOf(
        "planes", {"--eye", "-0.5,2.5,0", "--target", "0,0,0", "--samples", "16", "--techniques", "hard", "--json"}));
    ASSERT_EQ(ran.status, 0) << ran.err;
    const json result = json::parse(ran.out);
    EXPECT_GT(result["pixels"]["counted"].get<int>(), 0);
    EXPECT_TRUE(result["results"][0]["error"]["rmse"].is_number());
}

/// Seen from here nothing can throw a shadow: the sun's own ground is all there is.
TEST(Compare, SaysWhyAMaskIsAllLit)
{
    const Place place;
    test::spill(place.folder / "a.gltf", test::kLightsAndCameras);
    const test::Ran ran = place.run(compareOf("a.gltf", {"--sun", "0,0,-1", "--samples", "16", "--techniques", "hard",
                                                         "--set", "max-distance=0.5", "--json"}));
    ASSERT_EQ(ran.status, 0) << ran.err;
    const json result = json::parse(ran.out);
    EXPECT_NE(result["results"][0]["outcome"]["kind"], "ok") << ran.out;
    EXPECT_GT(result["results"][0]["outcome"]["reason"].get<std::string>().size(), 10U);
    EXPECT_TRUE(says(ran.err, "no shadow map, so the mask is all lit")) << ran.err;
}

struct Refused {
    std::vector<std::string> arguments;
    int status;
    const char* says;
};

TEST(Compare, RefusesInOneLineAndLeavesNothing)
{
    const Place place;
    test::spill(place.folder / "a.gltf", test::kLightsAndCameras);
    test::spill(place.folder / "file", "");
    const std::vector<Refused> all{
        {compareOf("a.gltf", {"--partition", "single"}), 1,
         "comparing shadows of light light0: a point light, or a spot"},
        {compareOf("planes", {"--light", "sunn"}), 2, "did you mean \"sun\""},
        {compareOf("planes", {"--light", "sun", "--light-size", "1", "--strict"}), 2, "only on a spot or point light"},
        {compareOf("planes", {"--report", "file"}), 1, "it is not a folder"},
        {compareOf("planes", {"--report", "none/out"}), 1, "there is no folder"},
        {compareOf("planes", {"--json=none/a.json"}), 1, "no folder"},
        {{"compare", "planes", "--sweep", "bias.slope=0:1:2", "--equal-error"}, 2, "a --sweep does not measure"},
        {{"compare", "planes", "--techniques", "hard", "--sweep", "pcf.radius=1:2:2"},
         2,
         "pcf.radius has an effect only"},
        {{"compare", "planes", "--techniques", "hard,hard+bias.slope=1", "--sweep", "bias.slope=0:1:2"}, 2, "is twice"},
    };
    const std::size_t before = place.folder.names().size();
    for (const Refused& one : all) {
        const test::Ran ran = place.run(one.arguments);
        EXPECT_EQ(ran.status, one.status) << one.says << ": " << ran.err;
        EXPECT_EQ(ran.out, "");
        const auto lines = ran.errorLines();
        ASSERT_EQ(lines.size(), 1U) << ran.err;
        EXPECT_TRUE(says(lines[0], one.says)) << lines[0];
        EXPECT_EQ(place.folder.names().size(), before) << one.says;
    }
}

TEST(Compare, InterruptedLeavesNothing)
{
    const Place place;
    auto gltf = json::parse(test::kLightsAndCameras); // without lights, of which the program says so first
    gltf.erase("extensions");
    gltf.erase("extensionsUsed");
    gltf["nodes"][1].erase("extensions");
    test::spill(place.folder / "a.gltf", gltf.dump());
    test::How how = place.how();
    how.signal_at = "a sun is put in";
    how.signal = SIGINT;
    const test::Ran ran =
        test::gnomon({"compare", "a.gltf", "--size", "64x64", "--map-size", "64", "--samples", "16", "--repetitions",
                      "100000", "--techniques", "hard", "--report", "out", "--json=a.json"},
                     how);
    EXPECT_EQ(ran.status, 130) << ran.err;
    EXPECT_EQ(ran.out, "");
    EXPECT_TRUE(ran.err.ends_with("gnomon: interrupted\n")) << ran.err;
    EXPECT_EQ(place.folder.names(), std::vector<std::string>{"a.gltf"});
}

} // namespace
} // namespace gnomon
