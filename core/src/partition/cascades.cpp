// SPDX-License-Identifier: Apache-2.0
// The camera's depth in slices, each with a map of its own: fine ones near the eye, coarse ones far off.
// Based on: F. Zhang, H. Sun, L. Xu, L. K. Lun, "Parallel-split shadow maps for large-scale virtual environments",
// 2006, eq. 3 to 5; W. Engel, "Cascaded Shadow Maps", ShaderX5, 2006.
// Departure: the near and far ends are those of the receivers that the camera sees, not its planes. A camera may have
// no far plane, and nothing is gained by maps of the empty air before the eye.
#define GNOMON_REAL double
#include "partition/partition.h"

#include <gnomon/shared/cascade_fit.h>

#include <algorithm>

namespace gnomon {
Plane depthPlane(const CameraView& view, double depth_m, bool away)
{
    const double at = glm::dot(view.forward_ws, view.eye_ws) + depth_m;
    return away ? Plane{view.forward_ws, -at} : Plane{-view.forward_ws, at};
}

void partitionCascades(const PartitionInput& input, std::vector<Slice>& out)
{
    const CameraView& view = input.view;
    const CascadeOptions& options = input.cascades;
    const std::uint32_t count = options.count;
    const shared::SplitRange range = shared::splitRange(view.near_m, view.far_m, options.lambda, view.perspective);
    const auto end = [&](std::uint32_t i) {
        if (options.explicitEnds() && i < count) {
            return i == 0 ? 0.0 : options.ends_m[i - 1];
        }
        return shared::splitAt(range, static_cast<int>(i), static_cast<int>(count));
    };
    const glm::dvec4 axis(view.forward_ws, -glm::dot(view.forward_ws, view.eye_ws));
    for (std::uint32_t i = 0; i < count; ++i) {
        Slice slice = wholeSlice(input.light);
        slice.depth.axis = axis;
        // The first and the last serve what lies before and behind all splits too: rounding, and explicit ends that
        // leave something over. But nothing is to be seen before the nearest receiver and behind the farthest: without
        // these two planes the first body would begin at the eye, and a warp would spend its map on air.
        if (i == 0) {
            slice.cut[slice.cut_count++] = depthPlane(view, view.near_m - view.pad_m, true);
        }
        if (i + 1 == count) {
            slice.cut[slice.cut_count++] = depthPlane(view, range.far_m + view.pad_m, false);
        }
        if (i > 0) {
            slice.depth.blend_m = shared::blendWidth(options.blend, i > 1 ? end(i - 1) : range.near_m, end(i));
            slice.depth.begin_m = end(i) - slice.depth.blend_m;
            slice.cut[slice.cut_count++] = depthPlane(view, slice.depth.begin_m, true);
        }
        if (i + 1 < count) {
            slice.depth.end_m = end(i + 1);
            slice.cut[slice.cut_count++] = depthPlane(view, slice.depth.end_m, false);
        }
        out.push_back(slice);
    }
}

} // namespace gnomon
