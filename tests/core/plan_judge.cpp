// SPDX-License-Identifier: Apache-2.0
#include "plan_judge.h"

#include <gnomon/plan_views.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <span>

namespace gnomon::test {
namespace {

constexpr int kPointsOfObjects = 20;
constexpr int kPointsOfPicture = 24;

bool cameraSees(const RandomScene& scene, const glm::dvec3& p)
{
    const glm::dvec4 c = scene.camera.clip_from_world * glm::dvec4(p, 1.0);
    const double slack = 1e-6 * std::abs(c.w);
    const bool inside =
        c.w > 0.0 && std::abs(c.x) < c.w - slack && std::abs(c.y) < c.w - slack && c.z > 0.0 && c.z < c.w;
    const double limit = scene.options.max_distance_m;
    return inside && (limit == 0.0 || glm::distance(p, scene.camera.eye_ws) < limit * 0.999);
}

double reachOf(const Light& light, const Aabb& scene_ws)
{
    double reach = light.range_m;
    if (reach == 0.0)
        for (int i = 0; i < 8; ++i)
            reach = std::max(reach, glm::distance(glm::dvec3(scene_ws.corner(i)), light.position_ws));
    return reach;
}

/// How far p is along the axis of the light's frustum that serves it: a spot light's own, or of a light that no one
/// frustum holds the nearest to it of the world's.
double depthOf(const Light& light, const glm::dvec3& p)
{
    const glm::dvec3 to = p - light.position_ws;
    if (layoutOf(light) == LightType::spot)
        return glm::dot(to, light.direction_ws);
    return std::max({std::abs(to.x), std::abs(to.y), std::abs(to.z)});
}

/// Does the light get there? All inside with some slack.
bool lightReaches(const Light& light, const Aabb& scene_ws, const glm::dvec3& p)
{
    if (light.type == LightType::directional)
        return true;
    const glm::dvec3 to = p - light.position_ws;
    const double depth = depthOf(light, p);
    const double reach = reachOf(light, scene_ws);
    const bool within = depth > 0.00101 * reach && (light.range_m == 0.0 || glm::length(to) < reach * 0.999);
    if (light.type == LightType::point)
        return within;
    const double angle_rad = std::acos(glm::dot(to, light.direction_ws) / glm::length(to));
    return within && angle_rad < light.outer_half_angle_rad - 0.001;
}

/// Where a box is along the line from p (0), t in steps of `way`; false when it is not.
bool hit(const Aabb& box, const glm::dvec3& p, const glm::dvec3& way, double& enter, double& leave)
{
    for (int axis = 0; axis < 3; ++axis) {
        const double low = static_cast<double>(box.min[axis]) - p[axis];
        const double high = static_cast<double>(box.max[axis]) - p[axis];
        if (way[axis] == 0.0) {
            if (low > 0.0 || high < 0.0)
                return false;
            continue;
        }
        enter = std::max(enter, std::min(low / way[axis], high / way[axis]));
        leave = std::min(leave, std::max(low / way[axis], high / way[axis]));
    }
    return enter <= leave;
}

void checkFinite(const View& view)
{
    for (int i = 0; i < 16; ++i)
        ASSERT_TRUE(std::isfinite(view.projection.clip_from_world[i / 4][i % 4]));
    for (int i = 0; i < 4; ++i)
        ASSERT_TRUE(std::isfinite(view.projection.metric.metric_ws[i]));
    ASSERT_TRUE(std::isfinite(view.projection.metric.near_m) && std::isfinite(view.projection.metric.far_m));
    ASSERT_LT(view.projection.metric.near_m, view.projection.metric.far_m);
    ASSERT_GE(view.projection.metric.near_m, 0.0);
    ASSERT_GT(view.projection.texel_m, 0.0);
    ASSERT_TRUE(std::isfinite(view.projection.texel_m));
    ASSERT_EQ(view.projection.texel_m, std::max(view.projection.texel_xy_m.x, view.projection.texel_xy_m.y));
    ASSERT_TRUE(std::isfinite(view.fit.strength));
    for (const double v : {view.fit.finest_texel.x, view.fit.finest_texel.y, view.fit.coarsest_texel.x,
                           view.fit.coarsest_texel.y, view.projection.texel_xy_m.x, view.projection.texel_xy_m.y})
        ASSERT_TRUE(std::isfinite(v) && v > 0.0);
    for (int axis = 0; axis < 3; ++axis)
        ASSERT_TRUE(std::isfinite(view.projection.light_place_ws[axis]));
    for (int i = 0; i < 4; ++i)
        ASSERT_TRUE(std::isfinite(view.serves.slice.axis[i]));
    // Its ends may be infinite.
    ASSERT_LE(view.serves.slice.begin_m, view.serves.slice.end_m);
    ASSERT_TRUE(std::isfinite(view.serves.slice.blend_m) && view.serves.slice.blend_m >= 0.0);
}

/// A point that is seen and lit must be in the map, inside its border, at a depth the map can tell.
void checkInMap(const RandomScene& scene, const View& view, const glm::dvec3& p)
{
    const auto place = placeOnMap(view, p);
    ASSERT_TRUE(place.has_value());
    const double border = std::min(resolvedOrThrow(scene.options).border_texels(), 0.25 * largestSide(scene.options));
    const double edge = 1.0 - 2.0 * border / largestSide(scene.options) + 1e-6;
    ASSERT_LE(std::abs(place->x), edge);
    ASSERT_LE(std::abs(place->y), edge);
    if (view.projection.paraboloid) { // whose depth the rasteriser does not know
        ASSERT_LE(glm::length(*place), edge);
    } else {
        const glm::dvec4 c = view.projection.clip_from_world * glm::dvec4(p, 1.0);
        ASSERT_LE(c.z, c.w);
    }
    ASSERT_LE(depthOnMap(view, p), 1.0);
}

/// A caster between p and the light at q must be drawn at the place of p, and be stored before it. A fit that turns a
/// ray round puts it where it shades nothing.
void checkOnRay(const View& view, const glm::dvec3& p, const glm::dvec3& q)
{
    const glm::dvec4 of_q = view.projection.clip_from_world * glm::dvec4(q, 1.0);
    const auto place_of_p = placeOnMap(view, p);
    const auto place_of_q = placeOnMap(view, q);
    ASSERT_TRUE(place_of_p && place_of_q);
    ASSERT_TRUE(view.projection.paraboloid || of_q.z <= of_q.w); // before the far plane
    const glm::dvec2 apart = *place_of_q - *place_of_p;
    ASSERT_LE(std::max(std::abs(apart.x), std::abs(apart.y)), 1e-6);
    const double stored = depthOnMap(view, q);
    const double own = depthOnMap(view, p);
    ASSERT_GE(own, 0.0); // not clamped together with what shades it
    ASSERT_LE(stored, own + 1e-9);
    if (!view.projection.clamp_near) { // then the rasteriser cuts what is before the near plane
        ASSERT_TRUE(view.projection.paraboloid || of_q.z >= 0.0);
        ASSERT_GE(stored, 0.0);
    }
}

struct Lit {
    const RandomScene& scene;
    const Plan& plan;
    const Light& light;
    std::span<const View> views; // that serve the point
};

bool serves(const View& view, const glm::dvec3& p)
{
    return view.serves.slice.holds(p) && view.serves.sector.holds(p);
}

bool draws(const Lit& lit, const View& view, std::uint32_t object)
{
    const auto first = lit.plan.casters.begin() + view.casters.first;
    return std::find(first, first + view.casters.count, object) != first + view.casters.count;
}

/// Every caster on the way from p to the light is drawn, and none is stored behind p.
void checkCasters(const Lit& lit, const glm::dvec3& p, Tally& tally)
{
    const bool sunny = lit.light.type == LightType::directional;
    const glm::dvec3 toward = sunny ? -lit.light.direction_ws : glm::normalize(lit.light.position_ws - p);
    double way_m = 1e12;
    if (!sunny) { // as far as the light's near distance along its axis
        const double depth = depthOf(lit.light, p);
        const double near_m = 0.00101 * reachOf(lit.light, lit.scene.set.bounds());
        way_m = glm::distance(p, lit.light.position_ws) * (1.0 - near_m / depth);
    }
    for (std::uint32_t object = 0; object < lit.scene.set.size(); ++object) {
        double enter = 0.0;
        double leave = way_m;
        if (!lit.scene.set.flags(object).casts || !hit(lit.scene.set.bounds(object), p, toward, enter, leave))
            continue;
        ++tally.blocked;
        bool served = false;
        for (const View& view : lit.views) {
            if (!serves(view, p))
                continue;
            served = true;
            ASSERT_TRUE(draws(lit, view, object));
            ASSERT_NO_FATAL_FAILURE(checkOnRay(view, p, p + toward * enter));
            ASSERT_NO_FATAL_FAILURE(checkOnRay(view, p, p + toward * leave));
        }
        ASSERT_TRUE(served) << "no view has what something casts on";
    }
}

/// The views of a light that differ: of those that the GPU will make of a base map, the base map alone.
std::span<const View> viewsOfLight(const Plan& plan, const LightPlan& light)
{
    const std::span views = std::span(plan.views).subspan(light.first_view, light.view_count);
    const bool base = !views.empty() && views[0].projection.gpu_cascade != kNoIndex;
    return base ? views.first(1) : views;
}

void checkPoint(const RandomScene& scene, const Plan& plan, std::uint32_t object, const glm::dvec3& p, Tally& tally)
{
    ASSERT_TRUE(std::binary_search(plan.receivers.begin(), plan.receivers.end(), object));
    for (std::size_t i = 0; i < plan.lights.size(); ++i) {
        if (!lightReaches(scene.lights[i], scene.set.bounds(), p))
            continue;
        ++tally.seen;
        const LightPlan& light = plan.lights[i];
        ASSERT_NE(light.outcome.kind, OutcomeKind::no_receiver);
        ASSERT_NE(light.outcome.kind, OutcomeKind::atlas_full);
        const Lit lit{scene, plan, scene.lights[i], viewsOfLight(plan, light)};
        ASSERT_EQ(light.outcome.hasMap(), !lit.views.empty());
        for (const View& view : lit.views)
            if (serves(view, p)) {
                ASSERT_NO_FATAL_FAILURE(checkInMap(scene, view, p));
                if (filterTraits(scene.options.technique.filter)->filterable) {
                    ASSERT_TRUE(draws(lit, view, object));
                }
            }
        ASSERT_NO_FATAL_FAILURE(checkCasters(lit, p, tally));
    }
}

/// A point of a receiver, anywhere in it or at a corner.
void checkPointOfObject(const RandomScene& scene, const Plan& plan, Random& random, Tally& tally)
{
    const std::uint32_t object = random.below(scene.set.size());
    const Aabb& box = scene.set.bounds(object);
    const glm::dvec3 p = random.below(4) == 0 ? glm::dvec3(box.corner(static_cast<int>(random.below(8))))
                                              : random.inBox(glm::dvec3(box.min), glm::dvec3(box.max));
    if (scene.set.flags(object).receives && cameraSees(scene, p)) {
        ASSERT_NO_FATAL_FAILURE(checkPoint(scene, plan, object, p, tally));
    }
}

/// A point of a receiver that is at a random place of the picture, often at its edge. However narrow the view is, it is
/// seen; and what is in the map's corners is at the picture's.
void checkPointOfPicture(const RandomScene& scene, const Plan& plan, const glm::dmat4& world_from_clip, Random& random,
                         Tally& tally)
{
    glm::dvec2 place(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
    for (int axis = 0; axis < 2; ++axis)
        if (random.below(3) == 0)
            place[axis] = place[axis] < 0.0 ? -0.999998 : 0.999998;
    const glm::dvec4 a = world_from_clip * glm::dvec4(place, 0.75, 1.0);
    const glm::dvec4 b = world_from_clip * glm::dvec4(place, 0.25, 1.0);
    const glm::dvec3 at = glm::dvec3(a) / a.w;
    const glm::dvec3 way = glm::normalize(glm::dvec3(b) / b.w - at);
    const std::uint32_t first = random.below(scene.set.size());
    for (std::uint32_t i = 0; i < scene.set.size(); ++i) {
        const std::uint32_t object = (first + i) % scene.set.size();
        double enter = -1e12;
        double leave = 1e12;
        if (!scene.set.flags(object).receives || !hit(scene.set.bounds(object), at, way, enter, leave))
            continue;
        const double share = random.below(2) == 0 ? static_cast<double>(random.below(2)) : random.uniform();
        // Off its ray by rounding, the point may be off the box.
        const Aabb& box = scene.set.bounds(object);
        const glm::dvec3 p =
            glm::clamp(at + way * (enter + (leave - enter) * share), glm::dvec3(box.min), glm::dvec3(box.max));
        if (cameraSees(scene, p)) {
            ASSERT_NO_FATAL_FAILURE(checkPoint(scene, plan, object, p, tally));
            return;
        }
    }
}

template <typename... Values>
void append(std::string& out, const Values&... values)
{
    (out.append(reinterpret_cast<const char*>(&values), sizeof(values)), ...);
}

} // namespace

void judge(const RandomScene& scene, const Plan& plan, Random& random, Tally& tally)
{
    for (const LightPlan& light : plan.lights)
        ++tally.outcomes[static_cast<std::size_t>(light.outcome.kind)];
    for (const View& view : plan.views) {
        ASSERT_NO_FATAL_FAILURE(checkFinite(view));
        tally.warped += view.fit.strength > 1.0 ? 1 : 0;
    }
    const int seen = tally.seen;
    const int blocked = tally.blocked;
    for (int i = 0; i < kPointsOfObjects; ++i)
        ASSERT_NO_FATAL_FAILURE(checkPointOfObject(scene, plan, random, tally));
    const glm::dmat4 world_from_clip = glm::inverse(scene.camera.clip_from_world);
    for (int i = 0; i < kPointsOfPicture; ++i)
        ASSERT_NO_FATAL_FAILURE(checkPointOfPicture(scene, plan, world_from_clip, random, tally));
    for (int i = 0; i < kAwkwardCount; ++i)
        if (scene.is(static_cast<Awkward>(i))) {
            tally.seen_awkward[static_cast<std::size_t>(i)] += tally.seen > seen ? 1 : 0;
            tally.blocked_awkward[static_cast<std::size_t>(i)] += tally.blocked > blocked ? 1 : 0;
        }
}

std::string bytesOf(const Plan& plan)
{
    std::string out;
    for (const LightPlan& light : plan.lights)
        append(out, light.first_view, light.view_count, light.outcome.kind);
    for (const View& v : plan.views) {
        append(out, v.light, v.projection.clip_from_world, v.projection.metric, v.projection.orthographic,
               v.projection.clamp_near, v.projection.texel_m, v.place.tile, v.place.part);
        append(out, v.casters.first, v.casters.count, v.casters.still, v.contents.redraw, v.contents.kept_layer,
               v.projection.texel_xy_m);
        append(out, v.serves.slice.axis, v.serves.slice.begin_m, v.serves.slice.end_m, v.serves.slice.blend_m,
               v.serves.slice.over, v.serves.slice.across);
        append(out, v.fit, v.serves.sector, v.projection.gpu_cascade, v.projection.parallel, v.projection.paraboloid,
               v.projection.light_place_ws);
    }
    for (const std::vector<std::uint32_t>* objects : {&plan.casters, &plan.receivers})
        for (const std::uint32_t object : *objects)
            append(out, object);
    append(out, plan.pages[0], plan.pages[0].kept_layers);
    return out;
}

} // namespace gnomon::test
