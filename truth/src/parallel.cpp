// SPDX-License-Identifier: Apache-2.0
#include "parallel.h"

#include <glm/common.hpp>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace gnomon::truth {
namespace {

constexpr std::uint32_t kTileSide = 16;

/// Denormal numbers, which cost a trap each, become zero while this lives. Of the thread that makes it.
class NoDenormals {
public:
#if defined(__SSE__)
    NoDenormals() : before_(__builtin_ia32_stmxcsr())
    {
        __builtin_ia32_ldmxcsr(before_ | kFlushToZero | kReadAsZero);
    }
    ~NoDenormals()
    {
        __builtin_ia32_ldmxcsr(before_);
    }
#else
    NoDenormals() = default;
    ~NoDenormals() = default;
#endif
    NoDenormals(const NoDenormals&) = delete;
    NoDenormals& operator=(const NoDenormals&) = delete;

private:
#if defined(__SSE__)
    static constexpr unsigned kFlushToZero = 0x8000; // bits of the control register
    static constexpr unsigned kReadAsZero = 0x0040;
    unsigned before_;
#endif
};

class Tiles {
public:
    Tiles(const glm::uvec2& size_px, const Options& options, const std::function<void(const Tile&)>& work)
        : size_px_(size_px), columns_((size_px.x + kTileSide - 1) / kTileSide),
          count_(columns_ * ((size_px.y + kTileSide - 1) / kTileSide)), cancel_(options.cancel), work_(work)
    {
    }

    /// A thread's life: takes tiles until none is left, somebody cancels or a thread fails.
    void take()
    {
        const NoDenormals no_denormals;
        try {
            for (std::uint32_t i = next_++; i < count_ && !stopped(); i = next_++) {
                const glm::uvec2 min = glm::uvec2(i % columns_, i / columns_) * kTileSide;
                work_({min, glm::min(min + kTileSide, size_px_)});
                ++done_;
            }
        } catch (...) {
            const std::lock_guard lock(mutex_);
            failure_ = std::current_exception();
            stop_ = true;
        }
    }
    void leave()
    {
        const std::lock_guard lock(mutex_);
        --running_;
        changed_.notify_one();
    }
    void enter()
    {
        const std::lock_guard lock(mutex_);
        ++running_;
    }
    void stop() { stop_ = true; }
    [[nodiscard]] double share() const { return static_cast<double>(done_) / count_; }
    /// Waits a moment; true once no thread is at work.
    bool rest()
    {
        std::unique_lock lock(mutex_);
        return changed_.wait_for(lock, std::chrono::milliseconds(50), [this] { return running_ == 0; });
    }
    /// After the last thread has ended.
    [[nodiscard]] bool finished() const
    {
        if (failure_) {
            std::rethrow_exception(failure_);
        }
        return done_ == count_;
    }
    [[nodiscard]] std::uint32_t count() const { return count_; }

private:
    [[nodiscard]] bool stopped() const { return stop_ || (cancel_ != nullptr && *cancel_); }

    glm::uvec2 size_px_;
    std::uint32_t columns_;
    std::uint32_t count_;
    const std::atomic<bool>* cancel_;
    const std::function<void(const Tile&)>& work_;
    std::atomic<std::uint32_t> next_{0};
    std::atomic<std::uint32_t> done_{0};
    std::atomic<bool> stop_{false};
    std::mutex mutex_;
    std::condition_variable changed_;
    std::uint32_t running_ = 0;
    std::exception_ptr failure_;
};

/// Ends its threads before it goes, whatever else happens.
class Workers {
public:
    Workers(Tiles& tiles, std::uint32_t count) : tiles_(tiles)
    {
        threads_.reserve(count);
        for (std::uint32_t i = 0; i < count; ++i) {
            tiles.enter();
            try {
                threads_.emplace_back([&tiles] {
                    tiles.take();
                    tiles.leave();
                });
            } catch (...) { // no more threads to be had, or no memory for one: fewer will do
                tiles.leave();
                break;
            }
        }
    }
    ~Workers()
    {
        tiles_.stop();
        join();
    }
    Workers(const Workers&) = delete;
    Workers& operator=(const Workers&) = delete;
    [[nodiscard]] bool none() const { return threads_.empty(); }
    void join()
    {
        for (std::thread& thread : std::exchange(threads_, {})) {
            thread.join();
        }
    }

private:
    Tiles& tiles_;
    std::vector<std::thread> threads_;
};

} // namespace

bool forEachTile(const glm::uvec2& size_px, const Options& options, const std::function<void(const Tile&)>& work)
{
    Tiles tiles(size_px, options, work);
    const std::uint32_t cores = std::max(std::thread::hardware_concurrency(), 1U);
    Workers workers(tiles, std::min(options.threads == 0 ? cores : options.threads, tiles.count()));
    if (workers.none()) {
        tiles.take();
    }
    while (!tiles.rest()) {
        if (options.progress) {
            options.progress(tiles.share());
        }
    }
    workers.join();
    const bool finished = tiles.finished();
    if (finished && options.progress) {
        options.progress(1.0);
    }
    return finished;
}

} // namespace gnomon::truth
