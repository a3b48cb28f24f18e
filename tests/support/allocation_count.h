// SPDX-License-Identifier: Apache-2.0
// Counts what is taken from the heap through operator new. A test binary that links gnomon_allocation_count has its
// operators replaced.
#pragma once

#include <cstdint>

namespace gnomon::test {

/// Allocations of this thread since it began.
[[nodiscard]] std::uint64_t heapAllocations();

} // namespace gnomon::test
