// SPDX-License-Identifier: Apache-2.0
#include "threads.h"

#include <gnomon/error.h>

#include <algorithm>
#include <exception>
#include <future>
#include <string>
#include <thread>
#include <unistd.h>
#include <vector>

namespace gnomon::host {

unsigned threadsOfSoftwareDriver()
{
    constexpr long kMostThatDraw = 32; // however many cores there are
    return static_cast<unsigned>(std::clamp(::sysconf(_SC_NPROCESSORS_ONLN), 1L, kMostThatDraw)) + 2;
}

void requireThreads(unsigned count, const char* tried)
{
    std::promise<void> all_there;
    const std::shared_future<void> end = all_there.get_future().share();
    std::vector<std::thread> threads;
    threads.reserve(count);
    try {
        while (threads.size() < count) {
            threads.emplace_back([end] { end.wait(); });
        }
    } catch (const std::exception&) { // told below, when the others have ended
    }
    all_there.set_value();
    const std::size_t started = threads.size();
    for (std::thread& thread : threads) {
        thread.join();
    }
    if (started < count) {
        throw Error(tried,
                    "of " + std::to_string(count) + " threads that the driver may need, " + std::to_string(started) +
                        " could be started",
                    "allow more processes or memory (ulimit -u, ulimit -v)");
    }
}

} // namespace gnomon::host
