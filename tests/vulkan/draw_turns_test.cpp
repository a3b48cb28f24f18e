// SPDX-License-Identifier: Apache-2.0
// A light that waits for its turn: what is drawn is drawn for the others, and its own map and mask are what they were.
#include "fixture.h"

#include <gnomon/planner.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace gnomon::test {
namespace {

constexpr VkExtent2D kScreen{64, 48};

Aabb boundsOf(const Box& box)
{
    const auto reach = static_cast<float>(glm::length(box.half)); // turned by whatever angle
    return {glm::vec3(box.centre) - reach, glm::vec3(box.centre) + reach};
}

/// Two suns over the boxes, one of which moves. The picture is that of before, so that masks tell of maps alone.
struct Turns {
    explicit Turns(std::uint64_t draw_budget_texels)
        : bench(kScreen, ShadowOptions{.technique = kPlainTechnique}),
          planner({.technique = kPlainTechnique, .map_size = 64, .draw_budget_texels = draw_budget_texels})
    {
        lights = {makeSun({0.8, -0.9, -0.35}), makeSun({-0.6, -0.9, 0.2})};
        lights[1].key = 1;
        bench.setLights(lights, {{0, 0, 0, 64, 64}, {1, 0, 0, 64, 64}}, {64, 64, 2});
        bench.drawer.setScene(bench.mesh.parts, bench.mesh.objects, bench.mesh.batches);
        (void)objects.add({{-30.0F, 0.0F, -30.0F}, {30.0F, 0.0F, 30.0F}});
        for (const Box& box : bench.scene.boxes) {
            (void)objects.add(boundsOf(box));
        }
    }
    /// Draws a frame; returns its plan.
    const Plan& draw()
    {
        Frame frame;
        frame.camera = bench.camera;
        frame.lights = lights;
        frame.objects = &objects;
        frame.size_px = {kScreen.width, kScreen.height};
        bench.plan = planner.plan(frame);
        (void)bench.renderer.prepare(bench.plan, kScreen);
        const auto transforms = bench.scene.transforms();
        passes = 0;
        gpu().run([&](VkCommandBuffer commands) {
            bench.drawer.beginFrame(0, bench.plan, bench.mesh.geometry, transforms);
            bench.renderer.recordMaps(commands, 0, bench.plan, [&](const vulkan::MapPass& pass) {
                bench.drawer.draw(pass);
                ++passes;
            });
            bench.renderer.recordMask(commands, 0, bench.plan, bench.inputs);
        });
        return bench.plan;
    }
    void move()
    {
        Box& box = bench.scene.boxes[0];
        box.centre += glm::dvec3(0.4, 0.0, 0.3);
        objects.update(objects.idAt(1), boundsOf(box));
    }
    [[nodiscard]] std::vector<float> mapOf(std::size_t light)
    {
        const Tile tile = bench.plan.views.at(bench.plan.lights.at(light).first_view).place.tile;
        return bench.readMap(tile.layer);
    }

    Bench bench;
    Planner planner;
    ObjectSet objects;
    std::vector<Light> lights;
    int passes = 0;
};

TEST(DrawTurns, LeaveMapAndMaskOfWhoWaitsAsTheyWere)
{
    Turns turns(1);
    Turns all(0);
    ASSERT_EQ(turns.draw().pages[0].waiting_lights, 0U);
    (void)all.draw();
    EXPECT_EQ(turns.passes, 2);
    std::vector<std::vector<float>> maps;
    std::vector<std::vector<std::byte>> masks;
    for (std::uint32_t light = 0; light < 2; ++light) {
        maps.push_back(turns.mapOf(light));
        masks.push_back(turns.bench.readMask(light));
    }
    turns.move();
    all.move();
    const Plan plan = turns.draw();
    (void)all.draw();
    ASSERT_EQ(plan.pages[0].waiting_lights, 1U);
    EXPECT_EQ(turns.passes, 1);
    const std::uint32_t waits = plan.lights[0].waited > 0 ? 0 : 1;
    EXPECT_EQ(turns.mapOf(waits), maps[waits]);
    EXPECT_EQ(turns.bench.readMask(waits), masks[waits]);
    EXPECT_NE(turns.mapOf(1 - waits), maps[1 - waits]) << "the other's turn";
    EXPECT_EQ(turns.bench.readMask(1 - waits), all.bench.readMask(1 - waits));
    EXPECT_NE(all.bench.readMask(waits), masks[waits]) << "else waiting would be no different";
    // Its turn comes, and then all is as if nobody had waited.
    (void)turns.draw();
    for (std::uint32_t light = 0; light < 2; ++light) {
        EXPECT_EQ(turns.bench.plan.lights[light].waited, 0U);
        EXPECT_EQ(turns.bench.readMask(light), all.bench.readMask(light)) << light;
    }
    expectSilence(gpu());
}

} // namespace
} // namespace gnomon::test
