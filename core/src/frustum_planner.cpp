// SPDX-License-Identifier: Apache-2.0
#include "frustum_planner.h"

#include "depth_tilt.h"
#include "fit/no_loss.h"
#include "fit/projection.h"
#include "fit/scene.h"
#include "light_reach.h"
#include "outline.h"
#include "world_layers.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon {
namespace {

/// No map shows less: kLeastTangent as tangents, else kLeastPads times the length that coordinates are padded by.
constexpr double kLeastTangent = 1e-4;
constexpr double kLeastPads = 32.0;

} // namespace

bool isFinite(const View& view)
{
    double sum = view.projection.texel_m + view.projection.metric.near_m + view.projection.metric.far_m;
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) {
            sum += std::abs(view.projection.clip_from_world[column][row]);
        }
        sum += std::abs(view.projection.metric.metric_ws[column]);
    }
    for (int axis = 0; axis < 3; ++axis) {
        sum += std::abs(view.projection.light_place_ws[axis]);
    }
    return std::isfinite(sum) && view.projection.texel_m > 0.0 &&
           view.projection.metric.far_m > view.projection.metric.near_m;
}

FrustumPlanner::Lie FrustumPlanner::lieOf(const FrustumInput& input)
{
    const Recipe& recipe = input.recipe;
    const CameraView& camera = input.camera;
    Lie lie;
    lie.border_texels = recipe.resolved.borderOf(input.map_size);
    lie.space = lightSpaceOf(input.light, input.slice.axis_ws, input.slice.half_angle_rad, camera.scene_ws);
    lie.space.near_m *= input.slice.near_share;
    if (input.slice.up_ws != glm::dvec3(0.0)) {
        lie.space.up_ws = input.slice.up_ws;
        lie.space.right_ws = glm::cross(lie.space.forward_ws, input.slice.up_ws);
    }
    if (recipe.layersWorld() && recipe.options().moments.layer_axis == LayerAxis::height) {
        lie.space.depth_ws = heightDepth(lie.space);
    } else if (recipe.levelsDepth()) {
        lie.space.depth_ws = levelDepth(lie.space, *input.frame.objects, input.levellers);
    }
    lie.least_size = lie.space.perspective ? kLeastTangent : kLeastPads * camera.pad_m;
    const RegionInput around{
        lie.space,         input.slice, camera, *input.frame.objects, input.receivers, recipe.drawsReceivers(),
        input.light.groups};
    lie.outcome = region_.gatherReceivers(around);
    if (lie.outcome.kind == OutcomeKind::ok && input.ground != nullptr) {
        input.ground->note(region_, lie.space);
    }
    if (lie.outcome.kind == OutcomeKind::ok && recipe.resolved.integratesLight()) {
        lie.outcome = widenForLight(input, around, lie);
    }
    return lie;
}

FitInput FrustumPlanner::fitInputOf(const FrustumInput& input, const Lie& lie) const
{
    return {lie.space,
            region_.outline(),
            region_.body().points(),
            region_.body().faceSizes(),
            input.camera,
            strongestWarp(lie.border_texels, input.map_size)};
}

MapFrame FrustumPlanner::frameOfWarp(const FrustumInput& input, const Lie& lie, const Warp& warp) const
{
    if (input.recipe.holdsScene()) {
        return frameOf(rectOfScene(lie.space, input.scene_ws), lie.least_size, input.map_size, lie.border_texels);
    }
    // Unwarped, the rectangle of the receivers' boxes may be the smaller one.
    const LightRect rect = warp.warped() ? rectOf(warp, region_.outline()) : region_.rect();
    // A caller that wants to know how fine a frustum has to be needs only its seen part.
    const bool asks = input.recipe.grows() && !(input.slice.texel > 0.0);
    return (asks ? moveFreely : input.recipe.motion->move)(rect, {lie.space, input.frame.camera, input.camera,
                                                                  input.slice, lie.least_size, input.map_size,
                                                                  lie.border_texels, lie.light_reach});
}

/// Around what the GPU will probably fit the map, if it does: where the points are, and the room for their rays.
void FrustumPlanner::outlinePlaces(const FrustumInput& input, const Lie& lie)
{
    places_.clear();
    scratch_.clear();
    if (!input.recipe.takesDepth(layoutOf(input.light)) || lit_.empty()) {
        return;
    }
    for (const LitPoint& point : lit_) {
        scratch_.push_back(point.q);
    }
    outlineOf(scratch_, places_);
    if (lie.light_reach > 0.0) {
        const LightRect seen = rectOf({}, places_);
        widenOutline(places_, affordableReach(lie.light_reach, seen.high - seen.low), scratch_);
    }
}

Prediction FrustumPlanner::predict(const FrustumInput& input, const Sight& sight, double& strength)
{
    if (input.slice.paraboloid) {
        return predictHalf(input, sight);
    }
    const Lie lie = lieOf(input);
    if (lie.outcome.kind != OutcomeKind::ok) {
        return {};
    }
    lit_.clear();
    lit_.reserve(sight.points().size());
    lightPoints(lie.space, sight.points(), input.slice.depth, input.slice.sector, lit_);
    outlinePlaces(input, lie);
    const double feature_m = kFeature_px * sight.meanPixel_m();
    const double finest_px = input.recipe.grows() ? kEnoughForOne_px : kFineEnough_px;
    FrustumInput drawn = input;
    if (input.recipe.searchesWarp()) {
        const FitInput fit = fitInputOf(input, lie);
        strength = nextStrength({fit, slopeOfBody(fit), region_.rect(), lie.least_size, input.map_size,
                                 lie.border_texels, lit_, places_, feature_m, finest_px},
                                strength);
        drawn.strength = strength;
    }
    const Warp warp = warpOf(drawn, lie);
    const MapFrame frame = places_.empty()
                               ? frameOfWarp(drawn, lie, warp)
                               : frameOf(rectOf(warp, places_), lie.least_size, input.map_size, lie.border_texels);
    const FacingTexels facing =
        lit_.empty() ? facingAmid(input, sight, lie, warp, frame) : facingTexels(lit_, warp, frame, texels_px_);
    const glm::dvec2 size = frame.half - frame.texel * lie.border_texels;
    return {mapErrorOf(lit_, warp, frame, feature_m, finest_px),
            edgesBySize(lit_, warp, frame, feature_m, input.halvings),
            coarsestTexel_px(lit_, warp, frame, texels_px_),
            facing,
            true,
            2.0 * std::max(size.x, size.y)};
}

/// No point tells how fine the map should be: as fine as in the middle of what it shows, and half way to the eye.
FacingTexels FrustumPlanner::facingAmid(const FrustumInput& input, const Sight& sight, const Lie& lie, const Warp& warp,
                                        const MapFrame& frame)
{
    const CameraView& camera = input.camera;
    double least_m = std::numeric_limits<double>::infinity();
    double most_m = 0.0;
    for (const glm::dvec3& p : region_.body().points()) {
        const double depth_m = std::max(glm::dot(camera.forward_ws, p - camera.eye_ws), camera.pad_m);
        least_m = std::min(least_m, depth_m);
        most_m = std::max(most_m, depth_m);
    }
    SightPoint amid;
    amid.p_ws = region_.centre_ws();
    amid.facing_m = sight.pixelAt_m(std::sqrt(least_m * most_m), camera.perspective);
    const std::optional<LitPoint> lit = litPoint(lie.space, amid);
    if (!lit || !(lit->facing > 0.0)) {
        return {};
    }
    FacingTexels facing = facingTexels(std::span(&*lit, 1), warp, frame, texels_px_);
    facing.sum_px *= 0.5;
    return facing;
}

Outcome FrustumPlanner::plan(const FrustumInput& input, View& view, std::vector<std::uint32_t>& casters)
{
    if (input.slice.paraboloid) {
        return planHalf(input, view, casters);
    }
    const Recipe& recipe = input.recipe;
    const CameraView& camera = input.camera;
    const ObjectSet& objects = *input.frame.objects;
    const bool steady = recipe.steady();
    const Lie lie = lieOf(input);
    if (lie.outcome.kind != OutcomeKind::ok) {
        return lie.outcome;
    }
    const LightSpace& space = lie.space;
    const double border_texels = lie.border_texels;
    const RegionInput around{
        space, input.slice, camera, objects, input.receivers, recipe.drawsReceivers(), input.light.groups};
    const Warp warp = drawnWarp(input, lie);
    MapFrame shown = frameOfWarp(input, lie, warp);
    shown.centre += shown.texel * input.grid_move_texels;
    view.projection.light_reach = lie.light_reach;
    const FitReport fit = reportOf(warp, shown, region_.outline());

    const CasterReach reach{steady ? LightRect{shown.centre - shown.half, shown.centre + shown.half} : region_.rect(),
                            borderReach(warp, fit, border_texels, input.map_size),
                            recipe.holdsScene() ? depthsOfScene(space, input.scene_ws, 0.0).far_m
                                                : farthestCaster(region_, space, steady, camera.pad_m),
                            steady};
    const auto first_caster = static_cast<std::uint32_t>(casters.size());
    if (const Outcome found = region_.gatherCasters(around, reach, casters); found.kind != OutcomeKind::ok) {
        return found;
    }

    view.serves.slice = input.slice.depth;
    view.serves.sector = input.slice.sector;
    view.serves.faded_in = input.slice.faded_in;
    view.serves.layered = input.slice.layered;
    view.serves.rim = input.slice.rim;
    view.projection.parallel = !space.perspective;
    view.projection.orthographic = !space.perspective && !warp.warped();
    // Between a placed light and its near distance nothing casts, so there the rasteriser cuts.
    view.projection.clamp_near = input.frame.clamps_depth && recipe.resolved.traits().clamps_near &&
                                 !recipe.resolved.integratesLight() && !space.perspective;
    view.fit = fit;
    view.projection.texel_xy_m = fit.coarsest_texel;
    view.projection.texel_m = std::max(view.projection.texel_xy_m.x, view.projection.texel_xy_m.y);
    view.casters.first = first_caster;
    view.casters.count = static_cast<std::uint32_t>(casters.size()) - first_caster;
    const DepthRange range = rangeOf(input, space, view);
    view.projection.clip_from_world = clipFromWorld(space, warp, shown, range.near_m, range.far_m);
    measureDepth(input, space, range, view);
    if (!isFinite(view)) {
        casters.resize(first_caster);
        return kTooFarApart;
    }
    if (recipe.layersWorld()) {
        placeLayers(input.layers, recipe.options().moments.layer_axis, space.forward_ws, view);
    }
    return warp.outcome;
}

/// Makes room for the rays to all of the light. How far they lead depends on who casts, and who casts on how far they
/// lead; so the casters are looked for once more before, as far out as a map may have to show.
Outcome FrustumPlanner::widenForLight(const FrustumInput& input, const RegionInput& around, Lie& lie)
{
    if (input.recipe.steady() && !input.recipe.grows()) { // all of the scene, so that the map holds still
        lie.light_reach =
            steadyReach(input.light, lie.space, input.recipe.holdsScene() ? input.scene_ws : input.camera.scene_ws);
        return {};
    }
    const glm::dvec2 size = region_.rect().high - region_.rect().low;
    const double most = affordableReach(std::numeric_limits<double>::infinity(), size);
    const CasterReach reach{region_.rect(), most, farthestCaster(region_, lie.space, false, input.camera.pad_m), false};
    near_casters_.clear();
    const Outcome found = region_.gatherCasters(around, reach, near_casters_);
    if (found.kind == OutcomeKind::ok) {
        lie.light_reach =
            affordableReach(lightReach(input.light, lie.space, region_.casterNear_m(), region_.receiverFar_m()), size);
        region_.widen(lie.light_reach);
    }
    return found;
}

Warp FrustumPlanner::warpOf(const FrustumInput& input, const Lie& lie) const
{
    const Recipe& recipe = input.recipe;
    if (input.slice.up_ws != glm::dvec3(0.0)) {
        return {}; // a segment of a warp is affine
    }
    if (recipe.searchesWarp()) {
        const FitInput fit = fitInputOf(input, lie);
        return warpOfStrength(fit, slopeOfBody(fit), input.strength);
    }
    if (!recipe.steady()) {
        return recipe.fit(fitInputOf(input, lie));
    }
    Warp none;
    if (recipe.fit != fitUniform && recipe.fit != fitScene && recipe.fit != nullptr) {
        none.outcome = {OutcomeKind::fallback, kUnwarped};
    }
    return none;
}

/// The warp of the recipe's fit, kept as far as probably seen points gain by it. For parallel light alone: amid the
/// rays of a lamp the points tell too little, and warps would come and go. PSM is the camera's own space and has no
/// weaker form.
Warp FrustumPlanner::drawnWarp(const FrustumInput& input, const Lie& lie)
{
    const Warp warp = warpOf(input, lie);
    if (!warp.warped() || input.sight == nullptr || lie.space.perspective || input.recipe.fit == fitPsm) {
        return warp;
    }
    Warp none;
    const FitReport with = reportOf(warp, frameOfWarp(input, lie, warp), region_.outline());
    const glm::dvec2 without = frameOfWarp(input, lie, none).texel;
    const double gain = without.x * without.y / (with.finest_texel.x * with.finest_texel.y);
    lit_.clear();
    lightPoints(lie.space, input.sight->points(), input.slice.depth, input.slice.sector, lit_);
    constexpr std::size_t kFewest = 24; // a tenth of the picture; fewer tell too little of where texels are coarse
    double loss = 1.0;
    if (lit_.size() >= kFewest) {
        const auto coarsest = [&](const Warp& tried) {
            return coarsestTexel_px(lit_, tried, frameOfWarp(input, lie, tried), texels_px_);
        };
        loss = coarsest(warp) / coarsest(none);
    }
    return weakened(fitInputOf(input, lie), warp, gain, loss);
}

DepthRange FrustumPlanner::rangeOf(const FrustumInput& input, const LightSpace& space, const View& view) const
{
    const Recipe& recipe = input.recipe;
    const CameraView& camera = input.camera;
    const glm::dvec3 scene = glm::dvec3(camera.scene_ws.max) - glm::dvec3(camera.scene_ws.min);
    // Where casters are clamped there is room for what clamping needs; averages lose by a range that is not theirs.
    const bool needs_range = !view.projection.clamp_near && !recipe.resolved.traits().filterable;
    const double least_m = needs_range ? kLeastRange * std::max({scene.x, scene.y, scene.z}) : 0.0;
    if (recipe.holdsScene()) {
        const SceneDepths depths = depthsOfScene(space, input.scene_ws, least_m);
        return {depths.near_m, depths.far_m};
    }
    return depthRangeOf(
        {region_, space, view.projection.clamp_near, recipe.steady(), view.projection.texel_m, camera.pad_m, least_m});
}

/// The metric, and where its depths are measured from.
void FrustumPlanner::measureDepth(const FrustumInput& input, const LightSpace& space, const DepthRange& range,
                                  View& view) const
{
    const bool whole = input.recipe.holdsScene();
    const double place_m = whole ? range.near_m : lightPlaceOf(region_, space, range.near_m);
    const glm::dvec3 centre_ws = region_.centre_ws();
    view.projection.light_place_ws =
        space.perspective ? space.origin_ws : centre_ws + space.forward_ws * (place_m - space.coordinates(centre_ws).z);
    if (whole) {
        view.projection.light_place_ws = lightPlaceOfScene(space, input.scene_ws, place_m);
    }
    view.projection.metric.near_m = range.near_m - place_m;
    view.projection.metric.far_m = range.far_m - place_m;
    const glm::dvec4 depth(space.depth_ws, -glm::dot(space.depth_ws, space.origin_ws) - range.near_m);
    view.projection.metric.metric_ws = depth / (range.far_m - range.near_m);
}

} // namespace gnomon
