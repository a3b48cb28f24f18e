// SPDX-License-Identifier: Apache-2.0
// Walks in which cascades take turns, drawn: what waits shows what it showed, and no light leaks where it ends.
#include "host/frame_renderer.h"
#include "small_scene.h"

#include "scene/state.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::host::test {
namespace {

void addBox(scene::Scene& scene, glm::vec3 low, glm::vec3 high)
{
    constexpr std::array<std::array<int, 4>, 6> kFaces{
        {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
    scene::Primitive primitive;
    for (const auto& face : kFaces) {
        const auto first = static_cast<std::uint32_t>(primitive.positions.size());
        for (const int corner : face) {
            primitive.positions.push_back(Aabb{low, high}.corner(corner));
        }
        for (const std::uint32_t i : {0U, 1U, 2U, 0U, 2U, 3U}) {
            primitive.indices.push_back(first + i);
        }
    }
    addMesh(scene, std::move(primitive));
}

/// A field with pillars, and a roof over the left half of it: in its shadow a leak shows.
scene::Scene field()
{
    scene::Scene scene;
    scene.materials.resize(1);
    addBox(scene, {-60, -1, -120}, {60, 0, 10});
    addBox(scene, {-60, 7, -120}, {-1, 7.5, 10});
    for (int z = -110; z < 8; z += 6) {
        addBox(scene, {2, 0, z}, {3, 4, z + 1});
    }
    scene.lights.resize(1);
    scene::Node node;
    node.light = 0;
    node.transform.rotation = glm::angleAxis(-1.2F, glm::vec3(1, 0, 0));
    scene.nodes.push_back(node);
    finishScene(scene);
    return scene;
}

Eye eyeAt(int frame)
{
    Eye eye;
    eye.position_ws = {0.5 + 0.02 * frame, 1.7, 6.0 - 0.08 * frame};
    eye.target_ws = {0.5 - 0.9 * frame, 1.0, -20.0};
    return eye;
}

struct Field {
    scene::Scene scene = field();
    scene::State state = scene::evaluate(scene, 0.0);
    Gpu gpu{{.gpu = "software", .validate = true}};
    SceneOnGpu uploaded{gpu, scene, state};
    std::vector<ShadedLight> lights = lightsOf(scene, state);

    static RenderOptions options()
    {
        RenderOptions options;
        options.width = 160;
        options.height = 96;
        options.shadow.technique.partition = Partition::cascades;
        options.shadow.technique.filter = Filter::pcf;
        options.shadow.map_size = 512;
        return options;
    }
};

// By the device's own times: the first frames tell what a texel takes, and then less is drawn than is out of date.
TEST(DrawMilliseconds, BoundWhatIsDrawnOnceTheyAreKnown)
{
    Field field;
    RenderOptions options = Field::options();
    options.shadow.cascades.room = 0.1;
    options.shadow.draw_budget_ms = 1e-6; // less than any map takes
    options.shadow.longest_wait = 6;
    {
        FrameRenderer renderer(field.uploaded, options);
        std::vector<std::uint64_t> drawn;
        std::uint32_t longest = 0;
        for (int frame = 0; frame < 16; ++frame) {
            renderer.draw(field.state, eyeAt(frame), field.lights);
            drawn.push_back(renderer.plan().pages[0].drawn_texels);
            longest = std::max(longest, renderer.plan().pages[0].longest_wait);
        }
        const std::uint64_t map = std::uint64_t{512} * 512;
        EXPECT_EQ(drawn[0], 4 * map);
        EXPECT_EQ(drawn[1], 4 * map) << "nothing was measured yet";
        EXPECT_EQ(*std::min_element(drawn.begin(), drawn.end()), map) << "the first cascade alone";
        EXPECT_GT(longest, 1U);
        EXPECT_LE(longest, 6U);
        options.shadow.draw_budget_ms = 10000.0;
        renderer.setShadows(options.shadow);
        for (int frame = 0; frame < 8; ++frame) {
            renderer.draw(field.state, eyeAt(frame), field.lights);
            EXPECT_EQ(renderer.plan().pages[0].waiting_maps, 0U) << "there is time for all";
        }
    }
    EXPECT_EQ(field.gpu.messages(), std::vector<std::string>{});
}

} // namespace
} // namespace gnomon::host::test
