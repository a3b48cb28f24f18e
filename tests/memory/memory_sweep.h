// SPDX-License-Identifier: Apache-2.0
// Lets each allocation of some work fail once.
#pragma once

#include "allocation_count.h"

#include <cstdint>
#include <functional>
#include <string>

namespace gnomon::test {

struct MemorySweep {
    std::string name;
    std::uint64_t most = 400; // points, where not all are asked for
    FailingAllocation::Of whose = FailingAllocation::Of::this_thread;
    bool library_leaks = false; // a library in use does not give back all when memory runs out
};

/// Runs `work` twice with all the memory it wants, to count its allocations, and then once for each point of the sweep,
/// where one of them fails. Work may end as if nothing had been, or throw std::bad_alloc or an Error of the kind
/// out_of_memory; anything else fails the test. `check` looks at the remains and frees them, with all the memory it
/// wants; `ended` says that nothing was thrown. This thread must then have freed all that it took.
void sweepMemory(const MemorySweep& sweep, const std::function<void()>& work,
                 const std::function<void(bool ended)>& check);

} // namespace gnomon::test
