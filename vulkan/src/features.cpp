// SPDX-License-Identifier: Apache-2.0
// The device features that the backend uses: asked for, and looked for, from the same chain.
#include "functions.h"

#include <array>
#include <cstddef>
#include <cstring>

namespace gnomon::vulkan {
namespace {

struct Chain {
    VkPhysicalDeviceFeatures2 core{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2};
    VkPhysicalDeviceVulkan12Features v12{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES};
    VkPhysicalDeviceVulkan13Features v13{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES};

    Chain()
    {
        core.pNext = &v12;
        v12.pNext = &v13;
    }
    Chain(const Chain&) = delete;
    Chain& operator=(const Chain&) = delete;
};

struct Feature {
    const char* name;
    VkBool32& (*of)(Chain&);
};

// Indirect drawing of instances · casters clamped onto the near plane · the profiler · the linear metric of perspective
// views in each sample, not only in each texel · one compute shader for all formats of filterable maps ·
// passes and barriers.
constexpr Feature kFeatures[] = {
    {"multiDrawIndirect",
     [](Chain& c) -> VkBool32& {
         return c.core.features.multiDrawIndirect;
     }},
    {"drawIndirectFirstInstance",
     [](Chain& c) -> VkBool32& {
         return c.core.features.drawIndirectFirstInstance;
     }},
    {"depthClamp",
     [](Chain& c) -> VkBool32& {
         return c.core.features.depthClamp;
     }},
    {"pipelineStatisticsQuery",
     [](Chain& c) -> VkBool32& {
         return c.core.features.pipelineStatisticsQuery;
     }},
    {"sampleRateShading",
     [](Chain& c) -> VkBool32& {
         return c.core.features.sampleRateShading;
     }},
    {"shaderStorageImageWriteWithoutFormat",
     [](Chain& c) -> VkBool32& {
         return c.core.features.shaderStorageImageWriteWithoutFormat;
     }},
    {"hostQueryReset",
     [](Chain& c) -> VkBool32& {
         return c.v12.hostQueryReset;
     }},
    {"dynamicRendering",
     [](Chain& c) -> VkBool32& {
         return c.v13.dynamicRendering;
     }},
    {"synchronization2",
     [](Chain& c) -> VkBool32& {
         return c.v13.synchronization2;
     }},
    // The size of a compute shader's group, as SPIR-V 1.6 writes it.
    {"maintenance4",
     [](Chain& c) -> VkBool32& {
         return c.v13.maintenance4;
     }},
};

/// What is not there stays false.
void query(const DeviceView& view, Chain& chain)
{
    const auto get = reinterpret_cast<PFN_vkGetPhysicalDeviceFeatures2>(
        view.get_instance_proc_addr(view.instance, "vkGetPhysicalDeviceFeatures2"));
    if (get != nullptr) {
        get(view.physical_device, &chain.core);
    }
}

} // namespace

const VkPhysicalDeviceFeatures2& requiredFeatures(bool layered)
{
    static Chain with;
    static Chain without;
    static const bool filled = [] {
        for (Chain* const chain : std::array{&with, &without}) {
            for (const Feature& feature : kFeatures) {
                feature.of(*chain) = VK_TRUE;
            }
        }
        with.v12.shaderOutputLayer = VK_TRUE; // the maps of cascades in one pass
        return true;
    }();
    (void)filled;
    return layered ? with.core : without.core;
}

bool supportsLayered(const DeviceView& view)
{
    Chain have;
    query(view, have);
    return have.v12.shaderOutputLayer == VK_TRUE;
}

void missingFeatures(const DeviceView& view, char* text, std::uint32_t capacity)
{
    if (capacity == 0) {
        return;
    }
    text[0] = '\0';
    Chain have;
    query(view, have);
    std::uint32_t length = 0;
    for (const Feature& feature : kFeatures) {
        const char* separator = length == 0 ? "" : ", ";
        const std::size_t more = std::strlen(separator) + std::strlen(feature.name);
        if (feature.of(have) == VK_FALSE && length + more < capacity) {
            std::strcpy(text + length, separator);
            std::strcpy(text + length + std::strlen(separator), feature.name);
            length += static_cast<std::uint32_t>(more);
        }
    }
}

} // namespace gnomon::vulkan
