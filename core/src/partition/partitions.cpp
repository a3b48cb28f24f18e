// SPDX-License-Identifier: Apache-2.0
#include "partition/partition.h"

namespace gnomon {
namespace {

struct Row {
    Partition partition;
    PartitionFunction function;
    bool measures;
};
constexpr Row kPartitions[] = {
    {Partition::single, partitionSingle, false},
    {Partition::cascades, partitionCascades, true},
};

} // namespace

PartitionFunction partitionFunction(Partition partition)
{
    for (const Row& row : kPartitions)
        if (row.partition == partition)
            return row.function;
    return nullptr;
}

bool partitionMeasures(Partition partition)
{
    for (const Row& row : kPartitions)
        if (row.partition == partition)
            return row.measures;
    return false;
}

} // namespace gnomon
