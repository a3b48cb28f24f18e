// SPDX-License-Identifier: Apache-2.0
// No trace without an end: nothing can stop a call of the ray tracer that does not come back, so the process ends.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <thread>

namespace gnomon::truth {

/// While this lives, somebody must call goOn() every `seconds`; else one line is printed to the standard error, and the
/// process ends with status 1. Time in which the process or the machine stands still does not count. The system may have
/// no thread left: then nobody watches.
class Patience {
public:
    explicit Patience(std::uint32_t seconds);
    ~Patience();
    Patience(const Patience&) = delete;
    Patience& operator=(const Patience&) = delete;

    /// From any thread.
    void goOn() { steps_.fetch_add(1, std::memory_order_relaxed); }

private:
    void watch();

    std::uint32_t seconds_;
    std::atomic<std::uint64_t> steps_{0};
    std::mutex mutex_;
    std::condition_variable ends_;
    bool ended_ = false; // guarded by mutex_
    std::thread watcher_;
};

} // namespace gnomon::truth
