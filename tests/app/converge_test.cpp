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
    EXPECT_EQ(ran({"--partition", "virtual", "--strict"}).status, 0);
    const test::Ran alone = test::gnomon({"render", "planes", "--size", "32x18", "-o", "a.png", "--soften", "converge"},
                                         {.folder = folder.path()});
    EXPECT_EQ(alone.status, 0);
    EXPECT_NE(alone.err.find("--converge N draws N at rest"), std::string::npos) << "one frame averages nothing";
}

} // namespace
} // namespace gnomon
