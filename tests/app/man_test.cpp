// SPDX-License-Identifier: Apache-2.0
// The manual page: it names everything, and groff has no complaint.
#include "folder.h"
#include "process.h"

#include "app/command_line.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace gnomon {
namespace {

std::string page()
{
    const test::Folder folder;
    const test::Ran ran = test::gnomon({"man"}, {.folder = folder.path()});
    EXPECT_EQ(ran.status, 0) << ran.err;
    EXPECT_EQ(ran.err, "");
    return ran.out;
}

TEST(Man, NamesEverySubcommandAndSetting)
{
    const std::string text = page();
    const auto has = [&text](const std::string& part) {
        return text.find(part) != std::string::npos;
    };
    for (const char* section : {"NAME", "SYNOPSIS", "DESCRIPTION", "SUBCOMMANDS", "OPTIONS", "SETTINGS", "EXIT STATUS",
                                "ENVIRONMENT", "FILES", "EXAMPLES"}) {
        EXPECT_TRUE(has("\n.SH " + std::string(section) + "\n")) << section;
    }
    for (const app::Subcommand& subcommand : app::subcommands()) {
        EXPECT_TRUE(has("\n.B " + std::string(subcommand.name) + " ")) << subcommand.name;
    }
    for (const app::Setting& setting : app::settingTable()) {
        std::string key;
        for (const char c : setting.key) {
            key += c == '-' ? "\\-" : std::string(1, c);
        }
        EXPECT_TRUE(has("\n.B " + (setting.own_option ? "\\-\\-" + key : key + "=")) || setting.key == "out") << key;
    }
    EXPECT_TRUE(has(".B \\-o, \\-\\-out FILE"));
}

TEST(Man, IsReadByGroffWithoutAWarning)
{
    if (std::system("command -v groff > /dev/null 2>&1") != 0) {
        GTEST_SKIP() << "groff is not installed";
    }
    const test::Folder folder;
    test::spill(folder / "gnomon.1", page());
    const auto groff = [&folder] {
        const std::string command =
            "cd '" + folder.path().string() + "' && groff -ww -man -Tutf8 gnomon.1 > page.txt 2> warnings.txt";
        return std::system(command.c_str());
    };
    EXPECT_EQ(groff(), 0);
    EXPECT_EQ(test::slurp(folder / "warnings.txt"), "");
    EXPECT_GT(test::slurp(folder / "page.txt").size(), 20000U);
    test::spill(folder / "gnomon.1", page() + ".NONSENSE\n");
    (void)groff();
    EXPECT_NE(test::slurp(folder / "warnings.txt"), "") << "it does look";
}

} // namespace
} // namespace gnomon
