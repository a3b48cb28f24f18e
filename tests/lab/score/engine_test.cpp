// SPDX-License-Identifier: Apache-2.0
// The use by an engine that draws by itself: it scores a mask of its own with plain images, a camera and a light. This
// binary links neither our host nor the backend.
#include "lab/score/score.h"
#include "lab/score/traffic.h"

#include "scene/state.h"
#include "worlds/worlds.h"

#include <gnomon/planner.h>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace gnomon::lab {
namespace {

constexpr glm::uvec2 kSize_px{96, 64};

/// A picture of an engine with ordinary depth: 0 at the near plane, 1 at the far one and where there is nothing.
class Engine {
public:
    Engine() : scene(worlds::load("planes", 1)), state(scene::evaluate(scene, 0.0))
    {
        glm::dmat4 clip_from_view = glm::perspectiveRH_ZO(0.9, 1.5, 0.1, 200.0);
        clip_from_view[1][1] *= -1.0;
        camera.eye_ws = {6.0, 5.0, 8.0};
        camera.clip_from_world = clip_from_view * glm::lookAtRH(camera.eye_ws, {0.0, 1.0, 0.0}, {0.0, 1.0, 0.0});
        camera.reversed_z = false;
        sun.direction_ws = glm::normalize(glm::dvec3(0.4, -1.0, 0.2));

        const truth::Tracer tracer(scene, state);
        const truth::Options options{.kind = truth::Kind::hard, .threads = 1};
        const truth::View view = truthView(camera, kSize_px);
        traced.surfaces = tracer.see(view, options).value();
        traced.visibility = tracer.trace(traced.surfaces, view, truthLight(sun), options).value();
        depth = ImageF(kSize_px.x, kSize_px.y, 1, 1.0F);
        for (std::size_t i = 0; i < depth.values.size(); ++i) {
            if (traced.surfaces.object_ids.values[i] != 0) {
                const float* p = traced.surfaces.points.values.data() + 3 * i;
                const glm::dvec4 clip =
                    camera.clip_from_world * glm::dvec4(camera.eye_ws + glm::dvec3(p[0], p[1], p[2]), 1.0);
                depth.values[i] = static_cast<float>(clip.z / clip.w);
            }
        }
    }
    [[nodiscard]] Score score(const ImageF& mask) const
    {
        return scoreMask({state, camera, sun}, traced, traced.surfaces.object_ids, mask);
    }
    scene::Scene scene;
    scene::State state;
    Camera camera;
    Light sun;
    truth::Traced traced;
    ImageF depth;
};

TEST(EngineScore, OfAMaskOfItsOwn)
{
    const Engine engine;
    const ImageF& exact = engine.traced.visibility.visibility;
    const Score perfect = engine.score(exact);
    const std::uint64_t counted = perfect.pixels.counts.counted;
    EXPECT_GT(counted, 1000U);
    EXPECT_GT(perfect.pixels.counts.background, 100U);
    EXPECT_EQ(perfect.error.value().rmse, 0.0);

    ImageF wrong = exact;
    std::size_t turned = 0; // a hundred counted pixels, each wrong by all there is
    for (std::size_t i = 0; i < wrong.values.size() && turned < 100; ++i) {
        if (perfect.pixels.counted.values[i] != 0) {
            wrong.values[i] = 1.0F - wrong.values[i];
            ++turned;
        }
    }
    const Score score = engine.score(wrong);
    EXPECT_NEAR(score.error.value().rmse, std::sqrt(100.0 / static_cast<double>(counted)), 1e-12);
    const ClassErrors& errors = score.classification.value().errors;
    EXPECT_NEAR(errors.edge + errors.acne + errors.detached + errors.bleeding + errors.terminator,
                100.0 / static_cast<double>(counted), 1e-12);
    EXPECT_LT(score.ssim.value(), 1.0);
    EXPECT_GT(score.flip.value(), 0.0);
    EXPECT_EQ(truthNoise(engine.traced.visibility, score.pixels.counted), 0.0);
}

TEST(EngineScore, KnowsWhatItsMapsDeliver)
{
    const Engine engine;
    ObjectSet objects;
    for (const scene::Object& object : engine.state.objects) {
        objects.add(object.bounds_ws, {object.casts, object.receives, object.dynamic});
    }
    Frame frame;
    frame.camera = engine.camera;
    frame.size_px = kSize_px;
    frame.lights = {&engine.sun, 1};
    frame.objects = &objects;
    const Sight seen{engine.camera, engine.depth, engine.traced.surfaces.normals};
    const Counted counted = engine.score(engine.traced.visibility.visibility).pixels.counted;
    double density = 0.0;
    for (const std::uint32_t map_size : {256U, 512U}) {
        Planner planner({.technique = kPlainTechnique, .map_size = map_size});
        const Plan& plan = planner.plan(frame);
        const TexelDensity delivered = texelDensity(seen, counted, plan, 0, 1.0);
        EXPECT_GT(delivered.counted, 1000U);
        if (map_size == 512) { // twice the texels along each side, except for the border of fixed width
            EXPECT_NEAR(delivered.p50 / density, 2.0, 0.1);
        }
        density = delivered.p50;
        const TexelUse use = texelUse(seen, counted, plan, 0, 1.0);
        EXPECT_EQ(use.held, std::uint64_t{map_size} * map_size);
        EXPECT_GT(use.read, delivered.counted / 2);
        const std::uint64_t pixels = kSize_px.x * kSize_px.y;
        EXPECT_EQ(leastBytes(seen, frame.lights, plan, {.reach_texels = 1.0}),
                  4 * (use.held + texelUse(seen, facingPixels(seen, engine.sun), plan, 0, 1.0).read) + 13 * pixels);
    }
}

} // namespace
} // namespace gnomon::lab
