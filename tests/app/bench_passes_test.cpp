// SPDX-License-Identifier: Apache-2.0
// Where a frame goes, pass by pass, as `gnomon bench` says.
#include "folder.h"
#include "process.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <map>

namespace gnomon {
namespace {

using nlohmann::json;

TEST(BenchPasses, AreInJson)
{
    const test::Folder folder;
    const test::Ran ran = test::gnomon({"bench", "planes", "--sun", "1,-2,1", "--size", "64x32", "--map-size", "128",
                                        "--repetitions", "2", "--warmup", "0", "--techniques", "vsm+msaa=1", "--json"},
                                       {.folder = folder.path()});
    ASSERT_EQ(ran.status, 0) << ran.err;
    const json bench = json::parse(ran.out);
    const json& result = bench["results"][0];
    std::vector<std::string> names;
    double share = 0.0;
    std::uint64_t fragments = 0;
    std::map<std::string, json> passes;
    for (const json& pass : result["passes"]) {
        names.push_back(pass["name"]);
        passes[names.back()] = pass;
        share += pass["share"].get<double>();
        fragments += pass["fragment_invocations"].get<std::uint64_t>();
        EXPECT_GE(pass["ms"].get<double>(), 0.0);
        EXPECT_TRUE(pass["iqr_ms"].is_number());
    }
    const std::vector<std::string> order{"depth", "g-buffer", "shadow maps", "shadow filter", "mask", "light"};
    EXPECT_EQ(names, order);
    EXPECT_GT(share, 0.0);
    EXPECT_LT(share, 1.5); // medians of passes are not of one frame
    EXPECT_EQ(fragments, result["counters"]["fragment_invocations"].get<std::uint64_t>());
    constexpr std::uint64_t kTexels = 128 * 128;
    constexpr std::uint64_t kPixels = 64 * 32;
    EXPECT_EQ(passes["shadow maps"]["bytes_minimum"], 4 * kTexels);
    EXPECT_EQ(passes["shadow filter"]["texels"], kTexels);
    EXPECT_EQ(passes["shadow filter"]["bytes_minimum"], (4 + 5 * 8) * kTexels); // blurred, read without mip levels
    EXPECT_EQ(passes["mask"]["bytes_minimum"], 5 * kPixels);
    EXPECT_TRUE(passes["g-buffer"]["bytes_minimum"].is_null());
    EXPECT_EQ(bench["baseline"]["passes"][0]["name"], "depth");
    EXPECT_TRUE(bench["baseline"]["passes"][0]["texels"].is_null());
}

/// Where nothing moves the mask stays from the second frame on, but where frames converge.
TEST(BenchPasses, AreNoneOfShadowsWhereNothingMoves)
{
    const test::Folder folder;
    const test::Ran ran =
        test::gnomon({"bench", "planes", "--sun", "1,-2,1", "--size", "64x32", "--map-size", "128", "--repetitions",
                      "4", "--warmup", "3", "--techniques", "pcf,pcf+converge", "--json"},
                     {.folder = folder.path()});
    ASSERT_EQ(ran.status, 0) << ran.err;
    const json bench = json::parse(ran.out);
    const json& still = bench["results"][0];
    EXPECT_EQ(still["still_masks_kept"], 4);
    EXPECT_EQ(still["still_time_ms"]["mask"], 0.0);
    EXPECT_EQ(still["still_time_ms"]["maps"], 0.0);
    EXPECT_GT(still["still_time_ms"]["frame"].get<double>(), 0.0);
    EXPECT_GT(still["still_frame_ratio"].get<double>(), 0.0);
    EXPECT_GT(still["static_time_ms"]["mask"].get<double>(), 0.0);
    EXPECT_EQ(bench["results"][1]["still_masks_kept"], 0);
    EXPECT_GT(bench["results"][1]["still_time_ms"]["mask"].get<double>(), 0.0);
}

/// Surfaces ask the maps themselves, so there is neither G-buffer nor mask.
TEST(BenchPasses, AreThoseOfForwardShading)
{
    const test::Folder folder;
    const auto run = [&](const char* technique) {
        return test::gnomon({"bench", "planes", "--sun", "1,-2,1", "--size", "64x32", "--map-size", "128", "--shading",
                             "forward", "--repetitions", "1", "--warmup", "0", "--techniques", technique, "--json"},
                            {.folder = folder.path()});
    };
    const test::Ran ran = run("pcf");
    ASSERT_EQ(ran.status, 0) << ran.err;
    const json bench = json::parse(ran.out);
    std::vector<std::string> names;
    for (const json& pass : bench["results"][0]["passes"]) {
        names.push_back(pass["name"]);
    }
    EXPECT_EQ(names, (std::vector<std::string>{"depth", "shadow maps", "forward"}));
    EXPECT_GT(bench["results"][0]["counters"]["bytes_minimum"].get<std::uint64_t>(), 0U);
    const test::Ran refused = run("pcf+blur");
    EXPECT_EQ(refused.status, 1);
    EXPECT_NE(refused.err.find("shading pcf+blur"), std::string::npos) << refused.err;
}

/// With several techniques the table would be long.
TEST(BenchPasses, AreATableOfOneTechnique)
{
    const test::Folder folder;
    const auto table = [&](const char* techniques) {
        return test::gnomon({"bench", "planes", "--sun", "1,-2,1", "--size", "16x16", "--map-size", "64",
                             "--repetitions", "1", "--warmup", "0", "--techniques", techniques},
                            {.folder = folder.path()})
            .out;
    };
    const std::string one = table("hard");
    for (const char* word : {"\ng-buffer ", "\nshadow maps ", "\nmask ", "\noutside ", "least MiB"}) {
        EXPECT_NE(one.find(word), std::string::npos) << word << one;
    }
    EXPECT_EQ(table("hard,pcf").find("g-buffer"), std::string::npos);
}

} // namespace
} // namespace gnomon
