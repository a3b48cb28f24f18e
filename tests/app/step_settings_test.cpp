// SPDX-License-Identifier: Apache-2.0
// The options of a sun that moves in steps, and what is kept of maps.
#include "app/settings.h"

#include <glm/trigonometric.hpp>

#include <gtest/gtest.h>

#include <string>

namespace gnomon::app {
namespace {

Settings with(std::initializer_list<std::pair<const char*, const char*>> values)
{
    Settings settings = defaultSettings();
    for (const auto& [key, value] : values) {
        applySetting(settings, key, value);
    }
    return settings;
}

TEST(StepSettings, BecomeThePlanners)
{
    const Settings settings = with({{"step.by", "time"},
                                    {"step.angle", "2"},
                                    {"step.interval", "0.5"},
                                    {"step.fade", "smooth"},
                                    {"step.band", "0.5"},
                                    {"keep-still", "always"}});
    EXPECT_EQ(settings.shadow.steps.by, StepBy::time);
    EXPECT_DOUBLE_EQ(settings.shadow.steps.angle_rad, glm::radians(2.0));
    EXPECT_EQ(settings.shadow.steps.interval_s, 0.5);
    EXPECT_TRUE(settings.shadow.steps.smooth);
    EXPECT_EQ(settings.shadow.steps.band, 0.5);
    EXPECT_EQ(settings.shadow.keep_still, KeepStill::always);
    EXPECT_EQ(with({{"keep-still", "never"}}).shadow.keep_still, KeepStill::never);
    EXPECT_EQ(with({{"keep-still", "never"}, {"keep-still", "auto"}}).shadow.keep_still, KeepStill::automatic);
}

/// The options that each motion uses.
TEST(StepSettings, AreOfUseWithTheirMotionAlone)
{
    const auto isUsed = [](const char* key, const char* motion, const char* by) {
        const Settings settings = with({{"motion", motion}, {"step.by", by}});
        return app::isUsed(*findSetting(key), settings);
    };
    for (const char* key : {"step.by", "step.angle", "step.interval", "step.fade", "step.band", "step.wait"}) {
        EXPECT_FALSE(isUsed(key, "free", "angle")) << key;
        EXPECT_FALSE(isUsed(key, "snap", "time")) << key;
    }
    for (const char* motion : {"step-jump", "step-band", "step-blend", "step-alternate"}) {
        const std::string name = motion;
        EXPECT_TRUE(isUsed("step.by", motion, "angle"));
        EXPECT_TRUE(isUsed("step.angle", motion, "angle"));
        EXPECT_FALSE(isUsed("step.angle", motion, "time"));
        EXPECT_TRUE(isUsed("step.interval", motion, "time"));
        EXPECT_FALSE(isUsed("step.interval", motion, "angle"));
        EXPECT_EQ(isUsed("step.fade", motion, "angle"), name != "step-jump");
        EXPECT_EQ(isUsed("step.band", motion, "angle"), name == "step-band");
        EXPECT_EQ(isUsed("step.wait", motion, "angle"), name == "step-jump");
        EXPECT_FALSE(isUsed("step.longest-wait", motion, "angle")) << "nothing is waited for";
        const Settings waits = with({{"motion", motion}, {"step.wait", "camera"}});
        EXPECT_EQ(app::isUsed(*findSetting("step.longest-wait"), waits), name == "step-jump");
    }
    EXPECT_TRUE(isUsed("keep-still", "free", "angle"));
}

/// Two moments of a filterable map in such a texel are one map.
TEST(StepSettings, TwoMapsShareATexelOfAFormatOfTwo)
{
    EXPECT_FALSE(resolvedOrThrow(parseTechnique(defaultSettings(), "pcf").shadow).paired_maps());
    EXPECT_FALSE(resolvedOrThrow(parseTechnique(defaultSettings(), "vsm+map-format=rg16").shadow).paired_maps());
    EXPECT_FALSE(resolvedOrThrow(parseTechnique(defaultSettings(), "hard+map-format=r32f").shadow).paired_maps());
    EXPECT_FALSE(resolvedOrThrow(parseTechnique(defaultSettings(), "vsm+map-format=rg16f").shadow).paired_maps());
    EXPECT_TRUE(resolvedOrThrow(parseTechnique(defaultSettings(), "pcf+map-format=rg16f").shadow).paired_maps());
    EXPECT_TRUE(
        resolvedOrThrow(parseTechnique(defaultSettings(), "pcf+step-blend+map-format=rg16").shadow).paired_maps());
    EXPECT_TRUE(resolvedOrThrow(parseTechnique(defaultSettings(), "hard+map-format=rgba8").shadow).paired_maps());
}

} // namespace
} // namespace gnomon::app
