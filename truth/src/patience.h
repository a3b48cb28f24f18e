// SPDX-License-Identifier: Apache-2.0
// No trace without an end: nothing stops a call of the ray tracer that does not come back, so the process ends.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <thread>

namespace gnomon::truth {

/// While any thread is at work, one must call goOn() every `seconds`, at least 1. Else a line is printed to the
/// standard error, and the process ends with status 1. Time in which the process or the machine stands still does not
/// count. The system may have no thread left to watch: then nobody does.
class Patience {
public:
    /// While it lives, a thread is at work.
    class Work {
    public:
        explicit Work(Patience& patience) : patience_(patience) { ++patience_.at_work_; }
        ~Work() { --patience_.at_work_; }
        Work(const Work&) = delete;
        Work& operator=(const Work&) = delete;

    private:
        Patience& patience_;
    };

    explicit Patience(std::uint32_t seconds);
    ~Patience();
    Patience(const Patience&) = delete;
    Patience& operator=(const Patience&) = delete;

    /// May be called from any thread.
    void goOn() { steps_.fetch_add(1, std::memory_order_relaxed); }

private:
    void watch();

    std::uint32_t seconds_;
    std::atomic<std::uint64_t> steps_{0};
    std::atomic<std::uint32_t> at_work_{0};
    std::mutex mutex_;
    std::condition_variable ends_;
    bool ended_ = false; // guarded by mutex_
    std::thread watcher_;
};

} // namespace gnomon::truth
