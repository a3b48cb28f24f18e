// SPDX-License-Identifier: Apache-2.0
// `gnomon compare SCENE SCENE...`.
#include "folder.h"
#include "process.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>
#include <vector>

namespace gnomon {
namespace {

using Json = nlohmann::json;

/// Small and quick; `more` are further arguments.
test::Ran compared(const test::Folder& folder, const std::vector<std::string>& more)
{
    std::vector<std::string> arguments{"compare",  "--size",   "64x36",   "--truth",    "hard", "--repetitions",
                                       "1",        "--warmup", "0",       "--map-size", "128",  "--techniques",
                                       "hard,pcf", "--gpu",    "software"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return test::gnomon(arguments, {.folder = folder / ""});
}

TEST(CompareScenes, LooksForAllOfThemFirst)
{
    const test::Folder folder;
    const test::Ran ran = compared(folder, {"planes", "plains", "--report", "out"});
    EXPECT_EQ(ran.status, 1);
    EXPECT_NE(ran.err.find("'plains'"), std::string::npos) << ran.err;
    EXPECT_EQ(ran.err.find("scene 1 of 2"), std::string::npos) << ran.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

TEST(CompareScenes, HoldsTheSameTechniquesInEach)
{
    const test::Folder folder;
    const test::Ran ran = compared(folder, {"planes", "canopies", "planes", "--report", "out", "--json=all.json"});
    ASSERT_EQ(ran.status, 0) << ran.err;
    const Json all = Json::parse(std::ifstream(folder / "all.json"));
    ASSERT_EQ(all["scenes"].size(), 3U);
    EXPECT_EQ(all["scenes"][2]["name"], "planes-2") << "names are folders";
    for (const Json& scene : all["scenes"]) {
        const std::filesystem::path own = folder / "out" / scene["name"].get<std::string>();
        EXPECT_TRUE(std::filesystem::is_regular_file(own / "index.html"));
        EXPECT_EQ(Json::parse(std::ifstream(own / "result.json"))["scene"], scene["result"]["scene"]);
    }
    ASSERT_EQ(all["techniques"].size(), 2U);
    double last = 0.0;
    for (const Json& technique : all["techniques"]) {
        double product = 1.0;
        for (std::size_t i = 0; i < 3; ++i) {
            for (const Json& one : all["scenes"][i]["result"]["results"]) {
                if (one["technique"] == technique["technique"]) {
                    EXPECT_EQ(technique["rmse"][i], one["error"]["rmse"]);
                    product *= std::max(one["error"]["rmse"].get<double>(), 0.001);
                }
            }
        }
        EXPECT_NEAR(technique["mean"].get<double>(), std::cbrt(product), 1e-12);
        EXPECT_GE(technique["mean"].get<double>(), last) << "the least first";
        last = technique["mean"];
    }
    EXPECT_TRUE(std::filesystem::is_regular_file(folder / "out/index.html"));
    EXPECT_EQ(Json::parse(std::ifstream(folder / "out/result.json"))["techniques"], all["techniques"]);
    EXPECT_EQ(compared(folder, {"planes", "canopies", "--report", "out"}).status, 0) << "renewed";
}

TEST(CompareScenes, RefusesWhatIsOfOneScene)
{
    const test::Folder folder;
    const test::Ran swept = compared(folder, {"planes", "canopies", "--sweep", "bias.slope=0:4:2", "--report", "out"});
    EXPECT_EQ(swept.status, 2);
    EXPECT_NE(swept.err.find("--sweep is of one scene"), std::string::npos) << swept.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "out"));
    std::ofstream(folder / "broken.glb") << "glTF"; // it is there, and what is wrong with it is found when it is read
    const test::Ran broken = compared(folder, {"planes", "broken.glb", "--report", "out"});
    EXPECT_NE(broken.status, 0);
    EXPECT_NE(broken.err.find("broken.glb"), std::string::npos) << broken.err;
    EXPECT_TRUE(std::filesystem::is_regular_file(folder / "out/planes/index.html")) << "what is done is kept";
    EXPECT_FALSE(std::filesystem::exists(folder / "out/index.html"));
}

} // namespace
} // namespace gnomon
