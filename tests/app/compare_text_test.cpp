// SPDX-License-Identifier: Apache-2.0
// A comparison in words: what fits in a terminal, what is said of few pixels, of small lights and of truths kept.
#include "folder.h"
#include "process.h"

#include "compare_steps.h"
#include "compare_text.h"
#include "image/image_io.h"
#include "report_html.h"
#include "report_pages.h"
#include "sweep.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace gnomon {
namespace {

using nlohmann::json;

bool says(const std::string& text, const std::string& part)
{
    return text.find(part) != std::string::npos;
}

TEST(CompareTable, LongNamesStandBelowIt)
{
    const std::string longest(app::kTableWidth - 5, 'x');
    const app::TextTable fits{{"name", "x"}, {{longest, "1.5"}}};
    EXPECT_EQ(app::fittedTableText(fits), app::tableText(fits));
    const app::TextTable wide{{"name", "x"}, {{longest + "y", "1.5"}, {"short", "2"}, {longest + "y", "3"}}};
    EXPECT_EQ(app::fittedTableText(wide),
              "name    x\n1     1.5\n2       2\n1       3\n\n  1  " + longest + "y\n  2  short\n");
}

TEST(CompareTable, EveryColumnOfNumbersIsExplained)
{
    const app::Json technique{{"technique", "hard"}, {"equal_error", app::Json::object()}};
    const app::Json sweep{
        {"key", "fov"}, {"values", {1.0}}, {"truth", {nullptr}}, {"pixels", {nullptr}}, {"results", {technique}}};
    const app::Json results = app::Json::array({technique});
    for (const app::Json& result : {app::Json{{"results", results}, {"path", 1}, {"baseline", 1}},
                                    app::Json{{"results", {}}, {"sweep", sweep}}}) {
        const app::TextTable table = app::compareTable(result, false);
        const std::size_t first = result.contains("sweep") ? 2 : 1;
        ASSERT_EQ(table.meanings.size(), table.columns.size());
        EXPECT_GE(table.columns.size(), first + 9);
        for (std::size_t i = 0; i < first; ++i) {
            EXPECT_TRUE(table.meanings[i].empty());
        }
        for (std::size_t i = first; i < table.columns.size(); ++i) {
            EXPECT_GT(table.meanings[i].size(), 10U) << table.columns[i];
        }
    }
}

TEST(PixelsNote, IsOfNoneAndOfFew)
{
    lab::PixelCounts pixels;
    pixels.counted = 100;
    pixels.facing_away = 1900;
    pixels.background = 100000; // which sees no surface
    EXPECT_EQ(app::pixelsNote(app::pixelsJson(pixels), 1), "");
    pixels.counted = 99;
    pixels.facing_away = 1901;
    EXPECT_TRUE(app::pixelsNote(app::pixelsJson(pixels), 1).starts_with("only 99 of 2000 pixels with a surface count"));
    pixels.counted = 0;
    EXPECT_TRUE(
        app::pixelsNote(app::pixelsJson(pixels), 1).starts_with("no pixel counts, so there are no error numbers"));
    EXPECT_FALSE(says(app::pixelsNote(app::pixelsJson(pixels), 1), "no ray was traced"));
    EXPECT_TRUE(app::pixelsNote(app::pixelsJson(pixels), 0).ends_with("; no ray was traced"));
}

TEST(TruthText, SaysWhatWasTracedAndHowFast)
{
    app::TruthFacts truth{.kind = truth::Kind::area, .samples = 64, .rays = 3'000'000, .seconds = 1.5};
    const auto text = [&] {
        return app::truthText({{"truth", app::truthJson(truth, 0.01)}});
    };
    EXPECT_EQ(text(), "area, 64 rays per pixel, standard error 0.0100; 3000000 rays in 1.50 s, 2 million/s");
    truth.from_cache = true; // that was another run's time
    EXPECT_EQ(text(), "area, 64 rays per pixel, standard error 0.0100; 3000000 rays (from the cache)");
    truth = {.kind = truth::Kind::hard, .rays = 1, .seconds = 0.001};
    EXPECT_EQ(text(), "hard, one ray per pixel; 1 ray in less than 0.01 s");
    truth.rays = 0;
    EXPECT_EQ(text(), "hard, one ray per pixel; no rays");
    truth.kind = truth::Kind::area;
    truth.point_like = true;
    EXPECT_EQ(text(), "hard, one ray per pixel, for the light has no area; no rays");
}

/// A cache of the test's own.
struct Place {
    test::Folder folder;
    test::Folder cache;

    [[nodiscard]] test::Ran run(std::vector<std::string> arguments) const
    {
        arguments.insert(arguments.begin(), {"compare", "planes", "--size", "64x36", "--samples", "16"});
        return test::gnomon(arguments,
                            {.folder = folder.path(), .environment = {{"XDG_CACHE_HOME", cache.path().string()}}});
    }
};

const std::vector<std::string> kQuick{"--warmup",     "0",    "--repetitions", "1",
                                      "--techniques", "hard", "--map-size",    "64"};

/// All output of a run is in its result.json, and can be made from it again.
TEST(Compare, TableAndPageAreMadeOfTheJson)
{
    const Place place;
    const std::vector<std::vector<std::string>> runs{
        {"--samples", "16", "--techniques", "hard,pcf,vsm+cascades", "--repetitions", "1", "--warmup", "0",
         "--equal-error"},
        {"--samples", "16", "--techniques", "hard,pcf", "--sweep", "sun-angle=0:8:3"},
        {"--truth", "hard", "--techniques", "hard,pcf", "--path", "orbit", "--frames", "0-2"}};
    for (std::vector<std::string> arguments : runs) {
        arguments.insert(arguments.begin(),
                         {"compare", "planes", "--size", "64x36", "--map-size", "64", "--light", "sun"});
        arguments.insert(arguments.end(), {"--report", "out"});
        const test::Ran ran =
            test::gnomon(arguments, {.folder = place.folder.path(),
                                     .environment = {{"XDG_CACHE_HOME", place.cache.path().string()}}});
        ASSERT_EQ(ran.status, 0) << ran.err;
        const app::Json result = app::Json::parse(test::slurp(place.folder / "out/result.json"));
        EXPECT_EQ(app::compareText(result), ran.out);
        const std::string page = test::slurp(place.folder / "out/index.html");
        const std::size_t pictures = page.find(app::kPicturesTag);
        ASSERT_NE(pictures, std::string::npos);
        EXPECT_EQ(app::comparePage(result, nullptr).substr(0, pictures), page.substr(0, pictures));
    }
}

TEST(Compare, SaysWhatWasTracedOfALightWithoutExtent)
{
    const Place place;
    std::vector<std::string> arguments = kQuick;
    arguments.insert(arguments.end(), {"--sun-angle", "0", "--json"});
    for (const bool cached : {false, true}) {
        const test::Ran ran = place.run(arguments);
        ASSERT_EQ(ran.status, 0) << ran.err;
        const json result = json::parse(ran.out);
        const json& truth = result["truth"];
        EXPECT_EQ(truth["kind"], "hard");
        EXPECT_EQ(truth["requested"], "area");
        EXPECT_EQ(truth["samples"], 1);
        EXPECT_EQ(truth["standard_error"], 0.0);
        EXPECT_EQ(truth["from_cache"], cached);
        EXPECT_EQ(truth["seconds"].is_null(), cached);
        EXPECT_TRUE(!cached || truth["rays_per_second"].is_null());
        EXPECT_TRUE(result["results"][0]["iqr_ms"]["frame"].is_null()); // one frame has no range
        EXPECT_TRUE(result["baseline"]["iqr_ms"]["frame"].is_null());
    }
}

TEST(Compare, ItsMasksCanBeMeasured)
{
    const Place place;
    std::vector<std::string> arguments = kQuick;
    arguments.insert(arguments.end(), {"--report", "out"});
    ASSERT_EQ(place.run(arguments).status, 0);
    for (const char* name : {"out/01_mask.png", "out/truth.png"}) {
        EXPECT_EQ(readImage(place.folder / name).channels, 1U) << name;
    }
    const test::Ran ran =
        test::gnomon({"metrics", "out/01_mask.png", "out/truth.png", "--json"}, {.folder = place.folder.path()});
    ASSERT_EQ(ran.status, 0) << ran.err;
    EXPECT_EQ(json::parse(ran.out)["interpretation"], "grey values as linear visibility");
}

TEST(Sweep, SaysThatItEndsTheAutomaticBias)
{
    const auto ends = [](const char* key, const char* technique) {
        return app::planSweep({key, 0.0, 1.0, 2, false}, {app::parseTechnique(app::defaultSettings(), technique)})
            .ends_automatic_bias;
    };
    EXPECT_TRUE(ends("bias.slope", "hard"));
    EXPECT_FALSE(ends("bias.slope", "hard+bias=none"));
    EXPECT_FALSE(ends("border", "hard"));
    const Place place;
    const test::Ran ran = place.run({"--techniques", "hard", "--map-size", "64", "--sweep", "bias.slope=0:1:2"});
    EXPECT_EQ(ran.status, 0) << ran.err;
    EXPECT_TRUE(says(ran.err, "bias.slope ends the automatic bias")) << ran.err;
}

} // namespace
} // namespace gnomon
