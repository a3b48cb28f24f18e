// SPDX-License-Identifier: Apache-2.0
// An orthographic camera has the masks of the truth with every partition, fit and filter, and no warp.
#include "host/frame_renderer.h"
#include "scene/state.h"
#include "small_scene.h"
#include "traced.h"

#include <gnomon/choice_rules.h>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace gnomon::host::test {
namespace {

constexpr std::uint32_t kWidth = 160;
constexpr std::uint32_t kHeight = 100;
enum : std::uint32_t { kTheSun, kTheSpot, kTheLamp, kLights };

/// Closed, and outside is in front.
scene::Primitive box(const glm::vec3& centre, const glm::vec3& half)
{
    scene::Primitive out;
    for (int axis = 0; axis < 3; ++axis) {
        for (const float side : {-1.0F, 1.0F}) {
            glm::vec3 n(0.0F);
            n[axis] = side;
            glm::vec3 u(0.0F);
            u[(axis + 1) % 3] = side;
            const glm::vec3 v = glm::cross(n, u);
            const auto first = static_cast<std::uint32_t>(out.positions.size());
            for (const glm::vec3& corner : {n - u - v, n + u - v, n + u + v, n - u + v}) {
                out.positions.push_back(centre + half * corner);
                out.normals.push_back(n);
            }
            for (const std::uint32_t i : {0U, 1U, 2U, 0U, 2U, 3U}) {
                out.indices.push_back(first + i);
            }
        }
    }
    return out;
}

scene::Scene boxes()
{
    scene::Scene scene;
    addMesh(scene, box({0, -0.5F, 0}, {12, 0.5F, 12}));
    addMesh(scene, box({-3, 1, 1}, {1, 1, 1}));
    addMesh(scene, box({2, 1.5F, -3}, {0.4F, 1.5F, 0.8F}));
    addMesh(scene, box({4, 2.5F, 3}, {1.5F, 0.2F, 1}));
    scene.lights.resize(kLights);
    scene.lights[kTheSun].intensity = 3.0F;
    scene.lights[kTheSpot] = {.type = scene::LightType::spot, .intensity = 300.0F, .range_m = 40.0F};
    scene.lights[kTheSpot].outer_cone_rad = 1.0F;
    scene.lights[kTheLamp] = {.type = scene::LightType::point, .intensity = 200.0F, .range_m = 40.0F};
    for (std::uint32_t i = 0; i < kLights; ++i) {
        scene::Node node;
        node.light = i;
        node.transform.translation = {0.7F, 9.0F, 1.3F};
        const glm::quat turn = glm::angleAxis(2.6F, glm::vec3(0, 1, 0));
        node.transform.rotation = turn * glm::angleAxis(i == kTheSun ? -0.8F : -1.4F, glm::vec3(1, 0, 0));
        scene.nodes.push_back(node);
    }
    scene::finishScene(scene);
    return scene;
}

/// Obliquely, with a corner of the ground beside the picture and the eye's plane through none of it.
Eye eyeOf(double height_m)
{
    Eye eye;
    eye.position_ws = {9.0, 14.0, 17.0};
    eye.target_ws = {0.3, 0.5, 0.2};
    eye.height_m = height_m;
    return eye;
}

RenderOptions optionsOf(const ShadowOptions& shadow)
{
    RenderOptions options;
    options.width = kWidth;
    options.height = kHeight;
    options.shadow = shadow;
    options.shadow.map_size = 1024;
    return options;
}

class Orthographic : public testing::Test {
protected:
    Orthographic()
        : scene_(boxes()), state_(scene::evaluate(scene_, 0.0)), gpu_({.validate = true}),
          uploaded_(gpu_, scene_, state_), lights_(lightsOf(scene_, state_))
    {
    }
    ~Orthographic() override { EXPECT_EQ(gpu_.messages(), std::vector<std::string>{}); }

    const ImageF& truthOf(std::uint32_t light, const Eye& eye)
    {
        if (truths_.size() < kLights) {
            for (std::uint32_t i = 0; i < kLights; ++i) {
                truths_.push_back(tracedMask(scene_, state_, eye, kWidth, kHeight, i));
            }
        }
        return truths_[light];
    }

    /// Draws one light's mask. Nothing where the technique is refused; `why`: the outcome's reason.
    std::optional<std::size_t> wrongOf(const ShadowOptions& shadow, std::uint32_t light, int frames = 1,
                                       Outcome* outcome = nullptr)
    {
        const Eye eye = eyeOf(11.0);
        if (!resolve(shadow) || refusal(lights_[light].caster.type, shadow)) {
            return std::nullopt;
        }
        FrameRenderer renderer(uploaded_, optionsOf(shadow));
        for (int i = 0; i < frames; ++i) {
            renderer.draw(state_, eye, {lights_[light]});
        }
        const Outcome found = renderer.plan().lights[0].outcome;
        if (outcome != nullptr) {
            *outcome = found;
        }
        if (!found.hasMap()) {
            return std::nullopt;
        }
        const Picture picture = renderer.read({.masks = true});
        return wrongPixels(picture.masks.at(0), truthOf(light, eye));
    }

    scene::Scene scene_;
    scene::State state_;
    Gpu gpu_;
    SceneOnGpu uploaded_;
    std::vector<ShadedLight> lights_;
    std::vector<ImageF> truths_;
};

/// Pixels at edges of shadows, which a texel may take for the other side.
constexpr std::size_t kEdges = kWidth * kHeight / 100;

TEST_F(Orthographic, TruthHasShadowAndLight)
{
    for (std::uint32_t light = 0; light < kLights; ++light) {
        const ImageF& truth = truthOf(light, eyeOf(11.0));
        const auto dark = std::count_if(truth.values.begin(), truth.values.end(), [](float v) { return v < 0.5F; });
        EXPECT_GT(dark, 900) << light;
        EXPECT_LT(dark, 12000) << light;
    }
}

TEST_F(Orthographic, EveryPartitionAndFitIsTheTruth)
{
    std::size_t drawn[kLights] = {};
    for (std::uint32_t light = 0; light < kLights; ++light) {
        for (const Partition partition : {Partition::single, Partition::cascades, Partition::sdsm, Partition::cube,
                                          Partition::paraboloid, Partition::multi, Partition::automatic}) {
            for (const Fit fit :
                 {Fit::uniform, Fit::lispsm, Fit::lispsm_simple, Fit::tsm, Fit::psm, Fit::scene, Fit::automatic}) {
                ShadowOptions shadow;
                shadow.technique.partition = partition;
                shadow.technique.fit = fit;
                shadow.technique.filter = Filter::hard;
                Outcome outcome;
                const std::optional<std::size_t> wrong = wrongOf(shadow, light, 1, &outcome);
                if (!wrong) {
                    EXPECT_TRUE(outcome.kind == OutcomeKind::refused || outcome.reason.empty()) << outcome.reason;
                    continue;
                }
                ++drawn[light];
                // A paraboloid bends long edges.
                EXPECT_LT(*wrong, partition == Partition::paraboloid ? 3 * kEdges : kEdges)
                    << light << " " << nameOf(partition) << " " << nameOf(fit);
                const bool warps =
                    fit == Fit::lispsm || fit == Fit::lispsm_simple || fit == Fit::tsm || fit == Fit::psm;
                if (warps && partition == Partition::single) {
                    EXPECT_EQ(outcome.kind, OutcomeKind::fallback) << nameOf(fit); // nothing to gain
                    EXPECT_NE(outcome.reason.find("near and far things equally large"), std::string_view::npos)
                        << outcome.reason;
                }
            }
        }
    }
    EXPECT_GE(drawn[kTheSun], 14U);
    EXPECT_GE(drawn[kTheSpot], 7U);
    EXPECT_GE(drawn[kTheLamp], 3U);
}

TEST_F(Orthographic, EveryFilterIsTheTruth)
{
    for (const Filter filter : {Filter::pcf, Filter::vsm, Filter::msm, Filter::depth_id, Filter::volumes}) {
        for (std::uint32_t light = 0; light < kLights; ++light) {
            ShadowOptions shadow;
            shadow.technique.filter = filter;
            shadow.technique.partition = Partition::automatic;
            const std::optional<std::size_t> wrong = wrongOf(shadow, light);
            ASSERT_TRUE(wrong) << nameOf(filter);
            EXPECT_LT(*wrong, 2 * kEdges) << light << " " << nameOf(filter);
        }
    }
}

TEST_F(Orthographic, ConvergesAndSnaps)
{
    ShadowOptions shadow;
    shadow.technique.filter = Filter::hard;
    shadow.technique.soften = Soften::converge;
    const std::optional<std::size_t> converged = wrongOf(shadow, kTheSun, 16);
    ASSERT_TRUE(converged);
    EXPECT_LT(*converged, kEdges);
    shadow.technique.soften = Soften::none;
    shadow.technique.motion = Motion::snap;
    const std::optional<std::size_t> snapped = wrongOf(shadow, kTheSun, 2);
    ASSERT_TRUE(snapped);
    EXPECT_LT(*snapped, 2 * kEdges);
}

TEST_F(Orthographic, ForwardShadingSeesTheSameSurface)
{
    RenderOptions options = optionsOf({});
    FrameRenderer deferred(uploaded_, options);
    options.shading = Shading::forward;
    FrameRenderer forward(uploaded_, options);
    const Eye eye = eyeOf(11.0);
    deferred.draw(state_, eye, lights_);
    forward.draw(state_, eye, lights_);
    const Image8 a = deferred.read({}).colour;
    const Image8 b = forward.read({}).colour;
    ASSERT_EQ(a.values.size(), b.values.size());
    std::size_t differ = 0;
    for (std::size_t i = 0; i < a.values.size(); ++i) {
        differ += std::abs(a.values[i] - b.values[i]) > 5 ? 1 : 0;
    }
    EXPECT_LT(differ, a.values.size() / 100);
}

} // namespace
} // namespace gnomon::host::test
