// SPDX-License-Identifier: Apache-2.0
// Files in the user's cache folder: what is known of a device and its driver from one run to the next. Nothing depends
// on them.
#pragma once

#include <vulkan/vulkan.h>

#include <filesystem>
#include <string>
#include <string_view>

namespace gnomon::host {

/// $XDG_CACHE_HOME/gnomon or ~/.cache/gnomon, and in it one file per subject, device and driver version; empty when
/// neither variable is set.
[[nodiscard]] std::filesystem::path cacheFile(const VkPhysicalDeviceProperties& properties, std::string_view subject);
/// What writeCached() wrote; empty when the file is absent or torn.
[[nodiscard]] std::string readCached(const std::filesystem::path& file);
/// Writes the file whole or not at all. Throws Error where the folder cannot be written to.
void writeCached(const std::filesystem::path& file, std::string_view payload);

} // namespace gnomon::host
