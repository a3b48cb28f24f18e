// SPDX-License-Identifier: Apache-2.0
// A host of the backend on a driver that does nothing, whose calls can go wrong one at a time.
#pragma once

#include "null_driver.h"
#include "scene.h"

#include <gnomon/error.h>

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

namespace gnomon::test {

using vulkan::CasterDrawer;
using vulkan::DrawBatcher;
using vulkan::MapPass;
using vulkan::Profiler;
using vulkan::ShadowRenderer;

inline constexpr VkExtent2D kPicture{64, 48};

/// A host that does all right except for one thing at a time.
class Misuser {
public:
    explicit Misuser(const ShadowOptions& options = {}, const vulkan::CasterDrawerOptions& casters = {})
        : renderer(driver.view(), {.classics = vulkan::makeClassics()}), drawer(driver.view(), casters),
          profiler(driver.view(), 2, 8)
    {
        lights = {makeSun({0.5, -1.0, 0.2}), makeSpot({4.0, 8.0, 2.0}, {0.0, 0.0, 0.0}, 0.5)};
        const std::vector<Tile> tiles{{0, 0, 0, 256, 256}, {1, 0, 0, 256, 256}};
        plan = makePlan(scene, lights, tiles, {256, 256, 2}, options);
        inputs.extent = kPicture;
        inputs.depth = driver.makeView();
        parts = {{{0, 6, 0}, 0}, {{6, 36, 4}, 1}};
        objects.assign(1, {0, 1});
        objects.resize(1 + scene.boxes.size(), {1, 1});
        drawer.setScene(parts, objects, batches);
        geometry.positions = driver.makeBuffer();
        geometry.indices = driver.makeBuffer();
        transforms = scene.transforms();
    }
    void giveIds()
    {
        for (LightPlan& light : plan.lights) {
            light.first_object_id = static_cast<std::uint32_t>(plan.object_ids.size());
            plan.object_ids.resize(plan.object_ids.size() + objects.size(), 1);
        }
        plan.object_bounds.resize(objects.size(), {{-1.0F, -1.0F, -1.0F}, {1.0F, 1.0F, 1.0F}});
    }
    void prepare() { (void)renderer.prepare(plan, kPicture); }
    void begin() { drawer.beginFrame(0, plan, geometry, transforms); }
    void maps(std::uint32_t slot = 0) { renderer.recordMaps(driver.commands(), slot, plan, draw); }
    void mask(std::uint32_t slot = 0) { renderer.recordMask(driver.commands(), slot, plan, inputs); }
    /// Records a whole frame rightly.
    void record()
    {
        driver.beginSlot(0);
        prepare();
        begin();
        maps();
        mask();
    }

    NullDriver driver;
    Scene scene = makeScene();
    std::vector<Light> lights;
    Plan plan;
    vulkan::MaskInputs inputs;
    std::vector<vulkan::DrawPart> parts;
    std::vector<vulkan::DrawObject> objects;
    std::vector<vulkan::CasterBatch> batches = std::vector<vulkan::CasterBatch>(2);
    vulkan::CasterGeometry geometry;
    std::vector<vulkan::Rows3x4> transforms;
    ShadowRenderer renderer;
    CasterDrawer drawer;
    Profiler profiler;
    vulkan::DrawCasters draw = [this](const MapPass& pass) {
        drawer.draw(pass);
    };
};

inline std::string sentenceOf(const std::function<void()>& call)
{
    try {
        call();
    } catch (const Error& error) {
        return error.what();
    }
    return "no Error";
}

/// Expects that the call throws with these words and records nothing, and that right calls go on.
inline void expectRefused(Misuser& host, const char* words, const std::function<void()>& call)
{
    host.driver.clearEvents();
    const std::string said = sentenceOf(call);
    EXPECT_NE(said.find(words), std::string::npos) << said;
    EXPECT_TRUE(host.driver.events().empty()) << words;
}

} // namespace gnomon::test
