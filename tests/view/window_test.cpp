// SPDX-License-Identifier: Apache-2.0
// The window of `gnomon view` as somebody uses it: by mouse, keys and files.
#include "window_fixture.h"

#include "app/command_line.h"
#include "app/preset.h"
#include "sanitized.h"
#include "view/camera_moves.h"
#include "worlds/worlds.h"

#include <glm/geometric.hpp>

#include <array>
#include <filesystem>
#include <random>

namespace gnomon {
namespace {

using test::expectAsRendered;
using test::kSmall;
using test::User;
using test::ViewWindow;

TEST(ViewWithoutADesktop, SaysSoAndWhatToDo)
{
    unsetenv("DISPLAY");
    unsetenv("WAYLAND_DISPLAY");
    testing::internal::CaptureStderr();
    const std::vector<std::string> words{"view", "planes", "--gpu=software"};
    EXPECT_EQ(app::runProgram(words), 1);
    const std::string said = testing::internal::GetCapturedStderr();
    EXPECT_NE(said.find("no window system"), std::string::npos) << said;
    EXPECT_NE(said.find("gnomon render"), std::string::npos) << said;
}

TEST_F(ViewWindow, ShowsThePictureThatRenderDraws)
{
    User user(*desktop_, kSmall);
    expectAsRendered(user);
    user.window().shown().sun = false;
    user.viewer().say({" ", false});
    user.wait();
    const Image8 shown = user.shownPicture();
    const Image8 picture = user.viewer().picture();
    ASSERT_EQ(shown.width, 240U + 390U - static_cast<std::uint32_t>(user.window().pictureAt().x));
    // All but the last word over its lower edge.
    const std::size_t above = std::size_t{shown.width} * (shown.height - 60) * 3;
    EXPECT_TRUE(std::equal(shown.values.begin(), shown.values.begin() + static_cast<std::ptrdiff_t>(above),
                           picture.values.begin()));
}

TEST_F(ViewWindow, TurnsWithTheMouse)
{
    User user(*desktop_, kSmall);
    ASSERT_TRUE(user.rest());
    const host::Eye before = user.viewer().shot().eye;
    user.drag(user.inPicture(0.5, 0.3), user.inPicture(0.8, 0.1)); // the eye comes down from above
    const host::Eye orbited = user.viewer().shot().eye;
    EXPECT_EQ(orbited.target_ws, before.target_ws);
    EXPECT_GT(glm::distance(orbited.position_ws, before.position_ws), 0.1);
    EXPECT_NEAR(glm::distance(orbited.position_ws, orbited.target_ws),
                glm::distance(before.position_ws, before.target_ws), 1e-6);
    user.drag(user.inPicture(0.5, 0.2), user.inPicture(0.6, 0.4), 2);
    const host::Eye panned = user.viewer().shot().eye;
    EXPECT_NE(panned.target_ws, orbited.target_ws);
    user.drag(user.inPicture(0.5, 0.2), user.inPicture(0.6, 0.3), 3);
    EXPECT_EQ(user.viewer().shot().eye.position_ws, panned.position_ws);
    user.wheel(user.inPicture(0.5, 0.2), 2);
    const host::Eye nearer = user.viewer().shot().eye;
    EXPECT_LT(glm::distance(nearer.position_ws, nearer.target_ws),
              0.85 * glm::distance(panned.position_ws, panned.target_ws));
    user.press("w");
    EXPECT_NE(user.viewer().shot().eye.position_ws, nearer.position_ws);
    expectAsRendered(user);
}

TEST_F(ViewWindow, MovesTheSunByItsHandle)
{
    User user(*desktop_, kSmall);
    ASSERT_TRUE(user.rest());
    const auto handle = user.window().pointer().sunAt();
    ASSERT_TRUE(handle);
    const glm::dvec3 before = user.viewer().shot().lights.front().caster.direction_ws;
    user.drag(*handle, *handle + glm::dvec2(-25.0, 15.0));
    const glm::dvec3 after = user.viewer().shot().lights.front().caster.direction_ws;
    EXPECT_LT(glm::dot(before, after), 0.999);
    ASSERT_TRUE(user.window().pointer().sunAt());
    EXPECT_LT(glm::distance(*user.window().pointer().sunAt(), *handle + glm::dvec2(-25.0, 15.0)), 3.0)
        << "the handle follows the hand";
    expectAsRendered(user);
}

TEST_F(ViewWindow, TakesEveryChoiceOrSaysWhyNot)
{
    User user(*desktop_, kSmall);
    int taken = 0;
    int refused = 0;
    for (const std::string_view key : {"partition", "fit", "filter", "soften", "motion"}) {
        for (const std::string_view name : app::findSetting(key)->choices()) {
            const std::string why = app::view::edited(user.viewer().settings(), {{key, std::string(name)}}).refusal;
            user.pick(key, name);
            name == "converge" ? user.wait() : static_cast<void>(user.rest()); // that one averages for long
            const bool is_there = user.viewer().settings().values.at(std::string(key)) == name;
            if (name == "volumes") { // what the scene decides is said when it is asked for
                EXPECT_TRUE(user.viewer().message().is_refusal) << "the ground is open";
            } else {
                EXPECT_EQ(is_there, why.empty()) << key << " " << name << ": " << why;
            }
            (is_there ? taken : refused) += 1;
            if (!is_there) {
                user.press("Escape"); // the list
            }
        }
        user.pick(key, key == "motion" ? "free" : key == "soften" ? "none" : "auto");
    }
    EXPECT_GT(taken, 25);
    EXPECT_TRUE(user.rest());
}

TEST_F(ViewWindow, OpensEveryWorldAndDroppedFiles)
{
    User user(*desktop_, kSmall);
    for (const worlds::World& world : worlds::all()) {
        user.pick("world", world.name);
        EXPECT_EQ(user.viewer().settings().scene, world.name) << user.viewer().message().text;
        EXPECT_TRUE(user.rest());
    }
    EXPECT_FALSE(user.viewer().open("nowhere.glb"));
    EXPECT_TRUE(user.viewer().message().is_refusal);
    EXPECT_TRUE(user.rest()) << "the world that was there is there still";
    const std::filesystem::path shared(GNOMON_SHARED_DIR);
    if (!std::filesystem::exists(shared / "scenes")) {
        GTEST_SKIP() << "no scenes in " << shared << ", so that no file is dropped";
    }
    const std::string file = (shared / "scenes/skinned/Fox.glb").string();
    user.drop(file);
    EXPECT_EQ(user.viewer().settings().scene, file) << user.viewer().message().text;
    expectAsRendered(user);
    const Image8 before = user.viewer().picture();
    const host::Eye eye = user.viewer().shot().eye; // it has no camera, so this was fitted
    user.drag(user.inPicture(0.4, 0.3), user.inPicture(0.7, 0.4));
    EXPECT_GT(glm::distance(user.viewer().shot().eye.position_ws, eye.position_ws), 0.1);
    expectAsRendered(user);
    EXPECT_NE(user.viewer().picture().values, before.values);
}

TEST_F(ViewWindow, ResizesAndMinimises)
{
    User user(*desktop_, kSmall);
    ASSERT_TRUE(user.rest());
    user.window().window().resize({600, 260});
    user.wait(6);
    EXPECT_EQ(user.window().size_px(), glm::uvec2(600, 260));
    EXPECT_EQ(user.viewer().settings().size_px.y, 260U);
    EXPECT_EQ(user.viewer().settings().size_px.x, 600U - static_cast<std::uint32_t>(user.window().pictureAt().x));
    expectAsRendered(user);
    user.press("h");
    user.wait();
    EXPECT_EQ(user.viewer().settings().size_px.x, 600U) << "without the panel";
    user.window().window().resize({40, 30});
    user.wait(6);
    user.window().window().resize({500, 300});
    user.wait(6);
    EXPECT_TRUE(user.rest());
}

TEST_F(ViewWindow, StartsAtHalfSizeWhereTheProcessorDraws)
{
    User user(*desktop_, {"planes", "--camera=top", "--gpu=software", "--set=texels=262144"});
    EXPECT_TRUE(user.window().shown().half_size);
    user.window().window().resize({600, 260});
    user.wait(6);
    const glm::uvec2 room{600U - static_cast<std::uint32_t>(user.window().pictureAt().x), 260U};
    EXPECT_EQ(user.viewer().settings().size_px, room / 2U);
    expectAsRendered(user);
    user.window().shown().half_size = false;
    user.wait();
    EXPECT_EQ(user.viewer().settings().size_px, room);
}

TEST_F(ViewWindow, GivesItsSizeToTheOneThatIsOpenedInItsPlace)
{
    for (const int dpi : {96, 192}) {
        desktop_->setDensity(dpi);
        app::Settings again;
        glm::uvec2 size_px(0);
        {
            User user(*desktop_, kSmall);
            ASSERT_TRUE(user.rest());
            user.press("h"); // without the panel the picture is as wide as the window
            user.wait();
            size_px = user.window().size_px();
            again = user.window().settingsOfWindow();
        }
        const app::view::ViewWindow second(again);
        EXPECT_EQ(second.size_px(), size_px) << dpi;
    }
}

TEST_F(ViewWindow, HasTheSizeThatWasGivenWhateverDraws)
{
    User user(*desktop_, kSmall);
    EXPECT_FALSE(user.window().shown().half_size);
    EXPECT_EQ(user.viewer().settings().size_px, glm::uvec2(240, 300));
}

TEST_F(ViewWindow, IsNoLargerThanTheScreen)
{
    User user(*desktop_, {"planes", "--camera=top", "--size=3000x2000", "--gpu=software", "--set=texels=262144"});
    EXPECT_EQ(user.window().size_px(), test::kScreen_px);
}

TEST(WindowOnAScreen, HasRoomForItsFrameAndItsPixels)
{
    using Size = glm::ivec2;
    const auto fitting = [](const Size& size, int scale, const Size& frame, const Size& area_px) {
        return host::sizeOnScreen(size, size * scale, frame, area_px);
    };
    EXPECT_EQ(fitting({800, 600}, 1, {0, 0}, {1280, 720}), Size(800, 600));
    EXPECT_EQ(fitting({1670, 720}, 1, {10, 40}, {1280, 720}), Size(1270, 680));
    EXPECT_EQ(fitting({1670, 720}, 2, {10, 40}, {1280, 720}), Size(630, 320)) << "pixels half as large";
    EXPECT_EQ(fitting({1670, 720}, 1, {10, 40}, {0, 0}), Size(1670, 720)) << "a desktop that says nothing";
    EXPECT_EQ(fitting({1670, 720}, 1, {10, 40}, {8, 8}), Size(1, 1));
}

TEST_F(ViewWindow, SavesAndLoadsPresets)
{
    User user(*desktop_, kSmall);
    user.pick("filter", "vsm");
    user.drag(user.inPicture(0.5, 0.2), user.inPicture(0.7, 0.3));
    ASSERT_TRUE(user.rest());
    const Image8 before = user.viewer().picture();
    const std::filesystem::path file = folder_ / "preset.json";
    user.window().typed().preset_file = file.string();
    user.click("Save");
    ASSERT_TRUE(std::filesystem::exists(file)) << user.viewer().message().text;
    for (const app::Preset& preset : app::presets()) {
        user.pick("preset", preset.name);
        EXPECT_FALSE(user.viewer().message().is_refusal) << preset.name << ": " << user.viewer().message().text;
    }
    user.click("Load");
    ASSERT_TRUE(user.rest());
    EXPECT_EQ(before.values, user.viewer().picture().values) << user.viewer().message().text;
    const std::filesystem::path picture = folder_ / "picture.png";
    user.window().typed().screenshot = picture.string();
    user.click("Screenshot");
    EXPECT_EQ(test::readPixels(picture).values, before.values);
    user.click("Copy as command");
    EXPECT_EQ(user.window().window().clipboard(), user.viewer().command());
}

TEST_F(ViewWindow, GivesCommandsThatDrawTheSame)
{
    User user(*desktop_, {"sundial", "--size=200x150", "--gpu=software", "--set=texels=262144"});
    std::mt19937 random(17);
    const auto below = [&random](std::size_t n) {
        return static_cast<std::size_t>(random() % n);
    };
    for (int state = 0; state < 50; ++state) {
        const std::string_view key = std::array<std::string_view, 4>{"partition", "fit", "filter", "motion"}[below(4)];
        const auto names = app::findSetting(key)->choices();
        (void)user.viewer().change({{key, std::string(names[below(names.size())])}});
        (void)user.viewer().change({{"map-size", std::array{"auto", "256", "400", "1024"}[below(4)]}});
        if (below(3) == 0) {
            (void)user.viewer().change({{"sun", std::array{"1,-1,0.3", "-0.2,-1,0.7", "0.9,-0.2,0.1"}[below(3)]}});
        }
        if (below(3) == 0) {
            (void)user.viewer().change({{"aa", std::array{"none", "fxaa", "ssaa4", "auto"}[below(4)]}});
        }
        if (below(3) == 0) {
            (void)user.viewer().change({{"time", std::array{"0", "1.25", "17"}[below(3)]}});
        }
        const double x = static_cast<double>(below(1000)) / 1000.0 - 0.5;
        (void)user.viewer().look(app::view::orbited(user.viewer().shot().eye, {x, 0.1 * x}));
        expectAsRendered(user);
        ASSERT_FALSE(HasFailure()) << "state " << state;
    }
}

constexpr int kThings = test::kSanitized ? 150 : 1000;

TEST_F(ViewWindow, StandsAThousandThingsThatAreDone)
{
    User user(*desktop_, kSmall);
    std::mt19937 random(1);
    const auto share = [&random] {
        return static_cast<double>(random() % 1000) / 1000.0;
    };
    const std::array<std::string_view, 14> keys{"w", "a", "s", "d",      "q",   "e",      "f",
                                                "h", "p", "t", "Escape", "Tab", "Return", "space"};
    for (int i = 0; i < kThings; ++i) {
        user.window().shown().maps = i > kThings / 2; // readable in windows of any size
        const glm::dvec2 size(user.window().size_px());
        const glm::dvec2 at = glm::dvec2(share(), share()) * (size - 1.0);
        const glm::dvec2 to = glm::dvec2(share(), share()) * (size - 1.0);
        switch (random() % 6) {
        case 0:
        case 1:
            user.drag(at, at);
            break;
        case 2:
            user.drag(at, to, static_cast<int>(random() % 3 + 1));
            break;
        case 3:
            user.press(keys[random() % keys.size()]);
            break;
        case 4:
            user.wheel(at, static_cast<int>(random() % 3) - 1);
            break;
        default:
            if (random() % 8 == 0) {
                user.window().window().resize({200 + random() % 300, 100 + random() % 250});
            }
            user.wait();
        }
    }
    user.viewer().play(false);
    user.viewer().moveSun(false);
    EXPECT_TRUE(user.rest()) << user.viewer().message().text;
}

} // namespace
} // namespace gnomon
