// SPDX-License-Identifier: Apache-2.0
// Holds what every pass counts, in `gnomon bench` of the views of views.json, to recorded.json. On the software
// rasteriser counts are exact and the same on every machine. After a change that is meant to move them:
// GNOMON_COUNTERS_UPDATE=1 test_counters writes recorded.json anew.
#include "recorded.h"
#include "subcommands.h"

#include "app/command_line.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>

namespace gnomon::counters {
namespace {

namespace fs = std::filesystem;
using app::Json;

struct View {
    std::string name;
    std::string scene; // "shared:" in front: a file of the shared scenes
    std::vector<std::string> arguments;
};

/// The text of a failed case for googletest, instead of its bytes.
void PrintTo(const View& view, std::ostream* out)
{
    *out << view.scene;
}

fs::path folder()
{
    return GNOMON_COUNTERS_DIR;
}

std::string recordFile()
{
    return (folder() / "recorded.json").string();
}

Json readViews()
{
    std::ifstream in(folder() / "views.json");
    return Json::parse(in);
}

const std::vector<View>& views()
{
    static const std::vector<View> all = [] {
        const Json json = readViews();
        std::vector<View> made;
        for (const Json& view : json.at("views")) {
            made.push_back({view.at("name"), view.at("scene"), view.at("arguments")});
            for (const char* key : {"size", "map-size", "techniques"}) {
                const Json& value = json.at(key);
                made.back().arguments.push_back(std::string("--") + key);
                made.back().arguments.push_back(value.is_string() ? value.get<std::string>() : value.dump());
            }
        }
        return made;
    }();
    return all;
}

std::vector<std::string> names()
{
    std::vector<std::string> all;
    for (const View& view : views()) {
        all.push_back(view.name);
    }
    return all;
}

bool updating()
{
    return std::getenv("GNOMON_COUNTERS_UPDATE") != nullptr;
}

std::string sceneFile(const std::string& scene)
{
    constexpr std::string_view kShared = "shared:";
    if (!scene.starts_with(kShared)) {
        return scene;
    }
    const char* given = std::getenv("GNOMON_SHARED");
    return (fs::path(given != nullptr ? given : GNOMON_SHARED_DIR) / scene.substr(kShared.size())).string();
}

Json bench(const View& view)
{
    std::vector<std::string> arguments{
        "bench", sceneFile(view.scene), "--gpu", "software", "--repetitions", "1", "--warmup", "0"};
    arguments.insert(arguments.end(), view.arguments.begin(), view.arguments.end());
    return app::findByTiming(app::parseCommandLine(arguments).settings);
}

void record(const View& view, const std::string& driver, const Techniques& techniques)
{
    Recorded recorded = fs::exists(recordFile()) ? readRecorded(recordFile()) : Recorded{};
    recorded.driver = driver;
    recorded.views[view.name] = techniques;
    std::ofstream(recordFile()) << recordedText(recorded, names());
}

class CountersOfViews : public testing::TestWithParam<View> {};

TEST_P(CountersOfViews, AreThoseRecorded)
{
    const View& view = GetParam();
    const std::string scene = sceneFile(view.scene);
    if (scene != view.scene && !fs::exists(scene)) {
        GTEST_SKIP() << "NOT CHECKED: there is no " << scene;
    }
    const Json result = bench(view);
    const std::string driver = result.at("driver");
    if (!driver.starts_with("llvmpipe")) {
        GTEST_SKIP() << "NOT CHECKED: counts are recorded of llvmpipe, and this is " << driver;
    }
    const Techniques now = app::parseBenchFigures(result.dump(), view.name).techniques;
    if (updating()) {
        record(view, driver, now);
        return;
    }
    const Recorded recorded = readRecorded(recordFile());
    ASSERT_TRUE(recorded.views.contains(view.name)) << view.name << " is not recorded";
    std::string text;
    for (const std::string& change : changes(recorded.views.at(view.name), now)) {
        text += "\n  " + view.name + ", " + change;
    }
    EXPECT_TRUE(text.empty())
        << "what passes count has changed:" << text << "\nrecorded of " << recorded.driver << ", counted by " << driver
        << "\nIf it is meant, record anew: GNOMON_COUNTERS_UPDATE=1 build/test_counters, look at the "
           "difference of tests/counters/recorded.json, and commit it with the change";
}

INSTANTIATE_TEST_SUITE_P(Views, CountersOfViews, testing::ValuesIn(views()),
                         [](const auto& test) { return test.param.name; });

TEST(RecordedCounters, AreOfTheseViewsAndTechniques)
{
    if (updating()) {
        GTEST_SKIP() << "they are being written";
    }
    const Recorded recorded = readRecorded(recordFile());
    std::set<std::string> there;
    for (const auto& [name, techniques] : recorded.views) {
        there.insert(name);
        EXPECT_EQ(techniques.size(), 5U) << name;
    }
    const std::vector<std::string> wanted = names();
    EXPECT_EQ(there, std::set<std::string>(wanted.begin(), wanted.end()));
    EXPECT_EQ(wanted.size(), 6U);
    std::ifstream in(recordFile());
    const std::string text(std::istreambuf_iterator<char>(in), {});
    EXPECT_EQ(recordedText(recorded, wanted), text) << "not as it would be written";
}

/// A wrong number in the record is told, whichever it is and in whichever direction.
TEST(RecordedCounters, ThatAreWrongAreFound)
{
    if (updating()) {
        GTEST_SKIP() << "they are being written";
    }
    const Techniques recorded = readRecorded(recordFile()).views.at("rts_camp");
    EXPECT_TRUE(changes(recorded, recorded).empty());
    std::size_t planted = 0;
    for (std::size_t i = 0; i < recorded.size(); ++i) {
        Techniques now = recorded;
        for (app::PassFigures& pass : now[i].passes) {
            for (auto& [name, count] : pass.counts) {
                count += 1;
                const std::vector<std::string> grown = changes(recorded, now);
                ASSERT_EQ(grown.size(), 1U);
                EXPECT_NE(grown[0].find(now[i].name + ", " + pass.name + ": " + name + " has grown from " +
                                        std::to_string(count - 1) + " to " + std::to_string(count)),
                          std::string::npos)
                    << grown[0];
                const std::vector<std::string> shrunk = changes(now, recorded);
                ASSERT_EQ(shrunk.size(), 1U);
                EXPECT_NE(shrunk[0].find(name + " has shrunk"), std::string::npos) << shrunk[0];
                count -= 1;
                ++planted;
            }
        }
        now[i].counts.begin()->second += 1;
        EXPECT_EQ(changes(recorded, now).size(), 1U);
    }
    EXPECT_GT(planted, 100U);
    Techniques fewer = recorded;
    fewer.pop_back();
    EXPECT_EQ(changes(recorded, fewer).size(), 1U);
    EXPECT_EQ(changes(fewer, recorded).size(), 1U);
    fewer = recorded;
    fewer[0].passes.pop_back(); // whose counts are gone
    EXPECT_FALSE(changes(recorded, fewer).empty());
}

} // namespace
} // namespace gnomon::counters
