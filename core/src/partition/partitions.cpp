// SPDX-License-Identifier: Apache-2.0
#include "partition/partition.h"

namespace gnomon {
namespace {

struct Row {
    Partition partition;
    PartitionFunction function;
};
constexpr Row kPartitions[] = {
    {Partition::single, partitionSingle},
};

} // namespace

PartitionFunction partitionFunction(Partition partition)
{
    for (const Row& row : kPartitions)
        if (row.partition == partition)
            return row.function;
    return nullptr;
}

} // namespace gnomon
