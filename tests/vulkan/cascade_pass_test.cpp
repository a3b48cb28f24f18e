// SPDX-License-Identifier: Apache-2.0
// Cascades drawn each in a pass of its own and together in one: the same maps, bit for bit.
#include "cpu_map.h"
#include "fixture.h"
#include "null_driver.h"

#include <gnomon/error.h>

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>

namespace gnomon::test {
namespace {

constexpr VkExtent2D kScreen{64, 40};
constexpr std::uint32_t kMapSize = 128;

// Views of a sun or, perspective, of a spot: parts of its one map, each of which leaves out a caster that it shows.
// Around them a spot's map in layer 0 and another one above all of theirs.
struct Case {
    const char* name;
    MapFormat format;
    std::uint32_t views = 4;
    bool perspective = false;
    bool masked = false;
};

std::ostream& operator<<(std::ostream& out, const Case& c)
{
    return out << c.name;
}

// The square of side 2 / zoom around (x, y) of the view's map.
View partOf(View view, double zoom, double x, double y)
{
    const glm::dmat4 scale = glm::scale(glm::dmat4(1.0), {zoom, zoom, 1.0});
    view.projection.clip_from_world =
        scale * glm::translate(glm::dmat4(1.0), {-x, -y, 0.0}) * view.projection.clip_from_world;
    return view;
}

void addParts(Plan& plan, const View& base, std::uint32_t count)
{
    std::vector<std::uint32_t> all(plan.casters.begin() + base.casters.first,
                                   plan.casters.begin() + base.casters.first + base.casters.count);
    for (std::uint32_t i = 0; i < count; ++i) {
        // A shift is by parts of clip space, which is w wide in perspective: none there.
        const double shift = base.projection.orthographic ? 0.08 * i : 0.0;
        View view = partOf(base, 1.0 + 0.6 * i, shift, -shift);
        view.place.tile.layer = 1 + i;
        view.casters.first = static_cast<std::uint32_t>(plan.casters.size());
        std::copy_if(all.begin(), all.end(), std::back_inserter(plan.casters),
                     [&](std::uint32_t handle) { return i == 0 || handle != i; });
        view.casters.count = static_cast<std::uint32_t>(plan.casters.size()) - view.casters.first;
        plan.views.push_back(view);
    }
}

Plan makeCascades(const Scene& scene, std::span<const Light> lights, std::uint32_t count)
{
    const auto tile = [](std::uint32_t layer) {
        return Tile{layer, 0, 0, kMapSize, kMapSize};
    };
    Plan plan =
        makePlan(scene, lights, std::vector<Tile>{tile(0), tile(1), tile(count + 1)}, {kMapSize, kMapSize, count + 2});
    const std::vector<View> single = plan.views;
    plan.views = {single[0]};
    addParts(plan, single[1], count);
    plan.views.push_back(single[2]);
    plan.lights[1].view_count = count;
    plan.lights[2].first_view = count + 1;
    return plan;
}

std::vector<Light> lightsOf(bool perspective)
{
    const Light spot = makeSpot({-6.0, 9.0, 5.0}, {0.0, 0.0, 0.0}, 0.6);
    return {spot, perspective ? makeSpot({6.0, 9.0, 5.0}, {0.0, 0.0, 0.0}, 0.7) : makeSun({0.8, -0.9, -0.35}), spot};
}

class CascadePasses : public testing::TestWithParam<Case> {
protected:
    CascadePasses() : each(kScreen, GetParam().format), together(kScreen, GetParam().format)
    {
        const Case& c = GetParam();
        for (Bench* bench : {&each, &together}) {
            bench->setLights(lightsOf(c.perspective), std::vector<Tile>(3), {});
            bench->plan = makeCascades(bench->scene, bench->lights, c.views);
            bench->plan.options = planOptions(bench->options);
            if (c.masked) {
                bench->maskBoxes();
            }
        }
        set(CascadePass::layered);
        each.prepare();
    }

    void set(CascadePass pass)
    {
        together.options.cascades.pass = pass;
        together.plan.options = planOptions(together.options);
        together.prepare();
    }
    /// Draws what both plans say; returns the passes of the second, by their number of views.
    std::vector<std::uint32_t> record()
    {
        std::vector<std::uint32_t> passes;
        for (Bench* bench : {&each, &together}) {
            const auto transforms = bench->scene.transforms();
            passes.clear();
            gpu().run([&](VkCommandBuffer commands) {
                bench->drawer.beginFrame(0, bench->plan, bench->mesh.geometry, transforms);
                bench->renderer.recordMaps(commands, 0, bench->plan, [&](const vulkan::MapPass& pass) {
                    passes.push_back(pass.view_count);
                    bench->drawer.draw(pass);
                });
            });
        }
        return passes;
    }
    /// Bytes of the layers that are not the same.
    std::size_t differences() const
    {
        const vulkan::ImageRef a = each.renderer.maps();
        const vulkan::ImageRef b = together.renderer.maps();
        const bool depth = a.format == VK_FORMAT_D16_UNORM || a.format == VK_FORMAT_D32_SFLOAT;
        const VkImageAspectFlags aspect = depth ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
        std::size_t count = 0;
        for (std::uint32_t layer = 0; layer < a.layers; ++layer) {
            const auto x = gpu().read(a, layer, texelBytes(a.format), aspect);
            const auto y = gpu().read(b, layer, texelBytes(b.format), aspect);
            EXPECT_NE(std::adjacent_find(x.begin(), x.end(), std::not_equal_to<>()), x.end()) << "empty: " << layer;
            for (std::size_t i = 0; i < x.size(); ++i) {
                count += x[i] != y[i] ? 1 : 0;
            }
        }
        return count;
    }
    void moveBoxes()
    {
        for (Bench* bench : {&each, &together}) {
            for (Box& box : bench->scene.boxes) {
                box.centre.x += 0.7;
                box.angle += 0.4;
            }
        }
    }

    Bench each;
    Bench together;
};

std::uint64_t bytesOf(const Bench& bench)
{
    std::uint64_t sum = 0;
    for (const auto& uses : {bench.renderer.memory(), bench.drawer.memory()}) {
        for (const vulkan::MemoryUse& use : uses) {
            sum += use.bytes;
        }
    }
    return sum;
}

TEST_P(CascadePasses, giveTheSameMapsBitForBit)
{
    const std::uint32_t views = GetParam().views;
    EXPECT_EQ(record(), (std::vector<std::uint32_t>{1, views, 1}));
    EXPECT_EQ(differences(), 0U);
    EXPECT_EQ(together.renderer.reuse(0).drawn, views + 2);
    EXPECT_EQ(together.renderer.reuse(0).together, views);
    EXPECT_EQ(each.renderer.reuse(0).together, 0U);

    // Views that hold part the others: nothing of them is drawn.
    moveBoxes();
    for (Bench* bench : {&each, &together}) {
        for (const std::uint32_t held : {0U, 2U, views + 1}) {
            bench->plan.views[held].contents.redraw = false;
        }
    }
    const std::vector<std::uint32_t> rest =
        views == 2 ? std::vector<std::uint32_t>{1} : std::vector<std::uint32_t>{1, views - 2};
    EXPECT_EQ(record(), rest);
    EXPECT_EQ(differences(), 0U);

    // And back, with what it takes in memory.
    set(CascadePass::each);
    moveBoxes();
    for (Bench* bench : {&each, &together}) {
        for (View& view : bench->plan.views) {
            view.contents.redraw = true;
        }
    }
    EXPECT_EQ(record(), std::vector<std::uint32_t>(views + 2, 1));
    EXPECT_EQ(differences(), 0U);
    (void)record(); // what is not needed is kept until the slot comes round
    EXPECT_EQ(bytesOf(together), bytesOf(each));
    expectSilence(gpu());
}

TEST_P(CascadePasses, wouldDifferIfACasterWereDrawnForAViewThatLeavesItOut)
{
    for (View& view : together.plan.views) {
        view.casters.first = together.plan.views.front().casters.first;
        view.casters.count = together.plan.views.front().casters.count;
    }
    (void)record();
    EXPECT_GT(differences(), 100U);
    expectSilence(gpu());
}

INSTANTIATE_TEST_SUITE_P(Formats, CascadePasses,
                         testing::Values(Case{"d32f", MapFormat::d32f}, Case{"d16_2", MapFormat::d16, 2},
                                         Case{"r32f_6", MapFormat::r32f, 6}, Case{"rg16", MapFormat::rg16},
                                         Case{"rgba8", MapFormat::rgba8},
                                         Case{"d32f_masked", MapFormat::d32f, 4, false, true},
                                         Case{"r32f_masked", MapFormat::r32f, 3, false, true},
                                         Case{"d32f_perspective", MapFormat::d32f, 3, true},
                                         Case{"r32f_perspective_masked", MapFormat::r32f, 3, true, true}),
                         [](const auto& test_case) { return std::string(test_case.param.name); });

// --- On the driver that only counts

class NullCascades {
public:
    explicit NullCascades(NullDriver& driver_in, MapFormat format = MapFormat::d32f)
        : driver(driver_in), renderer(driver.view(), {}), drawer(driver.view(), {})
    {
        plan = makeCascades(scene, lights, 4);
        options.format = format;
        plan.options = planOptions(options);
        std::vector<vulkan::DrawObject> objects{{0, 1}};
        objects.resize(1 + scene.boxes.size(), {1, 1});
        drawer.setScene(std::vector<vulkan::DrawPart>{{{0, 6, 0}, 0}, {{6, 36, 4}, 0}}, objects,
                        std::vector<vulkan::CasterBatch>(1));
        geometry.positions = driver.makeBuffer();
        geometry.indices = driver.makeBuffer();
        transforms = scene.transforms();
    }

    void set(CascadePass pass)
    {
        options.cascades.pass = pass;
        plan.options = planOptions(options);
        (void)renderer.prepare(plan, kScreen);
    }
    void record(std::uint32_t slot = 0)
    {
        drawer.beginFrame(slot, plan, geometry, transforms);
        renderer.recordMaps(driver.commands(), slot, plan, draw);
    }
    /// The layers of each begun rendering.
    std::vector<std::uint32_t> layerCounts() const
    {
        std::vector<std::uint32_t> layers;
        for (const NullEvent& event : driver.events()) {
            if (event.kind == NullEvent::Kind::begin_rendering) {
                layers.push_back(event.count);
            }
        }
        return layers;
    }

    NullDriver& driver;
    ShadowOptions options{.technique = kPlainTechnique};
    Scene scene = makeScene();
    std::vector<Light> lights = lightsOf(false);
    Plan plan;
    vulkan::CasterGeometry geometry;
    std::vector<vulkan::Rows3x4> transforms;
    vulkan::ShadowRenderer renderer;
    vulkan::CasterDrawer drawer;
    vulkan::DrawCasters draw = [this](const vulkan::MapPass& pass) {
        drawer.draw(pass);
    };
};

TEST(NullCascadePass, onePassOfFourLayersInsteadOfFour)
{
    NullDriver driver;
    NullCascades host(driver);
    host.set(CascadePass::automatic);
    host.record();
    EXPECT_EQ(host.layerCounts(), std::vector<std::uint32_t>(6, 1));
    const auto each = driver.counts();
    const std::size_t boxes = host.scene.boxes.size();
    EXPECT_EQ(each.indirect_draws, 6U * 2U);
    EXPECT_EQ(each.instances, 6U * (1 + boxes) - 3U) << "three views leave one out";
    const std::uint64_t triangles = host.drawer.triangles();

    host.set(CascadePass::layered);
    driver.clearEvents();
    host.record();
    EXPECT_EQ(host.layerCounts(), (std::vector<std::uint32_t>{1, 4, 1}));
    EXPECT_EQ(driver.counts().indirect_draws - each.indirect_draws, 3U * 2U);
    EXPECT_EQ(driver.counts().instances, 2 * each.instances) << "what casts in a map, and no more";
    EXPECT_EQ(host.drawer.triangles(), triangles);
}

TEST(NullCascadePass, aSteadyFrameMakesNothing)
{
    for (const MapFormat format : {MapFormat::d32f, MapFormat::r32f}) {
        NullDriver driver;
        NullCascades host(driver, format);
        host.set(CascadePass::layered);
        host.record(0);
        host.record(1);
        const auto counts = driver.counts();
        for (std::uint32_t i = 0; i < 4; ++i) {
            EXPECT_FALSE(host.renderer.prepare(host.plan, kScreen));
            host.record(i % 2);
        }
        EXPECT_EQ(driver.counts().created, counts.created);
        EXPECT_EQ(driver.counts().allocations, counts.allocations);
        EXPECT_EQ(driver.counts().descriptor_updates, counts.descriptor_updates);
    }
}

TEST(NullCascadePass, nothingIsMadeForItBeforeItIsChosen)
{
    const auto madeBy = [](CascadePass pass) {
        NullDriver driver;
        NullCascades host(driver);
        if (pass == CascadePass::automatic) {
            (void)host.renderer.prepare(host.plan, kScreen);
        } else {
            host.set(pass);
        }
        host.record();
        return driver.counts().created;
    };
    EXPECT_EQ(madeBy(CascadePass::each), madeBy(CascadePass::automatic)) << "as if nobody had said anything";
    EXPECT_GT(madeBy(CascadePass::layered), madeBy(CascadePass::each));
}

TEST(NullCascadePass, isRefusedWithTheReasonWhereItCannotBe)
{
    NullDriver driver;
    vulkan::DeviceView view = driver.view();
    view.features.layered = false;
    vulkan::ShadowRenderer without(view, {});
    NullCascades host(driver);
    const auto prepareWith = [&](CascadePass pass) {
        host.options.cascades.pass = pass;
        host.plan.options = planOptions(host.options);
        (void)without.prepare(host.plan, kScreen);
    };
    EXPECT_NO_THROW(prepareWith(CascadePass::each));
    EXPECT_NO_THROW(prepareWith(CascadePass::automatic));
    EXPECT_THROW(prepareWith(CascadePass::layered), Error);
}

TEST(NullCascadePass, theFeatureIsAskedForOnlyByWhoWantsIt)
{
    const auto asks = [](const VkPhysicalDeviceFeatures2& features) {
        for (auto* next = static_cast<const VkBaseInStructure*>(features.pNext); next != nullptr; next = next->pNext) {
            if (next->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES) {
                return reinterpret_cast<const VkPhysicalDeviceVulkan12Features*>(next)->shaderOutputLayer == VK_TRUE;
            }
        }
        return false;
    };
    EXPECT_FALSE(asks(vulkan::requiredFeatures({})));
    EXPECT_TRUE(asks(vulkan::requiredFeatures({.layered = true})));
    NullDriver driver;
    EXPECT_TRUE(vulkan::supportedFeatures(driver.view()).layered);
    driver.hideFunction("vkGetPhysicalDeviceFeatures2");
    EXPECT_FALSE(vulkan::supportedFeatures(driver.view()).layered);
}

} // namespace
} // namespace gnomon::test
