// SPDX-License-Identifier: Apache-2.0
// Masks that are means over frames, held against the truth: at rest, and along paths.
#include "folder.h"
#include "process.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace gnomon {
namespace {

nlohmann::json comparedWith(const std::vector<std::string>& more)
{
    const test::Folder folder;
    const test::Folder cache;
    std::vector<std::string> arguments{"compare", "--size",      "256x144", "--light", "sun",       "--samples",
                                       "64",      "--sun-angle", "2",       "--json",  "--validate"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const test::Ran ran =
        test::gnomon(arguments, {.folder = folder.path(), .environment = {{"XDG_CACHE_HOME", cache.path().string()}}});
    EXPECT_EQ(ran.status, 0) << ran.err;
    return nlohmann::json::parse(ran.out);
}

TEST(Converge, comesNearerToTheTruthWithEachDoubling)
{
    const nlohmann::json json =
        comparedWith({"rts", "--preset", "plain", "--camera", "unit", "--techniques",
                      "hard+converge+lispsm,hard+converge+cascades,pcf+pcf.kernel=2x2+converge+lispsm,"
                      "raymarch+converge+lispsm",
                      "--map-size", "1024", "--sweep", "converge=1:32:6:log"});
    ASSERT_EQ(json["sweep"]["values"], (std::vector<double>{1, 2, 4, 8, 16, 32}));
    for (const nlohmann::json& line : json["sweep"]["results"]) {
        const std::vector<double> rmse = line["rmse"];
        for (std::size_t i = 1; i < rmse.size(); ++i) {
            EXPECT_LE(rmse[i], rmse[i - 1]) << line["technique"] << " at " << i;
        }
        // With frames of equal weight, raymarch's mean has 0.77 of the first one's error here.
        const bool is_soft = line["technique"].get<std::string>().starts_with("raymarch");
        EXPECT_LT(rmse.back(), (is_soft ? 0.65 : 0.8) * rmse.front()) << line["technique"];
    }
}

TEST(Converge, isNearerAndSteadierAlongPaths)
{
    for (const char* const path : {"pan", "orbit"}) {
        const nlohmann::json json =
            comparedWith({"planes", "--camera", "side", "--techniques", "hard+lispsm,hard+converge+lispsm",
                          "--map-size", "512", "--path", path, "--frames", "0-23"});
        ASSERT_EQ(json["results"].size(), 2U);
        const auto of = [&](const char* soften) {
            for (const nlohmann::json& one : json["results"]) {
                if (one["choices"]["soften"] == soften) {
                    return one;
                }
            }
            return nlohmann::json();
        };
        const nlohmann::json one = of("none");
        const nlohmann::json mean = of("converge");
        EXPECT_LE(mean["error"]["rmse"].get<double>(), 1.1 * one["error"]["rmse"].get<double>()) << path;
        EXPECT_LE(mean["stability"]["shimmer"].get<double>(), 0.65 * one["stability"]["shimmer"].get<double>()) << path;
    }
}

TEST(Converge, saysWhereItHasNoEffect)
{
    const test::Folder folder;
    const auto ran = [&](const std::vector<std::string>& more) {
        std::vector<std::string> arguments{"render", "planes", "--size", "32x18", "-o", "a.png", "--converge", "4"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return test::gnomon(arguments, {.folder = folder.path()});
    };
    EXPECT_EQ(ran({"--strict"}).status, 2);
    EXPECT_NE(ran({}).err.find("--converge has an effect only with soften converge"), std::string::npos);
    EXPECT_EQ(ran({"--soften", "converge", "--frames", "0-3", "--strict"}).status, 2);
    EXPECT_EQ(ran({"--soften", "converge", "--motion", "snap"}).status, 2);
    EXPECT_EQ(ran({"--soften", "converge"}).status, 0);
    const test::Ran alone = test::gnomon({"render", "planes", "--size", "32x18", "-o", "a.png", "--soften", "converge"},
                                         {.folder = folder.path()});
    EXPECT_EQ(alone.status, 0);
    EXPECT_NE(alone.err.find("--converge N draws N at rest"), std::string::npos) << "one frame averages nothing";
}

} // namespace
} // namespace gnomon
