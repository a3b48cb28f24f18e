// SPDX-License-Identifier: Apache-2.0
// Completion of command lines: what the program answers, and what shells make of it.
#include "folder.h"
#include "lights_and_cameras.h"
#include "process.h"

#include "app/command_line.h"
#include "completion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <sstream>

namespace gnomon {
namespace {

using Words = std::vector<std::string>;

Words wordsAfter(const Words& typed)
{
    Words words;
    for (const app::Candidate& candidate : app::completionOf(typed).candidates) {
        words.push_back(candidate.word);
    }
    return words;
}

TEST(Completion, AnswersByTheTables)
{
    EXPECT_EQ(wordsAfter({"ren"}), Words{"render"});
    EXPECT_EQ(wordsAfter({"render", "--fi"}), (Words{"--filter", "--fit"}));
    EXPECT_EQ(wordsAfter({"plan", "--mas"}), Words{}) << "an option of render";
    EXPECT_EQ(wordsAfter({"render", "--filter", "pc"}), (Words{"pcf", "pcss"}));
    EXPECT_EQ(wordsAfter({"render", "--filter=pc"}), (Words{"--filter=pcf", "--filter=pcss"}));
    EXPECT_EQ(wordsAfter({"render", "spo"}), Words{"spotlit"});
    EXPECT_EQ(wordsAfter({"render", "--mask", "spo"}), Words{"spotlit"}) << "a flag takes no value";
    EXPECT_EQ(wordsAfter({"render", "--set", "pcf.ker"}), Words{"pcf.kernel="});
    EXPECT_EQ(wordsAfter({"render", "--set", "pcf.kernel=5"}), Words{"pcf.kernel=5x5"});
    EXPECT_EQ(wordsAfter({"render", "--preset", "rts"}), Words{"rts-2011"});
    EXPECT_EQ(wordsAfter({"list", "msm.s"}), Words{"msm.solver"});
    EXPECT_EQ(wordsAfter({"completion", ""}), (Words{"bash", "zsh", "fish"}));
    EXPECT_EQ(wordsAfter({"compare", "--sweep", "map-s"}), Words{"map-size="});
    EXPECT_EQ(wordsAfter({"help", "pl"}), Words{"plan"});
    EXPECT_EQ(app::completionOf(Words{"render", ""}).files, "gltf glb");
    EXPECT_EQ(app::completionOf(Words{"metrics", "a.png", ""}).files, "png exr");
    EXPECT_EQ(app::completionOf(Words{"compare", "--report", ""}).files, "/");
}

TEST(Completion, AnswersPartsOfTechniques)
{
    EXPECT_EQ(wordsAfter({"render", "--technique", "pcf+sd"}), Words{"pcf+sdsm"});
    EXPECT_EQ(wordsAfter({"render", "--technique", "pcf+p"}),
              (Words{"pcf+paraboloid", "pcf+psm",
                     "pcf+pcf.kernel=", "pcf+pcf.taps=", "pcf+pcf.radius=", "pcf+pcf.sigma=", "pcf+penumbra="}))
        << "no second filter";
    EXPECT_EQ(wordsAfter({"render", "--technique", "pcf+msaa="}), (Words{"pcf+msaa=1", "pcf+msaa=4"}));
    EXPECT_EQ(wordsAfter({"bench", "--techniques", "hard,vsm+lisp"}),
              (Words{"hard,vsm+lispsm", "hard,vsm+lispsm-simple"}));
    EXPECT_TRUE(app::completionOf(Words{"render", "--technique", "pcf"}).goes_on);
    for (const std::string& word :
         wordsAfter({"render", "--technique", ""})) { // each is one, by itself or with a value
        if (!word.ends_with('=')) {
            EXPECT_NO_THROW((void)app::parseTechnique(app::defaultSettings(), word)) << word;
        }
    }
}

TEST(Completion, AnswersNamesInScenes)
{
    const test::Folder folder;
    test::spill(folder / "lights.gltf", test::kLightsAndCameras);
    test::spill(folder / "broken.gltf", "{ not json");
    EXPECT_EQ(wordsAfter({"render", "planes", "--light", "s"}), (Words{"sun", "spot"}));
    EXPECT_EQ(wordsAfter({"render", "--camera", "cam"}), Words{"camp"}) << "of rts";
    EXPECT_EQ(wordsAfter({"render", (folder / "broken.gltf").string(), "--camera", ""}), Words{});
    EXPECT_EQ(wordsAfter({"render", (folder / "none.gltf").string(), "--camera", ""}), Words{});
}

/// Every word that is offered after a subcommand's "-" is one that the subcommand takes.
TEST(Completion, OffersNoOptionThatIsRefused)
{
    for (const app::Subcommand& subcommand : app::subcommands()) {
        for (const std::string& word : wordsAfter({std::string(subcommand.name), "--"})) {
            try {
                (void)app::parseCommandLine(Words{std::string(subcommand.name), word});
            } catch (const app::UsageError& error) { // for want of a value, or of another option
                const std::string line = error.what();
                EXPECT_EQ(line.find("there is no option"), std::string::npos) << line;
                EXPECT_EQ(line.find("is not an option"), std::string::npos) << line;
            }
        }
    }
}

TEST(Completion, OfNonsenseIsNothingAndNoFailure)
{
    for (const Words& words :
         {Words{}, Words{"nonsense", ""}, Words{"render", "--nonsense", "x"}, Words{"render", "--technique", "++=+,"},
          Words{"render", "--set", "==", "="}, Words{"render", "--technique", std::string(10000, '+')},
          Words{"--", "--=", "\x01\xff"}, Words{"render", "--=", "--technique="}}) {
        EXPECT_NO_THROW((void)app::completionText(app::completionOf(words)));
    }
    app::Completion hostile;
    hostile.candidates = {{"two\nlines", ""}, {"fine", "with\ta tab"}, {":nospace", ""}};
    EXPECT_EQ(app::completionText(hostile), "fine\t\n");
}

/// Runs a script with a shell in a folder with a few files. Empty where there is no such shell.
class Shells : public testing::Test {
protected:
    Shells()
    {
        test::spill(folder / "a scene.gltf", "{}");
        test::spill(folder / "b.GLB", "");
        test::spill(folder / "notes.txt", "");
        std::filesystem::create_directory(folder / "models");
    }
    [[nodiscard]] static bool isThere(const std::string& shell)
    {
        return std::system(("command -v " + shell + " > /dev/null 2>&1").c_str()) == 0;
    }
    [[nodiscard]] Words linesOf(const std::string& shell, const std::string& script) const
    {
        test::spill(folder / ".script", script);
        const std::string program = std::filesystem::path(GNOMON_PROGRAM).parent_path().string();
        const std::string command = "cd '" + folder.path().string() + "' && PATH='" + program + "':\"$PATH\" HOME='" +
                                    folder.path().string() + "' " + shell + " .script 2>&1";
        std::FILE* pipe = ::popen(command.c_str(), "r");
        std::string text;
        for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) {
            text += static_cast<char>(c);
        }
        ::pclose(pipe);
        Words lines;
        std::istringstream in(text);
        for (std::string line; std::getline(in, line);) {
            lines.push_back(line);
        }
        std::ranges::sort(lines);
        return lines;
    }

    test::Folder folder;
};

class Bash : public Shells {
protected:
    /// The words that bash offers at the end of the line.
    [[nodiscard]] Words after(const std::string& line) const
    {
        return linesOf("bash", "source <(gnomon completion bash)\n"
                               "complete -p gnomon > /dev/null || echo none\n"
                               "COMP_LINE='" +
                                   line + "' COMP_POINT=" + std::to_string(line.size()) +
                                   "\n"
                                   "_gnomon gnomon\n"
                                   "((${#COMPREPLY[@]})) && printf '%s\\n' \"${COMPREPLY[@]}\"\n");
    }
};

TEST_F(Bash, Completes)
{
    ASSERT_TRUE(isThere("bash"));
    EXPECT_EQ(after("gnomon ren"), Words{"render"});
    EXPECT_EQ(after("gnomon render --fi"), (Words{"--filter", "--fit"}));
    EXPECT_EQ(after("gnomon render --filter p"), (Words{"pcf", "pcss"}));
    EXPECT_EQ(after("gnomon render --technique pcf+sd"), Words{"pcf+sdsm"});
    EXPECT_EQ(after("gnomon compare --techniques hard,pcs"), Words{"hard,pcss"});
    EXPECT_EQ(after("gnomon plan ring --light lantern\\ 4"), (Words{"lantern\\ 4", "lantern\\ 41", "lantern\\ 42"}));
    EXPECT_EQ(after("gnomon nonsense "), Words{});
}

/// Readline puts a candidate in the place of what follows the last "=".
TEST_F(Bash, CompletesAfterAnEqualsSign)
{
    EXPECT_EQ(after("gnomon render --set pcf.kernel=5"), Words{"5x5"});
    EXPECT_EQ(after("gnomon render --filter=pc"), (Words{"pcf", "pcss"}));
    EXPECT_EQ(after("gnomon render --technique pcf+msaa="), (Words{"1", "4"}));
}

TEST_F(Bash, CompletesFilesByWhatTheyAre)
{
    const Words all = after("gnomon render ");
    for (const char* word : {"a scene.gltf", "b.GLB", "models", "planes", "rts"}) {
        EXPECT_NE(std::ranges::find(all, word), all.end()) << word;
    }
    EXPECT_EQ(std::ranges::find(all, "notes.txt"), all.end());
    EXPECT_EQ(after("gnomon render b"), Words{"b.GLB"});
    EXPECT_EQ(after("gnomon compare --report "), Words{"models"});
    // Names that a shell would split are one word of the line.
    EXPECT_EQ(after("gnomon plan ring --light lantern").front(), "lantern\\ 0");
}

TEST_F(Shells, ReadTheirScripts)
{
    for (const char* shell : {"bash", "zsh", "fish"}) {
        if (isThere(shell)) {
            test::spill(folder / "script", std::string(app::completionScript(shell)));
            EXPECT_EQ(linesOf(std::string(shell) + " -n script", ""), Words{}) << shell;
        }
    }
}

/// The completion system is replaced by one that prints what it is given.
TEST_F(Shells, ZshCompletes)
{
    if (!isThere("zsh")) {
        GTEST_SKIP() << "zsh is not installed";
    }
    const auto after = [this](const Words& words) {
        std::string typed;
        for (const std::string& word : words) {
            typed += " '" + word + "'";
        }
        return linesOf("zsh -f", "compdef() { }\ncompset() { }\n"
                                 "compadd() { print -rl -- ${found/%/$suffix} }\n"
                                 "_files() { print -r -- files \"$@\" }\n"
                                 "source <(gnomon completion zsh)\n"
                                 "words=(gnomon" +
                                     typed + ")\nCURRENT=${#words}\nPREFIX=$words[CURRENT]\n_gnomon\n");
    };
    EXPECT_EQ(after({"ren"}), Words{"render "});
    EXPECT_EQ(after({"render", "--technique", "pcf+sd"}), Words{"pcf+sdsm"}) << "a technique may go on";
    EXPECT_EQ(after({"render", "--filter=p"}), (Words{"--filter=pcf ", "--filter=pcss "}));
    EXPECT_EQ(after({"render", "spot"}), (Words{"files -g *.(#i)(gltf|glb)", "spotlit "}));
    EXPECT_EQ(after({"compare", "--report", ""}), Words{"files -/"});
}

TEST_F(Shells, FishCompletes)
{
    if (!isThere("fish")) {
        GTEST_SKIP() << "fish is not installed";
    }
    const auto after = [this](const std::string& line) {
        Words words;
        for (const std::string& row :
             linesOf("fish", "gnomon completion fish | source\ncomplete -C '" + line + "'\n")) {
            words.push_back(row.substr(0, row.find('\t')));
        }
        return words;
    };
    EXPECT_EQ(after("gnomon ren"), Words{"render"});
    EXPECT_EQ(after("gnomon render --filter p"), (Words{"pcf", "pcss"}));
    EXPECT_EQ(after("gnomon render --filter=p"), (Words{"--filter=pcf", "--filter=pcss"}));
    EXPECT_EQ(after("gnomon render --technique pcf+sd"), Words{"pcf+sdsm"});
    const Words scenes = after("gnomon render ");
    EXPECT_NE(std::ranges::find(scenes, "rts"), scenes.end());
    EXPECT_NE(std::ranges::find(scenes, "a scene.gltf"), scenes.end()) << ::testing::PrintToString(scenes);
}

} // namespace
} // namespace gnomon
