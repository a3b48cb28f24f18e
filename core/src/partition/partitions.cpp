// SPDX-License-Identifier: Apache-2.0
#include "partition/partition.h"

namespace gnomon {
namespace {

constexpr PartitionTraits kPartitions[] = {
    // clang-format off
    {.partition = Partition::single, .divide = partitionSingle, .maps = 1},
    {.partition = Partition::cascades, .divide = partitionCascades, .measures = true},
    {.partition = Partition::sdsm, .divide = partitionSdsm, .measures = true, .fits_on_gpu = true},
    {.partition = Partition::cube, .divide = partitionCube, .maps = kCubeFaces},
    {.partition = Partition::paraboloid, .divide = partitionParaboloid, .maps = kHemispheres},
    {.partition = Partition::multi, .measures = true, .maps = 1, .grows = true},
    {.partition = Partition::automatic, .divide = partitionCascades, .measures = true},
    // clang-format on
};

} // namespace

const PartitionTraits* partitionTraits(Partition partition)
{
    for (const PartitionTraits& row : kPartitions) {
        if (row.partition == partition) {
            return &row;
        }
    }
    return nullptr;
}

} // namespace gnomon
