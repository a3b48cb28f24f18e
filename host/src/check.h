// SPDX-License-Identifier: Apache-2.0
// Results of Vulkan calls as exceptions, and debug names.
#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>

namespace gnomon::host {

[[nodiscard]] const char* resultText(VkResult result);
/// Throws Error(tried, the result's name) unless the call succeeded.
void check(VkResult result, const char* tried);

/// Names and labels through VK_EXT_debug_utils; does nothing where the extension is not there.
class DebugNames {
public:
    DebugNames() = default;
    DebugNames(VkInstance instance, VkDevice device);
    void name(VkObjectType type, std::uint64_t handle, const char* name) const;
    template <typename Handle>
    void name(VkObjectType type, Handle handle, const char* text) const
    {
        name(type, reinterpret_cast<std::uint64_t>(handle), text);
    }
    void begin(VkCommandBuffer commands, const char* label) const;
    void end(VkCommandBuffer commands) const;

private:
    VkDevice device_ = VK_NULL_HANDLE;
    PFN_vkSetDebugUtilsObjectNameEXT set_name_ = nullptr;
    PFN_vkCmdBeginDebugUtilsLabelEXT begin_ = nullptr;
    PFN_vkCmdEndDebugUtilsLabelEXT end_ = nullptr;
};

} // namespace gnomon::host
