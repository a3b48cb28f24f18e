// SPDX-License-Identifier: Apache-2.0
// `gnomon plan --draw`, and the pictures of `--debug` that colour receivers by what the plan has for them.
#include "folder.h"
#include "process.h"

#include "image/image_io.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace gnomon {
namespace {

using nlohmann::json;
using std::filesystem::exists;

test::Ran inFolder(const test::Folder& folder, const std::vector<std::string>& arguments, bool driver = true)
{
    test::How how;
    how.folder = folder.path();
    if (!driver) {
        how.environment = {{"VK_ICD_FILENAMES", "/nonexistent"}, {"VK_DRIVER_FILES", "/nonexistent"}};
    }
    return test::gnomon(arguments, how);
}

TEST(PlanDraw, WritesAPictureWithoutADriver)
{
    const test::Folder folder;
    const test::Ran ran = inFolder(
        folder,
        {"plan", "sundial", "--preset", "plain", "--camera", "long", "--partition", "cascades", "--draw", "maps.svg"},
        false);
    ASSERT_EQ(ran.status, 0) << ran.err;
    EXPECT_NE(ran.out.find("maps.svg: the maps of light sun of sundial, pcf+uniform+cascades"), std::string::npos)
        << ran.out;
    const std::string svg = test::slurp(folder / "maps.svg");
    EXPECT_TRUE(svg.starts_with("<svg "));
    EXPECT_TRUE(svg.ends_with("</svg>\n"));
    EXPECT_NE(svg.find("Light sun of sundial: pcf+uniform+cascades"), std::string::npos);
    EXPECT_NE(svg.find("Map 3: 2048 x 2048 texels"), std::string::npos);
}

TEST(PlanDraw, GoesWithJson)
{
    const test::Folder folder;
    const test::Ran ran =
        inFolder(folder, {"plan", "planes", "--light", "spot", "--draw", "maps.svg", "--json=-"}, false);
    ASSERT_EQ(ran.status, 0) << ran.err;
    EXPECT_TRUE(json::parse(ran.out, nullptr, false).is_object());
    EXPECT_NE(test::slurp(folder / "maps.svg").find("Light spot of planes"), std::string::npos);
}

TEST(PlanDraw, IsRefusedWhereItMakesNoSense)
{
    const test::Folder folder;
    const auto refuses = [&](const std::vector<std::string>& arguments, const char* part) {
        const test::Ran ran = inFolder(folder, arguments);
        EXPECT_EQ(ran.status, 2);
        EXPECT_NE(ran.err.find(part), std::string::npos) << ran.err;
        EXPECT_TRUE(folder.names().empty());
    };
    refuses({"plan", "planes", "--draw", "maps.png"}, "does not end in .svg");
    refuses({"plan", "planes", "--light", "sun", "--strict"}, "--light has an effect only with");
    refuses({"plan", "planes", "--draw", "a.svg", "--light", "moon"}, "moon");
    refuses({"render", "planes", "--draw", "maps.svg"}, "--draw is not an option of render");
}

constexpr std::uint32_t kWidth = 320;
constexpr std::uint32_t kHeight = 180;

ImageF drawn(const test::Folder& folder, std::vector<std::string> arguments)
{
    arguments.insert(arguments.end(), {"--size", "320x180", "--validate", "--out", "view.png"});
    const test::Ran ran = inFolder(folder, arguments);
    EXPECT_EQ(ran.status, 0) << ran.err;
    return ran.status == 0 ? readImage(folder / "view.png") : ImageF(kWidth, kHeight, 3);
}

bool isGrey(const float* rgb)
{
    return std::max({rgb[0], rgb[1], rgb[2]}) - std::min({rgb[0], rgb[1], rgb[2]}) < 0.02F;
}

/// A pixel's hue as the first two kinds have it: orange, or blue.
bool isOrange(const float* rgb)
{
    return rgb[0] > rgb[2] + 0.05F;
}
bool isBlue(const float* rgb)
{
    return rgb[2] > rgb[0] + 0.05F;
}

TEST(DebugViews, ColourEachCascade)
{
    const test::Folder folder;
    const ImageF view = drawn(folder, {"render", "planes", "--camera", "side", "--debug", "views", "--partition",
                                       "cascades", "--set", "cascades.ends=10", "--set", "cascades.blend=0"});
    EXPECT_GT(view.height, kHeight); // the legend
    std::size_t orange = 0;
    std::size_t blue = 0;
    for (std::uint32_t y = 0; y < kHeight; ++y) {
        for (std::uint32_t x = 0; x < kWidth; ++x) {
            orange += isOrange(view.pixel(x, y)) ? 1 : 0;
            blue += isBlue(view.pixel(x, y)) ? 1 : 0;
        }
    }
    EXPECT_GT(orange, 1000U);
    EXPECT_GT(blue, 1000U);
    // A single map has one colour.
    const ImageF single = drawn(folder, {"render", "planes", "--camera", "side", "--debug", "views"});
    for (std::uint32_t y = 0; y < kHeight; ++y) {
        for (std::uint32_t x = 0; x < kWidth; ++x) {
            EXPECT_FALSE(isBlue(single.pixel(x, y)) && !isGrey(single.pixel(x, y)));
        }
    }
}

/// Lines over a grey picture: orange are spheres, blue the largest cells.
TEST(DebugViews, OctreeHasCellsAndSpheres)
{
    const test::Folder folder;
    const auto pixels = [&](const ImageF& view, auto wanted) {
        std::size_t count = 0;
        for (std::uint32_t y = 0; y < kHeight; ++y) {
            for (std::uint32_t x = 0; x < kWidth; ++x) {
                count += wanted(view.pixel(x, y)) ? 1 : 0;
            }
        }
        return count;
    };
    const auto is_grey = [](const float* rgb) {
        return rgb[0] == rgb[1] && rgb[1] == rgb[2];
    };
    const auto is_orange = [](const float* rgb) {
        return rgb[0] > rgb[1] && rgb[1] > 2.0F * rgb[2];
    };
    const auto is_blue = [](const float* rgb) {
        return rgb[2] > rgb[1] && rgb[1] > 2.0F * rgb[0];
    };
    const ImageF view = drawn(folder, {"render", "planes", "--camera", "side", "--debug", "octree"});
    EXPECT_GT(pixels(view, is_grey), std::size_t{kWidth} * kHeight / 2);
    EXPECT_GT(pixels(view, is_orange), 50U) << "the box has a sphere";
    EXPECT_GT(pixels(view, is_blue), 50U) << "and the root a cell";
    const ImageF away =
        drawn(folder, {"render", "planes", "--eye", "0,1.5,-4", "--target", "0,0,-9", "--debug", "octree"});
    EXPECT_EQ(pixels(away, is_orange), 0U) << "what is behind the eye is not drawn";
}

TEST(DebugViews, LightCountHasTheLightsThatReachAPixel)
{
    const test::Folder folder;
    const std::vector<std::string> shot{"render", "planes", "--camera", "top", "--debug", "light-count"};
    const auto with = [&](const std::vector<std::string>& more) {
        std::vector<std::string> arguments = shot;
        arguments.insert(arguments.end(), more.begin(), more.end());
        return drawn(folder, arguments);
    };
    const auto differentPixels = [](const ImageF& a, const ImageF& b) {
        std::size_t different = 0;
        for (std::uint32_t y = 0; y < kHeight; ++y) {
            for (std::uint32_t x = 0; x < kWidth; ++x) {
                different += std::equal(a.pixel(x, y), a.pixel(x, y) + 3, b.pixel(x, y)) ? 0 : 1;
            }
        }
        return different;
    };
    const ImageF all = with({}); // a sun and a spot light
    const ImageF sun = with({"--sun", "0,-1,0.1"});
    const ImageF lamp = with({"--point", "0,3,0,3.5"});
    EXPECT_GT(differentPixels(all, sun), 1000U);
    EXPECT_GT(differentPixels(sun, lamp), 1000U) << "beyond a lamp's range there is none";
    EXPECT_LT(differentPixels(sun, lamp), std::size_t{kWidth} * kHeight - 100) << "below it there is one";
    const test::Ran ran =
        inFolder(folder, {"render", "planes", "--debug", "light-count", "--light", "sun", "--strict"});
    EXPECT_EQ(ran.status, 2);
    EXPECT_NE(ran.err.find("--light has an effect only with"), std::string::npos) << ran.err;
}

TEST(DebugViews, FadedShowsWhatComes)
{
    const test::Folder folder;
    // A camera that goes quickly around a lamp.
    const std::vector<std::string> shot{
        "render",   "planes",   "--eye",   "12,2,0",       "--target",    "0,0.5,0",
        "--point",  "0,2,0,30", "--path",  "orbit",        "--partition", "multi",
        "--motion", "snap",     "--set",   "path.speed=4", "--set",       "multi.texels-per-pixel=1",
        "--frames", "0-12",     "--debug", "faded"};
    const test::Ran refused = inFolder(folder, {"render", "planes", "--point", "0,3,0,30", "--debug", "faded"});
    EXPECT_EQ(refused.status, 2);
    EXPECT_NE(refused.err.find("motion snap"), std::string::npos) << refused.err;
    const ImageF view = drawn(folder, shot);
    std::size_t orange = 0;
    std::size_t blue = 0;
    for (std::uint32_t y = 0; y < kHeight; ++y) {
        for (std::uint32_t x = 0; x < kWidth; ++x) {
            orange += isOrange(view.pixel(x, y)) ? 1 : 0;
            blue += isBlue(view.pixel(x, y)) ? 1 : 0;
        }
    }
    EXPECT_GT(orange, 1000U) << "maps that were there";
    EXPECT_GT(blue, 50U) << "maps that come, where nothing was before";
}

TEST(DebugViews, ViewsAreGreyWhereALampDoesNotReach)
{
    const test::Folder folder;
    const ImageF view =
        drawn(folder, {"render", "planes", "--camera", "top", "--debug", "views", "--point", "0,3,0,3.5"});
    std::size_t grey = 0;
    for (std::uint32_t y = 0; y < kHeight; ++y) {
        for (std::uint32_t x = 0; x < kWidth; ++x) {
            grey += isGrey(view.pixel(x, y)) ? 1 : 0;
        }
    }
    EXPECT_GT(grey, 1000U);
    EXPECT_LT(grey, std::size_t{kWidth} * kHeight - 100);
}

TEST(DebugViews, RaysSaysHowManyThereAreAndWhereTheyCameToTheirCeiling)
{
    const test::Folder folder;
    const auto shares = [&](const char* sun_deg) {
        const test::Ran ran = inFolder(folder, {"render", "planes", "--camera", "top", "--debug", "rays", "--size",
                                                "160x90", "--sun-angle", sun_deg});
        EXPECT_EQ(ran.status, 0) << ran.err;
        double rays = -1.0;
        double ceiling = -1.0;
        const std::size_t at = ran.err.find("light ");
        EXPECT_NE(at, std::string::npos) << ran.err;
        const std::string said = ran.err.substr(ran.err.find(": ", at) + 2);
        EXPECT_EQ(
            std::sscanf(said.c_str(), "%lf %% of the pixels that face it take rays, %lf %% come", &rays, &ceiling), 2)
            << ran.err;
        EXPECT_LE(ceiling, rays);
        return rays;
    };
    const double narrow = shares("4");
    EXPECT_GT(narrow, 0.0);
    EXPECT_GT(shares("16"), narrow) << "a wider light has wider penumbrae";
}

TEST(DebugViews, AreRefusedWhereThereIsNothingToShow)
{
    const test::Folder folder;
    const test::Ran steps = inFolder(folder, {"render", "planes", "--debug", "steps"});
    EXPECT_EQ(steps.status, 2);
    EXPECT_NE(steps.err.find("a motion that steps"), std::string::npos) << steps.err;
    for (const char* view : {"density", "views"}) {
        const test::Ran sky =
            inFolder(folder, {"render", "planes", "--debug", view, "--eye", "0,5,0", "--target", "0,50,1"});
        EXPECT_EQ(sky.status, 1);
        EXPECT_NE(sky.err.find("showing the "), std::string::npos) << sky.err;
        EXPECT_FALSE(exists(folder / "gnomon.png"));
    }
}

} // namespace
} // namespace gnomon
