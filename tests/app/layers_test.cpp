// SPDX-License-Identifier: Apache-2.0
// lvsm's layers of depth, as the plan says them and as the picture shows them.
#include "folder.h"
#include "layer_depths.h"
#include "process.h"

#include "image/image_io.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string_view>

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

const std::vector<std::string> kSmall{"--filter", "lvsm", "--size", "160x90", "--map-size", "256"};

std::vector<std::string> with(std::vector<std::string> arguments, const std::vector<std::string>& more)
{
    arguments.insert(arguments.end(), kSmall.begin(), kSmall.end());
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

TEST(PlanOfLayers, ByHandNeedsNoDriver)
{
    const test::Folder folder;
    const test::Ran ran = inFolder(
        folder, with({"plan", "planes"}, {"--set", "lvsm.placement=uniform", "--set", "lvsm.layers=4"}), false);
    ASSERT_EQ(ran.status, 0) << ran.err;
    const json plan = json::parse(ran.out);
    ASSERT_FALSE(plan["views"].empty());
    for (const json& view : plan["views"]) {
        const json& layers = view["layers"];
        ASSERT_EQ(layers.size(), 4U);
        const double near_m = view["metric"]["near_m"];
        const double far_m = view["metric"]["far_m"];
        for (std::size_t i = 0; i < 4; ++i) {
            EXPECT_NEAR(layers[i]["begins"].get<double>(), 0.25 * double(i), 1e-6);
            EXPECT_NEAR(layers[i]["begins_m"].get<double>(), near_m + 0.25 * double(i) * (far_m - near_m),
                        1e-5 * far_m);
        }
        EXPECT_LT(layers[1]["near"].get<double>(), 0.25);
        EXPECT_GT(layers[1]["far_m"].get<double>(), layers[2]["begins_m"].get<double>());
    }
}

TEST(PlanOfLayers, FoundOnesAreOfWhatIsDrawn)
{
    const test::Folder folder;
    const test::Ran ran = inFolder(folder, with({"plan", "canopies"}, {"--validate"}));
    ASSERT_EQ(ran.status, 0) << ran.err;
    const json plan = json::parse(ran.out);
    const json& layers = plan["views"].at(0)["layers"];
    ASSERT_EQ(layers.size(), 2U);
    const double split = layers[1]["begins"];
    EXPECT_GT(split, 0.0);
    EXPECT_LT(split, 1.0);
    EXPECT_NE(split, 0.5);
    EXPECT_NE(inFolder(folder, with({"plan", "canopies"}, {}), false).status, 0);
}

TEST(PlanOfLayers, OtherFiltersHaveNone)
{
    const test::Folder folder;
    const test::Ran ran = inFolder(folder, {"plan", "planes"});
    ASSERT_EQ(ran.status, 0) << ran.err;
    EXPECT_FALSE(json::parse(ran.out)["views"].at(0).contains("layers"));
}

TEST(Depths, GoToMetresAndBack)
{
    View view;
    view.projection.metric.near_m = 2.0;
    view.projection.metric.far_m = 42.0;
    view.projection.metric.metric_ws = {0.0, 0.0, 1.0 / 40.0, -2.0 / 40.0};
    MomentOptions options;
    EXPECT_DOUBLE_EQ(app::metresOf(view, options, 0.25), 12.0);
    EXPECT_DOUBLE_EQ(app::storedDepth(view, options, {5.0, 5.0, 12.0}), 0.25);
    EXPECT_EQ(app::storedDepth(view, options, {0.0, 0.0, 100.0}), 1.0);
    options.metric = DepthMetricKind::z_over_w;
    EXPECT_DOUBLE_EQ(app::metresOf(view, options, 0.25), 12.0); // under a parallel light the two are one
    view.projection.orthographic = false;
    view.projection.parallel = false;
    EXPECT_DOUBLE_EQ(app::metresOf(view, options, 0.0), 2.0);
    EXPECT_DOUBLE_EQ(app::metresOf(view, options, 1.0), 42.0);
    view.projection.clip_from_world = glm::dmat4(0.0);
    view.projection.clip_from_world[2][2] = 42.0 / 40.0; // far / (far - near), as a perspective matrix has it
    view.projection.clip_from_world[3][2] = -84.0 / 40.0;
    view.projection.clip_from_world[2][3] = 1.0;
    for (const double metres : {2.0, 3.0, 12.0, 40.0}) {
        EXPECT_NEAR(app::metresOf(view, options, app::storedDepth(view, options, {0.0, 0.0, metres})), metres, 1e-9);
    }
}

TEST(Depths, HaveALayer)
{
    const std::vector<pack::DepthLayer> layers{{0.0F, 0.3F, 0.0F}, {0.2F, 0.7F, 0.25F}, {0.6F, 1.0F, 0.625F}};
    EXPECT_EQ(app::layerOf(layers, 0.0), 0U);
    EXPECT_EQ(app::layerOf(layers, 0.2499), 0U);
    EXPECT_EQ(app::layerOf(layers, 0.25), 1U);
    EXPECT_EQ(app::layerOf(layers, 0.625), 2U);
    EXPECT_EQ(app::layerOf(layers, 1.0), 2U);
}

/// Which of two hues a pixel has more of: orange (layer 0) or blue (layer 1).
enum class Hue { neither, orange, blue };
Hue hueOf(const float* rgb)
{
    const float difference = rgb[0] - rgb[2];
    return std::abs(difference) < 0.02F ? Hue::neither : difference > 0.0F ? Hue::orange : Hue::blue;
}

double shareOf(const ImageF& picture, std::uint32_t rows, Hue hue)
{
    std::size_t count = 0;
    for (std::uint32_t y = 0; y < rows; ++y) {
        for (std::uint32_t x = 0; x < picture.width; ++x) {
            count += hueOf(picture.pixel(x, y)) == hue ? 1 : 0;
        }
    }
    return double(count) / (double(rows) * picture.width);
}

TEST(DebugLayers, ColoursReceiversByTheirLayer)
{
    const test::Folder folder;
    const std::vector<std::string> size{"--filter", "lvsm", "--size", "320x180", "--map-size", "256", "--validate"};
    const auto draw = [&](const char* split, const char* file) {
        std::vector<std::string> arguments{"render", "planes", "--debug", "layers", "--set", split, "--out", file};
        arguments.insert(arguments.end(), size.begin(), size.end());
        const test::Ran ran = inFolder(folder, arguments);
        EXPECT_EQ(ran.status, 0) << ran.err;
        return readImage(folder / file);
    };
    const ImageF deep = draw("lvsm.splits=0.99999", "deep.png");
    const ImageF flat = draw("lvsm.splits=0.00001", "flat.png");
    EXPECT_EQ(deep.width, 320U);
    EXPECT_GT(deep.height, 180U); // the legend
    // All in the first layer, all in the second; the background is grey.
    EXPECT_GT(shareOf(deep, 180, Hue::orange), 0.3);
    EXPECT_LT(shareOf(deep, 180, Hue::blue), 0.01);
    EXPECT_GT(shareOf(flat, 180, Hue::blue), 0.3);
    EXPECT_LT(shareOf(flat, 180, Hue::orange), 0.01);
}

/// The part above the legend: a map of 128 x 128 texels, each two pixels wide, in the middle of 320.
ImageF mapIn(const ImageF& picture)
{
    ImageF map(128, 128, picture.channels);
    for (std::uint32_t y = 0; y < map.height; ++y) {
        for (std::uint32_t x = 0; x < map.width; ++x) {
            std::copy_n(picture.pixel(32 + 2 * x, 2 * y), picture.channels, map.pixel(x, y));
        }
    }
    return map;
}

/// All of its grey is in it: the nearest caster black, what nothing covers white.
TEST(DebugMap, IsTheMapFromBlackToWhiteAboveItsLegend)
{
    const test::Folder folder;
    double of_vsm = 0.0;
    for (const char* filter : {"hard", "lvsm", "vsm", "msm", "esm", "evsm"}) {
        SCOPED_TRACE(filter);
        const test::Ran ran = inFolder(folder, {"render", "planes", "--debug", "map", "--filter", filter, "--size",
                                                "32x18", "--map-size", "128", "--validate", "--out", "map.png"});
        ASSERT_EQ(ran.status, 0) << ran.err;
        EXPECT_NE(ran.err.find("light sun: its map's depth is "), std::string::npos) << ran.err;
        const ImageF picture = readImage(folder / "map.png");
        ASSERT_EQ(picture.width, 320U);
        ASSERT_GT(picture.height, 256U + 40U);
        const ImageF map = mapIn(picture);
        const auto [least, most] = std::minmax_element(map.values.begin(), map.values.end());
        EXPECT_EQ(*least, 0.0F);
        EXPECT_EQ(*most, 1.0F);
        for (std::size_t i = 0; i < map.values.size(); i += map.channels) {
            ASSERT_EQ(map.values[i], map.values[i + 1]);
            ASSERT_EQ(map.values[i], map.values[i + 2]);
        }
        // Whatever stands in the texels, they stand for the same depths.
        const double mean =
            std::accumulate(map.values.begin(), map.values.end(), 0.0) / static_cast<double>(map.values.size());
        if (std::string_view(filter) == "vsm") {
            of_vsm = mean;
        } else if (of_vsm > 0.0) {
            EXPECT_NEAR(mean, of_vsm, 0.05);
        }
        std::filesystem::remove(folder / "map.png");
    }
}

TEST(DebugMap, HasAllMapsOfALight)
{
    const test::Folder folder;
    const test::Ran ran = inFolder(folder, {"render", "planes", "--camera", "side", "--debug", "map", "--filter",
                                            "hard", "--partition", "cascades", "--set", "cascades.count=3",
                                            "--map-size", "256", "--size", "32x18", "--out", "map.png"});
    ASSERT_EQ(ran.status, 0) << ran.err;
    const ImageF picture = readImage(folder / "map.png");
    EXPECT_EQ(picture.width, 2U * 256 + 4) << "two columns";
    EXPECT_GT(picture.height, 2U * (256 + 18) + 4) << "two rows, each map below its name, and the legend";
}

TEST(DebugMap, IsRefusedWhereThereIsNoMap)
{
    const test::Folder folder;
    const test::Ran sky =
        inFolder(folder, {"render", "planes", "--debug", "map", "--eye", "0,5,0", "--target", "0,50,1"});
    EXPECT_EQ(sky.status, 1);
    EXPECT_NE(sky.err.find("showing the map of light"), std::string::npos) << sky.err;
    const test::Ran mask = inFolder(folder, {"render", "planes", "--debug", "map", "--mask"});
    EXPECT_EQ(mask.status, 2);
    EXPECT_FALSE(exists(folder / "gnomon.png"));
}

TEST(DebugLayers, IsRefusedWhereThereIsNothingToShow)
{
    const test::Folder folder;
    const auto refuses = [&](const std::vector<std::string>& arguments, const char* part) {
        const test::Ran ran = inFolder(folder, arguments);
        EXPECT_EQ(ran.status, 2);
        EXPECT_NE(ran.err.find(part), std::string::npos) << ran.err;
        EXPECT_FALSE(exists(folder / "gnomon.png"));
    };
    refuses({"render", "planes", "--debug", "layers"}, "filter lvsm");
    refuses({"render", "planes", "--debug", "rays", "--filter", "pcss"}, "filter raymarch");
    refuses({"render", "planes", "--debug", "rays", "--soften", "converge"}, "soften none");
    refuses({"render", "planes", "--debug", "layers", "--filter", "vsm"}, "filter lvsm");
    refuses({"render", "planes", "--debug", "layers", "--filter", "lvsm", "--mask"}, "--mask");
    refuses({"render", "planes", "--debug", "layers", "--truth", "hard"}, "--truth");
    refuses({"render", "planes", "--debug", "layers", "--filter", "lvsm", "--out", "a.exr"}, ".png");
    refuses({"render", "planes", "--debug", "layer"}, "layers");
}

} // namespace
} // namespace gnomon
