// SPDX-License-Identifier: Apache-2.0
// A layer between the program and Vulkan's loader: counts the calls that may fail and lets one of them fail, on the
// real driver. A binary that links vulkan_faults.cpp calls its functions in place of the loader's of the same names.
#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>

namespace gnomon::test {

/// Calls that may fail, since the program began, without those that only name objects for debuggers.
[[nodiscard]] std::uint64_t fallibleVulkanCalls();
/// Objects that were made and not destroyed yet: with their device, instances and devices too. Memory counts as one.
/// Objects that are freed with a pool are not counted.
[[nodiscard]] std::int64_t liveVulkanObjects();

/// While it lives, the n-th call that may fail, counted from its construction and from 1, only returns this result.
/// With VK_ERROR_DEVICE_LOST all later ones do too, and the GPU has finished its earlier work. Calls that destroy do
/// not fail.
class FailingCall {
public:
    FailingCall(std::uint64_t nth, VkResult result);
    ~FailingCall();
    FailingCall(const FailingCall&) = delete;
    FailingCall& operator=(const FailingCall&) = delete;
};

/// While it lives, all fences seem unsignalled.
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
