// SPDX-License-Identifier: Apache-2.0
// Which truths share an entry, and where entries are kept.
#include "truth/cache.h"

#include "cache_key.h"
#include "device.h"

#include "worlds/worlds.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <functional>
#include <set>
#include <vector>

namespace gnomon::truth {
namespace {

struct Asked {
    scene::Scene scene;
    scene::State state;
    View view;
    Light light;
    Options options;
    [[nodiscard]] scene::Hash128 key() const { return keyOf(scene, state, view, light, options); }
};

Asked askedSample()
{
    Asked asked;
    asked.scene = worlds::load("planes", 1);
    asked.state = scene::evaluate(asked.scene, 0.0);
    asked.view.size_px = {4, 4};
    return asked;
}

TEST(CacheKey, EveryIngredientChangesIt)
{
    const Asked asked = askedSample();
    const std::vector<std::function<void(Asked&)>> changes{
        [](Asked& a) { a.scene.materials[0].alpha_cutoff += 0.1F; },
        [](Asked& a) { a.state.objects[0].casts = false; },
        [](Asked& a) { a.state.objects[0].groups = 2; },
        [](Asked& a) { a.view.eye_ws.z = 1e-9; },
        [](Asked& a) { a.view.world_from_clip[3][3] = 1.0 + 1e-9; },
        [](Asked& a) { a.view.size_px.x = 5; },
        [](Asked& a) { a.view.size_px.y = 5; },
        [](Asked& a) { a.light.type = scene::LightType::spot; },
        [](Asked& a) { a.light.position_ws.z = 1e-9; },
        [](Asked& a) { a.light.direction_ws.z = 1e-9; },
        [](Asked& a) { a.light.angular_diameter_rad += 1e-9; },
        [](Asked& a) { a.light.radius_m = 1e-9; },
        [](Asked& a) { a.light.near_m = 1e-9; },
        [](Asked& a) { a.light.groups = 1; },
        [](Asked& a) { a.options.kind = Kind::hard; },
        [](Asked& a) { a.options.samples *= 2; },
        [](Asked& a) { ++a.options.seed; },
        [](Asked& a) { a.options.pixels = PixelTruth::area; },
    };
    std::set<scene::Hash128> seen{asked.key()};
    for (std::size_t i = 0; i < changes.size(); ++i) {
        Asked other = asked;
        changes[i](other);
        EXPECT_TRUE(seen.insert(other.key()).second) << "change " << i;
    }
}

TEST(CacheKey, AnotherEmbreeOrOtherInstructionsChangeIt)
{
    const Asked asked = askedSample();
    const auto by = [&](std::uint64_t identity) {
        return keyBy(identity, asked.scene, asked.state, asked.view, asked.light, asked.options);
    };
    EXPECT_EQ(by(tracerIdentity()), asked.key());
    EXPECT_NE(by(tracerIdentity() + (1U << 8U)), asked.key());
    EXPECT_NE(by(tracerIdentity() ^ 4U), asked.key());
    EXPECT_EQ(tracerIdentity() >> 8U, RTC_VERSION);
}

TEST(CacheKey, WhatDoesNotMatterDoesNotChangeIt)
{
    const Asked asked = askedSample();
    Asked other = asked;
    const std::atomic<bool> cancel{false};
    other.options.threads = 3;
    other.options.progress = [](double) {
    };
    other.options.cancel = &cancel;
    other.scene.name = other.scene.nodes[0].name = "another name";
    EXPECT_EQ(other.key(), asked.key());
    // One ray to the centre is no sample.
    Asked hard = asked;
    hard.options.kind = Kind::hard;
    Asked hard_too = hard;
    hard_too.options.samples = 64;
    hard_too.options.seed = 9;
    EXPECT_EQ(hard_too.key(), hard.key());
    // But of a pixel's points there are many.
    hard.options.pixels = hard_too.options.pixels = PixelTruth::area;
    EXPECT_NE(hard_too.key(), hard.key());
}

/// Sets a variable of the environment, or removes it, while it lives.
class Variable {
public:
    Variable(const char* name, const char* value) : name_(name)
    {
        if (const char* before = std::getenv(name)) {
            before_ = before;
        }
        set(value);
    }
    ~Variable() { set(before_ ? before_->c_str() : nullptr); }
    Variable(const Variable&) = delete;
    Variable& operator=(const Variable&) = delete;

private:
    void set(const char* value) const
    {
        if (value == nullptr) {
            unsetenv(name_);
        } else {
            setenv(name_, value, 1);
        }
    }
    const char* name_;
    std::optional<std::string> before_;
};

TEST(CacheFolder, FollowsTheEnvironment)
{
    const Variable home("HOME", "/h");
    {
        const Variable xdg("XDG_CACHE_HOME", "/x/c");
        EXPECT_EQ(Cache::defaultFolder(), std::filesystem::path("/x/c/gnomon/truth"));
    }
    for (const char* unfit : {static_cast<const char*>(nullptr), "", "relative"}) {
        const Variable xdg("XDG_CACHE_HOME", unfit);
        EXPECT_EQ(Cache::defaultFolder(), std::filesystem::path("/h/.cache/gnomon/truth"));
        const Variable nowhere("HOME", unfit);
        EXPECT_EQ(Cache::defaultFolder(), std::nullopt);
    }
}

} // namespace
} // namespace gnomon::truth
