// SPDX-License-Identifier: Apache-2.0
#define GNOMON_REAL double
#include <gnomon/plan_views.h>

#include <glm/geometric.hpp>
#include <gnomon/shared/paraboloid.h>
#include <gnomon/shared/sun_steps.h>

#include <algorithm>
#include <cassert>

namespace gnomon {
namespace {

bool isDrawnAtOnce(const View& view, bool all)
{
    return (view.contents.redraw || all) && view.contents.kept_layer == kNoIndex &&
           view.place.part == TexelPart::whole && !view.projection.paraboloid;
}

/// Can one pass draw `next`, `above` layers above `view`?
bool goTogether(const View& view, const View& next, std::uint32_t above)
{
    const Tile& a = view.place.tile;
    const Tile& b = next.place.tile;
    const bool same_place =
        b.layer == a.layer + above && b.x == a.x && b.y == a.y && b.width == a.width && b.height == a.height;
    return same_place && next.light == view.light && next.serves.sun == view.serves.sun &&
           next.projection.orthographic == view.projection.orthographic &&
           next.projection.clamp_near == view.projection.clamp_near &&
           (next.projection.gpu_cascade == kNoIndex) == (view.projection.gpu_cascade == kNoIndex);
}

} // namespace

std::uint32_t maskChannelCount(const Plan& plan)
{
    return plan.lights.size() > 1 || std::ranges::any_of(plan.lights, &LightPlan::mask_coloured) ? 4 : 1;
}

SunPosition strongerPosition(const SunSteps& steps)
{
    if (!steps.paired) {
        return SunPosition::only;
    }
    if (steps.alternate) {
        return steps.read;
    }
    return steps.share > 0.5 ? SunPosition::later : SunPosition::earlier;
}

double laterWeight(const SunSteps& steps, double x)
{
    assert(steps.paired);
    const double per_band = steps.band > 0.0 ? 1.0 / steps.band : 0.0;
    return shared::stepWeight({steps.share, steps.edge, per_band, steps.smooth ? 1.0 : 0.0}, x);
}

std::span<const View> viewsOf(const Plan& plan, std::uint32_t light, SunPosition sun)
{
    const LightPlan& planned = plan.lights[light];
    if (!planned.outcome.hasMap()) {
        return {};
    }
    const std::span<const View> all = std::span(plan.views).subspan(planned.first_view, planned.view_count);
    const auto first = std::ranges::find(all, sun, [](const View& view) { return view.serves.sun; });
    const auto end = std::find_if(first, all.end(), [&](const View& view) { return view.serves.sun != sun; });
    return {first, end};
}

std::uint64_t texelsToDraw(const View& view)
{
    if (!view.contents.redraw) {
        return 0;
    }
    const std::uint64_t whole = std::uint64_t{view.place.tile.width} * view.place.tile.height;
    if (view.contents.kept_layer == kNoIndex) {
        return whole;
    }
    return std::uint64_t{view.contents.dirty.width} * view.contents.dirty.height +
           (view.contents.redraw_kept ? whole : 0);
}

std::optional<glm::dvec2> placeOnMap(const View& view, const glm::dvec3& p_ws)
{
    const glm::dvec4 clip = view.projection.clip_from_world * glm::dvec4(p_ws, 1.0);
    if (view.projection.paraboloid) {
        const glm::dvec3 q(clip);
        const bool is_behind = !(q.z + glm::length(q) > 0.0);
        return is_behind ? std::nullopt : std::optional(shared::paraboloidPlace(q) / clip.w);
    }
    return clip.w > 0.0 ? std::optional(glm::dvec2(clip) / clip.w) : std::nullopt;
}

double depthOnMap(const View& view, const glm::dvec3& p_ws)
{
    const glm::dvec4 p(p_ws, 1.0);
    return view.projection.paraboloid
               ? glm::length(glm::dvec3(view.projection.clip_from_world * p)) + view.projection.metric.metric_ws.w
               : glm::dot(view.projection.metric.metric_ws, p);
}

std::uint32_t viewsTogether(const Plan& plan, std::uint32_t first, bool all)
{
    const View& view = plan.views[first];
    std::uint32_t count = 1;
    if (!isDrawnAtOnce(view, all)) {
        return count;
    }
    while (count < kMaxCascades && first + count < plan.views.size()) {
        const View& next = plan.views[first + count];
        if (!isDrawnAtOnce(next, all) || !goTogether(view, next, count)) {
            break;
        }
        ++count;
    }
    return count;
}

} // namespace gnomon
