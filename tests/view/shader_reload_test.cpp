// SPDX-License-Identifier: Apache-2.0
// Shaders of the host and of the library that are changed while the window shows them.
#include "view/child.h"
#include "view/shader_reload.h"
#include "window_fixture.h"

#include "files/files.h"

#include <gnomon/error.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

namespace gnomon {
namespace {

namespace fs = std::filesystem;
using app::view::Child;
using app::view::ShaderBuild;
using test::expectAsRendered;
using test::User;

constexpr std::chrono::seconds kPatience{120}; // for a compiler on a busy machine

/// Gives a shader another main(), which does what the old one did and then `more`.
void addToMain(const fs::path& file, const std::string& more)
{
    std::string text = readWholeFile(file, 1 << 20);
    const std::string before = "void main()";
    ASSERT_NE(text.find(before), std::string::npos) << file;
    text.replace(text.find(before), before.size(), "void mainBefore()");
    std::ofstream(file) << text << "\nvoid main()\n{\n    mainBefore();\n    " << more << "\n}\n";
}

class ViewShaders : public test::ViewWindow {
protected:
    void SetUp() override
    {
        test::ViewWindow::SetUp();
        if (IsSkipped()) {
            return;
        }
        const fs::path tree = GNOMON_SOURCE_DIR;
        for (const char* folder : {"shaders", "host/shaders"}) {
            fs::create_directories(folder_ / folder);
            fs::copy(tree / folder, folder_ / folder, fs::copy_options::recursive);
        }
        fs::create_directories(folder_ / "modules");
        const std::string compile = "glslc --target-env=vulkan1.3 -I" + (folder_ / "shaders/include").string() + " ";
        std::ofstream(folder_ / "make.sh") << "set -e\ncd " << folder_.string() << "\n"
                                           << compile << "-o modules/shade.frag.spv host/shaders/shade.frag\n"
                                           << compile << "-DGNOMON_FILTER=GNOMON_FILTER_HARD"
                                           << " -o modules/mask_hard.frag.spv shaders/passes/mask.frag\n"
                                           << compile << "-DGNOMON_FILTER=GNOMON_FILTER_HARD -DGNOMON_ONE_VIEW"
                                           << " -o modules/mask_hard_one.frag.spv shaders/passes/mask.frag\n";
        build_.sources = {folder_ / "shaders", folder_ / "host/shaders"};
        build_.command = {"sh", (folder_ / "make.sh").string()};
        build_.modules = {folder_ / "modules"};
        build_.made = fs::file_time_type::min();
    }

    /// Turns the window until it says something with `word` in it.
    static bool waitToHear(User& user, const std::string& word)
    {
        user.viewer().say({"", false});
        const auto begun = std::chrono::steady_clock::now();
        while (user.viewer().message().text.find(word) == std::string::npos) {
            user.wait();
            const bool fails = user.viewer().message().text.find("do not compile") != std::string::npos;
            if (std::chrono::steady_clock::now() - begun > kPatience || (fails && word != "do not compile")) {
                return false;
            }
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
        }
        return true;
    }

    ShaderBuild build_;
};

TEST_F(ViewShaders, AreTakenWhenTheyAreSaved)
{
    User user(*desktop_, {"planes", "--size=240x300", "--gpu=software", "--validate", "--technique=hard+map-size=256"},
              build_);
    ASSERT_TRUE(user.rest());
    const Image8 before = user.viewer().picture();
    const fs::path shade = folder_ / "host/shaders/shade.frag";
    const fs::path mask = folder_ / "shaders/passes/mask.frag";
    const std::string shade_text = readWholeFile(shade, 1 << 20);
    const std::string mask_text = readWholeFile(mask, 1 << 20);

    std::ofstream(shade, std::ios::app) << "no GLSL\n";
    ASSERT_TRUE(waitToHear(user, "do not compile"));
    EXPECT_NE(user.window().shaders()->faults().find("host/shaders/shade.frag:"), std::string::npos)
        << user.window().shaders()->faults();
    EXPECT_EQ(user.window().shaders()->faults().find(folder_.string()), std::string::npos) << "paths are short";
    ASSERT_TRUE(user.rest());
    EXPECT_EQ(user.viewer().picture().values, before.values) << "a fault changes no picture";

    std::ofstream(shade) << shade_text;
    addToMain(shade, "out_light = vec4(out_light.rg * 0.5, 0.0, out_light.a);");
    ASSERT_TRUE(waitToHear(user, "modules are new")) << user.window().shaders()->faults();
    EXPECT_TRUE(user.window().shaders()->faults().empty());
    ASSERT_TRUE(user.rest());
    const Image8 shaded = user.viewer().picture();
    EXPECT_NE(shaded.values, before.values) << "the host's shader";

    addToMain(mask, "visibility = vec4(0.0);");
    ASSERT_TRUE(waitToHear(user, "modules are new")) << user.window().shaders()->faults();
    ASSERT_TRUE(user.rest());
    EXPECT_NE(user.viewer().picture().values, shaded.values) << "the library's shader";

    std::ofstream(shade) << shade_text;
    std::ofstream(mask) << mask_text;
    ASSERT_TRUE(waitToHear(user, "modules are new")) << user.window().shaders()->faults();
    ASSERT_TRUE(user.rest());
    EXPECT_EQ(user.viewer().picture().values, before.values) << "back as they were";
    expectAsRendered(user);
}

TEST_F(ViewShaders, ThatCannotBeDrawnWithAreGivenBack)
{
    User user(*desktop_, {"planes", "--size=240x300", "--gpu=software", "--technique=hard+map-size=256"}, build_);
    ASSERT_TRUE(user.rest());
    const Image8 before = user.viewer().picture();
    std::ofstream(folder_ / "make.sh") << "printf 'no module' >" << (folder_ / "modules/shade.frag.spv").string();
    std::ofstream(folder_ / "shaders/passes/mask.frag", std::ios::app) << "// another time\n";
    ASSERT_TRUE(waitToHear(user, "do not compile"));
    EXPECT_NE(user.window().shaders()->faults().find("it is no SPIR-V"), std::string::npos);
    ASSERT_TRUE(user.rest());
    EXPECT_EQ(user.viewer().picture().values, before.values);
}

TEST(ShaderBuild, IsThatOfTheProgramWhereItWasBuilt)
{
    const std::optional<ShaderBuild> build = app::view::findShaderBuild();
    if (!build) {
        GTEST_SKIP() << "this build has its shaders from another one";
    }
    Child compiler(build->command); // all are up to date: cmake finds the targets, and nothing to do
    std::optional<int> status;
    for (const auto begun = std::chrono::steady_clock::now();
         !(status = compiler.look()) && std::chrono::steady_clock::now() - begun < kPatience;) {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    EXPECT_EQ(status, 0) << compiler.text();
}

TEST(ShaderBuild, FaultsAreSaidOnceWithShortPaths)
{
    ShaderBuild build;
    build.sources = {"/a/b/shaders"};
    const std::string output = "[1/2] glslc mask_a.frag\n/a/b/shaders/passes/mask.frag:7: error: 'x' : undeclared\n"
                               "[2/2] glslc mask_b.frag\n/a/b/shaders/passes/mask.frag:7: error: 'x' : undeclared\n"
                               "ninja: build stopped\n";
    EXPECT_EQ(app::view::compilerFaults(output, build), "shaders/passes/mask.frag:7: error: 'x' : undeclared\n");
    EXPECT_EQ(app::view::compilerFaults("no rule\n", build), "no rule\n");
}

TEST(ViewChild, IsEndedWithWhatItStarted)
{
    {
        Child child({"sh", "-c", "echo said; sleep 600"});
        while (child.text() != "said\n") {
            EXPECT_FALSE(child.look());
        }
    } // and does not wait ten minutes
    Child failing({"sh", "-c", "exit 3"});
    std::optional<int> status;
    while (!(status = failing.look())) {
    }
    EXPECT_EQ(status, 3);
    EXPECT_THROW(Child({"no program has this name"}), Error);
}

} // namespace
} // namespace gnomon
