// SPDX-License-Identifier: Apache-2.0
// A result makes its own run again: as a preset, whole or by its settings alone.
#include "folder.h"
#include "process.h"

#include "app/preset.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace gnomon {
namespace {

using nlohmann::json;

/// A folder and a cache of the test's own.
struct Place {
    test::Folder folder;
    test::Folder cache;

    [[nodiscard]] test::Ran run(const std::vector<std::string>& arguments) const
    {
        return test::gnomon(arguments,
                            {.folder = folder.path(), .environment = {{"XDG_CACHE_HOME", cache.path().string()}}});
    }
    [[nodiscard]] json result(const std::vector<std::string>& arguments) const
    {
        const test::Ran ran = run(arguments);
        EXPECT_EQ(ran.status, 0) << ran.err;
        return json::parse(ran.out, nullptr, false);
    }
};

/// Small and quick; `more` adds to it.
std::vector<std::string> compareOf(const std::vector<std::string>& more)
{
    std::vector<std::string> arguments{"compare",       "planes",    "--size", "64x36",    "--map-size",
                                       "128",           "--samples", "16",     "--warmup", "0",
                                       "--repetitions", "1",         "--json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

TEST(Repeat, OneTechniqueOfManyByItsOwnSettings)
{
    const Place place;
    const json first = place.result(compareOf({"--techniques", "hard,pcf+pcf.kernel=7x7+map-size=64"}));
    for (const json& one : first["results"]) {
        test::spill(place.folder / "one.json", one["settings"].dump());
        const json again = place.result({"compare", "planes", "--preset", "one.json", "--json"});
        ASSERT_EQ(again["results"].size(), 1U);
        EXPECT_EQ(again["results"][0]["error"], one["error"]);
    }
}

/// Nothing is timed to choose it, so every run gives the same bits.
TEST(Repeat, ThePathToBlurIsTheSameOnEveryRun)
{
    const Place place;
    const auto expectPath = [](const json& result, const json& path) {
        for (const json& one : result["results"]) {
            EXPECT_EQ(one["counters"]["blur_path"], one["choices"]["filter"] == "vsm" ? path : json(nullptr)) << one;
        }
    };
    const json first = place.result(compareOf({"--techniques", "hard,vsm,esm+blur=none"}));
    expectPath(first, "compute");
    EXPECT_EQ(first["settings"]["techniques"], "hard,vsm,esm+blur=none");
    const json other = place.result(compareOf({"--techniques", "hard,vsm+blur.path=fragment"}));
    expectPath(other, "fragment");
    test::spill(place.folder / "result.json", other.dump());
    expectPath(place.result({"compare", "--preset", "result.json", "--json"}), "fragment");
}

TEST(Repeat, ASweepToo)
{
    const Place place;
    const json first = place.result({"compare", "planes", "--size", "64x36", "--samples", "16", "--sweep",
                                     "map-size=32:64:2", "--json", "--techniques", "hard,pcf"});
    test::spill(place.folder / "result.json", first.dump());
    const json again = place.result({"compare", "--preset", "result.json", "--json"});
    EXPECT_EQ(again["sweep"], first["sweep"]);
    EXPECT_EQ(first["sweep"]["values"].size(), 2U);
}

TEST(Repeat, BenchToo)
{
    const Place place;
    const json first = place.result({"bench", "planes", "--size", "32x18", "--map-size", "64", "--repetitions", "1",
                                     "--warmup", "0", "--techniques", "hard,pcf+pcf.kernel=vogel,vsm,msm", "--json"});
    EXPECT_EQ(first["settings"]["scene"], "planes");
    test::spill(place.folder / "result.json", first.dump());
    const json again = place.result({"bench", "--preset", "result.json", "--json"});
    ASSERT_EQ(again["results"].size(), first["results"].size());
    EXPECT_EQ(again["results"].size(), 4U);
    EXPECT_EQ(again["settings"], first["settings"]);
}

TEST(Repeat, SaysWhenTheSceneIsAnother)
{
    const Place place;
    json result = place.result(compareOf({"--filter", "hard"}));
    test::spill(place.folder / "result.json", result.dump());
    const auto noticed = [&](const std::vector<std::string>& more) {
        std::vector<std::string> arguments{"compare"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        arguments.insert(arguments.end(), {"--preset", "result.json", "--json"});
        const test::Ran ran = place.run(arguments);
        EXPECT_EQ(ran.status, 0) << ran.err;
        return ran.err.find("is not what the preset's result was measured on") != std::string::npos;
    };
    EXPECT_FALSE(noticed({}));
    EXPECT_TRUE(noticed({"spotlit"}));
    test::spill(place.folder / "other.json", R"({"scene": "spotlit"})");
    const test::Ran other = place.run({"compare", "--preset", "result.json", "--preset", "other.json", "--json"});
    EXPECT_EQ(other.err.find("is not what"), std::string::npos); // a scene of which nothing was said
    result["settings"]["scene_hash"] = std::string(32, '0');
    test::spill(place.folder / "result.json", result.dump());
    EXPECT_TRUE(noticed({}));
}

TEST(Repeat, ResultsWithoutSettingsAreRefused)
{
    const test::Folder folder;
    for (const char* text : {R"({"settings": 3})", R"({"settings": [1]})", R"({"settings": {"filtre": "pcf"}})",
                             R"({"version": "1", "results": []})"}) {
        test::spill(folder / "bad.json", text);
        app::Settings settings = app::defaultSettings();
        EXPECT_THROW(app::applyPreset(settings, (folder / "bad.json").string(), app::kCompare), app::UsageError)
            << text;
    }
}

} // namespace
} // namespace gnomon
