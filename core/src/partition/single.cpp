// SPDX-License-Identifier: Apache-2.0
// One frustum for everything.
// Based on: A. Marinescu, "Achieving real-time soft shadows using LVSM in an RTS game", 2011, section 4.
#include "partition/partition.h"

namespace gnomon {

Slice wholeSlice(const Light& light)
{
    Slice slice;
    slice.axis_ws = glm::normalize(light.direction_ws);
    slice.half_angle_rad = light.outer_half_angle_rad;
    return slice;
}

void partitionSingle(const PartitionInput& input, std::vector<Slice>& out)
{
    out.push_back(wholeSlice(input.light));
}

} // namespace gnomon
