// SPDX-License-Identifier: Apache-2.0
// The devices of the machine: which can be used, and which is taken.
#pragma once

#include "host/gpu.h"

#include <optional>
#include <string>

namespace gnomon::host {

[[nodiscard]] bool hasDeviceExtension(VkPhysicalDevice device, const char* name);
/// Whether images of this format can be used in all these ways, with optimal tiling.
[[nodiscard]] bool canBe(VkPhysicalDevice device, VkFormat format, VkFormatFeatureFlags uses);
/// Name and version, for reports.
[[nodiscard]] std::string driverOf(VkPhysicalDevice device);
/// The first family of queues that draws, computes and, where a window is wanted, presents to it.
[[nodiscard]] std::optional<std::uint32_t> familyFor(VkInstance instance, VkPhysicalDevice device,
                                                     const GpuOptions& options);
/// Throws Error that lists every device found and why it was not taken.
[[nodiscard]] VkPhysicalDevice pickDevice(VkInstance instance, const GpuOptions& options);

/// The samplers of a surface that reads maps (Pipelines::shadowed_layout): 11 for images of the frame, five for
/// textures, three for maps. Vulkan promises 16.
inline constexpr std::uint32_t kForwardSamplers = 19;
[[nodiscard]] bool hasForwardSamplers(const VkPhysicalDeviceLimits& limits);

} // namespace gnomon::host
