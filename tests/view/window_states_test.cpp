// SPDX-License-Identifier: Apache-2.0
// What the window of `gnomon view` shows beside the picture, and what it refuses and keeps.
#include "window_fixture.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <thread>

namespace gnomon {
namespace {

using app::view::Beside;
using app::view::Held;
using test::expectAsRendered;
using test::kSmall;
using test::User;
using test::ViewWindow;

TEST_F(ViewWindow, HoldsAgainstATechniqueAndTheTruth)
{
    User user(*desktop_, kSmall);
    user.click("a technique");
    user.type("technique", "hard+map-size=128");
    EXPECT_EQ(user.viewer().techniqueBeside(), "hard+map-size=128") << user.viewer().message().text;
    ASSERT_TRUE(user.rest());
    ASSERT_NE(user.viewer().canvasBeside(), nullptr);
    user.drag(user.inPicture(0.5, 0.9), user.inPicture(0.2, 0.9));
    EXPECT_NEAR(user.window().shown().divider, 0.2F, 0.03F);
    user.click("difference");
    EXPECT_EQ(user.viewer().held(), Held::difference);
    ASSERT_TRUE(user.rest());
    user.click("difference");
    user.click("the truth");
    EXPECT_EQ(user.viewer().beside(), Beside::truth);
    ASSERT_TRUE(user.rest());
    EXPECT_EQ(user.viewer().truthRays(), 256U);
    ASSERT_TRUE(user.viewer().rmse());
    EXPECT_GT(*user.viewer().rmse(), 0.0);
    EXPECT_LT(*user.viewer().rmse(), 0.2);
    user.drag(user.inPicture(0.5, 0.2), user.inPicture(0.6, 0.2));
    user.wait();
    EXPECT_FALSE(user.viewer().isTruthDone()) << "another picture has another truth";
    ASSERT_TRUE(user.rest());
    user.press("t");
    EXPECT_EQ(user.viewer().beside(), Beside::nothing);
}

/// How many pixels of the window differ from the picture, above its last 60 rows, where the last word is.
std::size_t drawnOver(User& user)
{
    user.viewer().say({" ", false});         // the shortest last word
    user.wheel(user.inPicture(0.1, 0.1), 0); // no widget explains itself
    const Image8 shown = user.shownPicture();
    const Image8 picture = user.viewer().picture();
    std::size_t count = 0;
    for (std::size_t i = 0; i < std::size_t{shown.width} * (shown.height - 60); ++i) {
        count += std::equal(&shown.values[i * 3], &shown.values[i * 3] + 3, &picture.values[i * 3]) ? 0 : 1;
    }
    return count;
}

TEST_F(ViewWindow, ShowsDebugViewsFrustaAndMaps)
{
    User user(*desktop_,
              {"planes", "--size=420x420", "--gpu=software", "--validate", "--technique=pcf+cascades+map-size=256"});
    user.window().shown().sun = false;
    ASSERT_TRUE(user.rest());
    EXPECT_EQ(drawnOver(user), 0U);
    user.click("Picture and debug views");
    user.click("frusta of the light's maps");
    ASSERT_TRUE(user.rest());
    EXPECT_GT(drawnOver(user), 100U);
    user.click("frusta of the light's maps");
    user.click("maps in a corner");
    ASSERT_TRUE(user.rest());
    ASSERT_FALSE(user.viewer().message().is_refusal) << user.viewer().message().text;
    EXPECT_GT(drawnOver(user), 160U * 160U / 2U);
    user.drag(user.inPicture(0.2, 0.3), user.inPicture(0.3, 0.2));
    ASSERT_TRUE(user.rest());
    user.click("maps in a corner");
    ASSERT_TRUE(user.rest());
    EXPECT_EQ(drawnOver(user), 0U);
    for (const std::string_view name : app::findSetting("debug")->choices()) {
        user.pick("debug", name);
        ASSERT_TRUE(user.rest()) << name;
        if (user.viewer().settings().debug != name) {
            user.press("Escape"); // the list, where it is grey
        }
    }
    user.pick("debug", "views");
    expectAsRendered(user);
}

TEST_F(ViewWindow, IsTwiceAsLargeOnADenseScreen)
{
    desktop_->setDensity(192);
    User user(*desktop_, {"planes", "--size=180x200", "--gpu=software", "--validate", "--set=texels=262144"});
    EXPECT_EQ(user.window().window().contentScale(), 2.0);
    ASSERT_TRUE(user.rest());
    const glm::uvec2 size = user.viewer().settings().size_px;
    EXPECT_EQ(size.y, 400U) << "the desktop's units are two pixels there";
    EXPECT_NEAR(double(size.x), 360.0, 8.0);
    user.click("play"); // widgets are where they are seen
    EXPECT_TRUE(user.viewer().plays());
    user.click("play");
    ASSERT_TRUE(user.rest());
    expectAsRendered(user);
}

/// --sun of what is shown; empty where it is not given.
std::string sunSetting(User& user)
{
    const app::Settings& settings = user.viewer().settings();
    const auto found = settings.values.find("sun");
    return found != settings.values.end() ? found->second : "";
}

TEST_F(ViewWindow, LetsTheSunMove)
{
    User user(*desktop_, kSmall);
    ASSERT_TRUE(user.rest());
    EXPECT_EQ(sunSetting(user), "");
    user.click("the sun moves");
    user.wait(5);
    const std::string first = sunSetting(user);
    EXPECT_NE(first, "");
    EXPECT_TRUE(user.viewer().isBusy());
    user.wait();
    EXPECT_NE(sunSetting(user), first);
    ASSERT_TRUE(user.viewer().change({{"sun", "1,-1,0"}})); // a hand leads it elsewhere, and it goes on from there
    user.wait();
    const glm::dvec3 sun = user.viewer().shot().lights.front().caster.direction_ws;
    EXPECT_GT(glm::dot(sun, glm::normalize(glm::dvec3(1.0, -1.0, 0.0))), 0.8);
    EXPECT_NE(sunSetting(user), "1,-1,0");
    user.click("the sun moves");
    expectAsRendered(user);
    ASSERT_TRUE(user.viewer().change({{"sun", ""}, {"point", "0,3,0,20"}}));
    user.click("the sun moves");
    user.wait();
    EXPECT_FALSE(user.viewer().movesSun()) << "there is none";
    EXPECT_TRUE(user.viewer().message().is_refusal);
}

TEST_F(ViewWindow, RefusesWhatRenderRefuses)
{
    User user(*desktop_,
              {"planes", "--size=240x300", "--gpu=software", "--validate", "--technique=raymarch+single+map-size=256",
               "--limit=file-bytes=2000000000", "--limit=count=2000000"});
    ASSERT_TRUE(user.rest());
    EXPECT_FALSE(user.viewer().change({{"filter", "volumes"}})) << "the ground is open";
    EXPECT_NE(user.viewer().message().text.find("open"), std::string::npos) << user.viewer().message().text;
    EXPECT_EQ(user.viewer().settings().values.at("filter"), "raymarch");
    ASSERT_TRUE(user.viewer().change({{"debug", "rays"}}));
    EXPECT_FALSE(user.viewer().change({{"filter", "hard"}})) << "rays are raymarch's";
    ASSERT_TRUE(user.viewer().change({{"debug", ""}})) << user.viewer().message().text;
    ASSERT_TRUE(user.viewer().change({{"fov", "50"}}));
    ASSERT_TRUE(user.viewer().change({{"fov", ""}})) << "with two limits: " << user.viewer().message().text;
    user.viewer().holdAgainst(Beside::technique);
    ASSERT_TRUE(user.viewer().setTechniqueBeside("vsm"));
    EXPECT_FALSE(user.viewer().setTechniqueBeside("volumes+msm"));
    EXPECT_EQ(user.viewer().techniqueBeside(), "vsm");
    ASSERT_TRUE(user.viewer().setTechniqueBeside("volumes+volumes.open=skip")) << user.viewer().message().text;
    expectAsRendered(user);
    const std::filesystem::path file = folder_ / "limits.json";
    ASSERT_TRUE(user.viewer().savePreset(file));
    EXPECT_TRUE(user.viewer().loadPreset(file.string())) << user.viewer().message().text;
}

TEST_F(ViewWindow, KeepsTheTruthForADifference)
{
    User user(*desktop_, kSmall);
    user.viewer().holdAgainst(Beside::truth);
    ASSERT_TRUE(user.rest());
    EXPECT_TRUE(user.viewer().isTruthDone());
    user.viewer().setHeld(Held::difference);
    EXPECT_TRUE(user.viewer().isTruthDone());
    user.wait();
    EXPECT_TRUE(user.viewer().isTruthDone());
    EXPECT_NE(user.shownPicture().values, user.viewer().picture().values) << "the difference is shown";
}

TEST_F(ViewWindow, HearsKeysOfSlowTurns)
{
    User user(*desktop_, kSmall);
    ASSERT_TRUE(user.rest());
    user.click("file");
    for (const char* const key : {"a", "b", "c"}) {
        desktop_->key(key, true);
        desktop_->key(key, false);
    }
    user.wait();
    EXPECT_EQ(user.window().typed().scene, "abc");
    desktop_->key("BackSpace", true); // all within one turn
    desktop_->key("BackSpace", false);
    std::this_thread::sleep_for(std::chrono::milliseconds(40)); // sooner GLFW takes it for a key that repeats itself
    desktop_->key("BackSpace", true);
    desktop_->key("BackSpace", false);
    user.wait(6);
    EXPECT_EQ(user.window().typed().scene, "a");
}

TEST_F(ViewWindow, TechniquesOfPresetsKeepThePicture)
{
    User user(*desktop_, kSmall);
    user.drag(user.inPicture(0.5, 0.3), user.inPicture(0.7, 0.2));
    ASSERT_TRUE(user.viewer().change({{"ground", "on"}}));
    const glm::dvec3 eye = user.viewer().shot().eye.position_ws;
    ASSERT_TRUE(user.viewer().loadPreset("fast")) << user.viewer().message().text;
    EXPECT_EQ(user.viewer().shot().eye.position_ws, eye);
    EXPECT_EQ(user.viewer().settings().ground, app::Ground::on);
    EXPECT_EQ(user.viewer().settings().values.at("quality"), "fast");
    ASSERT_TRUE(user.viewer().loadPreset("demo"));
    EXPECT_EQ(user.viewer().settings().scene, "sundial") << "which names its scene, and so all of a picture";
    expectAsRendered(user);
}

} // namespace
} // namespace gnomon
