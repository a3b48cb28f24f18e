// SPDX-License-Identifier: Apache-2.0
#include "check.h"

#include <gnomon/error.h>

namespace gnomon::host {

const char* resultText(VkResult result)
{
    switch (result) {
    case VK_ERROR_OUT_OF_HOST_MEMORY:
        return "out of host memory";
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
        return "out of device memory";
    case VK_ERROR_OUT_OF_POOL_MEMORY:
    case VK_ERROR_FRAGMENTED_POOL:
        return "out of memory for descriptors";
    case VK_ERROR_INITIALIZATION_FAILED:
        return "initialisation failed";
    case VK_ERROR_DEVICE_LOST:
        return "the device was lost";
    case VK_ERROR_LAYER_NOT_PRESENT:
        return "a layer is not present";
    case VK_ERROR_EXTENSION_NOT_PRESENT:
        return "an extension is not present";
    case VK_ERROR_FEATURE_NOT_PRESENT:
        return "a feature is not present";
    case VK_ERROR_INCOMPATIBLE_DRIVER:
        return "no Vulkan driver is installed";
    case VK_ERROR_TOO_MANY_OBJECTS:
        return "too many objects";
    case VK_ERROR_FORMAT_NOT_SUPPORTED:
        return "a format is not supported";
    case VK_TIMEOUT:
        return "the device did not finish in time";
    default:
        return "an unexpected Vulkan result";
    }
}

void check(VkResult result, const char* tried)
{
    if (result == VK_SUCCESS) {
        return;
    }
    switch (result) {
    case VK_ERROR_OUT_OF_HOST_MEMORY:
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
    case VK_ERROR_OUT_OF_POOL_MEMORY:
    case VK_ERROR_FRAGMENTED_POOL:
        throw Error(tried, resultText(result), "choose a smaller picture, a smaller map or a smaller scene",
                    ErrorKind::out_of_memory);
    case VK_ERROR_DEVICE_LOST:
        throw Error(tried, resultText(result), "begin again; where it happens again, draw less at once",
                    ErrorKind::device_lost);
    default:
        throw Error(tried, resultText(result));
    }
}

DebugNames::DebugNames(VkInstance instance, VkDevice device) : device_(device)
{
    set_name_ = reinterpret_cast<PFN_vkSetDebugUtilsObjectNameEXT>(
        vkGetInstanceProcAddr(instance, "vkSetDebugUtilsObjectNameEXT"));
    begin_ = reinterpret_cast<PFN_vkCmdBeginDebugUtilsLabelEXT>(
        vkGetInstanceProcAddr(instance, "vkCmdBeginDebugUtilsLabelEXT"));
    end_ =
        reinterpret_cast<PFN_vkCmdEndDebugUtilsLabelEXT>(vkGetInstanceProcAddr(instance, "vkCmdEndDebugUtilsLabelEXT"));
}

void DebugNames::name(VkObjectType type, std::uint64_t handle, const char* name) const
{
    if (set_name_ != nullptr) {
        VkDebugUtilsObjectNameInfoEXT info{VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT};
        info.objectType = type;
        info.objectHandle = handle;
        info.pObjectName = name;
        (void)set_name_(device_, &info); // nothing depends on it
    }
}

void DebugNames::begin(VkCommandBuffer commands, const char* label) const
{
    if (begin_ != nullptr) {
        VkDebugUtilsLabelEXT info{VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT};
        info.pLabelName = label;
        begin_(commands, &info);
    }
}

void DebugNames::end(VkCommandBuffer commands) const
{
    if (end_ != nullptr) {
        end_(commands);
    }
}

} // namespace gnomon::host
