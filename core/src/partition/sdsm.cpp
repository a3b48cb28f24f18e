// SPDX-License-Identifier: Apache-2.0
// Cascades that are cut and fitted to the pixels of the camera's depth buffer, on the GPU. Here, the map that they are
// rectangles of: that of one cascade for everything.
// Based on: A. Lauritzen, M. Salvi, A. Lefohn, "Sample Distribution Shadow Maps", I3D 2011.
// Departure: a cascade's map is a rectangle of the base map, which may be warped, instead of a box in light space; so
// every fit goes with it, and all that the GPU has to find of a map is a scale and an offset along two axes. How depth
// is measured, and who casts, is the base map's business and known beforehand.
#include "partition/partition.h"

namespace gnomon {

void partitionSdsm(const PartitionInput& input, std::vector<Slice>& out)
{
    CascadeOptions one;
    one.count = 1;
    partitionCascades({input.light, input.view, one}, out);
}

} // namespace gnomon
