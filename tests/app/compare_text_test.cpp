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
