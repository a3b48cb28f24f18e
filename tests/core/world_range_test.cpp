// SPDX-License-Identifier: Apache-2.0
// Beyond the range of sizes and places every light is refused with a reason; within it all are planned.
#include "worlds.h"

#include <gnomon/planner.h>
#include <gnomon/world_range.h>

#include <gtest/gtest.h>

#include <limits>
#include <string>

namespace gnomon {
namespace {

Aabb boxOf(double size_m, const glm::dvec3& low)
{
    return {glm::vec3(low), glm::vec3(low + glm::dvec3(size_m, 0.1 * size_m, 0.5 * size_m))};
}

TEST(WorldRange, HasEnds)
{
    EXPECT_TRUE(rangeFault({}).empty());
    EXPECT_TRUE(rangeFault(boxOf(1.01e-6, glm::dvec3(0.0))).empty());
    EXPECT_NE(rangeFault(boxOf(0.99e-6, glm::dvec3(0.0))).find("smaller than 1e-6 m"), std::string_view::npos);
    EXPECT_TRUE(rangeFault({glm::vec3(1e6F), glm::vec3(1e6F)}).empty()); // a point
    EXPECT_TRUE(rangeFault(boxOf(1.9e9, glm::dvec3(-0.95e9))).empty());
    EXPECT_NE(rangeFault(boxOf(1.1e9, glm::dvec3(0.0))).find("farther than 1e9 m"), std::string_view::npos);
    EXPECT_NE(rangeFault(boxOf(1.1e9, glm::dvec3(-1.1e9))).find("farther than 1e9 m"), std::string_view::npos);
    EXPECT_TRUE(rangeFault(boxOf(11.0, glm::dvec3(0.0, 0.0, 1e6))).empty());
    EXPECT_NE(rangeFault(boxOf(9.0, glm::dvec3(0.0, 0.0, 1e6))).find("1/100000"), std::string_view::npos);
    EXPECT_TRUE(isTooFar({0.0, 0.0, std::numeric_limits<double>::quiet_NaN()}));
    EXPECT_TRUE(isTooFar({0.0, -1.1e9, 0.0}));
    EXPECT_FALSE(isTooFar({1e9, -1e9, 0.0}));
}

/// A slab on a floor under a sun and a lamp, seen from above; lengths times `scale`.
struct Slab {
    ObjectSet set;
    std::vector<Light> lights;
    Frame frame;

    explicit Slab(double scale, const glm::dvec3& away = {})
    {
        const auto box = [&](const glm::dvec3& low, const glm::dvec3& high) {
            return Aabb{glm::vec3(low * scale + away), glm::vec3(high * scale + away)};
        };
        set.add(box({-8, -1, -8}, {8, 0, 8}));
        set.add(box({-1, 2, -1}, {1, 3, 1}));
        lights = {test::sun({0.4, -1, 0.2}), test::spot(glm::dvec3(1, 9, 0) * scale + away, {0, -1, 0}, 0.8)};
        lights[1].key = 1;
        lights[1].range_m = 20.0 * scale;
        frame.camera =
            test::perspectiveCamera(glm::dvec3(6, 8, 9) * scale + away, away, 1.0, 1.6, 0.1 * scale, 1000.0 * scale);
        frame.objects = &set;
        frame.lights = lights;
    }
};

TEST(WorldRange, PlansTheSameAtEverySizeWithin)
{
    for (const Partition partition : {Partition::single, Partition::cascades, Partition::sdsm}) {
        ShadowOptions options{.technique = kPlainTechnique};
        options.technique.partition = partition;
        options.technique.motion = partition == Partition::cascades ? Motion::snap : Motion::free;
        Planner first(options);
        const Slab slab(1.0);
        const Plan& plan = first.plan(slab.frame);
        for (const double scale : {0x1p-23, 0x1p-12, 0x1p12, 0x1p25}) {
            SCOPED_TRACE(scale);
            Planner planner(options);
            const Slab other(scale);
            const Plan& scaled = planner.plan(other.frame);
            ASSERT_EQ(scaled.views.size(), plan.views.size());
            for (std::size_t i = 0; i < plan.views.size(); ++i) {
                const double unit = plan.views[i].projection.parallel ? scale : 1.0; // a lamp's texels are tangents
                EXPECT_NEAR(scaled.views[i].projection.texel_m / unit / plan.views[i].projection.texel_m, 1.0, 1e-9);
                EXPECT_NEAR(scaled.views[i].projection.metric.far_m / scale / plan.views[i].projection.metric.far_m,
                            1.0, 1e-9);
                EXPECT_EQ(scaled.views[i].casters.count, plan.views[i].casters.count);
            }
        }
    }
}

void expectDegenerate(const Slab& slab, std::string_view part)
{
    Planner planner{ShadowOptions{.technique = kPlainTechnique}};
    for (const LightPlan& light : planner.plan(slab.frame).lights) {
        EXPECT_EQ(light.outcome.kind, OutcomeKind::degenerate);
        EXPECT_NE(light.outcome.reason.find(part), std::string_view::npos) << light.outcome.reason;
    }
}

TEST(WorldRange, SaysWhatIsBeyond)
{
    expectDegenerate(Slab(1e-8), "smaller than 1e-6 m");
    expectDegenerate(Slab(2e8), "farther than 1e9 m");
    expectDegenerate(Slab(1.0, {1e7, 0.0, 0.0}), "1/100000");
    Slab far_eye(1.0);
    far_eye.frame.camera.eye_ws.y = 2e9;
    expectDegenerate(far_eye, "the camera is farther");
}

TEST(WorldRange, HoldsForLightsToo)
{
    Slab slab(1.0);
    Planner planner{ShadowOptions{.technique = kPlainTechnique}};
    const auto reasonOf = [&](const Light& light) {
        slab.lights[1] = light;
        slab.frame.lights = slab.lights;
        const Plan& plan = planner.plan(slab.frame);
        EXPECT_EQ(plan.lights[0].outcome.kind, OutcomeKind::ok);
        return std::string(plan.lights[1].outcome.reason);
    };
    Light light = slab.lights[1];
    light.position_ws.y = 2e9;
    EXPECT_EQ(reasonOf(light), "the light is farther than 1e9 m from the origin");
    light.position_ws.y = 9.0;
    light.range_m = 2e9;
    EXPECT_EQ(reasonOf(light), "the light's range or radius is larger than 1e9 m");
    light.range_m = 20.0;
    EXPECT_EQ(reasonOf(light), "");
}

} // namespace
} // namespace gnomon
