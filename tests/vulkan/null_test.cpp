// SPDX-License-Identifier: Apache-2.0
// Recorded commands, checked on a driver that only counts.
#include "allocation_count.h"
#include "null_driver.h"
#include "scene.h"

#include <gnomon/error.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace gnomon::test {
namespace {

using vulkan::CasterDrawer;
using vulkan::MapPass;
using vulkan::Profiler;
using vulkan::ShadowRenderer;
using Kind = NullEvent::Kind;

constexpr VkExtent2D kScreen{64, 48};

// A sun and a spot over the scene of boxes, recorded frame by frame.
class NullHost {
public:
    explicit NullHost(NullDriver& driver_in, MapFormat format = MapFormat::d32f, std::uint32_t light_count = 2)
        : driver(driver_in), renderer(driver.view(), {.mask_shape = vulkan::MaskShape{.normals = true}}),
          drawer(driver.view(), {})
    {
        std::vector<Tile> tiles;
        for (std::uint32_t i = 0; i < light_count; ++i) {
            lights.push_back(i == 0 ? makeSun({0.5, -1.0, 0.2}) : makeSpot({4.0, 8.0, 2.0}, {0.0, 0.0, 0.0}, 0.5));
            tiles.push_back({i, 0, 0, 256, 256});
        }
        plan =
            makePlan(scene, lights, tiles, {256, 256, light_count}, {.technique = kPlainTechnique, .format = format});
        inputs.extent = kScreen;
        inputs.depth = driver.makeView();
        inputs.normal = driver.makeView();
        const std::vector<vulkan::DrawPart> parts{{{0, 6, 0}, 0}, {{6, 36, 4}, 1}};
        std::vector<vulkan::DrawObject> objects{{0, 1}};
        objects.resize(1 + scene.boxes.size(), {1, 1});
        drawer.setScene(parts, objects, std::vector<vulkan::CasterBatch>(2));
        geometry.positions = driver.makeBuffer();
        geometry.indices = driver.makeBuffer();
        transforms = scene.transforms();
    }

    void record(std::uint32_t slot, Profiler* profiler = nullptr)
    {
        names.name(plan);
        driver.beginSlot(slot);
        drawer.beginFrame(slot, plan, geometry, transforms);
        if (profiler != nullptr) {
            profiler->beginFrame(driver.commands(), slot);
        }
        renderer.recordMaps(driver.commands(), slot, plan, draw, profiler);
        renderer.recordMask(driver.commands(), slot, plan, inputs, profiler);
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

    NullDriver& driver;
    Scene scene = makeScene();
    std::vector<Light> lights;
    Plan plan;
    MapNames names;
    vulkan::MaskInputs inputs;
    vulkan::CasterGeometry geometry;
    std::vector<vulkan::Rows3x4> transforms;
    ShadowRenderer renderer;
    CasterDrawer drawer;
    vulkan::DrawCasters draw = drawer.callback();
};

TEST(NullRecording, passesComeInOrder)
{
    NullDriver driver;
    NullHost host(driver);
    EXPECT_TRUE(host.renderer.prepare(host.plan, kScreen));
    host.record(0);
    const auto passes = host.passes();
    ASSERT_EQ(passes.size(), 3U); // sun, spot, mask
    EXPECT_EQ(passes[0].extent.width, 256U);
    EXPECT_EQ(passes[1].extent.width, 256U);
    EXPECT_EQ(passes[2].extent.width, kScreen.width);
    EXPECT_EQ(driver.counts().draws, 1U);
    EXPECT_EQ(driver.counts().indirect_draws, 4U); // ground and boxes, twice
    EXPECT_EQ(driver.counts().instances, 2 * (1 + host.scene.boxes.size()));
    EXPECT_EQ(driver.counts().indices, 2 * (6 + 36 * host.scene.boxes.size()));
    EXPECT_EQ(host.drawer.triangles(), driver.counts().indices / 3);
    // Two layers and the mask go to attachment and back; one more for the stand-in of object ids.
    EXPECT_EQ(host.count(Kind::barrier), 7U);
    EXPECT_EQ(host.count(Kind::end_rendering), passes.size());
}

/// The driver takes one command at a time, as a device may.
TEST(NullRecording, eachPartOfABatchIsDrawn)
{
    NullDriver driver;
    NullHost host(driver, MapFormat::d32f, 1);
    const std::vector<vulkan::DrawPart> parts{{{0, 6, 0}, 0}, {{6, 36, 4}, 0}};
    std::vector<vulkan::DrawObject> objects{{0, 1}};
    objects.resize(1 + host.scene.boxes.size(), {1, 1});
    host.drawer.setScene(parts, objects, std::vector<vulkan::CasterBatch>(1));
    (void)host.renderer.prepare(host.plan, kScreen);
    host.record(0);
    EXPECT_EQ(driver.counts().indirect_draws, 2U);
    EXPECT_EQ(driver.counts().indices, 6 + 36 * host.scene.boxes.size());
}

TEST(NullRecording, viewsThatHoldAreNotDrawn)
{
    NullDriver driver;
    NullHost host(driver);
    host.plan.views[1].contents.redraw = false;
    (void)host.renderer.prepare(host.plan, kScreen);
    host.record(0);
    EXPECT_EQ(host.passes().size(), 3U) << "new images hold nothing yet, so everything is drawn";
    driver.clearEvents();
    host.record(1);
    EXPECT_EQ(host.passes().size(), 2U);
    EXPECT_EQ(host.count(Kind::barrier), 4U) << "the layer that holds is left alone";
    for (const NullEvent& event : driver.events()) {
        if (event.kind == Kind::barrier && event.new_layout == VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL) {
            EXPECT_NE(event.old_layout, VK_IMAGE_LAYOUT_UNDEFINED) << "other tiles of the layer would be lost";
        }
    }
    driver.clearEvents();
    host.plan.views[0].contents.redraw = false;
    host.record(0);
    EXPECT_EQ(host.passes().size(), 1U);
    EXPECT_EQ(host.count(Kind::barrier), 2U);
    driver.clearEvents();
    EXPECT_TRUE(host.renderer.prepare(host.plan, {65, 48}));
    host.inputs.extent = {65, 48};
    host.record(1);
    EXPECT_EQ(host.passes().size(), 1U) << "another screen is nothing to the maps";
}

TEST(NullRecording, steadyStateAllocatesNothing)
{
    for (const MapFormat format : {MapFormat::d32f, MapFormat::d16, MapFormat::r32f}) {
        NullDriver driver;
        NullHost host(driver, format, 5);
        Profiler profiler(driver.view(), 2, 8);
        (void)host.renderer.prepare(host.plan, kScreen);
        host.record(0, &profiler);
        host.record(1, &profiler);
        const auto created = driver.counts().created;
        const auto allocated = driver.counts().allocations;
        const auto updates = driver.counts().descriptor_updates;
        const auto heap = heapAllocations();
        for (std::uint32_t i = 0; i < 10; ++i) {
            EXPECT_FALSE(host.renderer.prepare(host.plan, kScreen));
            host.record(i % 2, &profiler);
            EXPECT_EQ(profiler.results(i % 2).size(), 2U);
        }
        EXPECT_EQ(heapAllocations(), heap);
        EXPECT_EQ(driver.counts().created, created);
        EXPECT_EQ(driver.counts().allocations, allocated);
        // The mask's set, in every frame: see HostHandles.AreWrittenInEveryFrame.
        EXPECT_EQ(driver.counts().descriptor_updates, updates + 10);
    }
}

TEST(NullRecording, filterableMapsThatHoldAreNeitherDrawnNorFiltered)
{
    for (const BlurPath path : {BlurPath::compute, BlurPath::fragment}) {
        NullDriver driver;
        const NullHost host(driver);
        ShadowRenderer renderer(driver.view(), {});
        Plan plan = host.plan;
        ShadowOptions options{.technique = kPlainTechnique, .format = MapFormat::rg16f};
        options.technique.filter = Filter::vsm;
        options.moments.blur_path = path;
        plan.options = planOptions(options);
        const vulkan::DrawCasters nothing = [](const MapPass&) {
        };
        (void)renderer.prepare(plan, kScreen);
        renderer.recordMaps(driver.commands(), 0, plan, nothing);
        const auto counts = driver.counts();
        const auto heap = heapAllocations();
        EXPECT_EQ(counts.dispatches, path == BlurPath::fragment ? 4U : 6U) << "of two views";
        EXPECT_EQ(counts.draws, path == BlurPath::fragment ? 2U : 0U) << "the second direction of two views";
        bool waited = false;
        for (const NullEvent& event : driver.events()) {
            EXPECT_TRUE(event.kind != Kind::dispatch || waited) << "each reads what the one before wrote";
            waited = event.kind == Kind::memory_barrier || (waited && event.kind != Kind::dispatch);
        }
        renderer.recordMaps(driver.commands(), 1, plan, nothing);
        EXPECT_EQ(driver.counts().dispatches, 2 * counts.dispatches);
        EXPECT_EQ(driver.counts().created, counts.created);
        EXPECT_EQ(driver.counts().descriptor_updates, counts.descriptor_updates);
        for (View& view : plan.views) {
            view.contents.redraw = false;
        }
        driver.clearEvents();
        renderer.recordMaps(driver.commands(), 0, plan, nothing);
        EXPECT_TRUE(driver.events().empty()) << "not even a barrier";
        EXPECT_EQ(heapAllocations(), heap);
    }
}

TEST(NullRecording, memoryIsAccountedFor)
{
    NullDriver driver;
    NullHost host(driver);
    (void)host.renderer.prepare(host.plan, kScreen);
    std::uint64_t sum = 0;
    for (const auto& use : host.renderer.memory()) {
        sum += use.bytes;
    }
    for (const auto& use : host.drawer.memory()) {
        sum += use.bytes;
    }
    EXPECT_EQ(sum, driver.counts().bytes);
    const auto uses = host.renderer.memory();
    const auto maps = std::find_if(uses.begin(), uses.end(),
                                   [](const auto& use) { return std::string_view(use.purpose) == "shadow maps"; });
    ASSERT_NE(maps, uses.end());
    EXPECT_EQ(maps->bytes, 256U * 256U * 4U * 2U);
}

TEST(NullRecording, missingFunctionIsNamed)
{
    NullDriver driver;
    driver.hideFunction("vkCmdPipelineBarrier2");
    try {
        const ShadowRenderer renderer(driver.view(), {});
        FAIL();
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("vkCmdPipelineBarrier2"), std::string::npos);
    }
}

TEST(NullRecording, anInstanceThatIsTooOldIsToldApartFromADriverThatIs)
{
    const auto complaint = [](std::uint32_t version) -> std::string {
        NullDriver driver;
        driver.hideFunction("vkCmdPipelineBarrier2");
        driver.setApiVersion(version);
        try {
            const ShadowRenderer renderer(driver.view(), {});
        } catch (const Error& error) {
            return error.what();
        }
        return "none";
    };
    EXPECT_NE(complaint(VK_API_VERSION_1_3).find("apiVersion is too low"), std::string::npos);
    EXPECT_NE(complaint(VK_API_VERSION_1_1).find("use a driver with Vulkan 1.3"), std::string::npos);
}

TEST(NullRecording, aFormatThatTheDeviceCannotFilterIsRefusedWithWhatItLacks)
{
    ShadowOptions options{.technique = kPlainTechnique, .format = MapFormat::rg32f};
    options.technique.filter = Filter::vsm;
    struct Lack {
        VkFormatFeatureFlags feature;
        const char* said;
        const char* remedy;
    };
    // Vulkan promises none of vsm's own formats.
    constexpr const char* kRemedy = "filter evsm with rgba16f";
    for (const Lack& lack : {Lack{VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT, "write in shaders", kRemedy},
                             Lack{VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT, "draw to", "another map format"},
                             Lack{VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT, "filter linearly", kRemedy}}) {
        NullDriver driver;
        driver.hideFormatFeatures(lack.feature);
        try {
            ShadowRenderer renderer(driver.view(), {});
            Plan plan = NullHost(driver).plan;
            plan.options = planOptions(options);
            (void)renderer.prepare(plan, kScreen);
            FAIL() << lack.said;
        } catch (const Error& error) {
            EXPECT_NE(std::string(error.what()).find(lack.said), std::string::npos) << error.what();
            EXPECT_NE(std::string(error.what()).find("rg32f"), std::string::npos) << error.what();
            EXPECT_NE(std::string(error.what()).find(lack.remedy), std::string::npos) << error.what();
        }
        EXPECT_EQ(driver.counts().created, driver.counts().destroyed);
    }
}

TEST(NullRecording, lightsWithoutMapsStillHaveAMask)
{
    NullDriver driver;
    NullHost host(driver, MapFormat::d32f, 1);
    host.plan.views.clear();
    host.plan.casters.clear();
    host.plan.pages[0] = {};
    host.plan.lights[0].view_count = 0;
    host.plan.lights[0].outcome = {OutcomeKind::no_caster, "nothing casts"};
    EXPECT_TRUE(host.renderer.prepare(host.plan, kScreen));
    host.record(0);
    EXPECT_EQ(host.passes().size(), 1U);
    EXPECT_EQ(host.renderer.mask().format, VK_FORMAT_R8_UNORM);
}

TEST(NullRecording, memoryHooksAreUsedForEverything)
{
    struct Ledger {
        int live = 0;
        int total = 0;
        int images = 0;
        int buffers = 0;
        std::vector<std::vector<std::byte>> blocks;
    } ledger;
    NullDriver driver;
    vulkan::DeviceView view = driver.view();
    view.memory.user = &ledger;
    view.memory.allocate = [](void* user, const vulkan::MemoryRequest& request, vulkan::MemoryBlock* block) {
        auto& l = *static_cast<Ledger*>(user);
        ++l.live;
        ++l.total;
        l.blocks.emplace_back(request.needs.size);
        l.images += request.image != VK_NULL_HANDLE && !request.linear() && request.prefers_dedicated ? 1 : 0;
        l.buffers += request.buffer != VK_NULL_HANDLE && request.linear() && !request.prefers_dedicated ? 1 : 0;
        block->mapped = l.blocks.back().data();
        return VK_SUCCESS;
    };
    view.memory.release = [](void* user, const vulkan::MemoryBlock&) {
        --static_cast<Ledger*>(user)->live;
    };
    {
        ShadowRenderer renderer(view, {});
        NullDriver other;
        const NullHost host(other);
        EXPECT_TRUE(renderer.prepare(host.plan, kScreen));
        EXPECT_EQ(ledger.live, 6); // maps, mask, what stands in for ids, two slots of constants, layers of depth
        EXPECT_EQ(ledger.images, 3) << "the driver wants memory of their own for images";
        EXPECT_EQ(ledger.buffers, 3);
    }
    EXPECT_EQ(ledger.live, 0);
    EXPECT_EQ(driver.counts().allocations, 0U);
}

} // namespace
} // namespace gnomon::test
