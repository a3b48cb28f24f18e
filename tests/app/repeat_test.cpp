// SPDX-License-Identifier: Apache-2.0
// A result makes its own run again: as a preset, whole or by its settings alone.
#include "folder.h"
#include "process.h"

#include "app/preset.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
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

/// A list without the paths to blur, which a device chooses.
std::string withoutPaths(std::string techniques)
{
    for (const std::string path : {"+blur.path=compute", "+blur.path=fragment"}) {
        for (auto at = techniques.find(path); at != std::string::npos; at = techniques.find(path)) {
            techniques.erase(at, path.size());
        }
    }
    return techniques;
}

/// Technique and error of every result, in order.
json errorsOf(const json& result)
{
    json errors = json::array();
    for (const json& one : result["results"]) {
        errors.push_back({one["technique"], one["error"]});
    }
    return errors;
}

TEST(Repeat, EveryWayToChooseTechniques)
{
    const Place place;
    struct Case {
        const char* name;
        std::vector<std::string> more;
        const char* techniques; // as the settings have them
        std::size_t count;
        std::vector<const char*> presets = {"settings.json", "result.json"};
    };
    const std::vector<Case> cases{
        {"the default list",
         {},
         "hard,pcf+pcf.kernel=2x2,pcf+pcf.kernel=3x3,pcf+pcf.kernel=5x5,pcf+pcf.kernel=7x7,pcf+pcf.kernel=poisson,"
         "pcf+pcf.kernel=vogel,vsm,lvsm,esm,evsm,msm",
         12,
         {"result.json"}}, // many take long, and which file it is has nothing to do with how many
        {"one by its options", {"--set", "pcf.kernel=vogel", "--set", "pcf.radius=4"}, "pcf+pcf.kernel=vogel", 1},
        {"one without options of its own", {"--filter", "hard", "--bias", "slope=1.5,constant=0.01"}, "hard", 1},
        {"a list", {"--techniques", "pcf+map-size=64,hard"}, "pcf+map-size=64,hard", 2}};
    for (const Case& one : cases) {
        SCOPED_TRACE(one.name);
        const json first = place.result(compareOf(one.more));
        ASSERT_EQ(first["results"].size(), one.count);
        EXPECT_EQ(withoutPaths(first["settings"]["techniques"]), one.techniques);
        EXPECT_EQ(first["settings"]["scene"], "planes");
        EXPECT_EQ(first["settings"]["scene_hash"], first["scene_hash"]);
        test::spill(place.folder / "settings.json", first["settings"].dump());
        test::spill(place.folder / "result.json", first.dump());
        for (const char* preset : one.presets) {
            const json again = place.result({"compare", "--preset", preset, "--json"}); // the scene is in it
            EXPECT_EQ(errorsOf(again), errorsOf(first)) << preset;
            EXPECT_EQ(again["settings"], first["settings"]) << preset;
            EXPECT_EQ(again["scene"], "planes");
        }
    }
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

/// Which path is faster is measured anew by every run: the result says which one it was, and a repeated run keeps it.
TEST(Repeat, ThePathToBlurIsKept)
{
    const Place place;
    const auto pathOf = [](const json& one) {
        return one["counters"]["blur_path"];
    };
    for (const std::vector<std::string>& more :
         {std::vector<std::string>{"--techniques", "hard,vsm,esm+blur=none"}, {"--filter", "vsm"}}) {
        json first = place.result(compareOf(more));
        const auto vsm = std::find_if(first["results"].begin(), first["results"].end(),
                                      [](const json& one) { return one["choices"]["filter"] == "vsm"; });
        ASSERT_NE(vsm, first["results"].end());
        const std::string path = pathOf(*vsm);
        EXPECT_EQ((*vsm)["settings"]["blur.path"], path);
        EXPECT_EQ((*vsm)["technique"].get<std::string>().find("+blur.path=" + path) != std::string::npos, true);
        const std::string other = path == "compute" ? "fragment" : "compute";
        for (const std::string& kept : {path, other}) {
            std::string text = first["settings"].dump();
            for (auto at = text.find(path); at != std::string::npos && kept != path; at = text.find(path)) {
                text.replace(at, path.size(), kept);
            }
            test::spill(place.folder / "result.json", text);
            const json again = place.result({"compare", "--preset", "result.json", "--json"});
            for (const json& one : again["results"]) {
                EXPECT_EQ(pathOf(one), one["choices"]["filter"] == "vsm" ? json(kept) : json(nullptr)) << one;
            }
        }
    }
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
