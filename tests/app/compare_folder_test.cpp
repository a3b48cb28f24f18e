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
#include <cmath>
#include <filesystem>
#include <sstream>

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

TEST(ReportFiles, AreNumberedByTechnique)
{
    using Names = std::vector<std::string>;
    EXPECT_EQ(app::reportFiles(1), (Names{"truth.png", "01_mask.png", "01_error.png", "01_classes.png",
                                          "01_density.png", "index.html", "result.json"}));
    EXPECT_EQ(app::reportFiles(0), (Names{"truth.png", "index.html", "result.json"})); // of a sweep
}

/// A frame of up to a second; more, or --equal-error, makes it wider.
TEST(CompareTable, Fits120Columns)
{
    app::Json result{{"baseline", app::Json::object()}, {"results", app::Json::array()}};
    for (app::Settings settings : app::contestants(app::defaultSettings())) {
        if (filterTraits(settings.shadow.technique.filter)->filterable) {
            app::applySetting(settings, "blur.path", "fragment"); // the longest name
        }
        result["results"].push_back(
            {{"technique", app::describeTechnique(settings)},
             {"error", app::errorJson(lab::ErrorNumbers{0.1, 0.1, -0.1, 0.9}, lab::ClassErrors{0.01, 0.0, 0.0, 0.0},
                                      {{"ssim", 0.5}, {"flip", 0.5}})},
             {"time_ms", {{"frame", 999.99}}},
             {"frame_ratio", 1.0},
             {"memory_bytes", std::uint64_t{1} << 30U}});
    }
    ASSERT_EQ(result["results"].size(), 17U);
    const app::TextTable table = app::compareTable(result, true);
    EXPECT_EQ(table.rows[0].back(), "1024.0");
    std::istringstream in(app::tableText(table));
    for (std::string line; std::getline(in, line);) {
        EXPECT_LE(line.size(), 120U) << line;
    }
}

TEST(CompareTable, LeavesOutWhatAllTechniquesShare)
{
    const std::vector<std::string> names{"hard+map-size=64+bias=none", "pcf+map-size=64+bias=none+pcf.kernel=3x3"};
    EXPECT_EQ(app::commonParts(names), "map-size=64+bias=none");
    EXPECT_EQ(app::withoutParts(names[1], app::commonParts(names)), "pcf+pcf.kernel=3x3");
    EXPECT_EQ(app::commonParts({"pcf+map-size=64"}), "");
    EXPECT_EQ(app::commonParts({"pcf", "hard"}), "");
    EXPECT_EQ(app::withoutParts("pcf+map-size=64", ""), "pcf+map-size=64");
    EXPECT_EQ(app::commonBlurPath({"hard", "vsm+blur.path=compute", "msm+blur.path=compute"}), "blur.path=compute");
    EXPECT_EQ(app::commonBlurPath({"vsm+blur.path=compute", "vsm+blur.path=fragment"}), "");
    EXPECT_EQ(app::commonBlurPath({"hard", "esm+blur=none"}), "");
}

TEST(CompareTable, CellsShowNumbersOrNone)
{
    EXPECT_EQ(app::cell(0.12345, 3), "0.123");
    EXPECT_EQ(app::cell(std::nullopt, 3), "-");
    EXPECT_EQ(app::cell(std::nan(""), 3), "-");
    using Row = std::vector<std::string>;
    const auto row_of = [](const app::Json& error) {
        return app::compareTable({{"results", app::Json::array({{{"technique", "hard"}, {"error", error}}})}}, false)
            .rows.at(0);
    };
    EXPECT_EQ(row_of(app::errorJson(lab::ErrorNumbers{0.2, 0.1, -0.00001, 0.9},
                                    lab::ClassErrors{0.02, 0.01, 0.0, 0.0, 0.01})),
              (Row{"hard", "0.2000", "0.1000", "0.0000", "50.0", "25.0", "0.0", "0.0", "25.0"}));
    EXPECT_EQ(row_of(app::errorJson(lab::ErrorNumbers{0.2, 0.1, 0.05, 0.9}, lab::ClassErrors{}))[3], "+0.0500");
    EXPECT_EQ(row_of(app::errorJson(lab::ErrorNumbers{0.0, 0.0, -0.05, 0.0}, lab::ClassErrors{})),
              (Row{"hard", "0.0000", "0.0000", "-0.0500", "-", "-", "-", "-", "-"}));
    EXPECT_EQ(row_of(app::errorJson(std::nullopt, std::nullopt)),
              (Row{"hard", "-", "-", "-", "-", "-", "-", "-", "-"}));
    EXPECT_EQ(app::tableText({{"name", "x"}, {{"a", "10"}, {"long name", "2"}}}),
              "name        x\na          10\nlong name   2\n");
}

} // namespace
} // namespace gnomon
