// SPDX-License-Identifier: Apache-2.0
// The Vulkan instance.
#pragma once

#include "host/gpu.h"

namespace gnomon::host {

inline constexpr const char* kLookingForDevice = "looking for a Vulkan device";
inline constexpr const char* kInstallDriver = "install a Vulkan driver; mesa-vulkan-drivers has one for the CPU";

/// Makes an instance as `options` ask, which also lists devices with a subset of Vulkan (macOS). Sets `debug_labels`:
/// whether objects can be named. Throws Error.
[[nodiscard]] VkInstance makeInstance(const GpuOptions& options, bool& debug_labels);

} // namespace gnomon::host
