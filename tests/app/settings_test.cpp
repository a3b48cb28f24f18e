// SPDX-License-Identifier: Apache-2.0
// The settings from options of truth and comparison.
#include "folder.h"

#include "app/command_line.h"
#include "app/preset.h"
#include "app/shot.h"
#include "contestants.h"
#include "result_json.h"
#include "technique_text.h"

#include <gtest/gtest.h>

namespace gnomon {
namespace {

app::Settings settingsOf(const std::vector<std::string>& arguments)
{
    return app::parseCommandLine(arguments).settings;
}

/// Each is a number of cascades; the other says the same or nothing, so that a technique's text makes it again.
TEST(Settings, OfCascadesEndsAndCountTheLastHolds)
{
    const std::string ends = "cascades.ends=10/40";
    const std::string count = "cascades.count=5";
    const auto with = [](const std::string& one, const std::string& two) {
        return settingsOf({"plan", "--partition", "cascades", "--set", one, "--set", two});
    };
    const app::Settings by_ends = with(count, ends);
    EXPECT_EQ(by_ends.shadow.cascades.count, 3U);
    EXPECT_TRUE(by_ends.shadow.cascades.explicitEnds());
    EXPECT_EQ(by_ends.values.at("cascades.count"), "3");
    const app::Settings by_count = with(ends, count);
    EXPECT_EQ(by_count.shadow.cascades.count, 5U);
    EXPECT_FALSE(by_count.shadow.cascades.explicitEnds());
    EXPECT_FALSE(by_count.values.contains("cascades.ends"));
    for (const app::Settings& one : {by_ends, by_count}) {
        const app::Settings again = app::parseTechnique(settingsOf({"plan"}), app::describeTechnique(one));
        EXPECT_EQ(again.shadow.cascades.count, one.shadow.cascades.count);
        EXPECT_EQ(again.shadow.cascades.ends_m, one.shadow.cascades.ends_m);
    }
}

TEST(Settings, CompareIsAgainstAreaTruthUnlessTold)
{
    EXPECT_EQ(settingsOf({"compare"}).truth, truth::Kind::area);
    EXPECT_EQ(settingsOf({"compare", "--truth", "hard"}).truth, truth::Kind::hard);
    EXPECT_EQ(settingsOf({"compare"}).values.at("truth"), "area");
    EXPECT_EQ(settingsOf({"compare", "--samples", "64"}).samples, 64U);
    EXPECT_FALSE(settingsOf({"render"}).truth.has_value());
    EXPECT_EQ(settingsOf({"render"}).samples, 256U);
    EXPECT_EQ(settingsOf({"compare", "--light", "sun"}).light, "sun"); // without --mask
}

TEST(Settings, PicturesThatAreLookedAtAreSmoothAndThoseThatAreMeasuredAreNot)
{
    const auto of = [](const std::vector<std::string>& arguments) {
        const host::RenderOptions options = app::renderOptions(settingsOf(arguments));
        return std::pair(options.anti_aliasing, options.ambient_occlusion.on);
    };
    using enum host::AntiAliasing;
    for (const char* shows : {"render", "view"}) {
        EXPECT_EQ(of({shows}), std::pair(fxaa, true)) << shows;
        EXPECT_EQ(of({shows, "--aa", "none", "--set", "ambient-occlusion=off"}), std::pair(none, false)) << shows;
    }
    for (const char* measures : {"bench", "compare"}) {
        EXPECT_EQ(of({measures}), std::pair(none, false)) << measures;
    }
    EXPECT_EQ(of({"bench", "--aa", "ssaa4", "--set", "ambient-occlusion=on"}), std::pair(ssaa4, true));
    EXPECT_EQ(of({"render", "--mask"}), std::pair(none, false)) << "a mask is no picture";
    EXPECT_EQ(of({"render", "--shading", "forward"}), std::pair(fxaa, false));
    EXPECT_EQ(of({"render", "--preset", "plain"}), std::pair(fxaa, false));
    for (const char* published : {"shastry-2005", "rts-2011", "icefall-2010", "esm-2008", "startopia-2006"}) {
        const host::RenderOptions options = app::renderOptions(settingsOf({"render", "--preset", published}));
        EXPECT_EQ(options.anti_aliasing, none) << published;
        EXPECT_FALSE(options.ambient_occlusion.on || options.dither) << published;
        EXPECT_EQ(options.tone, host::ToneCurve::filmic) << published;
    }
}

TEST(Settings, SweepsAreTakenApart)
{
    const auto sweep = settingsOf({"compare", "--sweep", "map-size=256:4096:5:log"}).sweep;
    ASSERT_TRUE(sweep.has_value());
    EXPECT_EQ(sweep->key, "map-size");
    EXPECT_EQ(sweep->from, 256.0);
    EXPECT_EQ(sweep->to, 4096.0);
    EXPECT_EQ(sweep->steps, 5U);
    EXPECT_TRUE(sweep->logarithmic);
    const auto down = settingsOf({"compare", "--sweep", "pcf.radius=8:0.5:16"}).sweep;
    ASSERT_TRUE(down.has_value());
    EXPECT_EQ(down->from, 8.0);
    EXPECT_FALSE(down->logarithmic);
    for (const char* key : {"sun-angle", "light-size", "samples", "time", "fov", "seed", "map-size", "max-distance"}) {
        EXPECT_EQ(settingsOf({"compare", "--sweep", std::string(key) + "=16:64:3"}).sweep->key, key);
    }
}

TEST(Settings, SizesOfLightsAreWhatWasSaid)
{
    const app::Shot sun =
        app::makeShot(settingsOf({"render", "planes", "--sun", "0,-1,0", "--truth", "area", "--sun-angle", "90"}));
    ASSERT_EQ(sun.lights.size(), 1U);
    EXPECT_NEAR(sun.lights[0].caster.angular_diameter_rad, 1.5707963, 1e-6);
    const app::Shot lamp = app::makeShot(
        settingsOf({"render", "planes", "--point", "0,5,0,20", "--truth", "area", "--light-size", "0.5"}));
    ASSERT_EQ(lamp.lights.size(), 1U);
    EXPECT_EQ(lamp.lights[0].caster.radius_m, 0.25); // the size is the diameter
}

TEST(Settings, SeveralLampsAreToldApart)
{
    const app::Shot shot = app::makeShot(settingsOf(
        {"render", "planes", "--sun", "0,-1,0", "--point", "0,5,0,20,1,2,3,4", "--mask", "--light", "point 1"}));
    ASSERT_EQ(shot.lights.size(), 3U);
    EXPECT_EQ(shot.lights[1].name, "point 0");
    EXPECT_EQ(shot.lights[2].name, "point 1");
    EXPECT_EQ(shot.lights[2].caster.position_ws, glm::dvec3(1.0, 2.0, 3.0));
    EXPECT_EQ(shot.lights[2].caster.range_m, 4.0);
    EXPECT_NE(shot.lights[1].caster.key, shot.lights[2].caster.key);
}

TEST(Settings, ATruthOfAPresetPassesOverItsTechnique)
{
    const test::Folder folder;
    test::spill(folder / "a.json", R"({"truth": "area", "samples": 64, "sun-angle": 2, "filter": "hard"})");
    const app::Settings settings = settingsOf({"render", "--preset", (folder / "a.json").string()});
    EXPECT_EQ(settings.truth, truth::Kind::area);
    EXPECT_EQ(settings.samples, 64U);
    EXPECT_EQ(settings.sun_angle_deg, 2.0);
    EXPECT_FALSE(settingsOf({"plan", "--preset", (folder / "a.json").string()}).truth.has_value());
}

// Partition and fit have a value of that name; alone in a technique it is both of theirs.
TEST(Settings, AutoInATechniqueIsThatOfEveryChoiceThatHasIt)
{
    const app::Settings base = app::defaultSettings();
    const app::Settings both = app::parseTechnique(base, "pcf+auto+quality=best");
    EXPECT_EQ(both.shadow.technique.partition, Partition::automatic);
    EXPECT_EQ(both.shadow.technique.fit, Fit::automatic);
    EXPECT_EQ(both.shadow.quality, Quality::best);
    const app::Settings again = app::parseTechnique(base, app::describeTechnique(both));
    EXPECT_EQ(again.shadow, both.shadow);
    const app::Settings warp = app::parseTechnique(base, "pcf+single+fit=auto");
    EXPECT_EQ(warp.shadow.technique.partition, Partition::single);
    EXPECT_EQ(warp.shadow.technique.fit, Fit::automatic);
    EXPECT_THROW((void)app::parseTechnique(base, "pcf+auto+lispsm"), app::UsageError) << "the fit twice";
    EXPECT_EQ(
        app::partsWithoutEffect(app::parseTechnique(base, "hard+single+uniform+quality=best"), "quality=best").size(),
        1U);
}

// The filter that nobody names looks at the light's size; those of a list count instead of it.
TEST(Settings, TheLightsSizeIsForTechniquesThatLookAtIt)
{
    const std::vector<std::string> hard{"compare", "planes", "--truth", "hard", "--sun-angle", "2", "--techniques"};
    const auto toldOf = [&hard](const char* techniques) {
        std::vector<std::string> arguments = hard;
        arguments.emplace_back(techniques);
        return app::parseCommandLine(arguments).notices.size();
    };
    EXPECT_EQ(toldOf("hard,pcf"), 1U);
    EXPECT_EQ(toldOf("hard,auto"), 0U);
    EXPECT_EQ(toldOf("hard,pcf+converge"), 0U);
}

// Presets are handed on, so their authors must not choose which files are overwritten here.
TEST(Settings, OfAPresetNameNothingThatIsWritten)
{
    const test::Folder folder;
    const std::string file = (folder / "a.json").string();
    const auto settingsBy = [&](const char* subcommand, const char* text) {
        test::spill(folder / "a.json", text);
        return settingsOf({subcommand, "--preset", file});
    };
    EXPECT_THROW((void)settingsBy("plan", R"({"json": "victim.json"})"), app::UsageError);
    EXPECT_THROW((void)settingsBy("plan", R"({"draw": "victim.svg"})"), app::UsageError);
    EXPECT_THROW((void)settingsBy("render", R"({"out": "victim.png"})"), app::UsageError);
    EXPECT_THROW((void)settingsBy("compare", R"({"report": "victim"})"), app::UsageError);
    EXPECT_THROW((void)settingsBy("render", R"({"report": "victim"})"), app::UsageError) << "of another subcommand";
    EXPECT_THROW((void)settingsBy("plan", R"({"json": "-"})"), app::UsageError);
    EXPECT_THROW((void)settingsBy("compare", R"({"settings": {"json": "victim.json"}})"), app::UsageError);
    // So a result does not say where it is, and is run again without being overwritten.
    const app::Settings settings = settingsOf({"compare", "--json=r.json", "--report", "r", "--seed", "7"});
    const app::Json result = app::settingsJson(settings, app::kCompare);
    EXPECT_EQ(result["seed"], 7);
    EXPECT_FALSE(result.contains("json") || result.contains("report"));
}

// Either would make of one line another.
TEST(Settings, OfAPresetHaveNoNulAndNoEndlessKeys)
{
    const test::Folder folder;
    const auto refusalOf = [&](const std::string& text) -> std::string {
        test::spill(folder / "a.json", text);
        try {
            (void)settingsOf({"plan", "--preset", (folder / "a.json").string()});
        } catch (const app::UsageError& error) {
            return error.what();
        }
        return {};
    };
    EXPECT_TRUE(refusalOf(R"({"size": "16x16\u0000"})").ends_with("size takes no string with a NUL in it"));
    EXPECT_TRUE(refusalOf(R"({"siz\u0000e": "16x16"})").ends_with("a key of 5 bytes is no setting"));
    EXPECT_TRUE(
        refusalOf("{\"" + std::string(100'000, 'k') + "\": 1}").ends_with("a key of 100000 bytes is no setting"));
}

TEST(Contestants, AreTheOnesNamed)
{
    EXPECT_EQ(app::contestants(settingsOf({"compare"})).size(), 17U);
    EXPECT_EQ(app::contestants(settingsOf({"bench"})).size(), 17U);
    EXPECT_EQ(app::contestants(settingsOf({"compare", "--techniques", "all"})).size(), 17U);
    EXPECT_EQ(app::contestants(settingsOf({"compare", "--filter", "hard"})).size(), 1U);
    EXPECT_EQ(app::contestants(settingsOf({"bench", "--techniques", "hard,pcf"})).size(), 2U);
    EXPECT_THROW((void)settingsOf({"bench", "--techniques", "pcf,pcf+pcf.kernel=3x3"}), app::UsageError);
    // A filter and a way to soften others have one name.
    const auto smoothies =
        app::contestants(settingsOf({"bench", "--techniques", "smoothies,hard+smoothies,auto+smoothies"}));
    EXPECT_EQ(smoothies[0].shadow.technique.filter, Filter::smoothies);
    EXPECT_EQ(smoothies[0].shadow.technique.soften, Soften::none);
    EXPECT_EQ(smoothies[1].shadow.technique.filter, Filter::hard);
    EXPECT_EQ(smoothies[1].shadow.technique.soften, Soften::smoothies);
    EXPECT_EQ(smoothies[2].shadow.technique.filter, Filter::automatic);
    EXPECT_EQ(smoothies[2].shadow.technique.soften, Soften::smoothies);
}

} // namespace
} // namespace gnomon
