// SPDX-License-Identifier: Apache-2.0
// The bias that docs/integrating.md gives to hosts of door 3 that read maps by a test of their own.
#include <gnomon/planner.h>

#include <gnomon/object_set.h>
#include <gnomon/plan_views.h>

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace gnomon::test {
namespace {

constexpr double kLeastCosine = 0.2; // between normals and the light

/// Rows that take a point to a view's map: texels of its tile times w, w, and the metric.
struct Rows {
    glm::dvec4 x, y, w, metric;

    explicit Rows(const View& view) : metric(view.projection.metric.metric_ws)
    {
        const glm::dmat4 rows = glm::transpose(view.projection.clip_from_world);
        w = rows[3];
        x = 0.5 * view.place.tile.width * (rows[0] + w);
        y = 0.5 * view.place.tile.height * (rows[1] + w);
    }
};

/// A receiver's plane on a map, by the names of docs/integrating.md.
struct Plane {
    glm::dvec2 texel{0.0};
    glm::dvec2 slope{0.0};   // s
    glm::dvec2 w_slope{0.0}; // q

    Plane(const Rows& rows, const glm::dvec3& p, const glm::dvec3& n)
    {
        const glm::dvec4 at(p, 1.0);
        const double w = glm::dot(rows.w, at);
        texel = glm::dvec2(glm::dot(rows.x, at), glm::dot(rows.y, at)) / w;
        const glm::dvec3 x = glm::dvec3(rows.x) - texel.x * glm::dvec3(rows.w);
        const glm::dvec3 y = glm::dvec3(rows.y) - texel.y * glm::dvec3(rows.w);
        const glm::dvec3 a = glm::cross(y, n);
        const glm::dvec3 b = glm::cross(n, x);
        const double d = glm::dot(x, a);
        slope = w * glm::dvec2(glm::dot(glm::dvec3(rows.metric), a), glm::dot(glm::dvec3(rows.metric), b)) / d;
        w_slope = glm::dvec2(glm::dot(glm::dvec3(rows.w), a), glm::dot(glm::dvec3(rows.w), b)) / d;
    }
    [[nodiscard]] double bias(double reach) const
    {
        const double shrinks = 1.0 - reach * (std::abs(w_slope.x) + std::abs(w_slope.y));
        return reach * (std::abs(slope.x) + std::abs(slope.y)) / std::max(shrinks, 0.1);
    }
};

/// How much nearer to the light than the receiver the plane is at most, at texels up to `reach` away along each axis:
/// found on the plane itself.
double mostNearer(const Rows& rows, const Plane& plane, const glm::dvec3& p, const glm::dvec3& n, double reach)
{
    double most = 0.0;
    for (const glm::dvec2 corner : {glm::dvec2(-1, -1), glm::dvec2(1, -1), glm::dvec2(-1, 1), glm::dvec2(1, 1)}) {
        const glm::dvec2 there = plane.texel + reach * corner;
        const glm::dvec4 across = rows.x - there.x * rows.w; // 0 at points that lie at this texel
        const glm::dvec4 down = rows.y - there.y * rows.w;
        const glm::dmat3 three = glm::transpose(glm::dmat3(glm::dvec3(across), glm::dvec3(down), n));
        const glm::dvec3 point = glm::inverse(three) * glm::dvec3(-across.w, -down.w, glm::dot(n, p));
        const bool seen = glm::dot(rows.w, glm::dvec4(point, 1.0)) > 0.0;
        most = std::max(most, seen ? glm::dot(rows.metric, glm::dvec4(p - point, 0.0)) : 0.0);
    }
    return most;
}

struct Counts {
    int receivers = 0;
    int shadowed = 0;      // by their own plane, with the bias
    int half_shadowed = 0; // with half of it
    double room = 0.0;     // sum of the bias over what it takes
};

Counts countOf(const Plan& plan, const Light& light)
{
    const double reach = (*plan.options)[0].reach_texels();
    std::mt19937 random(1);
    const auto number = [&] {
        return static_cast<double>(random()) / 2147483648.0 - 1.0;
    };
    Counts counts;
    for (int i = 0; i < 20000; ++i) {
        const glm::dvec3 p(30.0 * number(), 3.0 * std::max(number(), 0.0), 30.0 * number());
        glm::dvec3 n = glm::normalize(glm::dvec3(number(), number(), number()));
        for (const View& view : plan.views) {
            const Rows rows(view);
            const double metric = glm::dot(rows.metric, glm::dvec4(p, 1.0));
            if (!view.serves.slice.holds(p) || !view.serves.sector.holds(p) ||
                glm::dot(rows.w, glm::dvec4(p, 1.0)) <= 0.0 || metric < 0.0 || metric > 1.0) {
                continue;
            }
            const glm::dvec3 to_light =
                view.projection.parallel ? -light.direction_ws : glm::normalize(light.position_ws - p);
            n = glm::dot(n, to_light) < 0.0 ? -n : n;
            const Plane plane(rows, p, n);
            const glm::dvec2 size(view.place.tile.width, view.place.tile.height);
            const glm::dvec2 edge = glm::min(plane.texel, size - plane.texel);
            if (glm::dot(n, to_light) < kLeastCosine || std::min(edge.x, edge.y) < tileMarginTexels(reach)) {
                break;
            }
            const double takes = mostNearer(rows, plane, p, n, reach);
            const double bias = plane.bias(reach);
            ++counts.receivers;
            counts.shadowed += takes > bias * (1.0 + 1e-6) + 1e-9 ? 1 : 0;
            counts.half_shadowed += takes > 0.5 * bias ? 1 : 0;
            counts.room += bias / takes;
            break;
        }
    }
    return counts;
}

TEST(PlaneBias, NeverLetsAPlaneShadowItselfInAnyKindOfMap)
{
    ObjectSet objects;
    (void)objects.add(Aabb{{-40.0F, -0.1F, -40.0F}, {40.0F, 0.0F, 40.0F}});
    (void)objects.add(Aabb{{-1.0F, 0.0F, -1.0F}, {1.0F, 2.0F, 1.0F}});
    (void)objects.add(Aabb{{-8.0F, 0.0F, -9.0F}, {-5.0F, 6.0F, -7.0F}});
    Light light;
    light.direction_ws = glm::normalize(glm::dvec3(0.5, -1.0, 0.3));
    light.outer_half_angle_rad = 0.9;
    light.range_m = 60.0;
    Frame frame;
    frame.camera.eye_ws = {0.0, 2.0, 12.0};
    glm::dmat4 projection = glm::perspectiveRH_ZO(1.0, 640.0 / 360.0, 200.0, 0.1);
    projection[1][1] *= -1.0;
    frame.camera.clip_from_world =
        projection * glm::lookAtRH(frame.camera.eye_ws, glm::dvec3(0.0, 1.0, 0.0), glm::dvec3(0.0, 1.0, 0.0));
    frame.size_px = {640, 360};
    frame.objects = &objects;
    frame.lights = {&light, 1};
    for (const LightType type : {LightType::directional, LightType::spot, LightType::point}) {
        light.type = type;
        light.position_ws = type == LightType::directional ? glm::dvec3(0.0) : glm::dvec3(-6.0, 9.0, -4.0);
        for (const Fit fit : {Fit::uniform, Fit::lispsm, Fit::tsm}) {
            for (const Filter filter : {Filter::hard, Filter::pcf}) {
                SCOPED_TRACE(testing::Message()
                             << "light " << int(type) << ", fit " << int(fit) << ", filter " << int(filter));
                ShadowOptions options{.technique = kPlainTechnique};
                options.technique.partition = type == LightType::point ? Partition::cube : Partition::single;
                options.technique.fit = fit;
                options.technique.filter = filter;
                options.map_size = 512;
                Planner planner(options);
                const Plan& plan = planner.plan(frame);
                ASSERT_TRUE(plan.lights[0].outcome.hasMap()) << plan.lights[0].outcome.reason;
                const Counts counts = countOf(plan, light);
                EXPECT_GT(counts.receivers, 500);
                EXPECT_EQ(counts.shadowed, 0);
                EXPECT_GT(counts.half_shadowed, counts.receivers * 9 / 10) << "no more than it takes";
                EXPECT_LT(counts.room / counts.receivers, 1.1);
            }
        }
    }
}

} // namespace
} // namespace gnomon::test
