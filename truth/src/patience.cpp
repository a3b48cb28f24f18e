// SPDX-License-Identifier: Apache-2.0
#include "patience.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <new>
#include <system_error>

namespace gnomon::truth {

Patience::Patience(std::uint32_t seconds) : seconds_(std::max(seconds, 1U))
{
    try {
        watcher_ = std::thread(&Patience::watch, this);
    } catch (const std::system_error&) { // no more threads to be had
    } catch (const std::bad_alloc&) {    // nor memory for one
    }
}

Patience::~Patience()
{
    if (watcher_.joinable()) {
        {
            const std::lock_guard lock(mutex_);
            ended_ = true;
        }
        ends_.notify_one();
        watcher_.join();
    }
}

// It counts its own seconds, so that a process which was stopped for an hour is not taken for one that hangs.
void Patience::watch()
{
    std::unique_lock lock(mutex_);
    std::uint64_t before = steps_;
    std::uint32_t waited = 0;
    while (!ends_.wait_for(lock, std::chrono::seconds(1), [this] { return ended_; })) {
        const std::uint64_t now = steps_;
        waited = now == before && at_work_ > 0 ? waited + 1 : 0;
        before = now;
        if (waited >= seconds_) {
            std::fprintf(stderr,
                         "gnomon: error: tracing rays: the ray tracer (Embree) has not come back for %u s, and nothing "
                         "can end a call of it but the end of the program; please report the scene and the command\n",
                         seconds_);
            std::_Exit(EXIT_FAILURE);
        }
    }
}

} // namespace gnomon::truth
