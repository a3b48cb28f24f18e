// SPDX-License-Identifier: Apache-2.0
// One frustum for everything.
// Based on: A. Marinescu, "Achieving real-time soft shadows using LVSM in an RTS game", 2011, section 4.
#include "partition/partition.h"

namespace gnomon {

void partitionSingle(const PartitionInput& input, std::vector<Slice>& out)
{
    Slice slice;
    slice.axis_ws = glm::normalize(input.light.direction_ws);
    slice.half_angle_rad = input.light.outer_half_angle_rad;
    out.push_back(slice);
}

} // namespace gnomon
