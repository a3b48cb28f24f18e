// SPDX-License-Identifier: Apache-2.0
// Where one frustum of partition multi ends and another begins, a shadow's edge goes on as if nothing were there: the
// step from the one's last pixel to the other's first is no larger than those before and behind it.
#include "host/frame_renderer.h"
#include "lab/score/view_shares.h"
#include "scene/state.h"
#include "worlds/worlds.h"

#include <gnomon/options.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace gnomon::lab {
namespace {

struct Seams {
    std::size_t pairs = 0;     // neighbours that two frustums shadow, with an edge of a shadow there
    double median_step = 0.0;  // of visibility, beyond what the neighbours' neighbours have
    double largest_step = 0.0; // that a twentieth of them exceed
    std::size_t views = 0;
};

/// Which of the views counts most; -1: none.
int strongest(const ImageF& shares, std::uint32_t x, std::uint32_t y)
{
    const float* const here = shares.pixel(x, y);
    const float* const most = std::max_element(here, here + shares.channels);
    return *most > 0.0F ? static_cast<int>(most - here) : -1;
}

Seams seamsOf(const ImageF& mask, const ImageF& shares)
{
    std::vector<double> steps;
    const auto look = [&](std::uint32_t x, std::uint32_t y, std::uint32_t dx, std::uint32_t dy) {
        const int here = strongest(shares, x, y);
        const int there = strongest(shares, x + dx, y + dy);
        if (here < 0 || there < 0 || here == there) {
            return;
        }
        const auto v = [&](int i) {
            return static_cast<double>(*mask.pixel(x + i * static_cast<int>(dx), y + i * static_cast<int>(dy)));
        };
        const auto [least, most] = std::minmax({v(-1), v(0), v(1), v(2)});
        if (most > least) {
            steps.push_back(std::abs(v(1) - v(0)) - std::max(std::abs(v(0) - v(-1)), std::abs(v(2) - v(1))));
        }
    };
    for (std::uint32_t y = 1; y + 2 < mask.height; ++y) {
        for (std::uint32_t x = 1; x + 2 < mask.width; ++x) {
            look(x, y, 1, 0);
            look(x, y, 0, 1);
        }
    }
    Seams seams;
    seams.pairs = steps.size();
    if (!steps.empty()) {
        std::sort(steps.begin(), steps.end());
        seams.median_step = steps[steps.size() / 2];
        seams.largest_step = steps[steps.size() - 1 - steps.size() / 20];
    }
    return seams;
}

/// The world `planes` on 64 tiles that join.
scene::Scene planesOnTiles()
{
    scene::Scene scene = worlds::load("planes", 1);
    constexpr float kTile_m = 5.0F;
    for (scene::Node& node : scene.nodes) {
        if (node.mesh == scene::kNone || scene.meshes[node.mesh].primitives[0].bounds.max.y > 0.0F) {
            continue;
        }
        scene::Primitive tile;
        tile.material = scene.meshes[node.mesh].primitives[0].material;
        tile.positions = {{0, 0, kTile_m}, {kTile_m, 0, kTile_m}, {kTile_m, 0, 0}, {0, 0, 0}};
        tile.normals.assign(4, {0.0F, 1.0F, 0.0F});
        tile.indices = {0, 1, 2, 0, 2, 3};
        scene.meshes[node.mesh].primitives = {tile};
        for (int i = 0; i < 64; ++i) {
            glm::mat4 place(1.0F);
            place[3] = {kTile_m * static_cast<float>(i % 8 - 4), 0.0F, kTile_m * static_cast<float>(i / 8 - 4), 1.0F};
            node.instances.push_back(place);
        }
    }
    scene::finishScene(scene);
    return scene;
}

class MultiSeams : public testing::TestWithParam<Filter> {
protected:
    Seams draw(const scene::Scene& scene, MultiDivide divide, double blend)
    {
        const scene::State state = scene::evaluate(scene, 0.0);
        std::vector<host::ShadedLight> lights = host::lightsOf(scene, state);
        lights.resize(1);
        lights[0].caster.type = LightType::point;
        lights[0].caster.position_ws = {-3.5, 3.0, 0.3};
        lights[0].caster.radius_m = 0.3;
        host::RenderOptions options;
        options.width = 480;
        options.height = 270;
        options.shadow.technique = {.partition = Partition::multi, .fit = Fit::uniform, .filter = GetParam()};
        options.shadow.max_texels = 1U << 20U;
        options.shadow.multi = {.divide = divide, .texels_per_pixel = 1.0, .most_times = 2.0};
        options.shadow.cascades.blend = blend;
        const host::Eye eye{.position_ws = {6.0, 2.0, 5.0}, .target_ws = {0.0, 0.0, 0.0}, .fov_y_rad = 0.9};
        host::Gpu gpu({.gpu = "software", .validate = true});
        const host::SceneOnGpu uploaded(gpu, scene, state);
        host::FrameRenderer renderer(uploaded, options);
        renderer.draw(state, eye, lights);
        const host::Picture picture =
            renderer.read({.colour = false, .linear = false, .masks = true, .geometry = true});
        const Camera camera = host::cameraOf(eye, options.width, options.height, state.bounds_ws);
        const ImageF shares = viewShares({camera, picture.depth, picture.normals}, renderer.plan(), 0,
                                         static_cast<double>(reachTexels(options.shadow)));
        EXPECT_EQ(gpu.messages(), std::vector<std::string>{});
        Seams seams = seamsOf(picture.masks[0], shares);
        seams.views = renderer.plan().lights[0].view_count;
        RecordProperty("pairs", static_cast<int>(seams.pairs));
        RecordProperty("views", static_cast<int>(seams.views));
        RecordProperty("median_step", std::to_string(seams.median_step));
        RecordProperty("largest_step", std::to_string(seams.largest_step));
        return seams;
    }
};

TEST_P(MultiSeams, AreNotToBeSeen)
{
    const Seams seams = draw(worlds::load("planes", 1), MultiDivide::space, 0.1);
    ASSERT_GE(seams.views, 4U);
    ASSERT_GE(seams.pairs, 20U) << "no shadow's edge crosses a border of frustums";
    EXPECT_LE(seams.median_step, 1.0 / 255.0);
}

TEST_P(MultiSeams, OfJoinedReceiversAreNotToBeSeen)
{
    const Seams seams = draw(planesOnTiles(), MultiDivide::receivers, 0.2);
    ASSERT_GE(seams.views, 3U);
    ASSERT_GE(seams.pairs, 20U) << "no shadow's edge crosses a border of frustums";
    EXPECT_LE(seams.median_step, 1.0 / 255.0);
}

INSTANTIATE_TEST_SUITE_P(All, MultiSeams,
                         testing::Values(Filter::hard, Filter::pcf, Filter::pcss, Filter::raymarch, Filter::vsm,
                                         Filter::msm, Filter::evsm),
                         [](const auto& filter) { return std::string(nameOf(filter.param)); });

} // namespace
} // namespace gnomon::lab
