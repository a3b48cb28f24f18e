// SPDX-License-Identifier: Apache-2.0
// Compiled alone: it has a variable with the name of another source's function.
// One setting over many values, against one truth.
#include "folder.h"
#include "process.h"

#include "sweep.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace gnomon {
namespace {

app::Settings technique(const std::string& text)
{
    return app::parseTechnique(app::defaultSettings(), text);
}

TEST(SweepPlan, TakesValuesByEqualStepsOrFactors)
{
    const app::SweepPlan steps = app::planSweep({"bias.slope", 0.0, 0.5, 6, false}, {technique("hard")});
    EXPECT_EQ(steps.values, (std::vector<double>{0.0, 0.1, 0.2, 0.3, 0.4, 0.5}));
    EXPECT_EQ(steps.unit, "texel depths");
    const app::SweepPlan factors = app::planSweep({"map-size", 1024.0, 64.0, 5, true}, {technique("hard")});
    EXPECT_EQ(factors.values, (std::vector<double>{1024.0, 512.0, 256.0, 128.0, 64.0}));
    // Whole numbers once each: 4, 4.9, 6, 7.3, 9 by equal factors.
    const app::SweepPlan whole = app::planSweep({"pcf.taps", 4.0, 6.0, 5, true}, {technique("pcf+pcf.kernel=vogel")});
    EXPECT_EQ(whole.values, (std::vector<double>{4.0, 5.0, 6.0}));
    ASSERT_EQ(whole.lines.size(), 1U);
    EXPECT_EQ(whole.lines[0].points[1].shadow.pcf.taps, 5U);
}

TEST(SweepPlan, SetsTheValueAndNamesTheTechniqueWithoutIt)
{
    const app::SweepPlan plan = app::planSweep({"map-size", 64.0, 256.0, 3, true},
                                               {technique("hard+map-size=512"), technique("pcf+bias=none")});
    ASSERT_EQ(plan.lines.size(), 2U);
    EXPECT_EQ(plan.lines[0].technique, "hard");
    EXPECT_EQ(plan.lines[1].technique, "pcf+bias=none+pcf.kernel=3x3");
    for (const app::SweepPlan::Line& line : plan.lines) {
        ASSERT_EQ(line.points.size(), 3U);
        EXPECT_EQ(line.points[0].shadow.map_size, 64U);
        EXPECT_EQ(line.points[2].shadow.map_size, 256U);
    }
}

TEST(SweepPlan, LeavesOutTechniquesThatItDoesNotTouch)
{
    const app::SweepPlan plan =
        app::planSweep({"pcf.radius", 1.0, 4.0, 3, false}, {technique("hard"), technique("pcf+pcf.kernel=poisson")});
    ASSERT_EQ(plan.lines.size(), 1U);
    ASSERT_EQ(plan.left_out.size(), 1U);
    EXPECT_TRUE(plan.left_out[0].starts_with("hard is left out: pcf.radius has an effect only with"));
    EXPECT_EQ(resolvedOrThrow(plan.lines[0].points[2].shadow).border_texels(),
              5.0); // the room that a disc of 4 texels needs
    EXPECT_THROW((void)app::planSweep({"pcf.radius", 1.0, 4.0, 3, false}, {technique("hard")}), app::UsageError);
    EXPECT_THROW((void)app::planSweep({"map-size", 64.0, 128.0, 2, false},
                                      {technique("hard+map-size=64"), technique("hard+map-size=512")}),
                 app::UsageError);
}

TEST(SweepPlan, KeepsABorderThatIsSwept)
{
    const app::SweepPlan plan = app::planSweep({"border", 0.0, 8.0, 3, false}, {technique("hard")});
    EXPECT_EQ(plan.lines[0].points[0].shadow.border_texels, 0.0);
    EXPECT_EQ(plan.lines[0].points[2].shadow.border_texels, 8.0);
}

TEST(SweepPlan, RoundsToMultiplesAndKnowsWhatMakesTheShotAnew)
{
    const std::vector<app::Settings> techniques{technique("hard")};
    app::Settings area = techniques[0];
    area.truth = truth::Kind::area;
    const app::SweepPlan samples = app::planSweep({"samples", 4.0, 64.0, 7, false}, {area});
    EXPECT_EQ(samples.values, (std::vector<double>{4.0, 16.0, 24.0, 36.0, 44.0, 56.0, 64.0}));
    EXPECT_TRUE(samples.remakes_shot);
    EXPECT_FALSE(app::planSweep({"map-size", 64.0, 128.0, 2, false}, techniques).remakes_shot);
    EXPECT_EQ(app::settingsAt(samples, 2, area).samples, 24U);
    EXPECT_EQ(app::placeText(samples.key, samples.values[2]), "samples=24");
    EXPECT_THROW((void)app::planSweep({"samples", 4.0, 64.0, 7, false}, techniques), app::UsageError); // no truth
    // All digits of a large whole number.
    const app::SweepPlan seeds = app::planSweep({"seed", 1.0, 9e15, 2, false}, techniques);
    EXPECT_EQ(app::settingsAt(seeds, 1, techniques[0]).seed, 9000000000000000U);
}

TEST(Sweep, HasNoNumbersWhereNoPixelCounts)
{
    app::SweepResult result;
    result.plan = app::planSweep({"map-size", 256.0, 64.0, 3, true}, {technique("hard")});
    result.points = {{{lab::ErrorNumbers{0.1, 0.0, 0.0, 0.0}, lab::ClassErrors{0.0075, 0.0025, 0.0, 0.0}, {}},
                      {std::nullopt, {}, {}},
                      {lab::ErrorNumbers{0.4, 0.0, 0.0, 0.0}, lab::ClassErrors{0.16, 0.0, 0.0, 0.0}, {}}}};
    const app::Json json = app::sweepJson(result);
    EXPECT_TRUE(json["results"][0]["rmse"][1].is_null());
    EXPECT_TRUE(json["results"][0]["acne"][1].is_null());
    EXPECT_FALSE(json["results"][0]["settings"].contains("map-size"));
    EXPECT_EQ(json["class_colours"]["acne"], "#d55e00");
}

TEST(Sweep, ErrorFallsAsTheMapGrows)
{
    const test::Folder folder;
    const test::Folder cache;
    const test::Ran ran =
        test::gnomon({"compare", "planes", "--size", "160x90", "--samples", "16", "--sun", "1,-2,0.7", "--techniques",
                      "hard,pcf", "--sweep", "map-size=64:1024:3:log", "--report", "out", "--json"},
                     {.folder = folder.path(), .environment = {{"XDG_CACHE_HOME", cache.path().string()}}});
    ASSERT_EQ(ran.status, 0) << ran.err;
    const nlohmann::json result = nlohmann::json::parse(ran.out);
    EXPECT_TRUE(result["results"].empty());
    const nlohmann::json& sweep = result["sweep"];
    EXPECT_EQ(sweep["key"], "map-size");
    EXPECT_EQ(sweep["unit"], "texels");
    EXPECT_EQ(sweep["values"], (std::vector<double>{64, 256, 1024}));
    ASSERT_EQ(sweep["results"].size(), 2U);
    for (const auto& line : sweep["results"]) {
        const std::vector<double> rmse = line["rmse"];
        ASSERT_EQ(rmse.size(), 3U);
        EXPECT_GT(rmse[0], 2.0 * rmse[2]) << line;
        for (std::size_t i = 0; i < rmse.size(); ++i) {
            double parts = 0.0;
            for (const char* part : {"edge", "acne", "detached", "bleeding", "terminator"}) {
                parts += line[part][i].get<double>();
            }
            EXPECT_NEAR(parts, rmse[i] * rmse[i], 1e-12);
        }
    }
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "out")) {
        names.push_back(entry.path().filename().string());
    }
    std::sort(names.begin(), names.end());
    EXPECT_EQ(names, (std::vector<std::string>{"index.html", "result.json", "truth.png"}));
    EXPECT_TRUE(result["notes"].empty());
    EXPECT_EQ(result["sweep"]["results"][1]["commands"][2],
              "gnomon compare planes --size=160x90 --sun=1,-2,0.7 --truth=area --samples=16 "
              "--techniques=pcf+map-size=1024+pcf.kernel=3x3");
}

/// One truth cache for all its runs.
class SweepOfTheShot : public testing::Test {
protected:
    nlohmann::json run(const std::vector<std::string>& more)
    {
        std::vector<std::string> arguments{"compare",    "planes", "--size",       "80x45", "--camera", "side",
                                           "--map-size", "512",    "--techniques", "hard",  "--json"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const test::Ran ran = test::gnomon(
            arguments, {.folder = folder.path(), .environment = {{"XDG_CACHE_HOME", cache.path().string()}}});
        EXPECT_EQ(ran.status, 0) << ran.err;
        last_error = ran.err;
        return nlohmann::json::parse(ran.out);
    }
    test::Folder folder;
    test::Folder cache;
    std::string last_error;
};

/// Each point is what a run with that value alone finds.
TEST_F(SweepOfTheShot, HoldsEachSunAgainstItsOwnTruth)
{
    const std::vector<std::string> common{"--samples", "16", "--sun", "1,-2,0.7"};
    const auto with = [&](std::vector<std::string> more) {
        more.insert(more.end(), common.begin(), common.end());
        return run(more);
    };
    const nlohmann::json result = with({"--sweep", "sun-angle=0:8:3", "--report", "out"});
    EXPECT_EQ(last_error.find("no extent"), std::string::npos) << last_error; // only one of them has none
    const nlohmann::json& sweep = result["sweep"];
    EXPECT_EQ(sweep["unit"], "degrees");
    EXPECT_EQ(sweep["values"], (std::vector<double>{0.0, 4.0, 8.0}));
    ASSERT_EQ(sweep["truth"].size(), 3U);
    ASSERT_EQ(sweep["pixels"].size(), 3U);
    EXPECT_EQ(sweep["truth"][0]["standard_error"], 0.0);
    EXPECT_GT(sweep["truth"][2]["standard_error"].get<double>(), 0.0);
    EXPECT_EQ(result["truth"], sweep["truth"][0]);
    EXPECT_EQ(result["light_source"]["angular_diameter_rad"], 0.0);
    EXPECT_FALSE(result["settings"].contains("sun-angle"));
    const std::vector<double> rmse = sweep["results"][0]["rmse"];
    ASSERT_EQ(rmse.size(), 3U);
    EXPECT_LT(rmse[0], rmse[1]); // a hard shadow is ever farther from that of a wider sun
    EXPECT_LT(rmse[1], rmse[2]);
    const nlohmann::json alone = with({"--sun-angle", "8", "--repetitions", "1", "--warmup", "0"});
    EXPECT_EQ(alone["truth"]["from_cache"], true); // the sweep kept it
    EXPECT_EQ(alone["results"][0]["error"]["rmse"], rmse[2]);
    EXPECT_EQ(alone["pixels"], sweep["pixels"][2]);
    EXPECT_TRUE(test::slurp(folder / "out/index.html").find("at sun-angle=0") != std::string::npos);
}

TEST_F(SweepOfTheShot, TakesAnyNumber)
{
    const nlohmann::json samples = run({"--sun-angle", "8", "--sweep", "samples=4:64:3:log"});
    EXPECT_EQ(samples["sweep"]["values"], (std::vector<double>{4, 16, 64}));
    EXPECT_GT(samples["sweep"]["truth"][0]["standard_error"], samples["sweep"]["truth"][2]["standard_error"]);
    EXPECT_EQ(samples["sweep"]["truth"][2]["samples"], 64);

    const nlohmann::json sizes = run({"--samples", "16", "--light", "spot", "--sweep", "light-size=0.05:1:2"});
    EXPECT_LT(sizes["sweep"]["results"][0]["rmse"][0], sizes["sweep"]["results"][0]["rmse"][1]);

    const nlohmann::json fields = run({"--truth", "hard", "--sweep", "fov=20:60:2"});
    EXPECT_NE(fields["sweep"]["pixels"][0], fields["sweep"]["pixels"][1]);
    EXPECT_NEAR(fields["eye"]["fov_y_rad"].get<double>(), 20.0 * 3.14159265358979 / 180.0, 1e-9);

    const nlohmann::json seeds = run({"--sun-angle", "8", "--samples", "16", "--sweep", "seed=1:2:2"});
    EXPECT_EQ(seeds["sweep"]["truth"][1]["seed"], 2);
    EXPECT_NE(seeds["sweep"]["results"][0]["rmse"][0], seeds["sweep"]["results"][0]["rmse"][1]);

    // Nothing moves here: the second moment's truth is the first one's.
    const nlohmann::json times = run({"--truth", "hard", "--sweep", "time=0:1:2"});
    EXPECT_EQ(times["sweep"]["truth"][1]["from_cache"], true);
    EXPECT_EQ(times["sweep"]["results"][0]["rmse"][0], times["sweep"]["results"][0]["rmse"][1]);
}

} // namespace
} // namespace gnomon
