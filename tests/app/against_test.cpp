// SPDX-License-Identifier: Apache-2.0
// `gnomon bench --against`: what has grown since an earlier result, by counters and by times, and what is no result.
#include "bench_against.h"
#include "folder.h"
#include "process.h"

#include <gnomon/error.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace gnomon {
namespace {

using app::Json;

/// One technique of two passes: a frame of 20 ms beside one of 10 ms.
Json result()
{
    const auto pass = [](const char* name, double ms, int fragments, int draws) {
        return Json{{"name", name},
                    {"ms", ms},
                    {"iqr_ms", 1.0},
                    {"share", ms / 20.0},
                    {"fragment_invocations", fragments},
                    {"draws", draws},
                    {"texels", nullptr},
                    {"bytes_minimum", 5}};
    };
    Json technique{{"technique", "hard"},
                   {"time_ms", {{"plan", 1.0}, {"frame", 20.0}}},
                   {"iqr_ms", {{"plan", 0.5}, {"frame", 2.0}}},
                   {"frame_ratio", 2.0},
                   {"static_frame_ratio", 1.0},
                   {"counters", {{"texels_rendered", 100}, {"draws", 9}, {"bytes_minimum", 7}}}};
    technique["passes"] = {pass("shadow maps", 8.0, 1000, 9), pass("mask", 4.0, 400, 0)};
    return {{"scene_hash", "abc"},
            {"device", "d"},
            {"driver", "e"},
            {"eye", {{"fov_y_rad", 0.5}}},
            {"lights", Json::array()},
            {"settings", {{"size", "64x64"}, {"map-size", 64}, {"time", 0.0}}},
            {"results", Json::array({technique})}};
}

app::BenchFigures figuresOf(const Json& json)
{
    return app::parseBenchFigures(json.dump(), "file");
}

Json hold(const Json& before, const Json& now)
{
    return app::againstJson(figuresOf(before), figuresOf(now));
}

TEST(Against, TheSameHasNotGrown)
{
    const Json against = hold(result(), result());
    EXPECT_TRUE(against["counters"]["grew"].empty());
    EXPECT_TRUE(against["counters"]["shrank"].empty());
    EXPECT_TRUE(against["times"]["judged"]);
    EXPECT_TRUE(against["times"]["grew"].empty());
    EXPECT_NO_THROW(app::requireNoGrowth(against));
    EXPECT_NE(app::againstText(against).find("no counter has grown"), std::string::npos);
}

TEST(Against, ACounterThatGrewByOneIsNamed)
{
    Json now = result();
    now["results"][0]["passes"][0]["fragment_invocations"] = 1001;
    now["results"][0]["passes"][1]["fragment_invocations"] = 399;
    const Json against = hold(result(), now);
    ASSERT_EQ(against["counters"]["grew"].size(), 1U);
    const Json& grew = against["counters"]["grew"][0];
    EXPECT_EQ(grew["technique"], "hard");
    EXPECT_EQ(grew["pass"], "shadow maps");
    EXPECT_EQ(grew["counter"], "fragment_invocations");
    EXPECT_EQ(grew["before"], 1000);
    EXPECT_EQ(grew["now"], 1001);
    EXPECT_DOUBLE_EQ(grew["factor"], 1.001);
    ASSERT_EQ(against["counters"]["shrank"].size(), 1U);
    EXPECT_EQ(against["counters"]["shrank"][0]["pass"], "mask");
    EXPECT_THROW(app::requireNoGrowth(against), Error);
    const std::string text = app::againstText(against);
    EXPECT_NE(text.find("fragment_invocations    1000  1001   1.001"), std::string::npos) << text;
    EXPECT_NE(text.find("counters that have shrunk: 1"), std::string::npos) << text;
}

TEST(Against, CountersOfTheWholeFrameAreToldOnce)
{
    Json now = result();
    now["results"][0]["counters"] = {{"texels_rendered", 101}, {"draws", 10}, {"bytes_minimum", 8}};
    const Json against = hold(result(), now);
    ASSERT_EQ(against["counters"]["grew"].size(), 1U)
        << against.dump(); // passes have the draws, and a least is no work
    EXPECT_EQ(against["counters"]["grew"][0]["counter"], "texels_rendered");
    EXPECT_EQ(against["counters"]["grew"][0]["pass"], "frame");
}

TEST(Against, APassThatComesOrGoesCountsFromNothing)
{
    Json now = result();
    now["results"][0]["passes"][1]["name"] = "soften";
    const Json against = hold(result(), now);
    ASSERT_EQ(against["counters"]["grew"].size(), 1U);
    EXPECT_EQ(against["counters"]["grew"][0]["pass"], "soften");
    EXPECT_TRUE(against["counters"]["grew"][0]["factor"].is_null());
    ASSERT_EQ(against["counters"]["shrank"].size(), 1U);
    EXPECT_EQ(against["counters"]["shrank"][0]["pass"], "mask");
    EXPECT_EQ(against["counters"]["shrank"][0]["now"], 0);
}

TEST(Against, WhatADeviceDoesNotCountIsNotCompared)
{
    Json now = result();
    now["results"][0]["passes"][0]["fragment_invocations"] = nullptr;
    EXPECT_TRUE(hold(result(), now)["counters"]["shrank"].empty());
    EXPECT_TRUE(hold(now, result())["counters"]["grew"].empty());
}

/// A run on a machine half as fast is the same.
TEST(Against, TimesAreByTheFrameWithoutShadows)
{
    Json now = result();
    Json& technique = now["results"][0];
    for (const char* key : {"plan", "frame"}) {
        technique["time_ms"][key] = 2.0 * technique["time_ms"][key].get<double>();
        technique["iqr_ms"][key] = 2.0 * technique["iqr_ms"][key].get<double>();
    }
    for (Json& pass : technique["passes"]) {
        pass["ms"] = 2.0 * pass["ms"].get<double>();
        pass["iqr_ms"] = 2.0 * pass["iqr_ms"].get<double>();
    }
    EXPECT_TRUE(hold(result(), now)["times"]["grew"].empty());
    technique["passes"][0]["ms"] = 17.9; // 0.095 of the frame without shadows more; it spreads by 0.1
    EXPECT_TRUE(hold(result(), now)["times"]["grew"].empty());
    technique["passes"][0]["ms"] = 18.1;
    const Json against = hold(result(), now);
    ASSERT_EQ(against["times"]["grew"].size(), 1U);
    EXPECT_EQ(against["times"]["grew"][0]["pass"], "shadow maps");
    EXPECT_NEAR(against["times"]["grew"][0]["before"].get<double>(), 0.8, 1e-12);
    EXPECT_NEAR(against["times"]["grew"][0]["now"].get<double>(), 0.905, 1e-12);
    EXPECT_NO_THROW(app::requireNoGrowth(against)); // times are told only
    EXPECT_EQ(hold(now, result())["times"]["shrank"].size(), 1U);
}

TEST(Against, OneSampleHasNoSpread)
{
    Json now = result();
    now["results"][0]["iqr_ms"] = {{"plan", nullptr}, {"frame", nullptr}};
    for (Json& pass : now["results"][0]["passes"]) {
        pass["iqr_ms"] = nullptr;
        pass["ms"] = 1000.0;
    }
    const Json against = hold(result(), now);
    EXPECT_FALSE(against["times"]["judged"]);
    EXPECT_TRUE(against["times"]["grew"].empty());
    EXPECT_NE(app::againstText(against).find("times are not compared"), std::string::npos);
}

TEST(Against, TechniquesOfOneSideAreNamed)
{
    Json now = result();
    now["results"].push_back(now["results"][0]);
    now["results"][1]["technique"] = "pcf";
    Json before = result();
    before["results"].push_back(before["results"][0]);
    before["results"][1]["technique"] = "vsm";
    const Json against = hold(before, now);
    EXPECT_EQ(against["only_before"], Json::array({"vsm"}));
    EXPECT_EQ(against["only_now"], Json::array({"pcf"}));
    const std::string text = app::againstText(against);
    EXPECT_NE(text.find("not in this run: vsm"), std::string::npos) << text;
    EXPECT_NE(text.find("not in the earlier run: pcf"), std::string::npos) << text;
}

TEST(Against, AnotherPictureIsRefused)
{
    const app::BenchFigures earlier = figuresOf(result());
    EXPECT_NO_THROW(app::requireComparable(earlier, result(), {"pcf", "hard"}));
    EXPECT_THROW(app::requireComparable(earlier, result(), {"pcf"}), Error);
    for (const char* place : {"/scene_hash", "/eye/fov_y_rad", "/settings/size", "/settings/time"}) {
        Json other = result();
        other[Json::json_pointer(place)] = 3;
        EXPECT_THROW(app::requireComparable(earlier, other, {"hard"}), Error) << place;
    }
    Json other = result();
    other["settings"]["map-size"] = 32; // a technique's
    EXPECT_NO_THROW(app::requireComparable(earlier, other, {"hard"}));
}

TEST(Against, WhatIsNoResultOfBenchIsAnError)
{
    struct Broken {
        const char* place;
        Json value;
        const char* says;
    };
    const Broken all[] = {
        {"/results", "hard", "/results: it is no list"},
        {"/results", Json::array(), "/results: it has no technique"},
        {"/results/0", 1, "/results/0: it is no object"},
        {"/results/0/technique", 1, "/results/0/technique: it is no name"},
        {"/results/0/technique", std::string(2000, 'x'), "/results/0/technique: it is no name"},
        {"/results/0/passes", {{"shadow maps", 1}}, "/results/0/passes: it is no list"},
        {"/results/0/passes/1/ms", "1", "/results/0/passes/1/ms: it is no number"},
        {"/results/0/passes/1/ms", -1.0, "/results/0/passes/1/ms: it is no number"},
        {"/results/0/passes/1/draws", -1, "/results/0/passes/1/draws: it is no count"},
        {"/results/0/passes/1/name", "shadow maps", "a pass is listed twice: shadow maps"},
        {"/results/0/counters", nullptr, "/results/0/counters: it is no object"},
        {"/results/0/time_ms", 3, "/results/0/time_ms: it is no object"},
        {"/settings", 3, "/settings: it is no object"},
    };
    for (const Broken& broken : all) {
        Json json = result();
        json[Json::json_pointer(broken.place)] = broken.value;
        try {
            (void)figuresOf(json);
            ADD_FAILURE() << broken.place << " was taken";
        } catch (const Error& error) {
            EXPECT_NE(std::string(error.what()).find(broken.says), std::string::npos) << error.what();
        }
    }
    Json json = result();
    json["results"][0].erase("static_frame_ratio"); // as compare's
    EXPECT_THROW((void)figuresOf(json), Error);
    json = result();
    json["results"].push_back(json["results"][0]);
    EXPECT_THROW((void)figuresOf(json), Error);
    for (const char* text : {"", "[]", "{", "{}", "3"}) {
        EXPECT_THROW((void)app::parseBenchFigures(text, "file"), Error) << text;
    }
}

TEST(Against, OfTheProgram)
{
    const test::Folder folder;
    const auto run = [&](std::vector<std::string> more) {
        std::vector<std::string> words{"bench",    "planes",     "--sun",        "1,-2,1",        "--size",
                                       "32x32",    "--map-size", "64",           "--repetitions", "1",
                                       "--warmup", "0",          "--techniques", "hard"};
        words.insert(words.end(), more.begin(), more.end());
        return test::gnomon(words, {.folder = folder.path()});
    };
    ASSERT_EQ(run({"--json=a.json"}).status, 0);
    const test::Ran same = run({"--against", "a.json"});
    EXPECT_EQ(same.status, 0) << same.err;
    EXPECT_NE(same.out.find("against a.json\nno counter has grown; counters that have shrunk: 0\n"), std::string::npos)
        << same.out;
    EXPECT_NE(same.out.find("g-buffer"), std::string::npos) << "no table of the passes\n" << same.out;

    Json planted = Json::parse(test::slurp(folder / "a.json"));
    EXPECT_FALSE(planted["settings"].contains("against"));
    Json& draws = planted["results"][0]["passes"][0]["draws"];
    draws = draws.get<int>() - 1;
    test::spill(folder / "b.json", planted.dump());
    const test::Ran grown = run({"--against", "b.json", "--json=c.json"});
    EXPECT_EQ(grown.status, 1);
    ASSERT_EQ(grown.errorLines().size(), 1U) << grown.err;
    EXPECT_NE(grown.err.find("counters that have grown: 1, the first is draws of depth in hard"), std::string::npos)
        << grown.err;
    const Json written = Json::parse(test::slurp(folder / "c.json"));
    EXPECT_EQ(written["against"]["counters"]["grew"].size(), 1U);
    EXPECT_EQ(written["against"]["file"], "b.json");

    draws = draws.get<int>() + 1;
    planted["driver"] = "another";
    test::spill(folder / "b.json", planted.dump());
    const test::Ran elsewhere = run({"--against", "b.json"});
    EXPECT_EQ(elsewhere.status, 0);
    EXPECT_NE(elsewhere.err.find("may count otherwise"), std::string::npos) << elsewhere.err;

    test::spill(folder / "d.json", R"({"against": "a.json"})");
    EXPECT_EQ(run({"--preset", "d.json"}).status, 2);
    EXPECT_EQ(run({"--against", "nowhere.json"}).status, 1);
    EXPECT_EQ(run({"--against", "d.json"}).status, 1);
    const test::Ran other = run({"--against", "a.json", "--time", "1"});
    EXPECT_EQ(other.status, 1);
    EXPECT_NE(other.err.find("another \"time\""), std::string::npos) << other.err;
}

} // namespace
} // namespace gnomon
