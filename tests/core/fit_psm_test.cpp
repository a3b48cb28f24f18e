// SPDX-License-Identifier: Apache-2.0
// PSM's homography against the whole pipeline of the paper, and the kinds of light in post-perspective space.
#include "fit_stage.h"

#include "fit/psm.h"

#include <gtest/gtest.h>

#include <array>

namespace gnomon {
namespace {

using test::FitStage;
using test::Random;
using test::Stage;

Stage randomStage(Random& random)
{
    Stage stage;
    for (int i = 0; i < 6; ++i)
        stage.set.add(test::boxAt(random.inBox({-20, 0, -20}, {20, 5, 20}), random.inBox({1, 0, 1}, {9, 3, 9})));
    const glm::dvec3 eye = random.inBox({-40, 1, -40}, {40, 30, 40});
    stage.camera = test::perspectiveCamera(eye, random.inBox({-10, 0, -10}, {10, 5, 10}), random.uniform(0.2, 1.8));
    stage.light = random.below(2) == 0 ? test::sun(random.direction())
                                       : test::spot(random.inBox({-40, 5, -40}, {40, 60, 40}), random.direction(), 0.9);
    return stage;
}

/// The paper's way: to post-perspective space, and from there a picture from the light toward the middle of the cube.
class Pipeline {
public:
    Pipeline(const Stage& stage, const FitStage& seen)
    {
        const glm::dmat4 view = glm::dmat4(1.0);
        double near = 1e9;
        double far = 0.0;
        for (const glm::dvec3& p : seen.region.body().points()) {
            near = std::min(near, seen.view.depthOf(p));
            far = std::max(far, seen.view.depthOf(p));
        }
        // x and y are the camera's; z is remade as OpenGL has it, from w, which is the depth here.
        post_from_world_ = stage.camera.clip_from_world * view;
        for (int column = 0; column < 4; ++column)
            post_from_world_[column][2] = post_from_world_[column][3] * (far + near) / (far - near);
        post_from_world_[3][2] -= 2.0 * far * near / (far - near);
        const glm::dvec4 light = seen.space.perspective ? glm::dvec4(stage.light.position_ws, 1.0)
                                                        : glm::dvec4(-stage.light.direction_ws, 0.0);
        const glm::dvec4 image = post_from_world_ * light;
        place_ = glm::dvec3(image) / image.w;
        toward_ = glm::normalize(-place_);
        across_ =
            glm::normalize(glm::cross(toward_, std::abs(toward_.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
        upward_ = glm::cross(across_, toward_);
    }
    [[nodiscard]] glm::dvec2 operator()(const glm::dvec3& p) const
    {
        const glm::dvec4 post = post_from_world_ * glm::dvec4(p, 1.0);
        const glm::dvec3 ray = glm::dvec3(post) / post.w - place_;
        return glm::dvec2(glm::dot(ray, across_), glm::dot(ray, upward_)) / glm::dot(ray, toward_);
    }

private:
    glm::dmat4 post_from_world_{1.0};
    glm::dvec3 place_{0.0};
    glm::dvec3 toward_{0.0};
    glm::dvec3 across_{0.0};
    glm::dvec3 upward_{0.0};
};

TEST(FitPsm, IsThePapersPipelineUpToAnAffineMap)
{
    Random random(7);
    std::array<int, 3> kinds{};
    int compared = 0;
    double worst = 0.0;
    for (int round = 0; round < 2000; ++round) {
        Stage stage = randomStage(random);
        const FitStage seen(stage);
        if (!seen.found)
            continue;
        const Plan plan = stage.plan(Fit::psm);
        if (plan.lights[0].outcome.kind != OutcomeKind::ok || plan.views[0].fit.strength < 1.2)
            continue;
        ++kinds[static_cast<std::size_t>(psmImageOf(seen.input()).kind)];
        const Pipeline pipeline(stage, seen);
        // Random points of the body; three of them tell the affine map, all others test it.
        const std::span corners = seen.region.body().points();
        std::vector<glm::dvec2> theirs;
        std::vector<glm::dvec2> ours;
        for (int i = 0; i < 12; ++i) {
            glm::dvec3 p(0.0);
            double sum = 0.0;
            for (int k = 0; k < 4; ++k) {
                const double weight = random.uniform(0.01, 1.0);
                p += corners[random.below(static_cast<std::uint32_t>(corners.size()))] * weight;
                sum += weight;
            }
            theirs.push_back(pipeline(p / sum));
            ours.push_back(test::mapPlace(plan.views[0], p / sum));
        }
        const glm::dmat2 from(theirs[1] - theirs[0], theirs[2] - theirs[0]);
        const glm::dmat2 to(ours[1] - ours[0], ours[2] - ours[0]);
        if (std::abs(glm::determinant(to)) < 0.05)
            continue;
        const glm::dmat2 affine = to * glm::inverse(from);
        for (std::size_t i = 3; i < ours.size(); ++i)
            worst = std::max(worst, glm::length(ours[0] + affine * (theirs[i] - theirs[0]) - ours[i]));
        ++compared;
    }
    EXPECT_LT(worst, 1e-6);
    EXPECT_GT(compared, 100);
    EXPECT_GT(kinds[static_cast<std::size_t>(PsmLight::point)], 20);
    EXPECT_GT(kinds[static_cast<std::size_t>(PsmLight::inverse)], 20);
}

PsmLight kindOf(const Light& light)
{
    Stage stage = test::levelGround();
    stage.light = light;
    return psmImageOf(FitStage(stage).input()).kind;
}

TEST(FitPsm, TellsPointInverseAndParallelLights)
{
    // The viewer looks along -z.
    EXPECT_EQ(kindOf(test::sun({0.1, -1, 1})), PsmLight::point);    // it shines toward him from ahead
    EXPECT_EQ(kindOf(test::sun({0.1, -1, -1})), PsmLight::inverse); // from behind
    EXPECT_EQ(kindOf(test::sun({0.3, -1, 0})), PsmLight::parallel);
    EXPECT_EQ(kindOf(test::spot({0, 9, -9}, {0, -1, 0}, 0.9)), PsmLight::point);
    EXPECT_EQ(kindOf(test::spot({0, 9, 9}, {0, -1, -1}, 0.9)), PsmLight::inverse);
    EXPECT_EQ(kindOf(test::spot({3, 9, 0}, {0, -1, -1}, 0.9)), PsmLight::parallel);
}

TEST(FitPsm, WarpsAllThreeKinds)
{
    for (const double ahead : {-0.5, 0.0, 0.5}) {
        Stage stage = test::levelGround();
        stage.light = test::sun({0.1, -1, ahead});
        const Plan plan = stage.plan(Fit::psm);
        EXPECT_EQ(plan.lights[0].outcome.kind, OutcomeKind::ok) << ahead << ": " << plan.lights[0].outcome.reason;
        EXPECT_GT(plan.views[0].fit.strength, 10.0);
    }
}

TEST(FitPsm, SaysWhyItDoesNotWarp)
{
    Stage stage = test::levelGround();
    const auto reason = [&] {
        const Outcome outcome = stage.plan(Fit::psm).lights[0].outcome;
        EXPECT_EQ(outcome.kind, OutcomeKind::fallback);
        return std::string(outcome.reason);
    };
    stage.light = test::spot({0, 5, -30}, {0, -1, 0}, 0.9); // a lamp that the viewer sees
    EXPECT_NE(reason().find("in the camera's view"), std::string::npos);
    // A lamp close beside the picture, on a wall that is seen farther in that corner than the lamp itself.
    stage.set.add(test::boxAt({0, 50, -60}, {200, 50, 1}));
    stage.light = test::spot({10.0, 9.2, -20}, {0, 0.3, -1}, 1.0);
    EXPECT_NE(reason().find("lies around the light"), std::string::npos);
    stage.light = test::sun({0.1, -1, 0});
    stage.options.border_texels = 64.0;
    stage.options.map_size = 1024;
    EXPECT_NE(reason().find("stronger warp than the map can bear"), std::string::npos);
}

} // namespace
} // namespace gnomon
