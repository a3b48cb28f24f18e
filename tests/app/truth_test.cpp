// SPDX-License-Identifier: Apache-2.0
// `gnomon render --truth`: without a GPU, from the cache, and when it is told to stop.
#include "folder.h"
#include "lights_and_cameras.h"
#include "process.h"

#include "image/image_io.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <csignal>

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
        EXPECT_TRUE(says(ran.out, "truth hard of light sun, 6144 rays")) << ran.out;
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

TEST(Truth, ASunThreeDegreesWideHasAWiderPenumbra)
{
    const test::Folder folder;
    const test::Folder cache;
    const auto penumbra = [&](const char* degrees) {
        auto arguments = maskOf("area", "a.exr");
        arguments.insert(arguments.end(), {"--sun-angle", degrees});
        EXPECT_EQ(test::gnomon(arguments, withCache(folder, cache)).status, 0);
        const ImageF mask = readImage(folder / "a.exr");
        return std::count_if(mask.values.begin(), mask.values.end(),
                             [](float value) { return value > 0.0F && value < 1.0F; });
    };
    EXPECT_EQ(penumbra("0"), 0);
    const auto narrow = penumbra("6");
    EXPECT_GT(narrow, 0);
    EXPECT_GT(penumbra("30"), 2 * narrow);
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
    EXPECT_EQ(other.err, "");
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

TEST(Truth, WritesFrames)
{
    const test::Folder folder;
    const test::Folder cache;
    const test::Ran ran = test::gnomon({"render", "rts", "--size", "64x36", "--truth", "area", "--samples", "4",
                                        "--mask", "--frames", "0-1", "--fps", "1", "-o", "out"},
                                       withCache(folder, cache));
    ASSERT_EQ(ran.status, 0) << ran.err;
    const std::string first = test::slurp(folder / "out/frame_0000.png");
    EXPECT_FALSE(first.empty());
    EXPECT_NE(first, test::slurp(folder / "out/frame_0001.png")) << "the units walk";
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

/// A file without lights, of which the program says so before it traces: the moment to interrupt it.
std::string lightless()
{
    auto gltf = nlohmann::json::parse(test::kLightsAndCameras);
    gltf.erase("extensions");
    gltf.erase("extensionsUsed");
    gltf["nodes"][1].erase("extensions");
    return gltf.dump();
}

TEST(Interrupt, EndsATraceInOrder)
{
    const test::Folder folder;
    const test::Folder cache;
    test::spill(folder / "a.gltf", lightless());
    for (const auto& [number, status] : {std::pair{SIGINT, 130}, std::pair{SIGTERM, 143}}) {
        for (const bool frames : {false, true}) {
            std::vector<std::string> arguments{"render", "a.gltf",  "--truth",  "area",      "--mask",
                                               "--size", "900x900", "--ground", "--samples", "65536"};
            if (frames) {
                arguments.insert(arguments.end(), {"--frames", "0-9"});
            }
            test::How how = withCache(folder, cache);
            how.signal_at = "a sun is put in";
            how.signal = number;
            const test::Ran ran = test::gnomon(arguments, how);
            EXPECT_EQ(ran.status, status);
            EXPECT_EQ(ran.out, "");
            EXPECT_TRUE(ran.err.ends_with("gnomon: interrupted\n")) << ran.err;
            EXPECT_EQ(folder.names(), std::vector<std::string>{"a.gltf"});
            EXPECT_TRUE(cache.names().empty());
        }
    }
}

TEST(Interrupt, EndsFramesAndKeepsTheWholeOnes)
{
    const test::Folder folder;
    test::spill(folder / "a.gltf", lightless());
    const test::Ran ran =
        test::gnomon({"render", "a.gltf", "--size", "64x64", "--map-size", "64", "--frames", "0-99999", "-o", "out"},
                     {.folder = folder.path(), .signal_at = "a sun is put in", .signal = SIGINT});
    EXPECT_EQ(ran.status, 130);
    EXPECT_TRUE(ran.err.ends_with("gnomon: interrupted\n")) << ran.err;
    if (std::filesystem::exists(folder / "out")) {
        for (const auto& entry : std::filesystem::directory_iterator(folder / "out")) {
            EXPECT_EQ(readImage(entry.path()).width, 64U) << entry.path();
        }
    }
}

} // namespace
} // namespace gnomon
