// SPDX-License-Identifier: Apache-2.0
#include "parallel.h"

#include <glm/common.hpp>

#include <algorithm>
#include <exception>
#include <future>
#include <new>
#include <system_error>
#include <thread>
#include <vector>

namespace gnomon::truth {
namespace {

constexpr std::uint32_t kTileSide = 16;

/// Denormal numbers, which cost a trap each, become zero on this thread while this lives.
class NoDenormals {
public:
#if defined(__SSE__)
    NoDenormals() : before_(__builtin_ia32_stmxcsr())
    {
        constexpr unsigned kFlushToZero = 0x8000; // bits of the control register
        constexpr unsigned kReadAsZero = 0x0040;
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
    [[maybe_unused]] unsigned before_ = 0;
};

} // namespace

bool forEachTile(const glm::uvec2& size_px, const Options& options, const std::function<void(const Tile&)>& work)
{
    const glm::uvec2 tiles = (size_px + kTileSide - 1U) / kTileSide;
    const std::uint32_t count = tiles.x * tiles.y;
    std::atomic<std::uint32_t> next{0};
    std::atomic<std::uint32_t> done{0};
    std::atomic<bool> failed{false};
    Patience patience(options.patience_s);
    const auto takeTiles = [&](const std::function<void(double)>& progress) {
        try {
            for (std::uint32_t i = next++; i < count && !failed && !(options.cancel && *options.cancel); i = next++) {
                {
                    const Patience::Work at_work(patience);
                    const NoDenormals no_denormals;
                    const glm::uvec2 min = glm::uvec2(i % tiles.x, i / tiles.x) * kTileSide;
                    work({min, glm::min(min + kTileSide, size_px), &patience});
                }
                ++done;
                patience.goOn();
                if (progress) {
                    progress(static_cast<double>(done) / count);
                }
            }
        } catch (...) {
            failed = true;
            throw;
        }
    };

    const std::uint32_t cores = std::max(std::thread::hardware_concurrency(), 1U);
    const std::uint32_t threads = std::min(options.threads == 0 ? cores : options.threads, count);
    std::vector<std::future<void>> helpers; // their destructors wait for them
    try {
        helpers.reserve(threads);
        for (std::uint32_t i = 1; i < threads; ++i) {
            helpers.push_back(std::async(std::launch::async, takeTiles, nullptr));
        }
    } catch (const std::system_error&) { // no more threads to be had: fewer will do
    } catch (const std::bad_alloc&) {    // nor memory for one
    }
    takeTiles(options.progress);
    for (std::future<void>& helper : helpers) {
        helper.get(); // throws what it threw
    }
    const bool finished = done == count;
    if (finished && options.progress) {
        options.progress(1.0);
    }
    return finished;
}

} // namespace gnomon::truth
