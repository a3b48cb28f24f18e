// SPDX-License-Identifier: Apache-2.0
// A report's folder and the tables of a comparison, without a run.
#include "folder.h"

#include "compare_folder.h"
#include "compare_table.h"
#include "compare_text.h"
#include "contestants.h"
#include "image/image_io.h"
#include "technique_json.h"

#include <gnomon/error.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

namespace gnomon {
namespace {

namespace fs = std::filesystem;

/// In alphabetical order.
std::vector<std::string> namesIn(const fs::path& folder)
{
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder)) {
        names.push_back(entry.path().filename().string());
    }
    std::sort(names.begin(), names.end());
    return names;
}

TEST(ReportFolder, GoesAwayUnlessItIsKept)
{
    const test::Folder folder;
    const std::vector<std::string> files = app::reportFiles(1);
    {
        app::ReportFolder report(folder / "out", files);
        report.write("result.json", "{}");
        report.write("01_mask.png", Image8(4, 4, 1));
        EXPECT_FALSE(fs::exists(folder / "out")); // not before all is there
    }
    EXPECT_TRUE(folder.names().empty());
    {
        app::ReportFolder report(folder / "new/", files);
        report.write("result.json", "{}");
        report.keep();
    }
    EXPECT_EQ(namesIn(folder / "new"), std::vector<std::string>{"result.json"});
    EXPECT_THROW(app::ReportFolder(folder / "new/result.json", files), Error);
    EXPECT_THROW(app::ReportFolder(folder / "none/out", files), Error);
    fs::create_symlink(folder / "nowhere", folder / "link");
    EXPECT_THROW(app::ReportFolder(folder / "link", files), Error) << "before the work";
}

TEST(ReportFolder, ChangesAnotherOnlyWhenKept)
{
    const test::Folder folder;
    test::spill(folder / "mine.txt", "keep me");
    test::spill(folder / "03_mask.png", "old");
    test::spill(folder / "2024_mask.png", "no report's: not in its list");
    test::spill(folder / "result.json", R"({"report_files": ["03_mask.png", "result.json", "mine.txt", "../x", 3]})");
    const std::vector<std::string> before = namesIn(folder.path());
    {
        app::ReportFolder report(folder.path(), app::reportFiles(0));
        report.write("result.json", "new");
    }
    EXPECT_EQ(namesIn(folder.path()), before);
    EXPECT_NE(test::slurp(folder / "result.json"), "new");
    app::ReportFolder report(folder.path(), app::reportFiles(0));
    report.write("result.json", "new");
    report.write("truth.png", "new");
    report.keep();
    EXPECT_EQ(test::slurp(folder / "result.json"), "new");
    EXPECT_TRUE(fs::exists(folder / "truth.png"));
    EXPECT_FALSE(fs::exists(folder / "03_mask.png")); // the earlier report's alone
    EXPECT_TRUE(fs::exists(folder / "2024_mask.png"));
    EXPECT_TRUE(fs::exists(folder / "mine.txt"));
}

} // namespace
} // namespace gnomon
