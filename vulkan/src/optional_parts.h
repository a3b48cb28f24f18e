// SPDX-License-Identifier: Apache-2.0
// Parts that devices may lack: the only table that has the purpose of each, the behaviour without it, and the uses that
// need it.
#pragma once

#include "device.h"

namespace gnomon::vulkan {

/// Throws Error unless `view` has all that asking takes.
void requireInstance(const DeviceView& view);

/// How many bits of the queues' timestamps count; 0: they make none.
[[nodiscard]] std::uint32_t timestampBits(const DeviceView& view);

/// Depth and stencil to count shadow volumes in: the better of the two of which every device has one.
[[nodiscard]] VkFormat stencilFormat(const DeviceView& view);

/// Threads of a compute shader's group that no device has to take: 128 are promised.
inline constexpr std::uint32_t kLargeGroup = 256;
[[nodiscard]] bool hasLargeGroups(const VkPhysicalDeviceLimits& limits);

/// Throws Error that says what is lacking and what to do instead, unless it is on (or, where it is no feature, there).
void requirePart(const Device& device, const char* tried, bool FeatureUses::*use);
void requireLargeGroups(const Device& device, const char* tried);

} // namespace gnomon::vulkan
