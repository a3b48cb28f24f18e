// SPDX-License-Identifier: Apache-2.0
#include "frustum_planner.h"

#include "depth_tilt.h"
#include "fit/projection.h"

#include <algorithm>
#include <cmath>

namespace gnomon {
namespace {

/// No map shows less: tangents, or so many times what coordinates are padded by.
constexpr double kLeastTangent = 1e-4;
constexpr double kLeastPads = 32.0;

bool isFinite(const View& view)
{
    double sum = view.texel_m + view.metric.near_m + view.metric.far_m;
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) {
            sum += std::abs(view.clip_from_world[column][row]);
        }
        sum += std::abs(view.metric.metric_ws[column]);
    }
    for (int axis = 0; axis < 3; ++axis) {
        sum += std::abs(view.light_place_ws[axis]);
    }
    return std::isfinite(sum) && view.texel_m > 0.0 && view.metric.far_m > view.metric.near_m;
}

} // namespace

Outcome FrustumPlanner::plan(const FrustumInput& input, View& view, std::vector<std::uint32_t>& casters)
{
    const Recipe& recipe = input.recipe;
    const CameraView& camera = input.camera;
    const ObjectSet& objects = *input.frame.objects;
    const bool steady = recipe.steady();
    const double border_texels = recipe.resolved.borderOf(input.map_size);

    LightSpace space = lightSpaceOf(input.light, input.slice.axis_ws, input.slice.half_angle_rad, camera.scene_ws);
    if (recipe.levelsDepth()) {
        space.depth_ws = levelDepth(space, objects, input.levellers);
    }
    const RegionInput around{space, input.slice, camera, objects, input.receivers, recipe.filter->filterable};
    if (const Outcome found = region_.gatherReceivers(around); found.kind != OutcomeKind::ok) {
        return found;
    }

    const Warp warp = warpOf(input, space, border_texels);
    // Unwarped, the rectangle of the receivers' boxes may be the smaller one.
    const LightRect rect = warp.warped() ? rectOf(warp, region_.outline()) : region_.rect();
    const double least_size = space.perspective ? kLeastTangent : kLeastPads * camera.pad_m;
    const MapFrame shown = recipe.motion->move(
        rect, {space, input.frame.camera, camera, input.slice, least_size, input.map_size, border_texels});
    const FitReport fit = reportOf(warp, shown, region_.outline());

    const CasterReach reach{steady ? LightRect{shown.centre - shown.half, shown.centre + shown.half} : region_.rect(),
                            borderReach(warp, fit, border_texels, input.map_size),
                            farthestCaster(region_, space, steady, camera.pad_m), steady};
    const auto first_caster = static_cast<std::uint32_t>(casters.size());
    if (const Outcome found = region_.gatherCasters(around, reach, casters); found.kind != OutcomeKind::ok) {
        return found;
    }

    view.slice = input.slice.depth;
    view.parallel = !space.perspective;
    view.orthographic = !space.perspective && !warp.warped();
    // Between a placed light and its near distance nothing casts, so there the rasteriser cuts.
    view.clamp_near = recipe.filter->clamps_near && !space.perspective;
    view.fit = fit;
    view.texel_xy_m = fit.coarsest_texel;
    view.texel_m = std::max(view.texel_xy_m.x, view.texel_xy_m.y);
    view.first_caster = first_caster;
    view.caster_count = static_cast<std::uint32_t>(casters.size()) - first_caster;
    const DepthRange range = depthRangeOf({region_, space, view.clamp_near, steady, view.texel_m, camera.pad_m});
    view.clip_from_world = clipFromWorld(space, warp, shown, range.near_m, range.far_m);
    measureDepth(space, range, view);
    if (!isFinite(view)) {
        casters.resize(first_caster);
        return kTooFarApart;
    }
    return warp.outcome;
}

Warp FrustumPlanner::warpOf(const FrustumInput& input, const LightSpace& space, double border_texels) const
{
    if (!input.recipe.steady()) {
        return input.recipe.fit({space, region_.outline(), region_.body().points(), region_.body().faceSizes(),
                                 input.camera, strongestWarp(border_texels, input.map_size)});
    }
    Warp none;
    if (input.recipe.options.technique.fit != Fit::uniform) {
        none.outcome = {OutcomeKind::fallback, kUnwarped};
    }
    return none;
}

/// The metric, and where its depths are measured from.
void FrustumPlanner::measureDepth(const LightSpace& space, const DepthRange& range, View& view) const
{
    const double place_m = lightPlaceOf(region_, space, range.near_m);
    const glm::dvec3 centre_ws = region_.centre_ws();
    view.light_place_ws =
        space.perspective ? space.origin_ws : centre_ws + space.forward_ws * (place_m - space.coordinates(centre_ws).z);
    view.metric.near_m = range.near_m - place_m;
    view.metric.far_m = range.far_m - place_m;
    const glm::dvec4 depth(space.depth_ws, -glm::dot(space.depth_ws, space.origin_ws) - range.near_m);
    view.metric.metric_ws = depth / (range.far_m - range.near_m);
}

} // namespace gnomon
