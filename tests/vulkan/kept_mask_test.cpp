// SPDX-License-Identifier: Apache-2.0
// A mask that is left as it was is what would have been drawn, bit for bit; and whatever changes is drawn.
#include "fixture.h"
#include "planned_scene.h"

#include "mask_source.h"

#include <gnomon/planner.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

namespace gnomon::test {
namespace {

constexpr VkExtent2D kScreen{64, 40};

ShadowOptions optionsOf(Filter filter, Partition partition = Partition::single, Soften soften = Soften::none)
{
    ShadowOptions options{.technique = kPlainTechnique, .map_size = 64};
    options.technique.filter = filter;
    options.technique.partition = partition;
    options.technique.soften = soften;
    return options;
}

/// One renderer that may keep its mask, and one that is told nothing of what images show.
struct Kept {
    explicit Kept(std::vector<ShadowOptions> options, std::uint32_t frames_in_flight = 2, bool ids = false,
                  const pack::CompactMaskRule& compact = {})
        : planner(options), keeps(gpu(), scene.mesh(), compact, frames_in_flight),
          draws(gpu(), scene.mesh(), compact, frames_in_flight), slots(frames_in_flight)
    {
        scene.remakeViews(kScreen, true, ids);
        for (Light& light : lights) {
            light.options = light.key % static_cast<std::uint32_t>(options.size());
        }
    }
    /// Draws a frame; was its mask kept?
    bool frame()
    {
        const Frame now = scene.frameOf(lights);
        const Plan& plan = planner.plan(now);
        const std::uint32_t slot = count++ % slots;
        scene.nameContent(content);
        const std::vector<std::byte> mask = scene.draw(keeps, plan, slot);
        scene.nameContent(0);
        const std::vector<std::byte> wanted = scene.draw(draws, plan, slot);
        EXPECT_TRUE(mask == wanted) << "frame " << count;
        EXPECT_LT(*std::ranges::min_element(mask), std::byte{128}) << "nothing is in shadow";
        EXPECT_FALSE(draws.renderer.maskKept(slot));
        expectSilence(gpu());
        return keeps.renderer.maskKept(slot);
    }
    /// Until nothing is to be drawn any more.
    void settle()
    {
        (void)frame();
        (void)frame();
        ASSERT_TRUE(frame());
    }

    PlannedScene scene{gpu(), kScreen};
    std::vector<Light> lights = sunsAndSpots(3);
    Planner planner;
    Drawing keeps;
    Drawing draws;
    std::uint32_t slots;
    std::uint32_t count = 0;
    ContentNumber content = 1;
};

TEST(KeptMask, IsWhatWouldBeDrawnByEveryFilter)
{
    using enum Filter;
    for (const Filter filter : {hard, pcf, pcss, raymarch, vsm, lvsm, esm, evsm, msm, id, depth_id, smoothies}) {
        const bool ids = filter == id || filter == depth_id;
        Kept kept({optionsOf(filter)}, 2, ids);
        EXPECT_FALSE(kept.frame()) << nameOf(filter);
        EXPECT_TRUE(kept.frame()) << nameOf(filter);
        EXPECT_TRUE(kept.frame()) << nameOf(filter);
    }
}

TEST(KeptMask, IsKeptWithWhatComesAfterIt)
{
    for (const Soften soften : {Soften::blur, Soften::smoothies}) {
        Kept kept({optionsOf(Filter::pcf, Partition::single, soften)});
        kept.settle();
    }
    ShadowOptions half = optionsOf(Filter::pcf);
    half.mask_size = MaskSize::half;
    Kept({half}).settle();
    Kept cascades({optionsOf(Filter::pcf, Partition::cascades), optionsOf(Filter::hard)});
    for (Light& light : cascades.lights) {
        light.options = light.type == LightType::directional ? 0 : 1;
    }
    cascades.settle();
}

TEST(KeptMask, IsDrawnWhereItsSizeChanges)
{
    ShadowOptions half = optionsOf(Filter::pcf);
    half.mask_size = MaskSize::half;
    Kept kept({optionsOf(Filter::pcf)});
    kept.settle();
    Planner other(half);
    std::swap(kept.planner, other);
    EXPECT_FALSE(kept.frame());
    kept.settle();
    std::swap(kept.planner, other);
    EXPECT_FALSE(kept.frame());
}

TEST(KeptMask, GoesOnWithAnyNumberOfFramesInFlight)
{
    for (const std::uint32_t frames : {1U, 2U, 3U}) {
        for (const std::uint32_t channels : {0U, 4U}) {
            Kept kept({optionsOf(Filter::pcf)}, frames, false, {.channels = channels});
            kept.settle();
            for (std::uint32_t i = 0; i <= frames; ++i) {
                EXPECT_TRUE(kept.frame());
                const std::uint32_t slot = (kept.count - 1) % frames;
                EXPECT_EQ(kept.keeps.renderer.maskTiles(slot).bytes > 0, channels > 0);
            }
            kept.scene.moveCaster();
            EXPECT_FALSE(kept.frame());
            for (std::uint32_t i = 0; i <= frames; ++i) {
                EXPECT_TRUE(kept.frame());
            }
        }
    }
}

TEST(KeptMask, IsDrawnAnewWhateverChanges)
{
    Kept kept({optionsOf(Filter::pcf), optionsOf(Filter::hard)});
    ShadowOptions wider = optionsOf(Filter::pcf);
    wider.pcf.kernel = PcfKernel::poisson;
    Planner same(std::vector{optionsOf(Filter::pcf), optionsOf(Filter::hard)});
    Planner other(std::vector{wider, optionsOf(Filter::hard)});
    struct Change {
        const char* what;
        std::function<void()> make;
    };
    const std::vector<Change> changes{
        {"content",
         [&] {
             ++kept.content;
         }},
        {"camera, with content that is said to be the same",
         [&] {
             kept.scene.remakeViews(kScreen, true, false);
         }},
        {"caster",
         [&] {
             kept.scene.moveCaster();
         }},
        {"sun",
         [&] {
             kept.lights[0].direction_ws = glm::normalize(glm::dvec3(0.4, -1.0, 0.3));
         }},
        {"spot",
         [&] {
             kept.lights[1].position_ws.x += 0.1;
         }},
        {"spot's cone",
         [&] {
             kept.lights[1].outer_half_angle_rad *= 1.1;
         }},
        {"light without a shadow",
         [&] {
             kept.lights[2].casts_shadow = false;
         }},
        {"light's options",
         [&] {
             kept.lights[0].options = 1 - kept.lights[0].options;
         }},
        {"light with one again",
         [&] {
             kept.lights[2].casts_shadow = true;
         }},
        {"fewer lights",
         [&] {
             kept.lights.pop_back();
         }},
        {"size",
         [&] {
             kept.scene.remakeViews({48, 30}, true, false);
         }},
        {"size of before",
         [&] {
             kept.scene.remakeViews(kScreen, true, false);
         }},
        {"other inputs",
         [&] {
             kept.scene.remakeViews(kScreen, false, false);
         }},
        {"ids",
         [&] {
             kept.scene.remakeViews(kScreen, true, true);
         }},
        {"another planner",
         [&] {
             std::swap(kept.planner, same);
         }},
        {"another technique",
         [&] {
             std::swap(kept.planner, other);
         }},
        {"lost maps",
         [&] {
             kept.planner.reset();
         }},
        {"a frame that is not drawn",
         [&] {
             kept.keeps.renderer.reset();
         }},
    };
    for (const Change& change : changes) {
        kept.settle();
        change.make();
        EXPECT_FALSE(kept.frame()) << change.what;
    }
    kept.settle();
    kept.content = 0;
    EXPECT_FALSE(kept.frame());
    EXPECT_FALSE(kept.frame());
    kept.content = 7;
    EXPECT_FALSE(kept.frame());
    EXPECT_TRUE(kept.frame());
}

/// Plans that were made and not drawn have moved maps on that nobody drew.
TEST(KeptMask, IsDrawnAfterFramesThatWereSkipped)
{
    Kept kept({optionsOf(Filter::pcf)});
    kept.settle();
    kept.scene.moveCaster();
    (void)kept.planner.plan(kept.scene.frameOf(kept.lights));
    EXPECT_FALSE(kept.frame());
    EXPECT_TRUE(kept.frame());
}

TEST(KeptMask, IsNoneWhereFramesJoinOrTheGpuFits)
{
    for (const ShadowOptions& options :
         {optionsOf(Filter::pcf, Partition::single, Soften::converge), optionsOf(Filter::pcf, Partition::sdsm)}) {
        Kept kept({options});
        kept.lights.resize(1);
        for (int i = 0; i < 4; ++i) {
            EXPECT_FALSE(kept.frame());
        }
    }
}

TEST(KeptMask, IsNoneWhereSunsTakeTurns)
{
    Plan plan;
    plan.lights.resize(2);
    const vulkan::MaskInputs inputs{.content = 5};
    EXPECT_EQ(vulkan::nameOfInputs(plan, inputs), 5U);
    plan.lights[1].steps.paired = true;
    EXPECT_EQ(vulkan::nameOfInputs(plan, inputs), 5U);
    plan.lights[1].steps.alternate = true;
    EXPECT_EQ(vulkan::nameOfInputs(plan, inputs), 0U);
}

TEST(KeptMask, HasNoPass)
{
    Kept kept({optionsOf(Filter::pcf, Partition::single, Soften::blur)});
    vulkan::Profiler profiler(gpu().view(), 2, 16);
    const auto passes = [&] {
        const Frame frame = kept.scene.frameOf(kept.lights);
        kept.scene.nameContent(1);
        (void)kept.scene.draw(kept.keeps, kept.planner.plan(frame), 0, &profiler);
        std::vector<std::string> names;
        for (const vulkan::PassRecord& pass : profiler.results(0)) {
            names.emplace_back(pass.name);
        }
        return names;
    };
    EXPECT_EQ(passes(), (std::vector<std::string>{"shadow maps", "mask", "soften"}));
    EXPECT_EQ(passes(), std::vector<std::string>{});
    EXPECT_TRUE(kept.keeps.renderer.maskKept(0));
    EXPECT_FALSE(kept.keeps.renderer.maskKept(99));
    expectSilence(gpu());
}

} // namespace
} // namespace gnomon::test
