// SPDX-License-Identifier: Apache-2.0
#include "memory_sweep.h"

#include "sweep.h"

#include <gnomon/error.h>

#include <gtest/gtest.h>

#include <exception>
#include <iostream>
#include <limits>
#include <new>

namespace gnomon::test {
namespace {

enum class Outcome : std::uint8_t { ended, no_memory, error };

Outcome outcomeOf(const std::function<void()>& work)
{
    try {
        work();
    } catch (const std::bad_alloc&) {
        return Outcome::no_memory;
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::out_of_memory) << error.what();
        return Outcome::error;
    } catch (const std::exception& other) {
        ADD_FAILURE() << other.what();
        return Outcome::error;
    }
    return Outcome::ended;
}

std::uint64_t allocationsOf(const MemorySweep& sweep, const std::function<void()>& work,
                            const std::function<void(bool)>& check)
{
    std::uint64_t count = 0;
    // The first run makes all that is made once and kept.
    for (int run = 0; run < 2; ++run) {
        {
            const FailingAllocation none(std::numeric_limits<std::uint64_t>::max(), sweep.whose);
            work();
            count = none.asked();
        }
        check(true);
    }
    return count;
}

} // namespace

void sweepMemory(const MemorySweep& sweep, const std::function<void()>& work, const std::function<void(bool)>& check)
{
    const std::uint64_t count = allocationsOf(sweep, work, check);
    ASSERT_GT(count, 0U);
    std::uint64_t of[3] = {};
    for (const std::uint64_t point : sweepPoints(sweep.name, count, sweep.most)) {
        SCOPED_TRACE("allocation " + std::to_string(point));
        const std::ptrdiff_t held = heapHeld();
        Outcome outcome = Outcome::ended;
        bool failed = false;
        {
            const FailingAllocation failing(point, sweep.whose);
            outcome = outcomeOf(work);
            failed = FailingAllocation::failed();
        }
        check(outcome == Outcome::ended);
        if (sweep.whose == FailingAllocation::Of::this_thread) {
            EXPECT_TRUE(failed);
            EXPECT_TRUE(sweep.library_leaks || heapHeld() == held) << heapHeld() - held << " bytes are left";
        }
        ++of[static_cast<int>(outcome)];
        ASSERT_FALSE(testing::Test::HasFailure());
    }
    std::cout << "[   sweep  ] " << sweep.name << ": " << of[1] << " std::bad_alloc, " << of[2] << " Error, " << of[0]
              << " ended well\n";
}

} // namespace gnomon::test
