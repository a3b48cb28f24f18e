// SPDX-License-Identifier: Apache-2.0
// Commands for a stepping sun and for kept maps, checked on a driver that only counts.
#include "allocation_count.h"
#include "null_driver.h"
#include "scene.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace gnomon::test {
namespace {

using vulkan::ShadowRenderer;
using Kind = NullEvent::Kind;

constexpr VkExtent2D kScreen{64, 48};

// A sun's two positions over the scene of boxes.
class Host {
public:
    Host(NullDriver& driver_in, Filter filter, MapFormat format)
        : driver(driver_in), renderer(driver.view(), {.classics = vulkan::makeClassics()})
    {
        const std::vector<Tile> tiles{{0, 0, 0, 256, 256}};
        plan = makePlan(scene, lights, tiles, {256, 256, 2}, optionsOf(filter, format));
        View later = makeView(scene, makeSun({0.4, -1.0, 0.3}), 0, {1, 0, 0, 256, 256});
        later.casters.count = plan.views[0].casters.count;
        later.serves.sun = SunPosition::later;
        plan.views[0].serves.sun = SunPosition::earlier;
        plan.views.push_back(later);
        plan.lights[0].view_count = 2;
        SunSteps& steps = plan.lights[0].steps;
        steps.stepping = true;
        steps.paired = true;
        steps.share = 0.5;
        inputs.extent = kScreen;
        inputs.depth = driver.makeView();
        inputs.normal = driver.makeView();
    }

    /// From now on what stands still is kept.
    void keep()
    {
        plan.pages[0].kept_layers = 2;
        for (std::uint32_t i = 0; i < 2; ++i) {
            plan.views[i].contents.kept_layer = i;
            plan.views[i].casters.still = 3;
            plan.views[i].contents.dirty = {16, 32, 64, 48};
        }
    }
    void record(std::uint32_t slot)
    {
        names.name(plan);
        driver.beginSlot(slot);
        renderer.recordMaps(driver.commands(), slot, plan, [](const vulkan::MapPass&) {});
        renderer.recordMask(driver.commands(), slot, plan, inputs);
    }
    std::vector<VkRect2D> passes() const
    {
        std::vector<VkRect2D> areas;
        for (const NullEvent& event : driver.events()) {
            if (event.kind == Kind::begin_rendering) {
                areas.push_back(event.area);
            }
        }
        return areas;
    }
    std::size_t count(Kind kind) const
    {
        return static_cast<std::size_t>(std::count_if(driver.events().begin(), driver.events().end(),
                                                      [&](const NullEvent& event) { return event.kind == kind; }));
    }

    static ShadowOptions optionsOf(Filter filter, MapFormat format)
    {
        ShadowOptions options{.technique = kPlainTechnique};
        options.technique.filter = filter;
        options.format = format;
        return options;
    }

    NullDriver& driver;
    Scene scene = makeScene();
    std::vector<Light> lights{makeSun({0.5, -1.0, 0.2})};
    Plan plan;
    MapNames names;
    vulkan::MaskInputs inputs;
    ShadowRenderer renderer;
};

TEST(NullSteps, onlyWhatIsDirtyIsDrawnAgain)
{
    for (const MapFormat format : {MapFormat::d32f, MapFormat::r32f}) {
        NullDriver driver;
        Host host(driver, Filter::pcf, format);
        host.keep();
        (void)host.renderer.prepare(host.plan, kScreen);
        host.record(0);
        EXPECT_EQ(host.passes().size(), 5U) << "two kept maps, two maps, the mask";
        EXPECT_EQ(host.passes()[2].extent.width, 256U) << "new images: all of it";
        driver.clearEvents();
        host.plan.views[1].contents.dirty = {};
        host.record(1);
        const auto passes = host.passes();
        ASSERT_EQ(passes.size(), 2U) << "one map and the mask";
        EXPECT_EQ(passes[0].offset.x, 16);
        EXPECT_EQ(passes[0].offset.y, 32);
        EXPECT_EQ(passes[0].extent.width, 64U);
        EXPECT_EQ(passes[0].extent.height, 48U);
    }
}

TEST(NullSteps, depthsOfFilterableMapsAreCopied)
{
    NullDriver driver;
    Host host(driver, Filter::vsm, MapFormat::rg16f);
    host.keep();
    (void)host.renderer.prepare(host.plan, kScreen);
    host.record(0);
    EXPECT_EQ(host.count(Kind::copy_image), 2U);
    EXPECT_EQ(host.passes().size(), 5U);
    driver.clearEvents();
    host.record(1);
    EXPECT_EQ(host.count(Kind::copy_image), 2U);
    EXPECT_EQ(host.passes().size(), 3U) << "what stands still is not drawn again";
}

// Only pixels in the band may pay for both positions.
TEST(NullSteps, aBandPartsTheMaskInThree)
{
    NullDriver driver;
    Host host(driver, Filter::pcf, MapFormat::d32f);
    host.plan.lights[0].steps.band = 0.25;
    host.plan.lights[0].steps.edge = 0.5;
    (void)host.renderer.prepare(host.plan, kScreen);
    host.record(0);
    EXPECT_EQ(driver.counts().draws, 3U);
    host.plan.lights[0].steps.edge = 0.0; // it has not come in yet
    host.record(1);
    EXPECT_EQ(driver.counts().draws, 4U);
    host.plan.lights[0].steps.edge = 0.1;
    host.record(0);
    EXPECT_EQ(driver.counts().draws, 6U);
}

TEST(NullSteps, steadyStateAllocatesNothing)
{
    for (const bool alternate : {false, true}) {
        NullDriver driver;
        Host host(driver, Filter::pcf, MapFormat::rg16);
        host.keep();
        for (std::uint32_t i = 0; i < 2; ++i) {
            host.plan.views[i].place.part = i == 0 ? TexelPart::first : TexelPart::second;
            host.plan.views[i].place.tile.layer = 0;
        }
        SunSteps& steps = host.plan.lights[0].steps;
        steps.alternate = alternate;
        const auto frame = [&](std::uint32_t i) {
            steps.read = i % 2 == 0 ? SunPosition::earlier : SunPosition::later;
            (void)host.renderer.prepare(host.plan, kScreen);
            host.record(i % 2);
        };
        for (std::uint32_t i = 0; i < 4; ++i) {
            frame(i);
        }
        const auto counts = driver.counts();
        const auto heap = heapAllocations();
        for (std::uint32_t i = 0; i < 10; ++i) {
            frame(i);
        }
        EXPECT_EQ(heapAllocations(), heap);
        EXPECT_EQ(driver.counts().created, counts.created);
        EXPECT_EQ(driver.counts().allocations, counts.allocations);
        EXPECT_EQ(driver.counts().descriptor_updates - counts.descriptor_updates, alternate ? 20U : 10U)
            << "set by set";
        EXPECT_EQ(driver.counts().draws - counts.draws, 10U * (2 + (alternate ? 2 : 1))) << "restored, and the mask";
    }
}

} // namespace
} // namespace gnomon::test
