// SPDX-License-Identifier: Apache-2.0
// How a light's receivers are divided among frustums. A partition is one file and one line in partitions.cpp.
#pragma once

#include "camera_view.h"

#include <span>
#include <vector>

namespace gnomon {

/// The part of the world that one frustum of a light serves.
struct Slice {
    glm::dvec3 axis_ws{0.0, -1.0, 0.0}; // of the frustum, unit
    double half_angle_rad = 0.0;        // lights with a place: the frustum is a square pyramid around the axis
    std::array<Plane, 8> cut;           // inward; receivers outside belong to another slice
    std::uint32_t cut_count = 0;
};

struct PartitionInput {
    const Light& light;
    const Camera& camera;
    const CameraView& view;
};
/// Appends the slices of a light; the count depends on the technique and the light's type alone, so that tiles last.
using PartitionFunction = void (*)(const PartitionInput& input, std::vector<Slice>& out);

/// Null for a partition that is not available.
[[nodiscard]] PartitionFunction partitionFunction(Partition partition);

void partitionSingle(const PartitionInput& input, std::vector<Slice>& out);

} // namespace gnomon
