// SPDX-License-Identifier: Apache-2.0
#include "cascade_turns.h"

#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>

namespace gnomon {
namespace {

/// Tangents, or metres under parallel light, that an outline may be off by rounding.
constexpr double kRoundedTangent = 1e-9;

bool holds(std::span<const glm::dvec2> outline, const glm::dvec2& p, double rounding)
{
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const glm::dvec2 edge = outline[(i + 1) % outline.size()] - outline[i];
        const glm::dvec2 to = p - outline[i];
        if (edge.x * to.y - edge.y * to.x < -rounding * glm::length(edge)) {
            return false;
        }
    }
    return true;
}

} // namespace

void ViewGround::note(const Region& region, const LightSpace& of)
{
    space = of;
    region.body().planes(planes);
    outline.assign(region.outline().begin(), region.outline().end());
    near_m = region.receiverNear_m();
    far_m = region.receiverFar_m();
}

bool ViewGround::covers(const Region& seen, double pad_m) const
{
    if (outline.size() < 3 || seen.receiverNear_m() < near_m - pad_m || seen.receiverFar_m() > far_m + pad_m) {
        return false;
    }
    const double rounding = space.perspective ? kRoundedTangent : pad_m;
    return std::ranges::all_of(seen.outline(), [&](const glm::dvec2& p) { return holds(outline, p, rounding); }) &&
           std::ranges::all_of(planes, [&](const Plane& plane) {
               return std::ranges::all_of(seen.body().points(),
                                          [&](const glm::dvec3& p) { return plane.distance(p) >= -pad_m; });
           });
}

bool sameFrustum(const LightSpace& a, const LightSpace& b)
{
    return a.perspective == b.perspective &&
           (!a.perspective || (a.origin_ws == b.origin_ws && a.forward_ws == b.forward_ws && a.near_m == b.near_m &&
                               a.reach_m == b.reach_m && a.tangent == b.tangent));
}

Camera widened(const Camera& camera, double room)
{
    Camera wide = camera;
    wide.clip_depth = ClipDepth::zero_to_one;
    glm::dmat4 rows = glm::transpose(clipFromWorld(camera));
    rows[0] /= 1.0 + 2.0 * room;
    rows[1] /= 1.0 + 2.0 * room;
    const Frustum frustum = frustumFromClip(clipFromWorld(camera));
    const Plane& first = frustum.planes[camera.reversed_z ? 5 : 4];
    const Plane& last = frustum.planes[camera.reversed_z ? 4 : 5];
    if (last.normal != glm::dvec3(0.0)) {
        // A place beyond the far plane gets its depth, and the near plane keeps its own.
        const double length_m =
            std::max(last.distance(camera.eye_ws) + std::min(first.distance(camera.eye_ws), 0.0), 0.0);
        const glm::dvec4 beyond(camera.eye_ws - last.normal * (last.distance(camera.eye_ws) + room * length_m), 1.0);
        const double w = glm::dot(rows[3], beyond);
        const double z = glm::dot(rows[2], beyond) / w;
        if (w > 0.0 && camera.reversed_z && z < 0.0) {
            rows[2] = (rows[2] - rows[3] * z) / (1.0 - z);
        } else if (w > 0.0 && !camera.reversed_z && z > 1.0) {
            rows[2] /= z;
        }
    }
    wide.clip_from_world = glm::transpose(rows);
    return wide;
}

Slice widened(const Slice& slice, const CameraView& view, double room)
{
    const double end_m = std::min(slice.depth.end_m, view.far_m);
    const double more_m = room * std::max(end_m - slice.depth.begin_m, 0.0);
    Slice wide = slice;
    wide.depth.begin_m = slice.depth.begin_m - more_m;
    wide.depth.end_m = end_m + more_m;
    wide.cut_count = 0;
    wide.cut[wide.cut_count++] = depthPlane(view, wide.depth.begin_m - view.pad_m, true);
    wide.cut[wide.cut_count++] = depthPlane(view, wide.depth.end_m + view.pad_m, false);
    return wide;
}

double widenedFar_m(const CameraView& view, double room)
{
    return view.far_m + room * std::max(view.far_m - view.near_m, 0.0);
}

} // namespace gnomon
