// SPDX-License-Identifier: Apache-2.0
// A paraboloid's view: the whole half space around a point light. Only its reach and its casters depend on the seen
// part.
#include "frustum_planner.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Share of the range of depths that is added at its ends.
constexpr double kMargin = 1e-4;

double distanceTo(const Aabb& box, const glm::dvec3& p)
{
    return glm::distance(glm::clamp(p, glm::dvec3(box.min), glm::dvec3(box.max)), p);
}

/// Adds six planes, `by_m` outside the box.
void addBox(const glm::dvec3& low, const glm::dvec3& high, double by_m, std::vector<Plane>& out)
{
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 normal(0.0);
        normal[axis] = 1.0;
        out.push_back({normal, by_m - low[axis]});
        out.push_back({-normal, by_m + high[axis]});
    }
}

/// In front of the light, or so far behind it at most.
Plane halfSpace(const LightSpace& space, double behind_m)
{
    return {space.forward_ws, behind_m - glm::dot(space.forward_ws, space.origin_ws)};
}

/// All of the disc, and the border around it.
MapFrame frameOfDisc(const FrustumInput& input)
{
    return frameOf({glm::dvec2(-1.0), glm::dvec2(1.0)}, 1.0, input.map_size,
                   input.recipe.resolved.borderOf(input.map_size));
}

LightSpace spaceOf(const FrustumInput& input)
{
    return lightSpaceOf(input.light, input.slice.axis_ws, input.slice.half_angle_rad, input.camera.scene_ws);
}

/// A SightPoint with its place in the disc; nothing where the light does not reach it.
std::optional<LitPoint> litInDisc(const LightSpace& space, const SightPoint& point)
{
    const glm::dvec3 q = space.coordinates(point.p_ws);
    const double distance = glm::length(q);
    if (!(distance > space.near_m && distance < space.reach_m)) {
        return std::nullopt;
    }
    const glm::dvec2 place = glm::dvec2(q) / (q.z + distance);
    const auto step = [&](const glm::dvec3& d_ws) {
        const glm::dvec3 d(glm::dot(space.right_ws, d_ws), glm::dot(space.up_ws, d_ws), glm::dot(space.depth_ws, d_ws));
        return (glm::dvec2(d) - place * (d.z + glm::dot(q, d) / distance)) / (q.z + distance);
    };
    const double per_radian = 0.5 * (1.0 + glm::dot(place, place));
    return LitPoint{
        place, {step(point.right_ws), step(point.down_ws)}, point.pixel_m, point.facing_m / distance * per_radian};
}

} // namespace

Outcome FrustumPlanner::seeHalf(const FrustumInput& input, const LightSpace& space, SeenHalf& seen)
{
    const CameraView& camera = input.camera;
    planes_.assign(1, halfSpace(space, camera.pad_m));
    addBox(space.origin_ws, space.origin_ws, space.reach_m + camera.pad_m, planes_);
    const std::span<const Aabb> bounds = input.frame.objects->allBounds();
    Aabb receivers_ws;
    for (const std::uint32_t object : input.receivers) {
        const Aabb box = grown(bounds[object], camera.pad_m);
        if (distanceTo(box, space.origin_ws) <= space.reach_m && classify(planes_, box) != Containment::outside) {
            receivers_ws = merge(receivers_ws, box);
        }
    }
    constexpr Outcome kNone{OutcomeKind::no_receiver, "nothing that the camera sees is in the light's reach"};
    if (receivers_ws.empty()) {
        return kNone;
    }
    half_body_.reset(receivers_ws);
    half_body_.clip(camera.planes);
    half_body_.clip(planes_);
    if (half_body_.empty()) {
        return kNone;
    }
    seen.low_ws = space.origin_ws; // and all the way from the light
    seen.high_ws = space.origin_ws;
    for (const glm::dvec3& p : half_body_.points()) {
        seen.low_ws = glm::min(seen.low_ws, p);
        seen.high_ws = glm::max(seen.high_ws, p);
        seen.far_m = std::max(seen.far_m, glm::distance(p, space.origin_ws));
    }
    seen.far_m = std::min(seen.far_m, space.reach_m);
    return std::isfinite(seen.far_m) ? Outcome{} : kTooFarApart;
}

/// Appends who is between the light and what is seen, and finds how near the nearest of them is.
Outcome FrustumPlanner::gatherHalf(const FrustumInput& input, const LightSpace& space, double texel, SeenHalf& seen,
                                   std::vector<std::uint32_t>& casters)
{
    // A kernel reads texels beside the receiver's: of a place of 1 in the disc there are 2 radians at most.
    const double reach_texels = input.recipe.resolved.borderOf(input.map_size) + 1.0;
    const double pad_m = input.camera.pad_m + seen.far_m * 2.0 * texel * reach_texels;
    const ObjectSet& objects = *input.frame.objects;
    planes_.assign(1, halfSpace(space, pad_m));
    addBox(seen.low_ws, seen.high_ws, pad_m, planes_);
    const std::size_t first = casters.size();
    objects.query(planes_, ObjectSet::Want::casters, casters, input.light.groups);
    const std::span<const Aabb> bounds = objects.allBounds();
    const auto is_beyond = [&](std::uint32_t object) {
        return distanceTo(bounds[object], space.origin_ws) > seen.far_m + pad_m;
    };
    casters.erase(std::remove_if(casters.begin() + static_cast<std::ptrdiff_t>(first), casters.end(), is_beyond),
                  casters.end());
    if (casters.size() == first) {
        return {OutcomeKind::no_caster, "nothing can throw a shadow on what the camera sees"};
    }
    seen.near_m = kInfinity;
    for (const std::uint32_t object : std::span(casters).subspan(first)) {
        seen.near_m = std::min(seen.near_m, distanceTo(bounds[object], space.origin_ws));
    }
    return {};
}

Prediction FrustumPlanner::predictHalf(const FrustumInput& input, const Sight& sight)
{
    const LightSpace space = spaceOf(input);
    SeenHalf seen;
    if (seeHalf(input, space, seen).kind != OutcomeKind::ok) {
        return {};
    }
    lit_.clear();
    for (const SightPoint& point : sight.points()) {
        const std::optional<LitPoint> lit =
            input.slice.sector.holds(point.p_ws) ? litInDisc(space, point) : std::nullopt;
        if (lit) {
            lit_.push_back(*lit);
        }
    }
    const Warp none;
    const MapFrame frame = frameOfDisc(input);
    const double feature_m = kFeature_px * sight.meanPixel_m();
    return {mapErrorOf(lit_, none, frame, feature_m, kFineEnough_px),
            edgesBySize(lit_, none, frame, feature_m, input.halvings),
            coarsestTexel_px(lit_, none, frame, texels_px_),
            facingTexels(lit_, none, frame, texels_px_),
            true,
            2.0};
}

Outcome FrustumPlanner::planHalf(const FrustumInput& input, View& view, std::vector<std::uint32_t>& casters)
{
    const LightSpace space = spaceOf(input);
    const MapFrame frame = frameOfDisc(input);
    SeenHalf seen;
    if (const Outcome outcome = seeHalf(input, space, seen); outcome.kind != OutcomeKind::ok) {
        return outcome;
    }
    const auto first_caster = static_cast<std::uint32_t>(casters.size());
    if (const Outcome outcome = gatherHalf(input, space, frame.texel.x, seen, casters);
        outcome.kind != OutcomeKind::ok) {
        return outcome;
    }
    view.serves.slice = input.slice.depth;
    view.serves.sector = input.slice.sector;
    view.projection.parallel = false;
    view.projection.orthographic = false;
    view.projection.clamp_near = false; // nothing before the light's near distance casts
    view.projection.paraboloid = true;
    view.projection.light_place_ws = space.origin_ws;
    // In the disc's middle twice what it is at the rim.
    view.fit = {1.0, frame.texel, 2.0 * frame.texel};
    view.projection.texel_xy_m = view.fit.coarsest_texel;
    view.projection.texel_m = view.projection.texel_xy_m.x;
    view.casters.first = first_caster;
    view.casters.count = static_cast<std::uint32_t>(casters.size()) - first_caster;

    const glm::dvec3 scene = glm::dvec3(input.camera.scene_ws.max) - glm::dvec3(input.camera.scene_ws.min);
    double near_m = std::min(seen.near_m, seen.far_m);
    const double margin_m = kMargin * (seen.far_m - near_m) + input.camera.pad_m;
    near_m = std::max(near_m - margin_m, space.near_m);
    const double far_m = std::max(seen.far_m + margin_m,
                                  near_m + std::max(margin_m, kLeastRange * std::max({scene.x, scene.y, scene.z})));
    const double length = far_m - near_m;
    view.projection.metric = {{0.0, 0.0, 0.0, -near_m / length}, near_m, far_m};
    const auto row = [&](const glm::dvec3& axis) {
        return glm::dvec4(axis, -glm::dot(axis, space.origin_ws)) / length;
    };
    view.projection.clip_from_world = glm::transpose(glm::dmat4(
        row(space.right_ws), row(-space.up_ws), row(space.forward_ws), glm::dvec4(0.0, 0.0, 0.0, frame.half.x)));
    if (!isFinite(view)) {
        casters.resize(first_caster);
        return kTooFarApart;
    }
    return {};
}

} // namespace gnomon
