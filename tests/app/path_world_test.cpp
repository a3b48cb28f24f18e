// SPDX-License-Identifier: Apache-2.0
// `--path` in a world whose sun moves by itself, and techniques that keep something from frame to frame under the
// validation layer.
#include "folder.h"
#include "process.h"

#include "image/image_io.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace gnomon {
namespace {

using nlohmann::json;

test::Ran inFolder(const test::Folder& folder, const std::vector<std::string>& arguments)
{
    return test::gnomon(arguments,
                        {.folder = folder.path(), .environment = {{"XDG_CACHE_HOME", (folder / "cache").string()}}});
}

json planOf(const test::Folder& folder, const std::vector<std::string>& more)
{
    std::vector<std::string> arguments{"plan", "sundial", "--map-size", "128", "--json=-"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const test::Ran ran = inFolder(folder, arguments);
    EXPECT_EQ(ran.status, 0) << ran.err;
    return json::parse(ran.out, nullptr, false);
}

/// In `sundial` the sun's own course is the path's: a minute of the day is a second, and the speed is on top of that.
TEST(PathOfTheDay, IsTheSundialsOwn)
{
    const test::Folder folder;
    const std::vector<std::string> day{"--path", "day", "--set", "path.speed=60", "--fps", "1"};
    const auto direction = [](const json& plan) {
        return plan["lights"].at(0)["direction_ws"].get<std::vector<double>>();
    };
    std::vector<std::string> first = day;
    first.insert(first.end(), {"--frames", "0-0"});
    std::vector<std::string> fourth = day;
    fourth.insert(fourth.end(), {"--frames", "0-3"});
    const std::vector<double> start = direction(planOf(folder, first));
    const std::vector<double> later = direction(planOf(folder, fourth));
    EXPECT_EQ(start, direction(planOf(folder, {"--time", "0"})));
    EXPECT_EQ(later, direction(planOf(folder, {"--time", "180"})));
    // 180 s of a day of 1440 s turn the sun by 45 degrees about an axis, which seen from the sky is no more than that.
    const double cosine = start[0] * later[0] + start[1] * later[1] + start[2] * later[2];
    EXPECT_LT(cosine, std::cos(0.3));
    EXPECT_GT(cosine, std::cos(0.7855));
}

TEST(PathOfTheDay, ItsFramesAreTheMomentsOfTheDay)
{
    const test::Folder folder;
    // An automatic fit remembers the frames before.
    const std::vector<std::string> small{"--preset", "plain",      "--camera", "meadow", "--size",
                                         "160x90",   "--map-size", "128",      "--mask"};
    const auto draw = [&](std::vector<std::string> arguments) {
        arguments.insert(arguments.end(), small.begin(), small.end());
        const test::Ran ran = inFolder(folder, arguments);
        EXPECT_EQ(ran.status, 0) << ran.err;
    };
    draw(
        {"render", "sundial", "--path", "day", "--set", "path.speed=60", "--fps", "1", "--frames", "0-1", "-o", "day"});
    draw({"render", "sundial", "--time", "60", "-o", "still.png"});
    const std::string second = test::slurp(folder / "day/frame_0001.png");
    EXPECT_EQ(second, test::slurp(folder / "still.png"));
    EXPECT_NE(second, test::slurp(folder / "day/frame_0000.png"));
}

TEST(PathOfTheDay, IsMeasured)
{
    const test::Folder folder;
    const test::Ran ran = inFolder(folder, {"compare", "sundial", "--camera", "meadow", "--size", "96x54", "--map-size",
                                            "256", "--techniques", "hard,pcf", "--truth", "hard", "--path", "day",
                                            "--frames", "0-3", "--json=-"});
    ASSERT_EQ(ran.status, 0) << ran.err;
    const json result = json::parse(ran.out);
    EXPECT_EQ(result["path"]["name"], "day");
    ASSERT_EQ(result["results"].size(), 2U);
    for (const json& one : result["results"]) {
        EXPECT_GT(one["stability"]["shimmer"].get<double>(), 0.0);
        EXPECT_EQ(one["over_frames"]["rmse"].size(), 4U);
    }
}

/// With the sun between two steps nothing is drawn but what moves, and nothing moves in `planes`.
TEST(PathOfTheDay, CountsWhatIsNotDrawnAgain)
{
    const test::Folder folder;
    const auto reuse = [&](const char* technique) {
        const test::Ran ran = inFolder(folder, {"bench", "planes", "--camera", "side", "--size", "96x54", "--map-size",
                                                "64", "--techniques", technique, "--path", "day", "--fps", "100",
                                                "--frames", "0-7", "--json=-"});
        EXPECT_EQ(ran.status, 0) << ran.err;
        return json::parse(ran.out, nullptr, false)["results"].at(0)["static_reuse"];
    };
    const json followed = reuse("hard");
    const json stepped = reuse("hard+step-jump");
    EXPECT_GT(followed["maps_drawn"].get<double>(), 0.5); // the sun's in every frame
    EXPECT_GT(stepped["maps_held"].get<double>(), followed["maps_held"].get<double>());
    EXPECT_LT(stepped["maps_drawn"].get<double>() + stepped["kept_maps_drawn"].get<double>(), 0.5);
}

/// Techniques hand their state from frame to frame without a message of the validation layer.
class ValidPath : public testing::TestWithParam<const char*> {};

TEST_P(ValidPath, IsSilent)
{
    const test::Folder folder;
    for (const char* path : {"orbit", "day"}) {
        const test::Ran ran =
            inFolder(folder, {"bench", "planes", "--camera", "side", "--size", "96x54", "--map-size", "128",
                              "--techniques", GetParam(), "--path", path, "--frames", "0-3", "--validate"});
        EXPECT_EQ(ran.status, 0) << path << ": " << ran.err;
    }
}
/// Somebody walks through `sundial`, so maps are restored and drawn over from the first frame on, when some of the kept
/// ones were never drawn.
TEST(PathOfTheDay, KeepsMapsInSilence)
{
    const test::Folder folder;
    for (const char* format : {"rgba8", "d32f"}) {
        const test::Ran ran =
            inFolder(folder, {"render", "--preset", "icefall-2010", "--map-format", format,   "--map-size", "128",
                              "--size", "96x54",    "--time",       "300",          "--path", "day",        "--fps",
                              "2",      "--frames", "0-5",          "--validate",   "-o",     format});
        EXPECT_EQ(ran.status, 0) << ran.err;
        EXPECT_EQ(ran.err.find("shows two positions"), std::string::npos) << ran.err;
    }
    // Without a path nothing moves, and who wanted to see two positions hears how.
    const test::Ran still = inFolder(folder, {"render", "--preset", "icefall-2010", "--map-size", "128", "--size",
                                              "96x54", "--time", "300", "-o", "still.png"});
    EXPECT_EQ(still.status, 0) << still.err;
    EXPECT_NE(still.err.find("motion step-blend shows two positions"), std::string::npos) << still.err;
}

INSTANTIATE_TEST_SUITE_P(PathProgram, ValidPath,
                         testing::Values("pcf+cascades+snap", "vsm+tsm", "pcf+step-blend",
                                         "pcf+step-blend+map-format=rgba8", "hard+step-alternate"),
                         [](const auto& technique) {
                             std::string name = technique.param;
                             std::erase_if(name, [](char c) { return c == '+' || c == '-' || c == '='; });
                             return name;
                         });

} // namespace
} // namespace gnomon
