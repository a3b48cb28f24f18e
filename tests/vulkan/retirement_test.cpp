// SPDX-License-Identifier: Apache-2.0
// Nothing is freed or changed that a frame in flight may use, and in the end all is freed.
#include "null_driver.h"
#include "retirement.h"
#include "scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <utility>

namespace gnomon::test {
namespace {

using vulkan::ShadowRenderer;

struct Case {
    const char* name;
    Filter filter;
    MapFormat format;
    bool cascades = false; // that the GPU fits
};

std::ostream& operator<<(std::ostream& out, const Case& c)
{
    return out << c.name;
}

ShadowOptions optionsOf(const Case& c)
{
    ShadowOptions options{.technique = kPlainTechnique};
    options.technique.filter = c.filter;
    options.format = c.format;
    return options;
}

// A host that has two frames in flight and waits for nothing but a slot's last frame.
class Flight {
public:
    Flight(NullDriver& driver_in, const Case& c)
        : driver(driver_in), options(optionsOf(c)), renderer(driver.view(), {}), drawer(driver.view(), {})
    {
        inputs.depth = driver.makeView();
        inputs.normal = driver.makeView();
        const std::vector<vulkan::DrawPart> parts{{{0, 6, 0}, 0}};
        drawer.setScene(parts, std::vector<vulkan::DrawObject>(1 + scene.boxes.size(), {0, 1}),
                        std::vector<vulkan::CasterBatch>(1));
        geometry.positions = driver.makeBuffer();
        geometry.indices = driver.makeBuffer();
        transforms = scene.transforms();
        cascades_ = c.cascades;
    }
    void frame(std::uint32_t lights, std::uint32_t map_size, VkExtent2D screen, std::uint32_t kept = 0)
    {
        makePlan(lights, map_size, kept);
        const std::uint32_t slot = frame_++ % 2;
        plan_.frame = frame_;
        (void)renderer.prepare(plan_, screen);
        driver.beginSlot(slot); // as if the host waited for its fence here, as late as it may
        inputs.extent = screen;
        drawer.beginFrame(slot, plan_, geometry, transforms);
        const std::uint64_t pipelines = driver.counts().pipelines;
        renderer.recordBounds(driver.commands(), slot, plan_, inputs);
        renderer.recordMaps(driver.commands(), slot, plan_, [this](const vulkan::MapPass& pass) { drawer.draw(pass); });
        made_while_recording += driver.counts().pipelines - pipelines;
        renderer.recordMask(driver.commands(), slot, plan_, inputs);
    }
    void expectNoMistakes(const std::string& what) const
    {
        EXPECT_EQ(driver.counts().freed_in_use, 0U) << what;
        EXPECT_EQ(driver.counts().written_in_use, 0U) << what;
        EXPECT_EQ(driver.counts().used_after_free, 0U) << what;
        EXPECT_EQ(made_while_recording, 0U) << what;
    }

    NullDriver& driver;
    ShadowOptions options{.technique = kPlainTechnique};
    Scene scene = makeScene();
    ShadowRenderer renderer;
    vulkan::CasterDrawer drawer;
    vulkan::MaskInputs inputs;
    vulkan::CasterGeometry geometry;
    std::vector<vulkan::Rows3x4> transforms;
    std::uint64_t made_while_recording = 0;

private:
    void makePlan(std::uint32_t lights, std::uint32_t map_size, std::uint32_t kept)
    {
        lights_.clear();
        std::vector<Tile> tiles;
        for (std::uint32_t i = 0; i < lights; ++i) {
            lights_.push_back(i == 0 ? makeSun({0.5, -1.0, 0.2}) : makeSpot({4.0, 8.0, 2.0}, {0.0, 0.0, 0.0}, 0.5));
            tiles.push_back({i, 0, 0, map_size, map_size});
        }
        plan_ = test::makePlan(scene, lights_, tiles, {map_size, map_size, lights, kept}, options);
        for (std::uint32_t i = 0; i < std::min(lights, kept); ++i) {
            plan_.views[i].contents.kept_layer = i;
            plan_.views[i].casters.still = 2;
            plan_.views[i].contents.redraw_kept = frame_ % 3 == 0;
            plan_.views[i].contents.dirty = {0, 0, 16, 16};
        }
        if (cascades_) {
            plan_.views[0].projection.gpu_cascade = 0;
            ShadowOptions one = options;
            one.technique.partition = Partition::sdsm;
            one.cascades.count = 1;
            plan_.options = planOptions(one);
        }
        names_.name(plan_);
    }

    std::vector<Light> lights_;
    Plan plan_;
    MapNames names_;
    std::uint32_t frame_ = 0;
    bool cascades_ = false;
};

/// A host that records one kind of work alone never records a later one.
TEST(Retirement, WorkOfTheSameKindIsOfANewFrame)
{
    using Work = vulkan::Retirement::Work;
    vulkan::Retirement retirement;
    retirement.enter(0, Work::maps);
    auto resource = std::make_shared<int>(1);
    const std::weak_ptr<int> used = resource;
    retirement.keep(std::move(resource));
    retirement.enter(0, Work::mask);
    EXPECT_FALSE(used.expired()) << "the same frame";
    retirement.enter(0, Work::mask);
    EXPECT_TRUE(used.expired());
}

class Retired : public testing::TestWithParam<Case> {};

TEST_P(Retired, whileLightsMapsAndScreensComeAndGo)
{
    NullDriver driver;
    Flight flight(driver, GetParam());
    for (const std::uint32_t lights : {1U, 2U, 5U, 1U, 6U, 9U, 2U}) {
        for (const std::uint32_t size : {64U, 128U}) {
            flight.frame(lights, size, {64, 48});
            flight.frame(lights, size, {80, 48}, std::min(lights, 3U));
            flight.expectNoMistakes(std::to_string(lights) + " lights of " + std::to_string(size));
        }
    }
    flight.frame(9, 256, {80, 48}, 5);
    flight.frame(9, 256, {80, 48}, 5);
    flight.frame(9, 256, {80, 48}, 5);
    flight.expectNoMistakes("at the end");
    const std::uint64_t bytes = flight.driver.counts().bytes;
    const std::uint64_t allocations = flight.driver.counts().allocations;
    std::uint64_t accounted = 0;
    for (const auto& use : flight.renderer.memory()) {
        accounted += use.bytes;
    }
    for (const auto& use : flight.drawer.memory()) {
        accounted += use.bytes;
    }
    EXPECT_EQ(accounted, bytes);
    flight.frame(9, 256, {80, 48}, 5);
    EXPECT_EQ(flight.driver.counts().bytes, bytes) << "all that was retired is gone";
    EXPECT_EQ(flight.driver.counts().allocations, allocations);
}

TEST_P(Retired, allIsDestroyedInTheEnd)
{
    NullDriver driver;
    {
        Flight flight(driver, GetParam());
        flight.frame(1, 64, {64, 48});
        flight.frame(4, 128, {64, 48}, 2);
        flight.frame(7, 256, {65, 48}, 3);
        driver.finishAll();
    }
    EXPECT_EQ(driver.counts().created, driver.counts().destroyed);
    EXPECT_EQ(driver.counts().bytes, 0U);
    EXPECT_EQ(driver.counts().freed_in_use, 0U);
}

TEST_P(Retired, theDriverSeesWhatIsFreedTooEarly)
{
    NullDriver driver;
    auto renderer = std::make_unique<ShadowRenderer>(driver.view(), vulkan::ShadowRendererOptions{});
    const Scene scene = makeScene();
    const std::vector<Light> lights{makeSun({0.5, -1.0, 0.2})};
    const Tile tile{0, 0, 0, 64, 64};
    const Plan plan = makePlan(scene, lights, {&tile, 1}, {64, 64, 1}, optionsOf(GetParam()));
    (void)renderer->prepare(plan, {64, 48});
    renderer->recordMaps(driver.commands(), 0, plan, [](const vulkan::MapPass&) {});
    renderer.reset();
    EXPECT_GT(driver.counts().freed_in_use, 0U);
}

INSTANTIATE_TEST_SUITE_P(Filters, Retired,
                         testing::Values(Case{"pcf_d32f", Filter::pcf, MapFormat::d32f},
                                         Case{"pcf_d32f_sdsm", Filter::pcf, MapFormat::d32f, true},
                                         Case{"hard_r32f", Filter::hard, MapFormat::r32f},
                                         Case{"vsm", Filter::vsm, MapFormat::rg16f},
                                         Case{"lvsm", Filter::lvsm, MapFormat::rgba16}),
                         [](const auto& test_case) { return std::string(test_case.param.name); });

} // namespace
} // namespace gnomon::test
