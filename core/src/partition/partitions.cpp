// SPDX-License-Identifier: Apache-2.0
#include "partition/partition.h"

namespace gnomon {
namespace {

constexpr PartitionTraits kPartitions[] = {
    {Partition::single, partitionSingle, false, false, 1}, {Partition::cascades, partitionCascades, true, false, 0},
    {Partition::sdsm, partitionSdsm, true, true, 0},       {Partition::cube, partitionCube, false, false, kCubeFaces},
    {Partition::multi, nullptr, true, false, 1, true},     {Partition::automatic, partitionCascades, true, false, 0},
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
