// SPDX-License-Identifier: Apache-2.0
// The program's messages about casters whose shadow volumes cannot be counted, and about those without fins.
#include "folder.h"
#include "process.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace gnomon {
namespace {

test::Ran planned(const test::Folder& folder, const std::vector<std::string>& more)
{
    test::How how;
    how.folder = folder.path();
    std::vector<std::string> arguments{"plan", "planes", "--filter", "volumes"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return test::gnomon(arguments, how);
}

TEST(VolumesProgram, RefusesOpenCastersByName)
{
    const test::Folder folder;
    const test::Ran refused = planned(folder, {});
    EXPECT_EQ(refused.status, 1);
    EXPECT_EQ(refused.err,
              "gnomon: counting shadow volumes of planes: mesh ground is open: 4 of its edges have one triangle; leave "
              "such casters out by volumes.open=skip, or choose a filter with maps\n");
    EXPECT_TRUE(refused.out.empty());
}

TEST(VolumesProgram, LeavesThemOutAndSaysSo)
{
    const test::Folder folder;
    const test::Ran planned_without = planned(folder, {"--set", "volumes.open=skip"});
    EXPECT_EQ(planned_without.status, 0) << planned_without.err;
    EXPECT_NE(planned_without.err.find("filter volumes leaves out 1 of 2 objects: mesh ground is open"),
              std::string::npos)
        << planned_without.err;
    EXPECT_NE(planned_without.out.find("\"volume_count\": 1"), std::string::npos);
}

/// Fins need no closed casters, but the outline of their meshes.
TEST(FinsProgram, SaysWhatHasNone)
{
    const test::Folder folder;
    test::How how;
    how.folder = folder.path();
    const auto noticesOf = [&](const char* scene) {
        const test::Ran ran = test::gnomon({"plan", scene, "--filter", "smoothies"}, how);
        EXPECT_EQ(ran.status, 0) << ran.err;
        return ran.err;
    };
    EXPECT_EQ(noticesOf("planes").find("has no fins"), std::string::npos);
    EXPECT_NE(noticesOf("sundial").find("is masked"), std::string::npos);
}

} // namespace
} // namespace gnomon
