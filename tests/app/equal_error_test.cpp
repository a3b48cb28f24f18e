// SPDX-License-Identifier: Apache-2.0
// The PCF that errs no more than a technique, and what the technique costs beside it.
#include "folder.h"
#include "process.h"

#include "equal_error.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <set>

namespace gnomon {
namespace {

app::Settings base(const std::string& technique = "pcf")
{
    app::Settings settings = app::defaultSettings();
    app::applySetting(settings, "size", "64x36");
    return app::parseTechnique(settings, technique);
}

TEST(PcfLadder, HoldsEveryKernelAndSizeCheapestFirst)
{
    const auto ladder = app::pcfLadder(base(), 8192);
    EXPECT_EQ(ladder.size(), 19U * 6U);
    std::set<std::string> names;
    for (const app::PcfSetting& rung : ladder) {
        EXPECT_TRUE(app::isPlainPcf(rung.settings));
        names.insert(app::describeTechnique(rung.settings));
    }
    EXPECT_EQ(names.size(), ladder.size());
    EXPECT_TRUE(std::is_sorted(ladder.begin(), ladder.end(),
                               [](const app::PcfSetting& a, const app::PcfSetting& b) { return a.work < b.work; }));
    EXPECT_EQ(app::describeTechnique(ladder.front().settings), "pcf+uniform+single+map-size=16+pcf.kernel=2x2");
    EXPECT_EQ(app::describeTechnique(ladder.back().settings), "pcf+uniform+single+map-size=8192+pcf.kernel=7x7");
    EXPECT_EQ(ladder.front().work, 16.0 * 16.0 + 64.0 * 36.0 * 4.0);
}

TEST(PcfLadder, StopsAtTheDevicesLargestMap)
{
    for (const app::PcfSetting& rung : app::pcfLadder(base(), 2047)) {
        EXPECT_LE(rung.settings.shadow.map_size, 1448U);
    }
    EXPECT_EQ(app::pcfLadder(base(), 2047).size(), 14U * 6U);
    EXPECT_TRUE(app::pcfLadder(base(), 15).empty());
}

TEST(PcfLadder, IsPlainWhateverTheBaseAsksFor)
{
    for (const app::PcfSetting& rung : app::pcfLadder(base("hard+map-format=d16+bias=none"), 512)) {
        EXPECT_TRUE(app::isPlainPcf(rung.settings));
        EXPECT_FALSE(rung.settings.shadow.bias.automatic); // all else stays
        EXPECT_FALSE(refusal(Filter::pcf, formatOf(rung.settings.shadow)).has_value());
    }
    EXPECT_FALSE(app::isPlainPcf(base("hard")));
    EXPECT_TRUE(app::isPlainPcf(base("pcf+single+uniform+pcf.kernel=7x7")));
}

TEST(FirstWithin, AsksInOrderAndNoFurtherThanNeeded)
{
    const std::vector<std::optional<double>> errors{0.5, 0.3, std::nullopt, 0.2, 0.1};
    std::uint32_t tried = 0;
    const auto error_of = [&](std::size_t i) {
        return errors[i];
    };
    EXPECT_EQ(app::firstWithin(errors.size(), 0.2, error_of, tried), 3U);
    EXPECT_EQ(tried, 4U);
    tried = 0;
    EXPECT_EQ(app::firstWithin(errors.size(), 0.5, error_of, tried), 0U);
    EXPECT_EQ(tried, 1U);
    tried = 0;
    EXPECT_EQ(app::firstWithin(errors.size(), 0.05, error_of, tried), std::nullopt);
    EXPECT_EQ(tried, 5U);
}

nlohmann::json compared(const std::vector<std::string>& more)
{
    const test::Folder folder;
    const test::Folder cache;
    std::vector<std::string> arguments{"compare",  "planes", "--size",        "48x27", "--samples",     "16",
                                       "--warmup", "0",      "--repetitions", "1",     "--equal-error", "--json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const test::Ran ran =
        test::gnomon(arguments, {.folder = folder.path(), .environment = {{"XDG_CACHE_HOME", cache.path().string()}}});
    EXPECT_EQ(ran.status, 0) << ran.err;
    return nlohmann::json::parse(ran.out);
}

TEST(EqualError, FindsAPcfThatErrsNoMore)
{
    const auto result = compared({"--techniques", "hard+map-size=64,pcf+single+uniform+map-size=64"});
    ASSERT_EQ(result["results"].size(), 2U);
    for (const auto& one : result["results"]) {
        const auto& equal = one["equal_error"];
        if (one["choices"]["filter"] == "pcf") {
            EXPECT_TRUE(one["equal_error_ratio"].is_null());
            EXPECT_EQ(equal["reason"], "it is PCF itself");
            continue;
        }
        EXPECT_LE(equal["rmse"], one["error"]["rmse"]) << equal;
        EXPECT_TRUE(equal["technique"].get<std::string>().starts_with("pcf+")) << equal;
        EXPECT_GT(equal["tried"], 1);
        EXPECT_GT(equal["cheaper"]["rmse"], one["error"]["rmse"]) << equal;
        EXPECT_TRUE(equal["reason"].is_null());
        EXPECT_NEAR(one["equal_error_ratio"].get<double>(),
                    equal["frame_ms"]["technique"].get<double>() / equal["frame_ms"]["pcf"].get<double>(), 1e-9);
    }
}

TEST(EqualError, RatioOfTheShadowsLeavesOutTheRestOfTheFrame)
{
    const auto result = compared({"--techniques", "hard+map-size=64", "--repetitions", "5"});
    const auto& one = result["results"][0];
    const auto& frame = one["equal_error"]["frame_ms"];
    const double without = frame["without_shadows"];
    const double technique = frame["technique"].get<double>() - without;
    const double pcf = frame["pcf"].get<double>() - without;
    if (technique > 0.0 && pcf > 0.0) {
        EXPECT_NEAR(one["equal_error_shadow_ratio"].get<double>(), technique / pcf, 1e-9) << one;
    } else {
        EXPECT_TRUE(one["equal_error_shadow_ratio"].is_null()) << one;
    }
}

/// Worse than the worst PCF there is: any ratio would be of unequal errors.
TEST(EqualError, GivesNoRatioBelowTheCheapestPcf)
{
    const auto result =
        compared({"--techniques", "hard+map-size=16+bias.normal=0+bias.slope=0+bias.constant=-1", "--sun", "1,-1,0.3"});
    const auto& one = result["results"][0];
    EXPECT_TRUE(one["equal_error_ratio"].is_null()) << one;
    EXPECT_TRUE(one["equal_error_shadow_ratio"].is_null()) << one;
    EXPECT_EQ(one["equal_error"]["tried"], 1);
    EXPECT_LT(one["equal_error"]["rmse"], one["error"]["rmse"]);
    EXPECT_TRUE(one["equal_error"]["reason"].get<std::string>().find("the cheapest there is, errs less") !=
                std::string::npos)
        << one;
}

TEST(EqualError, SaysWhyThereIsNone)
{
    const auto result = compared({"--techniques", "hard+map-size=64", "--sun", "0,1,0"});
    const auto& one = result["results"][0];
    EXPECT_TRUE(one["equal_error_ratio"].is_null());
    EXPECT_EQ(one["equal_error"]["reason"], "no pixel counts, so there is no error to match");
    EXPECT_TRUE(one["equal_error"]["technique"].is_null());
}

} // namespace
} // namespace gnomon
