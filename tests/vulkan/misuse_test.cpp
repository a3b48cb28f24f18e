// SPDX-License-Identifier: Apache-2.0
// Wrong calls of the backend: each is a value or an Error with a sentence, and records nothing.
#include "misuser.h"

#include <gtest/gtest.h>

#include <functional>

namespace gnomon::test {
namespace {

TEST(Misuse, OfTheDeviceViewIsAnError)
{
    NullDriver driver;
    const std::vector<std::function<void(vulkan::DeviceView&)>> faults{
        [](vulkan::DeviceView& v) { v.instance = VK_NULL_HANDLE; },
        [](vulkan::DeviceView& v) { v.physical_device = VK_NULL_HANDLE; },
        [](vulkan::DeviceView& v) { v.device = VK_NULL_HANDLE; },
        [](vulkan::DeviceView& v) {
            v.get_instance_proc_addr = nullptr;
        }};
    for (const auto& fault : faults) {
        vulkan::DeviceView view = driver.view();
        fault(view);
        EXPECT_THROW(ShadowRenderer(view, {}), Error);
        EXPECT_THROW(CasterDrawer(view, {}), Error);
        EXPECT_THROW(Profiler(view, 2, 8), Error);
    }
    vulkan::DeviceView half = driver.view();
    half.memory.allocate = [](void*, const vulkan::MemoryRequest&, vulkan::MemoryBlock*) {
        return VK_ERROR_OUT_OF_DEVICE_MEMORY;
    };
    EXPECT_THROW(ShadowRenderer(half, {}), Error);
    char text[8];
    EXPECT_THROW(static_cast<void>(vulkan::supportedFeatures({})), Error);
    EXPECT_THROW(vulkan::missingFeatures({}, text, sizeof text), Error);
    vulkan::missingFeatures({}, nullptr, 0);
    EXPECT_EQ(driver.counts().created, driver.counts().destroyed);
}

TEST(Misuse, OfTheNumberOfFramesIsAnError)
{
    NullDriver driver;
    for (const std::uint32_t frames : {0U, vulkan::kMostFrames + 1, 0xFFFFFFFFU}) {
        EXPECT_THROW(ShadowRenderer(driver.view(), {.frames_in_flight = frames}), Error);
        EXPECT_THROW(CasterDrawer(driver.view(), {.frames_in_flight = frames}), Error);
        EXPECT_THROW(Profiler(driver.view(), frames, 8), Error);
    }
    for (const std::uint32_t passes : {0U, 0xFFFFFFFFU}) {
        EXPECT_THROW(Profiler(driver.view(), 2, passes), Error);
    }
    EXPECT_EQ(driver.counts().created, driver.counts().destroyed);
}

TEST(Misuse, OfTheOrderOfCallsIsAnError)
{
    Misuser host;
    expectRefused(host, "call prepare() with it first", [&] { host.maps(); });
    expectRefused(host, "call prepare() with it first", [&] { host.mask(); });
    EXPECT_EQ(host.renderer.mask().image, VkImage{VK_NULL_HANDLE});
    EXPECT_EQ(host.renderer.maps().image, VkImage{VK_NULL_HANDLE});
    EXPECT_EQ(host.renderer.maps(7).image, VkImage{VK_NULL_HANDLE});
    EXPECT_EQ(host.renderer.depthLayersBuffer(7).buffer, VkBuffer{VK_NULL_HANDLE});
    (void)host.renderer.prepare(host.plan, {0, 0});
    expectRefused(host, "made no mask of this size", [&] { host.mask(); });
    host.prepare();
    host.mask(); // without maps: what there is of them is read, and nothing is drawn
    MapPass pass;
    expectRefused(host, "no frame has begun", [&] { host.drawer.draw(pass); });
    host.record();
    EXPECT_GT(host.driver.counts().instances, 0U);
}

TEST(Misuse, OfSlotsAndHandlesIsAnError)
{
    Misuser host;
    host.record();
    for (const std::uint32_t slot : {2U, 1000U, 0xFFFFFFFFU}) {
        expectRefused(host, "there are 2 frames in flight", [&] { host.maps(slot); });
        expectRefused(host, "there are 2 frames in flight", [&] { host.mask(slot); });
        expectRefused(host, "there are 2 frames in flight",
                      [&] { host.renderer.recordBounds(host.driver.commands(), slot, host.plan, host.inputs); });
        expectRefused(host, "there are 2 frames in flight", [&] {
            host.renderer.recordViews(host.driver.commands(), slot, host.plan, host.geometry.indices);
        });
        expectRefused(host, "there are 2 frames in flight",
                      [&] { host.drawer.beginFrame(slot, host.plan, host.geometry, host.transforms); });
        expectRefused(host, "there are 2 frames in flight",
                      [&] { host.profiler.beginFrame(host.driver.commands(), slot); });
        EXPECT_EQ(host.renderer.reuse(slot).drawn, 0U);
        EXPECT_EQ(host.renderer.filterCost(slot).texels, 0U);
        EXPECT_TRUE(host.renderer.fittedViews(slot).empty());
        EXPECT_TRUE(host.profiler.results(slot).empty());
    }
    EXPECT_TRUE(host.renderer.depthLayers(host.plan, 77).empty());
    expectRefused(host, "command buffer is null",
                  [&] { host.renderer.recordMaps(VK_NULL_HANDLE, 0, host.plan, host.draw); });
    expectRefused(host, "command buffer is null",
                  [&] { host.renderer.recordMask(VK_NULL_HANDLE, 0, host.plan, host.inputs); });
    expectRefused(host, "no function that draws casters",
                  [&] { host.renderer.recordMaps(host.driver.commands(), 0, host.plan, nullptr); });
    vulkan::CasterGeometry nothing;
    expectRefused(host, "positions or of indices is null",
                  [&] { host.drawer.beginFrame(0, host.plan, nothing, host.transforms); });
    host.record();
}

TEST(Misuse, OfTheMasksInputsIsAnError)
{
    Misuser host;
    host.record();
    const auto with = [&](const vulkan::MaskInputs& inputs) {
        return [&host, inputs] {
            host.renderer.recordMask(host.driver.commands(), 0, host.plan, inputs);
        };
    };
    vulkan::MaskInputs inputs = host.inputs;
    inputs.depth = VK_NULL_HANDLE;
    expectRefused(host, "depth is null", with(inputs));
    for (const VkExtent2D extent : {VkExtent2D{0, 48}, VkExtent2D{64, 0}, VkExtent2D{65, 48}, VkExtent2D{64, 99999}}) {
        inputs = host.inputs;
        inputs.extent = extent;
        expectRefused(host, extent.width * extent.height == 0 ? "extent is 0" : "no mask of this size", with(inputs));
    }
    host.record();
}

TEST(Misuse, OfSizesBeyondTheDeviceIsAnErrorAndMendsItself)
{
    Misuser host;
    host.record();
    expectRefused(host, "goes up to", [&] { (void)host.renderer.prepare(host.plan, {0xFFFFFFFFU, 48}); });
    expectRefused(host, "call prepare() with it first", [&] { host.mask(); });
    host.record();
    const Plan good = host.plan;
    host.plan.pages[0] = {20000, 20000, 2};
    expectRefused(host, "goes up to", [&] { host.prepare(); });
    host.plan.pages[0] = {256, 256, 60000};
    expectRefused(host, "goes up to", [&] { host.prepare(); });
    host.plan = good;
    host.record();
}

/// Every way in which a plan can point out of itself.
std::vector<std::function<void(Plan&)>> planFaults()
{
    constexpr std::uint32_t kHuge = 0xFFFFFFFFU;
    return {[](Plan& p) { p.options.reset(); },
            [](Plan& p) { p.options = std::make_shared<std::vector<ResolvedOptions>>(); },
            [](Plan& p) { p.pages.clear(); },
            [](Plan& p) { p.lights[1].options = 1; },
            [](Plan& p) { p.lights[1].first_view = 2; },
            [](Plan& p) { p.lights[1].view_count = kHuge; },
            [](Plan& p) { p.lights[1].mask_layer = 1; },
            [](Plan& p) { p.lights[1].mask_channel = 4; },
            [](Plan& p) { p.lights[1].mask_coloured = true; }, // but has a channel of a shared layer
            [](Plan& p) { p.lights.pop_back(); },
            [](Plan& p) { p.views[1].light = 2; },
            [](Plan& p) { p.views[1].casters.first = kHuge; },
            [](Plan& p) { p.views[1].casters.count = kHuge; },
            [](Plan& p) { p.views[1].casters.still = p.views[1].casters.count + 1; },
            [](Plan& p) { p.casters.clear(); },
            [](Plan& p) { p.views[1].place.tile.layer = 2; },
            [](Plan& p) { p.views[1].place.tile.x = 1; },
            [](Plan& p) { p.views[1].place.tile.height = kHuge; },
            [](Plan& p) { p.views[1].place.tile.width = 0; },
            [](Plan& p) { p.views[1].contents.kept_layer = 0; },
            [](Plan& p) {
                p.views[1].contents.dirty = {250, 0, 10, 10};
            },
            [](Plan& p) {
                p.views[1].place.map = {kHuge - 1, 0};
            }};
}

TEST(Misuse, OfAPlanThatPointsOutOfItselfIsAnError)
{
    Misuser host;
    host.record();
    const Plan good = host.plan;
    for (const auto& fault : planFaults()) {
        Plan wrong = good;
        fault(wrong);
        const char* const kHint = "hand in a plan as its planner made it";
        expectRefused(host, kHint, [&] { (void)host.renderer.prepare(wrong, kPicture); });
        host.prepare();
        expectRefused(host, kHint, [&] { host.renderer.recordMaps(host.driver.commands(), 0, wrong, host.draw); });
        expectRefused(host, kHint, [&] { host.renderer.recordMask(host.driver.commands(), 0, wrong, host.inputs); });
        expectRefused(host, kHint, [&] { host.drawer.beginFrame(0, wrong, host.geometry, host.transforms); });
    }
    host.record();
}

TEST(Misuse, OfIdsOfObjectsIsAnError)
{
    ShadowOptions options{.technique = kPlainTechnique};
    options.technique.filter = Filter::depth_id;
    Misuser host(options);
    const char* const kHint = "hand in a plan as its planner made it";
    expectRefused(host, kHint, [&] { host.prepare(); }); // it has no ids
    for (LightPlan& light : host.plan.lights) {
        light.first_object_id = static_cast<std::uint32_t>(host.plan.object_ids.size());
        host.plan.object_ids.resize(host.plan.object_ids.size() + host.objects.size(), 1);
    }
    expectRefused(host, kHint, [&] { host.prepare(); }); // nor bounds
    host.plan.object_bounds.resize(host.objects.size(), {{-1.0F, -1.0F, -1.0F}, {1.0F, 1.0F, 1.0F}});
    Plan shorter = host.plan;
    shorter.object_ids.pop_back();
    expectRefused(host, kHint, [&] { (void)host.renderer.prepare(shorter, kPicture); });
    Plan fewer = host.plan;
    fewer.object_bounds.pop_back();
    expectRefused(host, kHint, [&] { (void)host.renderer.prepare(fewer, kPicture); });
    host.driver.beginSlot(0);
    host.prepare();
    host.begin();
    host.maps();
    expectRefused(host, "MaskInputs::object_id is null", [&] { host.mask(); });
    host.inputs.object_id = host.driver.makeView();
    host.record();
}

TEST(Misuse, OfTexturesWithoutCoordinatesIsAnError)
{
    vulkan::CasterDrawerOptions without;
    without.vertices.uv = {};
    Misuser plain({}, without); // no batch has a texture
    plain.record();
    plain.batches[1].texture = reinterpret_cast<VkDescriptorSet>(plain.driver.makeBuffer()); // the driver does not mind
    expectRefused(plain, "fill in CasterVertices::uv",
                  [&] { plain.drawer.setScene(plain.parts, plain.objects, plain.batches); });
    plain.record(); // the scene is what it was

    Misuser host;
    host.batches[1].texture = reinterpret_cast<VkDescriptorSet>(host.driver.makeBuffer());
    host.drawer.setScene(host.parts, host.objects, host.batches);
    expectRefused(host, "fill in CasterGeometry::uvs", [&] { host.begin(); });
    host.geometry.uvs = host.driver.makeBuffer();
    host.record();

    Misuser empty; // where no object has a batch there is nothing to read
    empty.batches[1].texture = reinterpret_cast<VkDescriptorSet>(empty.driver.makeBuffer());
    empty.drawer.setScene(empty.parts, {}, empty.batches);
    empty.geometry = {};
    for (View& view : empty.plan.views) {
        view.casters.count = view.casters.still = 0;
    }
    empty.begin();
}

TEST(Misuse, OfPiecesOfObjectsIsAnError)
{
    ShadowOptions options{.technique = kPlainTechnique};
    options.technique.filter = Filter::id;
    options.ids.of = IdOf::face;
    vulkan::CasterDrawerOptions with_pieces;
    with_pieces.vertices.piece = kPieceOfVertex;
    for (const bool has_pieces : {false, true}) {
        Misuser host(options, has_pieces ? with_pieces : vulkan::CasterDrawerOptions{});
        host.giveIds();
        host.driver.beginSlot(0);
        host.prepare();
        expectRefused(host, "fill in CasterGeometry::pieces", [&] { host.begin(); });
        host.geometry.pieces = host.driver.makeBuffer();
        if (!has_pieces) {
            expectRefused(host, "CasterVertices::piece", [&] { host.begin(); });
            expectRefused(host, "CasterVertices::piece", [&] { host.drawer.warmUp(resolvedOrThrow(options), false); });
            continue;
        }
        host.begin();
        host.maps();
        host.inputs.object_id = host.driver.makeView();
        expectRefused(host, "MaskInputs::object_pieces is false", [&] { host.mask(); });
        host.inputs.object_pieces = true;
        host.record();
    }
    vulkan::CasterDrawerOptions odd;
    odd.vertices.piece = {VK_FORMAT_R8_UINT, 1, 0};
    NullDriver driver;
    EXPECT_NE(sentenceOf([&] { CasterDrawer(driver.view(), odd); }).find("choose 16 or 32 bits of unsigned integers"),
              std::string::npos);
}

/// A plan that nobody prepared for: other options, larger pages, more of anything.
TEST(Misuse, OfAnotherPlanThanWasPreparedIsAnError)
{
    Misuser host;
    host.record();
    Misuser other({.technique = {.filter = Filter::vsm}});
    expectRefused(host, "call prepare() with it first",
                  [&] { host.renderer.recordMaps(host.driver.commands(), 0, other.plan, host.draw); });
    const std::vector<std::function<void(Plan&)>> larger{[](Plan& p) { p.pages[0].layers = 3; },
                                                         [](Plan& p) { p.pages[0].kept_layers = 1; },
                                                         [](Plan& p) {
                                                             p.pages[0] = {512, 512, 2};
                                                         },
                                                         [](Plan& p) { p.views.push_back(p.views.back()); },
                                                         [](Plan& p) { p.mask_layers = 2; },
                                                         [](Plan& p) {
                                                             p.lights.push_back(p.lights.back());
                                                             p.lights.back().mask_channel = 2;
                                                         }};
    for (const auto& grow : larger) {
        Plan grown = host.plan;
        grow(grown);
        expectRefused(host, "call prepare() with it first",
                      [&] { host.renderer.recordMaps(host.driver.commands(), 0, grown, host.draw); });
        (void)host.renderer.prepare(grown, kPicture);
        host.prepare();
    }
    host.record();
}

TEST(Misuse, OfCascadesThatWereNotFittedIsAnError)
{
    Misuser host;
    for (View& view : host.plan.views) {
        view.projection.gpu_cascade = 0;
    }
    host.plan.frame = 5;
    host.prepare();
    host.begin();
    expectRefused(host, "call recordBounds() with it first", [&] { host.maps(); });
    expectRefused(host, "call recordBounds() with it first", [&] { host.mask(); });
    expectRefused(host, "call recordBounds() with it first",
                  [&] { host.renderer.recordViews(host.driver.commands(), 0, host.plan, host.geometry.indices); });
    vulkan::MaskInputs inputs = host.inputs;
    inputs.depth = VK_NULL_HANDLE;
    expectRefused(host, "depth is null",
                  [&] { host.renderer.recordBounds(host.driver.commands(), 0, host.plan, inputs); });
    host.renderer.recordBounds(host.driver.commands(), 0, host.plan, host.inputs);
    expectRefused(host, "the buffer of views is null",
                  [&] { host.renderer.recordViews(host.driver.commands(), 0, host.plan, VK_NULL_HANDLE); });
    host.maps();
    host.mask();
}

/// A callback that throws, and one that ends the profiler's pass: the next frame is drawn as ever.
TEST(Misuse, OfTheCallbackLeavesTheRendererWhole)
{
    Misuser host;
    host.driver.beginSlot(0);
    host.prepare();
    host.begin();
    EXPECT_THROW(host.renderer.recordMaps(host.driver.commands(), 0, host.plan,
                                          [](const MapPass&) { throw std::runtime_error("of the host"); }),
                 std::runtime_error);
    host.profiler.beginFrame(host.driver.commands(), 0);
    const auto meddle = [&](const MapPass& pass) {
        host.profiler.endPass(pass.commands);
        host.drawer.draw(pass);
    };
    host.renderer.recordMaps(host.driver.commands(), 0, host.plan, meddle, &host.profiler);
    host.mask();
    EXPECT_EQ(host.renderer.reuse(0).drawn, 2U);
    EXPECT_GT(host.driver.counts().instances, 0U);
}

} // namespace
} // namespace gnomon::test
