// SPDX-License-Identifier: Apache-2.0
// Between the program and Vulkan's loader: counts the calls that may fail and lets one of them, on the real driver. A
// binary that links vulkan_faults.cpp calls what is defined there in place of the loader's functions of these names.
#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>

namespace gnomon::test {

/// Calls that may fail, since the program began. Those that only name objects for debuggers are not among them.
[[nodiscard]] std::uint64_t fallibleVulkanCalls();
/// Objects that were made and not destroyed yet: with their device, instances and devices too. Memory counts as one.
/// What goes with a pool is not counted.
[[nodiscard]] std::int64_t liveVulkanObjects();

/// For as long as it lives, the n-th call that may fail, counted from its making and from 1, does nothing but return
/// this result; with VK_ERROR_DEVICE_LOST so do all that follow, and the GPU has finished what it was given before. A
/// call that destroys is not failed.
class FailingCall {
public:
    FailingCall(std::uint64_t nth, VkResult result);
    ~FailingCall();
    FailingCall(const FailingCall&) = delete;
    FailingCall& operator=(const FailingCall&) = delete;
};

/// For as long as it lives no fence is ever signalled, as far as anybody is told.
class DeafFences {
public:
    DeafFences();
    ~DeafFences();
    DeafFences(const DeafFences&) = delete;
    DeafFences& operator=(const DeafFences&) = delete;
    /// Waits since it was made.
    [[nodiscard]] static std::uint64_t waits();
};

} // namespace gnomon::test
