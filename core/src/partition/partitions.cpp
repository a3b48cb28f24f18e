// SPDX-License-Identifier: Apache-2.0
#include "partition/partition.h"

namespace gnomon {
namespace {

constexpr PartitionTraits kPartitions[] = {
    {Partition::single, partitionSingle, false, false, false},
    {Partition::cascades, partitionCascades, true, false, true},
    {Partition::sdsm, partitionSdsm, true, true, true},
    {Partition::automatic, partitionCascades, true, false, true},
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
