// SPDX-License-Identifier: Apache-2.0
// Compiled pipelines kept between runs, in the user's cache folder.
#pragma once

#include <vulkan/vulkan.h>

#include <filesystem>

namespace gnomon::host {

/// A cache with the file's content, or an empty one when the file is absent, torn or of another driver.
[[nodiscard]] VkPipelineCache loadPipelineCache(VkDevice device, const std::filesystem::path& file);
/// Writes the file whole or not at all. Where the folder cannot be written to there is no file and no error, because
/// nothing depends on it.
void storePipelineCache(VkDevice device, VkPipelineCache cache, const std::filesystem::path& file);

} // namespace gnomon::host
