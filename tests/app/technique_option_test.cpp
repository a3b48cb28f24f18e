// SPDX-License-Identifier: Apache-2.0
// A technique in one word, on the command line, in presets and in files of them.
#include "folder.h"
#include "process.h"

#include "app/command_line.h"
#include "contestants.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <sys/stat.h>

namespace gnomon {
namespace {

app::Settings settingsOf(const std::vector<std::string>& arguments)
{
    return app::parseCommandLine(arguments).settings;
}

TEST(TechniqueOption, IsTheSameAsItsParts)
{
    for (const char* subcommand : {"render", "plan"}) {
        const app::Settings one = settingsOf({subcommand, "--technique", "pcf+sdsm+lispsm+map-size=1024"});
        const app::Settings parts =
            settingsOf({subcommand, "--filter", "pcf", "--partition", "sdsm", "--fit", "lispsm", "--map-size", "1024"});
        EXPECT_EQ(one.values, parts.values) << subcommand;
        EXPECT_EQ(one.shadow, parts.shadow) << subcommand;
    }
}

/// The option takes the text that `compare` prints for any technique.
TEST(TechniqueOption, TakesWhatComparePrints)
{
    for (const app::Settings& technique : app::contestants(settingsOf({"compare", "--techniques", "all"}))) {
        const std::string text = app::describeTechnique(technique);
        EXPECT_EQ(app::describeTechnique(settingsOf({"render", "--technique", text, "--strict"})), text);
    }
}

TEST(TechniqueOption, IsTheOneOfBenchAndCompare)
{
    for (const char* subcommand : {"bench", "compare"}) {
        for (const char* text : {"msm", "cascades", "pcf+pcf.kernel=5x5"}) {
            const app::Settings settings = settingsOf({subcommand, "--technique", text});
            EXPECT_EQ(app::contestants(settings).size(), 1U) << text;
            EXPECT_EQ(settings.shadow, app::parseTechnique(app::defaultSettings(), text).shadow) << text;
        }
    }
}

TEST(TechniqueOption, GoesWithOptionsThatSayTheSameOrSomethingElse)
{
    const app::Settings same = settingsOf({"plan", "--technique", "pcf+map-size=64", "--filter", "pcf"});
    EXPECT_EQ(same.shadow.map_size, 64U);
    const app::Settings more =
        settingsOf({"plan", "--technique", "pcf", "--map-size", "128", "--set", "pcf.kernel=vogel"});
    EXPECT_EQ(more.shadow.map_size, 128U);
    EXPECT_EQ(more.shadow.pcf.kernel, PcfKernel::vogel);
    // Parts of a bias end `none`, and do not contradict it.
    EXPECT_NO_THROW((void)settingsOf({"plan", "--technique", "hard+bias=none", "--set", "bias.slope=1"}));
}

TEST(TechniqueOption, WinsOverPresetsAndGivesWayInThem)
{
    const test::Folder folder;
    test::spill(folder / "one.json", R"({"technique": "pcf+single+map-size=256", "scene": "planes"})");
    test::spill(folder / "list.json", R"({"techniques": "hard,vsm"})");
    const std::string one = (folder / "one.json").string();
    const std::string list = (folder / "list.json").string();
    EXPECT_EQ(app::describeTechnique(settingsOf({"render", "--preset", one})),
              "pcf+single+map-size=256+pcf.kernel=3x3");
    EXPECT_EQ(app::describeTechnique(settingsOf({"render", "--preset", one, "--technique", "hard"})),
              "hard+single+map-size=256");
    EXPECT_EQ(settingsOf({"render", "--preset", one, "--filter", "vsm"}).shadow.technique.filter, Filter::vsm);
    EXPECT_EQ(app::contestants(settingsOf({"compare", "--preset", list, "--technique", "hard"})).size(), 1U);
    EXPECT_EQ(app::contestants(settingsOf({"compare", "--preset", list, "--preset", one})).size(), 1U);
    EXPECT_EQ(app::contestants(settingsOf({"compare", "--preset", one, "--techniques", "hard,vsm"})).size(), 2U);
}

TEST(TechniqueOption, IsWrittenInResultsByItsParts)
{
    const test::Folder folder;
    const test::Ran ran = test::gnomon({"plan", "planes", "--technique", "msm+single+uniform+map-size=64", "--json"},
                                       {.folder = folder.path()});
    ASSERT_EQ(ran.status, 0) << ran.err;
    const auto plan = nlohmann::json::parse(ran.out);
    EXPECT_EQ(plan["technique"]["filter"], "msm");
    EXPECT_EQ(plan["settings"]["filter"], "msm");
    EXPECT_FALSE(plan["settings"].contains("technique"));
    EXPECT_FALSE(plan["settings"].contains("strict"));
    test::spill(folder / "again.json", plan.dump());
    EXPECT_EQ(app::describeTechnique(settingsOf({"plan", "--preset", (folder / "again.json").string()})),
              app::describeTechnique(settingsOf({"plan", "--technique", "msm+single+uniform+map-size=64"})));
}

class TechniqueFile : public testing::Test {
protected:
    [[nodiscard]] std::string of(const std::string& text) const
    {
        test::spill(folder / "list.txt", text);
        return "@" + (folder / "list.txt").string();
    }
    /// The message of the refusal.
    [[nodiscard]] std::string refusalOf(const std::string& text) const
    {
        try {
            (void)settingsOf({"compare", "--techniques", of(text)});
        } catch (const app::UsageError& error) {
            return error.what();
        }
        return "nothing is wrong";
    }

    test::Folder folder;
};

TEST_F(TechniqueFile, HasATechniqueALine)
{
    const app::Settings settings = settingsOf(
        {"compare", "--techniques", of("# mine\nhard\n\n  pcf+sdsm # wide\r\n\tvsm"), "--techniques", "esm,msm"});
    EXPECT_EQ(settings.techniques, (std::vector<std::string>{"hard", "pcf+sdsm", "vsm", "esm", "msm"}));
    EXPECT_EQ(settings.values.at("techniques"), "hard,pcf+sdsm,vsm,esm,msm") << "as results have them";
    EXPECT_GT(app::contestants(settingsOf({"bench", "--techniques", of("all\n")})).size(), 10U);
}

TEST_F(TechniqueFile, IsToldByFileAndLine)
{
    const std::string file = (folder / "list.txt").string();
    const std::pair<const char*, const char*> kCases[] = {
        {"hard\npcv\n", ":2: technique \"pcv\": there is no \"pcv\" (did you mean \"pcf\"?)"},
        {"hard\n\npcf+map-format=rg32f\n", ":3: --map-format: rg32f cannot be had with filter pcf"},
        {"hard\npcf\nhard", ":3: --techniques: hard is listed twice"},
        {"pcf\npcf+pcf.kernel=3x3", ":2: --techniques: pcf and pcf+pcf.kernel=3x3 are the same"},
        {"hard,pcf", ":1: a line has one technique"},
        {"@other.txt", ":1: a file of techniques names no other"},
        {"hard\nall", ":2: --techniques: all stands alone"},
        {"vsm\n\x01hard", ":2: a line with control characters"},
    };
    for (const auto& [text, says] : kCases) {
        const std::string refusal = refusalOf(text);
        EXPECT_TRUE(refusal.starts_with(file + says)) << refusal;
    }
    EXPECT_NE(refusalOf("# nothing\n\n").find("has no technique in it"), std::string::npos);
    EXPECT_NE(refusalOf(std::string(5000, 'a')).find(":1: a line this long is no technique"), std::string::npos);
}

TEST_F(TechniqueFile, ThatIsHostileIsAnErrorAndNoCrash)
{
    std::string many;
    for (int i = 0; i < 1001; ++i) {
        many += "vsm+min-variance=" + std::to_string(0.0001 * (i + 1)) + "\n";
    }
    EXPECT_NE(refusalOf(many).find(":1001: more than 1000 techniques"), std::string::npos);
    EXPECT_THROW((void)settingsOf({"compare", "--techniques", of(std::string(300000, '\n'))}), std::exception);
    EXPECT_THROW((void)settingsOf({"compare", "--techniques", "@" + folder.path().string()}), std::exception);
    EXPECT_THROW((void)settingsOf({"compare", "--techniques", "@"}), std::exception);
    EXPECT_THROW((void)settingsOf({"compare", "--techniques", "hard,@list.txt"}), app::UsageError);
    ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
    EXPECT_THROW((void)settingsOf({"compare", "--techniques", "@" + (folder / "pipe").string()}), std::exception);
    std::string bytes;
    for (unsigned i = 0; i < 4096; ++i) {
        bytes += static_cast<char>((i * 2654435761U) >> 13U);
    }
    EXPECT_THROW((void)settingsOf({"compare", "--techniques", of(bytes)}), app::UsageError);
    // The user of a preset would not see which file it reads.
    test::spill(folder / "preset.json", R"({"techniques": "@list.txt"})");
    EXPECT_THROW((void)settingsOf({"compare", "--preset", (folder / "preset.json").string()}), app::UsageError);
}

} // namespace
} // namespace gnomon
