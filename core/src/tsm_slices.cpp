// SPDX-License-Identifier: Apache-2.0
// Fit tsm in affine segments: a slice of the light for each.
#define GNOMON_REAL double
#include "fit/tsm_segments.h"
#include "frustum_planner.h"

#include <gnomon/shared/cascade_fit.h>

namespace gnomon {
namespace {

/// Where the row is not negative.
Plane planeOf(const glm::dvec4& row)
{
    const double length = glm::length(glm::dvec3(row));
    return {glm::dvec3(row) / length, row.w / length};
}

} // namespace

void FrustumPlanner::divideTsm(const FrustumInput& input, std::uint32_t count, double blend, std::vector<Slice>& out)
{
    const Lie lie = lieOf(input);
    TsmSegments found = lie.outcome.kind == OutcomeKind::ok ? segmentTsm(fitInputOf(input, lie), count) : TsmSegments{};
    Slice whole = input.slice;
    if (found.ends.empty()) {
        out.push_back(whole);
        return;
    }
    // Place along the trapezoid is dot(axis, (p, 1)) / dot(over, (p, 1)): metres from the eye, or of a lamp tangents.
    const LightSpace& space = lie.space;
    const glm::dvec3& from_ws = space.perspective ? space.origin_ws : input.camera.eye_ws;
    const auto row = [&](const glm::dvec3& way_ws) {
        return glm::dvec4(way_ws, -glm::dot(way_ws, from_ws));
    };
    whole.up_ws = space.right_ws * found.along.x + space.up_ws * found.along.y;
    whole.depth.axis = row(whole.up_ws);
    whole.depth.across = true;
    if (space.perspective) {
        whole.depth.over = row(space.forward_ws);
        whole.sector.w = whole.depth.over;
    }
    std::vector<double>& ends = found.ends;
    for (double& end : ends) {
        end -= glm::dot(whole.up_ws, from_ws - space.origin_ws);
    }
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
        Slice& slice = out.emplace_back(whole);
        if (i > 0) {
            slice.depth.blend_m = shared::blendWidth(blend, ends[i - 1], ends[i]);
            slice.depth.begin_m = ends[i] - slice.depth.blend_m;
            slice.cut[slice.cut_count++] = planeOf(slice.depth.axis - slice.depth.over * slice.depth.begin_m);
        }
        if (i + 2 < ends.size()) {
            slice.depth.end_m = ends[i + 1];
            slice.cut[slice.cut_count++] = planeOf(slice.depth.over * slice.depth.end_m - slice.depth.axis);
        }
    }
}

} // namespace gnomon
