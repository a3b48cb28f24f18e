// SPDX-License-Identifier: Apache-2.0
// The caller's Vulkan 1.3 device as the backend sees it. Nothing here is owned, created or destroyed.
#pragma once

#include <vulkan/vulkan_core.h>

#include <cstdint>

namespace gnomon::vulkan {

/// One piece of device memory, as the host's memory policy gave it.
struct MemoryBlock {
    VkDeviceMemory memory = VK_NULL_HANDLE;
    VkDeviceSize offset = 0;
    void* mapped = nullptr; // host address of the block's first byte when it is host-visible, else null
    void* token = nullptr;  // for the hooks' own use
};

/// The host's memory policy. `purpose` is a static string ("shadow maps", "mask", "constants" …) for accounting.
struct MemoryHooks {
    void* user = nullptr;
    VkResult (*allocate)(void* user, const VkMemoryRequirements& needs, VkMemoryPropertyFlags properties,
                         const char* purpose, MemoryBlock* block) = nullptr;
    void (*release)(void* user, const MemoryBlock& block) = nullptr;
};

/// Precondition: the device was made with the features that requiredFeatures() names.
struct DeviceView {
    VkInstance instance = VK_NULL_HANDLE;
    VkPhysicalDevice physical_device = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;
    /// Where functions come from. All are looked up through it, so a host may hand in a loader, a layer or a mock.
    /// Not null.
    PFN_vkGetInstanceProcAddr get_instance_proc_addr = nullptr;
    MemoryHooks memory;        // empty: a dedicated allocation per resource
    bool debug_labels = false; // VK_EXT_debug_utils is enabled: name objects, label passes
    bool layered = false;      // the device has the feature shaderOutputLayer on, for CascadePass::layered
};

/// The features that the backend relies on, chained for VkDeviceCreateInfo::pNext. Static lifetime. Every desktop
/// driver of Vulkan 1.3 and Mesa's lavapipe have them; vulkan/src/features.cpp says what each is for. `layered`: and
/// shaderOutputLayer, which is optional.
[[nodiscard]] const VkPhysicalDeviceFeatures2& requiredFeatures(bool layered = false);
/// Has the physical device shaderOutputLayer?
[[nodiscard]] bool supportsLayered(const DeviceView& view);
/// Names of the required features that a physical device lacks, separated by ", "; empty when it has all. Writes at
/// most `capacity` bytes and a zero to `text`.
void missingFeatures(const DeviceView& view, char* text, std::uint32_t capacity);

} // namespace gnomon::vulkan
