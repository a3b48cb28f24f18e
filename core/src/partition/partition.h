// SPDX-License-Identifier: Apache-2.0
// How a light's receivers are divided among frustums. A partition is one file, and its declaration and row here.
#pragma once

#include "camera_view.h"

#include <gnomon/planner.h>

#include <algorithm>
#include <iterator>
#include <span>
#include <vector>

namespace gnomon {

/// The part of the world that one frustum of a light serves.
struct Slice {
    glm::dvec3 axis_ws{0.0, -1.0, 0.0}; // the frustum's axis, unit
    double half_angle_rad = 0.0;        // lights with a place: the frustum is a square pyramid around the axis
    double near_share = 1.0;            // where the pyramid begins along its axis, share of the light's near distance
    std::array<Plane, 8> cut;           // inward; receivers outside belong to another slice
    std::uint32_t cut_count = 0;
    ViewSlice depth;       // the camera's depths that it serves
    ViewSector sector;     // the light's directions that it serves
    glm::dvec3 up_ws{0.0}; // unit, across axis_ws: the map's way up; 0: the light's own
    /// Side of the texels of a map that holds still and shows no more than what is seen, as LightRect has it. 0: the
    /// motion finds it.
    double texel = 0.0;
    double faded_in = 1.0; // ViewServes::faded_in
    bool layered = false;  // ViewServes::layered
    double rim = 0.0;      // ViewServes::rim
    /// A half space around the light's place along the axis, whole, as ViewProjection::paraboloid has it: nothing is
    /// fitted.
    bool paraboloid = false;
};

struct PartitionInput {
    const Light& light;
    const CameraView& view; // measured, where PartitionTraits::measures says so
    const CascadeOptions& cascades;
};
/// Appends the slices of a light; the count depends on the options and the light's type alone, so that tiles last.
using PartitionFunction = void (*)(const PartitionInput& input, std::vector<Slice>& out);

struct PartitionTraits {
    Partition partition;
    PartitionFunction divide = nullptr;
    bool measures = false; // it needs CameraView::near_m and far_m
    /// Each of its slices is a base map, to be listed once for each cascade that the GPU fits to a part of it.
    bool fits_on_gpu = false;
    std::uint32_t maps = 0; // maps of a light; 0: one for each of CascadeOptions::count
    /// Its slices depend on what is seen: MultiPartition, and no `divide`.
    bool grows = false;
    /// They are pages: VirtualPartition, and no `divide`.
    bool pages = false;
};
inline constexpr std::uint32_t kCubeFaces = 6;
inline constexpr std::uint32_t kHemispheres = 2;
/// The one frustum of a light that is not divided.
[[nodiscard]] Slice wholeSlice(const Light& light);
/// Around a light's place: 0, 1: +x, -x, then y and z.
[[nodiscard]] Slice cubeFace(const Light& light, int face);
/// Does the cone of a spot light, if it is one, reach into that face?
[[nodiscard]] bool shinesIntoFace(const Light& light, const Slice& face);
/// Plane z = depth of the view, which faces away from the eye or towards it.
[[nodiscard]] Plane depthPlane(const CameraView& view, double depth_m, bool away);

void partitionSingle(const PartitionInput& input, std::vector<Slice>& out);
void partitionCascades(const PartitionInput& input, std::vector<Slice>& out);
void partitionSdsm(const PartitionInput& input, std::vector<Slice>& out);
void partitionCube(const PartitionInput& input, std::vector<Slice>& out);
void partitionParaboloid(const PartitionInput& input, std::vector<Slice>& out);

// clang-format off
inline constexpr PartitionTraits kPartitions[] = {
    {.partition = Partition::single, .divide = partitionSingle, .maps = 1},
    {.partition = Partition::cascades, .divide = partitionCascades, .measures = true},
    {.partition = Partition::sdsm, .divide = partitionSdsm, .measures = true, .fits_on_gpu = true},
    {.partition = Partition::cube, .divide = partitionCube, .maps = kCubeFaces},
    {.partition = Partition::paraboloid, .divide = partitionParaboloid, .maps = kHemispheres},
    {.partition = Partition::multi, .measures = true, .maps = 1, .grows = true},
    {.partition = Partition::automatic, .divide = partitionCascades, .measures = true},
    {.partition = Partition::virtual_pages, .maps = 1, .pages = true},
};
// clang-format on

/// Null for what is not a partition. That of Partition::automatic stands for all that it may choose.
[[nodiscard]] constexpr const PartitionTraits* partitionTraits(Partition partition)
{
    const auto* const row = std::ranges::find(kPartitions, partition, &PartitionTraits::partition);
    return row != std::end(kPartitions) ? row : nullptr;
}

} // namespace gnomon
