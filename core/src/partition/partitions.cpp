// SPDX-License-Identifier: Apache-2.0
#include "partition/partition.h"

namespace gnomon {
namespace {

struct Row {
    Partition partition;
    PartitionFunction function;
    bool measures;
    bool fits_on_gpu;
};
constexpr Row kPartitions[] = {
    {Partition::single, partitionSingle, false, false},
    {Partition::cascades, partitionCascades, true, false},
    {Partition::sdsm, partitionSdsm, true, true},
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

bool partitionFitsOnGpu(Partition partition)
{
    for (const Row& row : kPartitions)
        if (row.partition == partition)
            return row.fits_on_gpu;
    return false;
}

} // namespace gnomon
