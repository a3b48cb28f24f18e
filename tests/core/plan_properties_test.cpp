// SPDX-License-Identifier: Apache-2.0
// What must hold for every plan, tried on random scenes, cameras and lights, the awkward ones included. The judge works
// with points and rays, and with the camera's matrix itself; it uses no plane, no body and no tree.
#include "worlds.h"

#include <gnomon/plan_views.h>
#include <gnomon/planner.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

namespace gnomon {
namespace {

using test::Random;

struct Scene {
    ObjectSet set;
    Camera camera;
    std::vector<Light> lights;
    PlanOptions options;
    double size_m = 1.0;
};

void addObjects(Random& random, Scene& scene, const glm::dvec3& origin)
{
    const double size = scene.size_m;
    if (random.below(30) == 0) { // a scene without size
        scene.set.add(test::boxAt(origin, glm::dvec3(0.0)));
        return;
    }
    const std::uint32_t count = 1 + random.below(40);
    for (std::uint32_t i = 0; i < count; ++i) {
        const glm::dvec3 centre = origin + random.inBox(glm::dvec3(-size, 0, -size), glm::dvec3(size));
        glm::dvec3 half = random.inBox(glm::dvec3(0), glm::dvec3(0.2 * size));
        if (random.below(8) == 0)
            half = glm::dvec3(0.0); // a point
        if (random.below(8) == 0)
            half[static_cast<int>(random.below(3))] = 0.0; // a sheet
        scene.set.add(test::boxAt(centre, half), {random.below(4) != 0, random.below(4) != 0, random.below(2) == 0});
    }
    if (random.below(2) == 0)
        scene.set.add(test::boxAt(origin, {2 * size, 0.0, 2 * size}), {random.below(2) == 0, true, false});
}

Camera randomCamera(Random& random, const Scene& scene, const glm::dvec3& origin, const glm::dvec3& sun)
{
    const double size = scene.size_m;
    const glm::dvec3 eye = origin + random.inBox(glm::dvec3(-2 * size), glm::dvec3(2 * size));
    glm::dvec3 target = origin + random.inBox(glm::dvec3(-size), glm::dvec3(size));
    if (random.below(6) == 0)
        target = eye + sun; // along the light
    if (random.below(6) == 0)
        target = eye - sun; // into it
    const double fov = glm::radians(random.uniform(1.0, 170.0));
    switch (random.below(4)) {
    case 0:
        return test::endlessCamera(eye, target, fov, random.uniform(0.3, 3.0), 0.01 * size);
    case 1:
        return test::orthographicCamera(eye, target, random.uniform(0.1, 3.0) * size, 5 * size);
    case 2: // a far plane so far that it means nothing
        return test::perspectiveCamera(eye, target, fov, 1.6, 0.001 * size, 1e7 * size);
    default:
        return test::perspectiveCamera(eye, target, fov, random.uniform(0.3, 3.0), 0.01 * size,
                                       random.uniform(0.5, 9.0) * size);
    }
}

Scene randomScene(std::uint64_t seed, Fit fit)
{
    Random random(seed);
    Scene scene;
    scene.options.technique.fit = fit;
    scene.size_m = std::pow(10.0, random.uniform(-1.0, 3.0));
    glm::dvec3 origin(0.0);
    if (random.below(3) == 0)
        origin = random.inBox(glm::dvec3(-1000), glm::dvec3(1000)) * scene.size_m * 0.2;
    addObjects(random, scene, origin);
    const glm::dvec3 sun = random.below(8) == 0 ? glm::dvec3(0, random.below(2) == 0 ? -1 : 1, 0) : random.direction();
    scene.lights.push_back(test::sun(sun));
    const glm::dvec3 place = origin + random.inBox(glm::dvec3(-1.5), glm::dvec3(1.5)) * scene.size_m;
    scene.lights.push_back(test::spot(place, random.direction(), glm::radians(random.uniform(1.0, 60.0)),
                                      random.below(2) == 0 ? 0.0 : random.uniform(0.2, 4.0) * scene.size_m));
    const glm::dvec3 above = origin + glm::dvec3(0, random.uniform(1.0, 500.0) * scene.size_m, 0);
    scene.lights.push_back(test::spot(above, {0, -1, 0}, glm::radians(random.uniform(1.0, 60.0))));
    scene.camera = randomCamera(random, scene, origin, scene.lights[0].direction_ws);
    scene.options.map_size = 16U << random.below(8);
    scene.options.border_texels = random.below(2) == 0 ? 4.0 : random.uniform(0.0, 64.0);
    if (random.below(3) == 0)
        scene.options.max_distance_m = random.uniform(0.2, 3.0) * scene.size_m;
    return scene;
}

bool cameraSees(const Scene& scene, const glm::dvec3& p)
{
    const glm::dvec4 c = scene.camera.clip_from_world * glm::dvec4(p, 1.0);
    const double slack = 1e-6 * std::abs(c.w);
    const bool inside =
        c.w > 0.0 && std::abs(c.x) < c.w - slack && std::abs(c.y) < c.w - slack && c.z > 0.0 && c.z < c.w;
    const double limit = scene.options.max_distance_m;
    return inside && (limit == 0.0 || glm::distance(p, scene.camera.eye_ws) < limit * 0.999);
}

/// Distance along the axis, and whether the cone's light gets there; all inside with some slack.
bool lightReaches(const Light& light, const Aabb& scene_ws, const glm::dvec3& p)
{
    if (light.type == LightType::directional)
        return true;
    const glm::dvec3 to = p - light.position_ws;
    const double depth = glm::dot(to, light.direction_ws);
    double reach = light.range_m;
    if (reach == 0.0)
        for (int i = 0; i < 8; ++i)
            reach = std::max(reach, glm::distance(glm::dvec3(scene_ws.corner(i)), light.position_ws));
    const double across = glm::length(to - light.direction_ws * depth);
    return depth > 0.00101 * reach && glm::length(to) < reach * 0.999 &&
           across < 0.999 * depth * std::tan(light.outer_half_angle_rad);
}

/// Where a box is along the line from p (0) toward the light, t in metres; false when it is not.
bool hit(const Aabb& box, const glm::dvec3& p, const glm::dvec3& toward, double& enter, double& leave)
{
    for (int axis = 0; axis < 3; ++axis) {
        const double low = static_cast<double>(box.min[axis]) - p[axis];
        const double high = static_cast<double>(box.max[axis]) - p[axis];
        if (toward[axis] == 0.0) {
            if (low > 0.0 || high < 0.0)
                return false;
            continue;
        }
        enter = std::max(enter, std::min(low / toward[axis], high / toward[axis]));
        leave = std::min(leave, std::max(low / toward[axis], high / toward[axis]));
    }
    return enter <= leave;
}

struct Tally {
    int seen = 0;
    int blocked = 0;
    int warped = 0;
    std::array<int, 8> outcomes{};
};

void checkFinite(const View& view)
{
    for (int i = 0; i < 16; ++i)
        ASSERT_TRUE(std::isfinite(view.clip_from_world[i / 4][i % 4]));
    for (int i = 0; i < 4; ++i)
        ASSERT_TRUE(std::isfinite(view.metric.metric_ws[i]));
    ASSERT_TRUE(std::isfinite(view.metric.near_m) && std::isfinite(view.metric.far_m));
    ASSERT_LT(view.metric.near_m, view.metric.far_m);
    ASSERT_GE(view.metric.near_m, 0.0);
    ASSERT_GT(view.texel_m, 0.0);
    ASSERT_TRUE(std::isfinite(view.texel_m));
    ASSERT_EQ(view.texel_m, std::max(view.texel_xy_m.x, view.texel_xy_m.y));
}

/// A point that is seen and lit must be in the map, inside its border, at a depth the map can tell.
void checkInMap(const Scene& scene, const View& view, const glm::dvec3& p)
{
    const glm::dvec4 c = view.clip_from_world * glm::dvec4(p, 1.0);
    ASSERT_GT(c.w, 0.0);
    const double border = std::min(scene.options.border_texels, 0.25 * scene.options.map_size);
    const double edge = 1.0 - 2.0 * border / scene.options.map_size + 1e-6;
    ASSERT_LE(std::abs(c.x), c.w * edge);
    ASSERT_LE(std::abs(c.y), c.w * edge);
    ASSERT_LE(c.z, c.w);
    ASSERT_LE(glm::dot(view.metric.metric_ws, glm::dvec4(p, 1.0)), 1.0);
}

/// Every caster on the way from p to the light is drawn, and none is stored behind p.
void checkCasters(const Scene& scene, const Light& light, const Plan& plan, const LightPlan& planned,
                  const glm::dvec3& p, Tally& tally)
{
    const bool sunny = light.type == LightType::directional;
    const glm::dvec3 toward = sunny ? -light.direction_ws : glm::normalize(light.position_ws - p);
    for (std::uint32_t object = 0; object < scene.set.size(); ++object) {
        if (!scene.set.flags(object).casts)
            continue;
        double enter = 0.0;
        double leave = 1e12;
        if (!sunny) { // as far as the light's near distance along its axis
            const double depth = glm::dot(p - light.position_ws, light.direction_ws);
            double reach = light.range_m;
            if (reach == 0.0)
                for (int i = 0; i < 8; ++i)
                    reach = std::max(reach, glm::distance(glm::dvec3(scene.set.bounds().corner(i)), light.position_ws));
            leave = glm::distance(p, light.position_ws) * (1.0 - 0.00101 * reach / depth);
        }
        if (!hit(scene.set.bounds(object), p, toward, enter, leave))
            continue;
        ++tally.blocked;
        ASSERT_NE(planned.outcome.kind, OutcomeKind::no_caster);
        const View& view = plan.views[planned.first_view];
        const auto first = plan.casters.begin() + view.first_caster;
        ASSERT_NE(std::find(first, first + view.caster_count, object), first + view.caster_count);
        // A fit that turns a ray round puts the caster where it shades nothing.
        const glm::dvec4 c = view.clip_from_world * glm::dvec4(p + toward * leave, 1.0);
        ASSERT_GT(c.w, 0.0);
        ASSERT_LE(c.z, c.w);
        const double stored = std::max(0.0, glm::dot(view.metric.metric_ws, glm::dvec4(p + toward * leave, 1.0)));
        const double own = glm::dot(view.metric.metric_ws, glm::dvec4(p, 1.0));
        ASSERT_GE(own, 0.0); // not clamped together with what shades it
        ASSERT_LE(stored, own + 1e-9);
    }
}

void checkPlan(const Scene& scene, const Plan& plan, Random& random, Tally& tally)
{
    for (const LightPlan& light : plan.lights)
        ++tally.outcomes[static_cast<std::size_t>(light.outcome.kind)];
    for (const View& view : plan.views) {
        ASSERT_NO_FATAL_FAILURE(checkFinite(view));
        tally.warped += view.fit.strength > 1.0 ? 1 : 0;
    }
    for (int sample = 0; sample < 60; ++sample) {
        const std::uint32_t object = random.below(scene.set.size());
        if (!scene.set.flags(object).receives)
            continue;
        const Aabb& box = scene.set.bounds(object);
        const glm::dvec3 p = random.inBox(glm::dvec3(box.min), glm::dvec3(box.max));
        if (!cameraSees(scene, p))
            continue;
        ASSERT_TRUE(std::binary_search(plan.receivers.begin(), plan.receivers.end(), object));
        for (std::size_t i = 0; i < plan.lights.size(); ++i) {
            if (!lightReaches(scene.lights[i], scene.set.bounds(), p))
                continue;
            ++tally.seen;
            const LightPlan& light = plan.lights[i];
            ASSERT_NE(light.outcome.kind, OutcomeKind::no_receiver);
            if (light.outcome.hasMap()) {
                ASSERT_NO_FATAL_FAILURE(checkInMap(scene, plan.views[light.first_view], p));
            }
            ASSERT_NO_FATAL_FAILURE(checkCasters(scene, scene.lights[i], plan, light, p, tally));
        }
    }
}

/// From each position of a sun that moves in steps the maps are right, for a light that shines from there.
TEST(PlanPropertiesOfSteps, HoldForEachPosition)
{
    Tally tally;
    int pairs = 0;
    for (std::uint64_t seed = 1; seed <= 600; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Scene scene = randomScene(seed, Fit::uniform);
        scene.options.technique.motion = static_cast<Motion>(2 + seed % 4);
        scene.options.paired_maps = seed % 3 == 0;
        Planner planner(scene.options);
        Frame frame;
        frame.camera = scene.camera;
        frame.objects = &scene.set;
        Random random(seed + 1000000);
        glm::dvec3 aside = glm::cross(scene.lights[0].direction_ws, glm::dvec3(0.3, 0.5, 0.8));
        for (int step = 0; step < 3; ++step) {
            scene.lights[0].direction_ws = glm::normalize(scene.lights[0].direction_ws + aside * 0.002);
            frame.lights = scene.lights;
            const Plan& plan = planner.plan(frame);
            for (const bool later : {false, true}) {
                // As a plan of one sun alone, whose only views are those of this position.
                const SunSteps& steps = plan.lights[0].steps;
                if ((later && !steps.paired) || !plan.lights[0].outcome.hasMap())
                    continue;
                const SunPosition sun = !steps.paired ? SunPosition::only
                                        : later       ? SunPosition::later
                                                      : SunPosition::earlier;
                const std::span<const View> views = viewsOf(plan, 0, sun);
                if (views.empty())
                    continue; // nothing casts from there
                Plan one = plan;
                one.lights.resize(1);
                one.lights[0].first_view = static_cast<std::uint32_t>(views.data() - plan.views.data());
                Scene at = {.set = {},
                            .camera = scene.camera,
                            .lights = {scene.lights[0]},
                            .options = scene.options,
                            .size_m = scene.size_m};
                for (std::uint32_t object = 0; object < scene.set.size(); ++object)
                    at.set.add(scene.set.bounds(object), scene.set.flags(object));
                at.lights[0].direction_ws = later ? steps.later_ws : steps.earlier_ws;
                pairs += later ? 1 : 0;
                ASSERT_NO_FATAL_FAILURE(checkPlan(at, one, random, tally));
            }
        }
    }
    EXPECT_GT(pairs, 300);
    EXPECT_GT(tally.seen, 5000);
    EXPECT_GT(tally.blocked, 3000);
}

class PlanProperties : public testing::TestWithParam<Fit> {};

TEST_P(PlanProperties, HoldForRandomScenes)
{
    Tally tally;
    for (std::uint64_t seed = 1; seed <= 3000; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const Scene scene = randomScene(seed, GetParam());
        Planner planner(scene.options);
        Frame frame;
        frame.camera = scene.camera;
        frame.lights = scene.lights;
        frame.objects = &scene.set;
        Random random(seed + 1000000);
        ASSERT_NO_FATAL_FAILURE(checkPlan(scene, planner.plan(frame), random, tally));
    }
    // The sum of it must not be empty praise.
    EXPECT_GT(tally.seen, 20000);
    EXPECT_GT(tally.blocked, 20000);
    const auto count = [&](OutcomeKind kind) {
        return tally.outcomes[static_cast<std::size_t>(kind)];
    };
    EXPECT_GT(count(OutcomeKind::ok) + count(OutcomeKind::fallback), 1500);
    EXPECT_GT(count(OutcomeKind::no_receiver), 100);
    EXPECT_GT(count(OutcomeKind::no_caster), 30);
    EXPECT_EQ(count(OutcomeKind::degenerate), 0);
    if (GetParam() == Fit::uniform) {
        EXPECT_EQ(tally.warped, 0);
        EXPECT_EQ(count(OutcomeKind::fallback), 0);
    } else {
        EXPECT_GT(tally.warped, 500);
        EXPECT_GT(count(OutcomeKind::fallback), 500);
    }
}

TEST_P(PlanProperties, SameInputSameBits)
{
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
        const Scene one = randomScene(seed, GetParam());
        const Scene two = randomScene(seed, GetParam());
        Planner fresh(one.options);
        Planner used(two.options);
        Frame frame;
        frame.camera = one.camera;
        frame.lights = one.lights;
        frame.objects = &two.set;
        Frame other = frame;
        other.camera = test::perspectiveCamera({1, 2, 3}, {4, 5, 6}, 1.0);
        (void)used.plan(other); // what it planned before leaves no trace but `redraw`
        used.reset();
        const std::string second = toJson(used.plan(frame));
        frame.objects = &one.set;
        EXPECT_EQ(toJson(fresh.plan(frame)), second);
        const Plan& a = fresh.plan(frame);
        frame.objects = &two.set;
        const Plan& b = used.plan(frame);
        ASSERT_EQ(a.views.size(), b.views.size());
        for (std::size_t i = 0; i < a.views.size(); ++i)
            EXPECT_EQ(std::memcmp(&a.views[i].clip_from_world, &b.views[i].clip_from_world, sizeof(glm::dmat4)), 0);
    }
}

INSTANTIATE_TEST_SUITE_P(Fits, PlanProperties,
                         testing::Values(Fit::uniform, Fit::lispsm, Fit::lispsm_simple, Fit::tsm, Fit::psm),
                         [](const auto& fit) {
                             std::string name(nameOf(fit.param));
                             std::replace(name.begin(), name.end(), '-', '_');
                             return name;
                         });

} // namespace
} // namespace gnomon
