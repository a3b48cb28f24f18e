// SPDX-License-Identifier: Apache-2.0
// Two half spaces around a point light, above it and below, with a paraboloid's map each: the baseline of few maps
// beside `cube`. Based on: S. Brabec, T. Annen, H.-P. Seidel, "Shadow Mapping for Hemispherical and Omnidirectional
// Light Sources", CGI 2002. Departure: the axis is the world's up. Ground and ceilings, whose triangles are large, are
// in one map then, and only walls cross the rim.
#include "partition/partition.h"

#include <glm/gtc/constants.hpp>

namespace gnomon {

void partitionParaboloid(const PartitionInput& input, std::vector<Slice>& out)
{
    for (const double sign : {1.0, -1.0}) {
        Slice slice;
        slice.axis_ws = {0.0, sign, 0.0};
        slice.half_angle_rad = glm::half_pi<double>();
        slice.sector.w = {slice.axis_ws, -sign * input.light.position_ws.y};
        slice.paraboloid = true;
        out.push_back(slice);
    }
}

} // namespace gnomon
