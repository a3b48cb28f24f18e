// SPDX-License-Identifier: Apache-2.0
// `gnomon render --truth`: without a GPU, from the cache, and what it says.
#include "folder.h"
#include "lights_and_cameras.h"
#include "process.h"
#include "truth_run.h"

#include "image/image_io.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <limits>
#include <utility>

namespace gnomon {
namespace {

const std::vector<std::pair<std::string, std::string>> kNoDriver{{"VK_ICD_FILENAMES", "/nonexistent"},
                                                                 {"VK_DRIVER_FILES", "/nonexistent"}};

/// Without a Vulkan driver and with a cache of its own.
test::How withCache(const test::Folder& folder, const test::Folder& cache)
{
    test::How how{.folder = folder.path(), .environment = kNoDriver};
    how.environment.emplace_back("XDG_CACHE_HOME", cache.path().string());
    return how;
}

std::vector<std::string> maskOf(const char* kind, const char* file)
{
    return {"render", "planes", "--size", "96x64", "--truth", kind, "--mask", "-o", file};
}

bool says(const std::string& text, const std::string& part)
{
    return text.find(part) != std::string::npos;
}

TEST(Truth, MaskNeedsNoDriver)
{
    const test::Folder folder;
    const test::Folder cache;
    for (const char* file : {"m.png", "m.exr"}) {
        const test::Ran ran = test::gnomon(maskOf("hard", file), withCache(folder, cache));
        ASSERT_EQ(ran.status, 0) << ran.err;
        EXPECT_EQ(ran.err, "");
        EXPECT_TRUE(says(ran.out, "truth hard of light sun, 5725 rays")) << ran.out;
        EXPECT_FALSE(says(ran.out, "standard error")) << ran.out;
        const ImageF mask = readImage(folder / file);
        EXPECT_EQ(mask.channels, 1U);
        for (const float value : mask.values) {
            EXPECT_TRUE(value == 0.0F || value == 1.0F) << value;
        }
        EXPECT_EQ(std::count(mask.values.begin(), mask.values.end(), 0.0F) > 0, true);
    }
}

TEST(Truth, ComesFromTheCacheTheSecondTime)
{
    const test::Folder folder;
    const test::Folder cache;
    const test::Ran first = test::gnomon(maskOf("area", "a.png"), withCache(folder, cache));
    const test::Ran second = test::gnomon(maskOf("area", "b.png"), withCache(folder, cache));
    ASSERT_EQ(first.status, 0) << first.err;
    EXPECT_FALSE(says(first.out, "from the cache")) << first.out;
    EXPECT_TRUE(says(second.out, "from the cache")) << second.out;
    EXPECT_TRUE(says(second.out, "256 rays per pixel, standard error ")) << second.out;
    EXPECT_EQ(test::slurp(folder / "a.png"), test::slurp(folder / "b.png"));
    for (const char* option : {"--no-cache", "--seed=2", "--samples=64", "--sun-angle=2"}) {
        auto arguments = maskOf("area", "c.png");
        arguments.emplace_back(option);
        const test::Ran other = test::gnomon(arguments, withCache(folder, cache));
        ASSERT_EQ(other.status, 0) << other.err;
        EXPECT_FALSE(says(other.out, "from the cache")) << option;
    }
    EXPECT_EQ(cache.names(), std::vector<std::string>{"gnomon"});
}

TEST(Truth, NoCacheLeavesNone)
{
    const test::Folder folder;
    const test::Folder cache;
    auto arguments = maskOf("area", "a.png");
    arguments.emplace_back("--no-cache");
    ASSERT_EQ(test::gnomon(arguments, withCache(folder, cache)).status, 0);
    EXPECT_TRUE(cache.names().empty());
}

TEST(Truth, AnUnusableCacheIsANotice)
{
    const test::Folder folder;
    const test::Folder cache;
    test::spill(cache / "gnomon", "a file where a folder should be");
    const test::Ran ran = test::gnomon(maskOf("area", "a.png"), withCache(folder, cache));
    EXPECT_EQ(ran.status, 0);
    EXPECT_EQ(ran.errorLines().size(), 1U) << ran.err;
    EXPECT_TRUE(says(ran.err, "the truth is not kept: ")) << ran.err;
    EXPECT_TRUE(std::filesystem::exists(folder / "a.png"));
    test::How homeless = withCache(folder, cache);
    homeless.environment.emplace_back("XDG_CACHE_HOME", "");
    homeless.environment.emplace_back("HOME", "");
    const test::Ran without = test::gnomon(maskOf("hard", "a.png"), homeless);
    EXPECT_EQ(without.status, 0);
    EXPECT_TRUE(says(without.err, "truths are not kept: neither")) << without.err;
}

TEST(Truth, TakesPointLightsAndSaysThatTheyHaveNoSize)
{
    const test::Folder folder;
    const test::Folder cache;
    test::spill(folder / "lights.gltf", test::kLightsAndCameras);
    const std::vector<std::string> arguments{"render",   "lights.gltf", "--truth", "area",  "--size",  "64x64",
                                             "--ground", "--mask",      "-o",      "a.png", "--light", "Lamp"};
    const test::Ran ran = test::gnomon(arguments, withCache(folder, cache));
    ASSERT_EQ(ran.status, 0) << ran.err;
    EXPECT_TRUE(says(ran.err, "light light0 has no size")) << ran.err;
    EXPECT_TRUE(says(ran.err, "--light-size gives it one")) << ran.err;
    auto sized = arguments;
    sized.insert(sized.end(), {"--light-size", "0.5"});
    const test::Ran other = test::gnomon(sized, withCache(folder, cache));
    EXPECT_EQ(other.status, 0);
    EXPECT_FALSE(says(other.err, "has no size")) << other.err;
    EXPECT_TRUE(says(other.err, "reaches into the scene")) << "it hangs at the ground's edge: " << other.err;
}

TEST(Truth, ShadesThePictureWithItsMasks)
{
    const test::Folder folder;
    for (const char* aa : {"none", "ssaa4"}) {
        const test::Ran ran = test::gnomon({"render", "planes", "--size", "96x64", "--truth", "hard", "--aa", aa,
                                            "--validate", "-o", std::string(aa) + ".png"},
                                           {.folder = folder.path()});
        ASSERT_EQ(ran.status, 0) << ran.err;
        ASSERT_EQ(test::gnomon({"render", "planes", "--size", "96x64", "--filter", "hard", "--aa", aa, "-o", "t.png"},
                               {.folder = folder.path()})
                      .status,
                  0);
        const test::Ran metrics =
            test::gnomon({"metrics", "t.png", std::string(aa) + ".png", "--json"}, {.folder = folder.path()});
        ASSERT_EQ(metrics.status, 0) << metrics.err;
        // The same shading: only shadow edges differ. Without any shadow the picture is another one altogether.
        const auto error = nlohmann::json::parse(metrics.out)["error"];
        EXPECT_LT(error["rmse"].get<double>(), 0.03) << aa;
        EXPECT_GT(error["ssim"].get<double>(), 0.95) << aa;
    }
    const ImageF picture = readImage(folder / "none.png");
    const auto [dark, bright] = std::minmax_element(picture.values.begin(), picture.values.end());
    EXPECT_GT(*bright - *dark, 0.3F);
}

TEST(Truth, LeavesNothingWhenTheFileCannotBeWritten)
{
    const test::Folder folder;
    const test::Folder cache;
    test::How how = withCache(folder, cache);
    how.max_file_bytes = 64;
    const test::Ran ran = test::gnomon(maskOf("area", "a.png"), how);
    EXPECT_EQ(ran.status, 1);
    EXPECT_TRUE(says(ran.err, "too large")) << ran.err;
    EXPECT_TRUE(folder.names().empty());
}

TEST(Truth, OfAStillSceneIsTracedOnceForAllFrames)
{
    const test::Folder folder;
    const test::Folder cache;
    auto arguments = maskOf("hard", "out");
    arguments.insert(arguments.end(), {"--frames", "0-2"});
    const test::Ran ran = test::gnomon(arguments, withCache(folder, cache));
    ASSERT_EQ(ran.status, 0) << ran.err;
    EXPECT_TRUE(says(ran.out, "2 of 3 from the cache")) << ran.out;
    EXPECT_EQ(test::slurp(folder / "out/frame_0000.png"), test::slurp(folder / "out/frame_0002.png"));
}

/// A truth of everything lit, of any size.
truth::Traced lit(std::uint32_t width, std::uint32_t height)
{
    truth::Traced traced;
    traced.surfaces.object_ids = {width, height, 1};
    traced.surfaces.triangle_ids = {width, height, 1, scene::kNone};
    traced.surfaces.points = {width, height, 3};
    traced.surfaces.normals = {width, height, 3};
    traced.surfaces.smooth_normals = {width, height, 3};
    traced.visibility.kind = truth::Kind::hard;
    traced.visibility.visibility = {width, height, 1, 1.0F};
    traced.visibility.standard_error = {width, height, 1};
    traced.visibility.first_blocker_m = {width, height, 1, std::numeric_limits<float>::infinity()};
    return traced;
}

TEST(Truth, OfASecondLightIsTheSameFromTheFirstOnesSurfaces)
{
    app::Settings settings = app::defaultSettings();
    for (const auto& [key, value] : {std::pair("size", "64x36"), std::pair("sun", "1,-1,0"),
                                     std::pair("spot", "0,6,3,0,0,0,60"), std::pair("truth", "hard")}) {
        app::applySetting(settings, key, value);
    }
    settings.scene = "planes";
    settings.no_cache = true;
    const app::Shot shot = app::makeShot(settings);
    ASSERT_EQ(shot.lights.size(), 2U);
    const app::TruthRun alone = app::TruthTracer(shot, settings).trace(1);
    app::TruthTracer tracer(shot, settings);
    app::TruthRun first = tracer.trace(0);
    EXPECT_NE(first.traced.visibility.visibility.values, alone.traced.visibility.visibility.values);
    tracer.takeBack(std::move(first.traced.surfaces));
    const app::TruthRun second = tracer.trace(1);
    EXPECT_EQ(second.traced.surfaces.object_ids.values, alone.traced.surfaces.object_ids.values);
    EXPECT_EQ(second.traced.surfaces.points.values, alone.traced.surfaces.points.values);
    EXPECT_EQ(second.traced.visibility.visibility.values, alone.traced.visibility.visibility.values);
    // Those of nothing give nothing: they are used, not looked for again.
    tracer.takeBack(lit(64, 36).surfaces);
    EXPECT_EQ(tracer.trace(1).rays, 0U);
}

TEST(Truth, SaysThatALightReachesIntoTheScene)
{
    const test::Folder folder;
    const test::Folder cache;
    for (const auto& [metres, reaches] : {std::pair("11", true), std::pair("0.5", false)}) {
        const test::Ran ran =
            test::gnomon({"render", "planes", "--spot", "0,6,0,0.1,0,0,60", "--size", "48x32", "--truth", "area",
                          "--samples", "4", "--mask", "-o", "a.png", "--light-size", metres},
                         withCache(folder, cache));
        ASSERT_EQ(ran.status, 0) << ran.err;
        EXPECT_EQ(says(ran.err, "a sphere of 11 m across, reaches into the scene"), reaches) << ran.err;
        EXPECT_EQ(ran.errorLines().size(), reaches ? 1U : 0U) << ran.err;
    }
}

} // namespace
} // namespace gnomon
