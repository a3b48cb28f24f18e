// SPDX-License-Identifier: Apache-2.0
// `--path` in the program: frames that are drawn along it, what compare, bench and plan say of it, and what it does not
// go together with.
#include "folder.h"
#include "process.h"

#include "image/image_io.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace gnomon {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

/// A cache of the test's own.
struct Place {
    test::Folder folder;
    test::Folder cache;

    [[nodiscard]] test::Ran run(const std::vector<std::string>& arguments) const
    {
        return test::gnomon(arguments,
                            {.folder = folder.path(), .environment = {{"XDG_CACHE_HOME", cache.path().string()}}});
    }
    /// The result of `compare planes --truth hard` at a small size.
    [[nodiscard]] json compare(const std::vector<std::string>& more) const
    {
        std::vector<std::string> arguments{"compare", "planes", "--size", "160x90", "--truth", "hard", "--json=-"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const test::Ran ran = run(arguments);
        EXPECT_EQ(ran.status, 0) << ran.err;
        return json::parse(ran.out, nullptr, false);
    }
};

TEST(PathProgram, RenderDrawsTheFrames)
{
    const Place place;
    const test::Ran still =
        place.run({"render", "planes", "--size", "160x90", "--map-size", "64", "--mask", "-o", "still.png"});
    ASSERT_EQ(still.status, 0) << still.err;
    const test::Ran ran = place.run({"render", "planes", "--size", "160x90", "--map-size", "64", "--mask", "--path",
                                     "pan", "--set", "path.speed=20", "--frames", "1-3", "-o", "walk"});
    ASSERT_EQ(ran.status, 0) << ran.err;
    const std::string first = test::slurp(place.folder / "walk/frame_0001.png");
    EXPECT_EQ(first, test::slurp(place.folder / "still.png"));
    EXPECT_NE(first, test::slurp(place.folder / "walk/frame_0002.png"));
    EXPECT_TRUE(fs::exists(place.folder / "walk/frame_0003.png"));
    EXPECT_FALSE(fs::exists(place.folder / "walk/frame_0004.png"));
}

/// A single picture has the last frame, with the state that earlier frames left.
TEST(PathProgram, RenderDrawsTheLastFrameIntoAPicture)
{
    const Place place;
    const auto render = [&](const char* frames, const char* target) {
        const test::Ran ran =
            place.run({"render",  "sundial", "--size", "160x90",   "--map-size", "128",        "--camera", "meadow",
                       "--light", "sun",     "--time", "120",      "--motion",   "step-blend", "--mask",   "--path",
                       "day",     "--fps",   "2",      "--frames", frames,       "-o",         target});
        EXPECT_EQ(ran.status, 0) << ran.err;
        return ran.out;
    };
    EXPECT_NE(render("0-2", "walk").find("3 frames of sundial"), std::string::npos);
    EXPECT_NE(render("0-2", "last.png").find("160x90, last of 3 frames of sundial"), std::string::npos);
    (void)render("2-2", "alone.png");
    const std::string last = test::slurp(place.folder / "last.png");
    EXPECT_EQ(last, test::slurp(place.folder / "walk/frame_0002.png"));
    EXPECT_NE(last, test::slurp(place.folder / "alone.png")) << "the shadow is half way to another position";
}

/// The ray tracer's own masks follow the camera too, though nothing of the scene moves.
TEST(PathProgram, TheTruthFollows)
{
    const Place place;
    const test::Ran ran = place.run({"render", "planes", "--size", "160x90", "--mask", "--truth", "hard", "--path",
                                     "orbit", "--set", "path.speed=20", "--frames", "0-1", "-o", "walk"});
    ASSERT_EQ(ran.status, 0) << ran.err;
    EXPECT_NE(test::slurp(place.folder / "walk/frame_0000.png"), test::slurp(place.folder / "walk/frame_0001.png"));
}

void expectStability(const json& one, std::size_t frames)
{
    const json& stability = one["stability"];
    EXPECT_GT(stability["shimmer"].get<double>(), 0.0);
    EXPECT_LT(stability["shimmer"].get<double>(), 0.5);
    EXPECT_GT(stability["pop"].get<double>(), 0.0);
    EXPECT_LE(stability["pop"].get<double>(), stability["shimmer"].get<double>() * std::sqrt(double(frames)));
    EXPECT_EQ(stability["lag"], one["error"]["rmse"]);
    EXPECT_GE(one["pop_frame"].get<std::size_t>(), 6U);
    EXPECT_LT(one["pop_frame"].get<std::size_t>(), 5U + frames);
    const json& error = one["error"];
    const double rmse = error["rmse"];
    const double parts = error["edge"].get<double>() + error["acne"].get<double>() + error["detached"].get<double>() +
                         error["bleeding"].get<double>() + error["terminator"].get<double>();
    EXPECT_NEAR(parts, rmse * rmse, 1e-12);
    ASSERT_EQ(one["over_frames"]["rmse"].size(), frames);
    ASSERT_EQ(one["over_frames"]["mean_abs_change"].size(), frames);
    EXPECT_TRUE(one["over_frames"]["mean_abs_change"][0].is_null());
    double squares = 0.0;
    double largest = 0.0;
    for (std::size_t i = 0; i < frames; ++i) {
        squares += std::pow(one["over_frames"]["rmse"][i].get<double>(), 2.0);
        largest = std::max(largest, i == 0 ? 0.0 : one["over_frames"]["mean_abs_change"][i].get<double>());
    }
    EXPECT_NEAR(std::sqrt(squares / static_cast<double>(frames)), rmse, 1e-12);
    EXPECT_DOUBLE_EQ(largest, stability["pop"].get<double>());
    EXPECT_GT(one["time_ms"]["frame"].get<double>(), 0.0);
}

TEST(PathProgram, CompareHasStability)
{
    const Place place;
    const std::vector<std::string> walk{"--camera", "side",       "--path", "pan",          "--frames",
                                        "5-8",      "--map-size", "128",    "--techniques", "hard,pcf"};
    const json result = place.compare(walk);
    ASSERT_TRUE(result.is_object());
    EXPECT_EQ(result["path"]["name"], "pan");
    EXPECT_EQ(result["path"]["frames"]["first"], 5);
    EXPECT_EQ(result["path"]["frames"]["last"], 8);
    EXPECT_EQ(result["pixels"]["counted"].get<int>() + result["pixels"]["left_out"].get<int>(), 4 * 160 * 90);
    EXPECT_EQ(result["truth"]["from_cache"], false);
    ASSERT_EQ(result["results"].size(), 2U);
    for (const json& one : result["results"]) {
        expectStability(one, 4);
    }
    // From its own settings, with every frame's truth from the cache.
    test::spill(place.folder / "again.json", result.dump());
    const test::Ran again = place.run({"compare", "--preset", "again.json", "--json=-"});
    ASSERT_EQ(again.status, 0) << again.err;
    const json repeated = json::parse(again.out);
    EXPECT_EQ(repeated["truth"]["from_cache"], true);
    EXPECT_EQ(repeated["truth"]["rays"], result["truth"]["rays"]);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(repeated["results"][i]["stability"], result["results"][i]["stability"]);
        EXPECT_EQ(repeated["results"][i]["error"], result["results"][i]["error"]);
    }
}

TEST(PathProgram, OneFrameHasNoStability)
{
    const Place place;
    const test::Ran ran =
        place.run({"compare", "planes", "--size", "160x90", "--truth", "hard", "--map-size", "64", "--techniques",
                   "hard", "--camera", "side", "--path", "dolly", "--frames", "3-3", "--json=-"});
    ASSERT_EQ(ran.status, 0) << ran.err;
    EXPECT_NE(ran.err.find("one frame has no change from frame to frame"), std::string::npos) << ran.err;
    const json result = json::parse(ran.out);
    EXPECT_FALSE(result["results"][0].contains("stability"));
    EXPECT_GT(result["results"][0]["error"]["rmse"].get<double>(), 0.0);
}

TEST(PathProgram, ANightHasNoNumbers)
{
    const Place place;
    // Half a day on: the sun shines straight from below and every pixel faces away from it.
    const json result = place.compare({"--sun", "0,-1,0", "--path", "day", "--set", "path.speed=600", "--frames", "0-5",
                                       "--fps", "10", "--techniques", "hard", "--map-size", "64"});
    const json& rmse = result["results"][0]["over_frames"]["rmse"];
    EXPECT_TRUE(rmse[0].is_number());
    EXPECT_TRUE(rmse[1].is_null()); // after 60 s of the path
    EXPECT_TRUE(rmse[2].is_number());
    EXPECT_TRUE(result["results"][0]["over_frames"]["mean_abs_change"][1].is_null());
    EXPECT_EQ(result["results"][0]["stability"]["shimmer"], nullptr);
    EXPECT_EQ(result["results"][0]["stability"]["pop"], nullptr);
    EXPECT_TRUE(result["results"][0]["stability"]["lag"].is_number());
}

TEST(PathProgram, ReportShowsTheWalk)
{
    const Place place;
    const test::Ran ran =
        place.run({"compare", "planes", "--size", "160x90", "--truth", "hard", "--map-size", "64", "--techniques",
                   "hard,pcf", "--path", "orbit", "--frames", "0-4", "--report", "walk"});
    ASSERT_EQ(ran.status, 0) << ran.err;
    EXPECT_NE(ran.out.find("shimmer"), std::string::npos) << ran.out;
    EXPECT_NE(ran.out.find("orbit, frames 0 to 4"), std::string::npos) << ran.out;
    const json result = json::parse(test::slurp(place.folder / "walk/result.json"));
    EXPECT_EQ(result["report_files"].size(), 3U * (1U + 2U * 3U) + 2U);
    const std::string page = test::slurp(place.folder / "walk/index.html");
    for (const json& name : result["report_files"]) {
        const std::string file = name;
        EXPECT_TRUE(fs::exists(place.folder / "walk" / file)) << file;
    }
    std::size_t masks = 0; // of three frames and two techniques, in the page itself
    for (std::size_t at = page.find("\"mask\":\"data:"); at != std::string::npos;
         at = page.find("\"mask\":\"data:", at + 1)) {
        ++masks;
    }
    EXPECT_EQ(masks, 6U);
    EXPECT_NE(page.find("\"frame\":2,"), std::string::npos);
    // A shorter one takes its place, and what it has not is gone.
    const test::Ran shorter =
        place.run({"compare", "planes", "--size", "160x90", "--truth", "hard", "--map-size", "64", "--techniques",
                   "hard", "--path", "orbit", "--frames", "0-1", "--report", "walk"});
    ASSERT_EQ(shorter.status, 0) << shorter.err;
    EXPECT_TRUE(fs::exists(place.folder / "walk/01_mask_last.png"));
    EXPECT_FALSE(fs::exists(place.folder / "walk/01_mask_middle.png"));
    EXPECT_FALSE(fs::exists(place.folder / "walk/02_mask.png"));
}

TEST(PathProgram, BenchTimesTheFrames)
{
    const Place place;
    const test::Ran ran = place.run({"bench", "planes", "--size", "160x90", "--map-size", "64", "--filter", "hard",
                                     "--path", "pan", "--frames", "0-3", "--json=-"});
    ASSERT_EQ(ran.status, 0) << ran.err;
    const json result = json::parse(ran.out);
    EXPECT_EQ(result["path"]["frames"]["last"], 3);
    EXPECT_GT(result["results"][0]["time_ms"]["frame"].get<double>(), 0.0);
    EXPECT_FALSE(result["results"][0].contains("still_time_ms")); // something moves
    // A free motion follows the camera: every map is drawn in every frame.
    EXPECT_EQ(result["results"][0]["static_mean_texels_rendered"], 2 * 64.0 * 64.0); // sun and spot
}

// Sun and spot are drawn by turns, one in a frame.
TEST(PathProgram, SaysThatLightsWait)
{
    const Place place;
    const std::string said = "until their turn comes: up to 1 light and 1 map in a frame, for ";
    const std::vector<std::vector<std::string>> runs{
        {"plan", "planes"}, {"render", "planes", "-o", "a.png"}, {"bench", "planes", "--json=-"}};
    for (std::vector<std::string> run : runs) {
        for (const char* const more : {"--size", "160x90", "--map-size", "64", "--partition", "single", "--fit",
                                       "uniform", "--path", "pan", "--frames", "0-5"}) {
            run.emplace_back(more);
        }
        const test::Ran free = place.run(run);
        ASSERT_EQ(free.status, 0) << free.err;
        EXPECT_EQ(free.err.find("until their turn comes"), std::string::npos) << free.err;
        run.insert(run.end(), {"--set", "draw-budget=4096"});
        const test::Ran ran = place.run(run);
        ASSERT_EQ(ran.status, 0) << ran.err;
        EXPECT_NE((ran.err + ran.out).find(said), std::string::npos) << run[0] << ": " << ran.err;
    }
}

TEST(PathProgram, PlanFollows)
{
    const Place place;
    const auto view = [&](const std::string& frames) {
        const test::Ran ran = place.run({"plan", "planes", "--size", "160x90", "--path", "pan", "--frames", frames});
        EXPECT_EQ(ran.status, 0) << ran.err;
        return json::parse(ran.out, nullptr, false)["views"][0]["clip_from_world_rows"];
    };
    EXPECT_NE(view("0-0"), view("0-3"));
    EXPECT_EQ(view("0-0"), view("7-7")); // a path starts at its first frame
}

TEST(PathProgram, KeysFromAFile)
{
    const Place place;
    test::spill(place.folder / "walk.json", R"({"keys": [
        {"at": 0, "eye": [6, 5, 8], "target": [0, 1, 0], "sun": [0.6, -0.8, 0]},
        {"at": 0.1, "eye": [6.2, 5, 8], "target": [0.2, 1, 0], "sun": [0.6, -0.75, 0]}]})");
    const json result = place.compare(
        {"--path", "walk.json", "--frames", "0-3", "--techniques", "hard", "--map-size", "64", "--light", "sun"});
    EXPECT_EQ(result["eye"]["position_ws"], json({6.0, 5.0, 8.0}));
    EXPECT_NEAR(result["light_source"]["direction_ws"][1].get<double>(), -0.8, 1e-9);
    EXPECT_GT(result["results"][0]["stability"]["shimmer"].get<double>(), 0.0);
}

struct Wrong {
    const char* name;
    std::vector<std::string> arguments;
    int status;
    std::string says; // part of the line
};
void PrintTo(const Wrong& wrong, std::ostream* out)
{
    *out << wrong.name;
}
class WrongPath : public testing::TestWithParam<Wrong> {};

TEST_P(WrongPath, IsOneLine)
{
    const test::Folder folder;
    test::spill(folder / "walk.json", R"({"keys": [{"at": 0, "eye": [1, 2, 3], "target": [0, 0, 0], "fov": 40,
        "sun": [0, -1, 0.1], "time": 1}]})");
    test::spill(folder / "broken.json", R"({"keys": [{"at": 0, "eye": [1, 2]}]})");
    test::spill(folder / "meet.json", R"({"keys": [{"at": 0, "eye": [5, 0, 0], "target": [-5, 0, 0]},
        {"at": 0.1, "eye": [-5, 0, 0], "target": [5, 0, 0]}]})");
    test::spill(folder / "down.json", R"({"keys": [{"at": 0, "eye": [0, 5, 0], "target": [0, 0, 0]}]})");
    test::spill(folder / "flip.json", R"({"keys": [{"at": 0, "sun": [1, 0, 0]}, {"at": 0.2, "sun": [-1, 0, 0]}]})");
    const test::Ran ran = test::gnomon(GetParam().arguments, {.folder = folder.path()});
    EXPECT_EQ(ran.status, GetParam().status) << ran.err;
    EXPECT_EQ(ran.out, "");
    const auto lines = ran.errorLines();
    ASSERT_EQ(lines.size(), 1U) << ran.err;
    EXPECT_NE(lines[0].find(GetParam().says), std::string::npos) << lines[0];
}

const std::vector<Wrong> kWrong{
    {"NoFrames", {"render", "--path", "pan"}, 2, "--path needs --frames"},
    {"NoPath", {"compare", "planes", "--frames", "0-3"}, 2, "--frames needs --path"},
    {"NoPathInBench", {"bench", "planes", "--frames", "0-3"}, 2, "--frames needs --path"},
    {"Unknown", {"render", "planes", "--path", "orbitt", "--frames", "0-1"}, 2, "did you mean \"orbit\""},
    {"SpeedAlone", {"render", "planes", "--set", "path.speed=2", "--strict"}, 2, "has an effect only with --path"},
    {"SpeedZero",
     {"render", "planes", "--path", "pan", "--frames", "0-1", "--set", "path.speed=0"},
     2,
     "0.001 to 1000"},
    {"Sweep",
     {"compare", "planes", "--path", "pan", "--frames", "0-1", "--sweep", "fov=20:40:2"},
     2,
     "--path and --sweep both say"},
    {"EqualError", {"compare", "planes", "--path", "pan", "--frames", "0-1", "--equal-error"}, 2, "a single frame"},
    {"Repetitions",
     {"bench", "planes", "--path", "pan", "--frames", "0-1", "--repetitions", "3", "--strict"},
     2,
     "--repetitions has no effect with --path"},
    {"Warmup",
     {"compare", "planes", "--path", "pan", "--frames", "0-1", "--warmup", "3", "--strict"},
     2,
     "--warmup has no effect"},
    {"DayOfASpot",
     {"compare", "planes", "--path", "day", "--frames", "0-1", "--light", "spot"},
     2,
     "moves light sun and not spot"},
    {"DayWithoutASun",
     {"render", "planes", "--path", "day", "--frames", "0-1", "--spot", "0,5,0,0,0,0,40"},
     2,
     "there is no directional light"},
    {"KeysAndEye",
     {"render", "planes", "--path", "walk.json", "--frames", "0-1", "--eye", "1,1,1", "--target", "0,0,0"},
     2,
     "both say where the camera is"},
    {"KeysAndCamera", {"render", "planes", "--path", "walk.json", "--frames", "0-1", "--camera", "top"}, 2, "both say"},
    {"KeysAndFov",
     {"render", "planes", "--path", "walk.json", "--frames", "0-1", "--fov", "30"},
     2,
     "both say how wide"},
    {"KeysAndSun",
     {"render", "planes", "--path", "walk.json", "--frames", "0-1", "--sun", "0,-1,0"},
     2,
     "both say where"},
    {"KeysAndTime",
     {"render", "planes", "--path", "walk.json", "--frames", "0-1", "--time", "3"},
     2,
     "both say what time"},
    {"BrokenFile",
     {"render", "planes", "--path", "broken.json", "--frames", "0-1"},
     1,
     "/keys/0/eye: it is no list of"},
    {"Folder", {"render", "planes", "--path", ".", "--frames", "0-1"}, 1, "it is a directory"},
    {"EyeMeetsTarget",
     {"render", "planes", "--path", "meet.json", "--frames", "0-3", "--fps", "20"},
     2,
     "at frame 1 eye and target are the same point"},
    {"StraightDown", {"render", "planes", "--path", "down.json", "--frames", "0-3"}, 2, "looks along its own up"},
    {"SunFlips",
     {"render", "planes", "--path", "flip.json", "--frames", "0-3", "--fps", "10"},
     2,
     "at frame 1 the sun's direction is zero"},
    {"TooFar",
     {"render", "planes", "--camera", "top", "--path", "pan", "--frames", "0-999999", "--fps", "0.001"},
     2,
     "the camera is farther away"},
};
INSTANTIATE_TEST_SUITE_P(PathProgram, WrongPath, testing::ValuesIn(kWrong),
                         [](const auto& wrong) { return wrong.param.name; });

} // namespace
} // namespace gnomon
