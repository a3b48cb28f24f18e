// SPDX-License-Identifier: Apache-2.0
// A box's hard shadow on the ground of `planes`, against geometry: where the picture and the exact answer differ, the
// exact edge is at most one map texel away.
#include "host/renderer.h"
#include "scene/state.h"
#include "scene/worlds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace gnomon::host::test {
namespace {

using scene::PlanesWorld;

// Does the box stop the segment from `p` to the light (or the whole ray towards a sun)?
bool shadowedExactly(const Light& light, const glm::dvec3& p)
{
    const bool sun = light.type == LightType::directional;
    const glm::dvec3 ray = sun ? -light.direction_ws : light.position_ws - p;
    double enter = 0.0;
    double leave = sun ? 1e9 : 1.0;
    for (int axis = 0; axis < 3; ++axis) {
        const double low = double{PlanesWorld::box_min[axis]} - p[axis];
        const double high = double{PlanesWorld::box_max[axis]} - p[axis];
        if (ray[axis] == 0.0) {
            if (low > 0.0 || high < 0.0) {
                return false;
            }
            continue;
        }
        enter = std::max(enter, std::min(low / ray[axis], high / ray[axis]));
        leave = std::min(leave, std::max(low / ray[axis], high / ray[axis]));
    }
    return enter < leave;
}

glm::dvec2 texelOf(const View& view, const glm::dvec3& p)
{
    const glm::dvec4 clip = view.clip_from_world * glm::dvec4(p, 1.0);
    return (glm::dvec2(clip) / clip.w * 0.5 + 0.5) * glm::dvec2(view.tile.width, view.tile.height);
}

// The exact answers met within one texel of `p`, along the ground: bit 0 lit, bit 1 shadowed.
unsigned answersWithinOneTexel(const View& view, const Light& light, const glm::dvec3& p)
{
    constexpr double kStep_m = 1e-4;
    const glm::dvec2 here = texelOf(view, p);
    const glm::dvec2 along_x = (texelOf(view, p + glm::dvec3(kStep_m, 0.0, 0.0)) - here) / kStep_m;
    const glm::dvec2 along_z = (texelOf(view, p + glm::dvec3(0.0, 0.0, kStep_m)) - here) / kStep_m;
    const double det = along_x.x * along_z.y - along_x.y * along_z.x;
    unsigned met = shadowedExactly(light, p) ? 2U : 1U;
    for (int i = 0; i < 32; ++i) {
        const double angle = i * 0.19634954084936207; // a 32nd of a turn
        const glm::dvec2 d(std::cos(angle), std::sin(angle));
        const glm::dvec3 move((d.x * along_z.y - d.y * along_z.x) / det, 0.0,
                              (along_x.x * d.y - along_x.y * d.x) / det);
        for (const double radius : {0.5, 1.0}) {
            met |= shadowedExactly(light, p + move * radius) ? 2U : 1U;
        }
    }
    return met;
}

struct Tally {
    int lit = 0;
    int shadowed = 0;
    int beside_the_edge = 0; // not what geometry says, but within a texel of where it says so
    int wrong = 0;
};

// Tells how the mask of light `index` compares with geometry on the ground.
Tally tallyGround(const Picture& picture, const glm::dmat4& world_from_clip, const View& view, const Light& light,
                  std::size_t index)
{
    Tally tally;
    const ImageF& mask = picture.masks[index];
    for (std::uint32_t y = 0; y < mask.height; ++y) {
        for (std::uint32_t x = 0; x < mask.width; ++x) {
            const double depth = *picture.depth.pixel(x, y);
            const glm::dvec4 h = world_from_clip * glm::dvec4((x + 0.5) / mask.width * 2.0 - 1.0,
                                                              (y + 0.5) / mask.height * 2.0 - 1.0, depth, 1.0);
            const glm::dvec3 p = glm::dvec3(h) / h.w;
            if (depth == 0.0 || std::abs(p.y - double{PlanesWorld::ground_y}) > 1e-3) {
                continue;
            }
            const glm::dvec2 texel = texelOf(view, p);
            if (std::min(texel.x, texel.y) < 2.0 || texel.x > view.tile.width - 2.0 ||
                texel.y > view.tile.height - 2.0) {
                continue; // outside the cone: no map there
            }
            const float v = *mask.pixel(x, y);
            const unsigned said = v > 0.5F ? 1U : 2U;
            (said == 1U ? tally.lit : tally.shadowed)++;
            const bool agrees = (said == 2U) == shadowedExactly(light, p);
            if (!agrees) {
                ((answersWithinOneTexel(view, light, p) & said) != 0U ? tally.beside_the_edge : tally.wrong)++;
            }
        }
    }
    return tally;
}

class PlanesEdge : public testing::TestWithParam<std::uint32_t> {};

TEST_P(PlanesEdge, LiesWithinOneTexelOfWhereGeometryPutsIt)
{
    const scene::Scene scene = scene::makePlanes(1);
    const scene::State state = scene::evaluate(scene, 0.0);
    const std::vector<ShadedLight> lights = lightsOf(scene, state);
    RenderOptions options;
    options.width = 480;
    options.height = 360;
    options.plan.map_size = GetParam();
    options.filter.filter = Filter::hard;
    options.plan.technique.filter = Filter::hard;
    Gpu gpu({.gpu = "software", .validate = true});
    const Eye eye{.position_ws = {1.0, 14.0, 9.0}, .target_ws = {0.8, 0.0, 0.0}, .fov_y_rad = 0.7};
    Renderer renderer(gpu, scene, state, options);
    renderer.draw(state, eye, lights);
    const Picture picture = renderer.read({.colour = false, .linear = false, .masks = true, .geometry = true});
    const Camera camera = cameraOf(eye, options.width, options.height, state.bounds_ws);
    const glm::dmat4 world_from_clip = glm::inverse(camera.clip_from_world);
    ASSERT_EQ(lights.size(), 2U);
    for (std::size_t i = 0; i < lights.size(); ++i) {
        SCOPED_TRACE(lights[i].name);
        const LightPlan& plan = renderer.plan().lights[i];
        ASSERT_EQ(plan.view_count, 1U);
        const View& view = renderer.plan().views[plan.first_view];
        const Tally tally = tallyGround(picture, world_from_clip, view, lights[i].caster, i);
        EXPECT_GT(tally.lit, 10000);
        EXPECT_GT(tally.shadowed, 1000);
        EXPECT_EQ(tally.wrong, 0);
        RecordProperty(lights[i].name + "_beside_the_edge", tally.beside_the_edge);
    }
    EXPECT_EQ(gpu.messages(), std::vector<std::string>{});
}

INSTANTIATE_TEST_SUITE_P(MapSizes, PlanesEdge, testing::Values(128U, 256U, 1024U),
                         [](const auto& size) { return "map_" + std::to_string(size.param); });

} // namespace
} // namespace gnomon::host::test
