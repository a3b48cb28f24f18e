// SPDX-License-Identifier: Apache-2.0
// The names of pipelines: by their modules, and by all else that changes a compiler's code.
#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <map>
#include <string>
#include <unordered_map>
#include <vector>

namespace gnomon::compiled {

/// The words of each module that there is, and its name: "mask_pcf.frag".
using ModuleNames = std::map<const std::uint32_t*, std::string>;
using MadeModules = std::unordered_map<VkShaderModule, std::string>;

/// Empty where it is none of them.
[[nodiscard]] std::string nameOf(const ModuleNames& names, const VkShaderModuleCreateInfo& module);

struct StageNames {
    std::vector<std::string> modules;
    /// By stage. The vertex stage of a full-screen triangle, which three vertices run, has none.
    std::map<VkShaderStageFlags, std::string> labels;
};
[[nodiscard]] StageNames namesOf(const VkGraphicsPipelineCreateInfo& info, const MadeModules& modules);
[[nodiscard]] StageNames namesOf(const VkComputePipelineCreateInfo& info, const MadeModules& modules);

} // namespace gnomon::compiled
