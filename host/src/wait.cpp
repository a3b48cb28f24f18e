// SPDX-License-Identifier: Apache-2.0
#include "wait.h"

#include "check.h"
#include "owned.h"

#include <gnomon/error.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <string>

namespace gnomon::host {
namespace {

using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

constexpr std::uint64_t kSliceNs = 100'000'000; // how late a wait notices that it is to end, at most
constexpr Seconds kGrace{3.0};                  // for what was submitted, once the wait is to end
constexpr double kBusyShare = 0.01;             // share of one processor

/// Tells slow from hanging. A GPU shows nothing of its progress, so there only time counts. A software rasteriser works
/// in threads of this process: as long as the process uses more of a processor than these waits do, it gets on.
class Patience {
public:
    explicit Patience(const Gpu& gpu) : software_(gpu.software()), limit_(gpu.patience_s()) {}

    /// After a slice in which nothing came: has nothing happened for too long?
    [[nodiscard]] bool isOver()
    {
        const Clock::time_point now = Clock::now();
        const std::clock_t used = std::clock(); // processor time of all threads
        const double busy_s = static_cast<double>(used - used_before_) / CLOCKS_PER_SEC;
        if (software_ && busy_s > kBusyShare * Seconds(now - before_).count()) {
            idle_since_ = now;
        }
        used_before_ = used;
        before_ = now;
        return now - idle_since_ > limit_;
    }

private:
    bool software_;
    Seconds limit_;
    Clock::time_point before_ = Clock::now();
    Clock::time_point idle_since_ = before_;
    std::clock_t used_before_ = std::clock();
};

VkResult waitForASlice(const Gpu& gpu, VkFence fence)
{
    return vkWaitForFences(gpu.view().device, 1, &fence, VK_TRUE, kSliceNs);
}

bool isAskedToEnd(const Gpu& gpu) noexcept
{
    try {
        gpu.lookUp();
        return false;
    } catch (...) {
        return true;
    }
}

Clock::time_point endOfGrace()
{
    return Clock::now() + std::chrono::duration_cast<Clock::duration>(kGrace);
}

/// Signalled once the queue has done all that it was given so far.
OwnedFence fenceBehindAll(const Gpu& gpu)
{
    constexpr const char* kTried = "asking the GPU when it is done";
    const VkFenceCreateInfo info{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
    VkFence handle = VK_NULL_HANDLE;
    check(vkCreateFence(gpu.view().device, &info, nullptr, &handle), kTried);
    OwnedFence fence(gpu, handle);
    check(vkQueueSubmit(gpu.queue(), 0, nullptr, handle), kTried);
    return fence;
}

void settleBefore(const Gpu& gpu, VkFence fence, Clock::time_point end) noexcept
{
    if (gpu.abandoned()) {
        return;
    }
    Patience patience(gpu);
    while (Clock::now() < end && !patience.isOver()) {
        const VkResult result = waitForASlice(gpu, fence);
        if (result == VK_SUCCESS || result == VK_ERROR_DEVICE_LOST) {
            return;
        }
        if (result != VK_TIMEOUT || isAskedToEnd(gpu)) {
            end = std::min(end, endOfGrace());
        }
    }
    gpu.abandon();
}

} // namespace

void waitFor(const Gpu& gpu, VkFence fence)
{
    constexpr const char* kTried = "waiting for the GPU";
    Patience patience(gpu);
    try {
        for (;;) {
            const VkResult result = waitForASlice(gpu, fence);
            if (result != VK_TIMEOUT) {
                return check(result, kTried);
            }
            gpu.lookUp();
            if (patience.isOver()) {
                gpu.abandon();
                throw Error(kTried,
                            "nothing has come of it for " + std::to_string(std::lround(gpu.patience_s())) + " s",
                            "draw less at once, or look whether the driver hangs", ErrorKind::device_lost);
            }
        }
    } catch (const Error& error) {
        if (error.kind() != ErrorKind::device_lost) {
            settle(gpu, fence);
        }
        throw;
    } catch (...) { // it was asked to end
        settleBefore(gpu, fence, endOfGrace());
        throw;
    }
}

void settle(const Gpu& gpu, VkFence fence) noexcept
{
    settleBefore(gpu, fence, Clock::time_point::max());
}

void waitForQueue(const Gpu& gpu)
{
    const OwnedFence fence = fenceBehindAll(gpu);
    waitFor(gpu, fence.get());
}

void settleQueue(const Gpu& gpu) noexcept
{
    if (gpu.abandoned()) {
        return;
    }
    try {
        const OwnedFence fence = fenceBehindAll(gpu);
        settle(gpu, fence.get());
    } catch (const Error&) { // no memory for a fence, or the device is lost
        (void)vkQueueWaitIdle(gpu.queue());
    }
}

} // namespace gnomon::host
