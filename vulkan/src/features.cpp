// SPDX-License-Identifier: Apache-2.0
// The device features that the backend uses: asked for, and looked for, from the same chain.
#include "optional_parts.h"

#include <gnomon/error.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <iterator>

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

// Where a feature stands: its bit in the structure of its version, and in one of its own, if there is one. Both count
// from the structure's beginning.
struct Feature {
    const char* name;
    bool FeatureUses::*use; // null: always
    VkStructureType version;
    std::size_t bit;
    VkStructureType alone = VK_STRUCTURE_TYPE_MAX_ENUM;
    std::size_t bit_alone = 0;
};

constexpr bool FeatureUses::*kAlways = nullptr;
constexpr VkStructureType kCore = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
constexpr VkStructureType k12 = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES;
constexpr VkStructureType k13 = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES;

#define GNOMON_CORE(name)                                                                                              \
    kCore, offsetof(VkPhysicalDeviceFeatures2, features) + offsetof(VkPhysicalDeviceFeatures, name)
constexpr Feature kFeatures[] = {
    {"multiDrawIndirect", &FeatureUses::indirect_draws, GNOMON_CORE(multiDrawIndirect)},
    {"drawIndirectFirstInstance", &FeatureUses::indirect_draws, GNOMON_CORE(drawIndirectFirstInstance)},
    {"depthClamp", &FeatureUses::depth_clamp, GNOMON_CORE(depthClamp)},
    // One compute shader for all formats of filterable maps.
    {"shaderStorageImageWriteWithoutFormat", &FeatureUses::filterable,
     GNOMON_CORE(shaderStorageImageWriteWithoutFormat)},
    {"sampleRateShading", &FeatureUses::sample_metric, GNOMON_CORE(sampleRateShading)},
    {"shaderOutputLayer", &FeatureUses::layered, k12, offsetof(VkPhysicalDeviceVulkan12Features, shaderOutputLayer)},
    {"shaderClipDistance", &FeatureUses::clip_planes, GNOMON_CORE(shaderClipDistance)},
    {"depthBounds", &FeatureUses::depth_bounds, GNOMON_CORE(depthBounds)},
    {"pipelineStatisticsQuery", &FeatureUses::statistics, GNOMON_CORE(pipelineStatisticsQuery)},
    // Features that every device of Vulkan 1.3 has.
    {"hostQueryReset", kAlways, k12, offsetof(VkPhysicalDeviceVulkan12Features, hostQueryReset),
     VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_HOST_QUERY_RESET_FEATURES,
     offsetof(VkPhysicalDeviceHostQueryResetFeatures, hostQueryReset)},
    {"dynamicRendering", kAlways, k13, offsetof(VkPhysicalDeviceVulkan13Features, dynamicRendering),
     VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DYNAMIC_RENDERING_FEATURES,
     offsetof(VkPhysicalDeviceDynamicRenderingFeatures, dynamicRendering)},
    {"synchronization2", kAlways, k13, offsetof(VkPhysicalDeviceVulkan13Features, synchronization2),
     VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SYNCHRONIZATION_2_FEATURES,
     offsetof(VkPhysicalDeviceSynchronization2Features, synchronization2)},
    // The size of a compute shader's group, as SPIR-V 1.6 writes it.
    {"maintenance4", kAlways, k13, offsetof(VkPhysicalDeviceVulkan13Features, maintenance4),
     VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_4_FEATURES,
     offsetof(VkPhysicalDeviceMaintenance4Features, maintenance4)},
};
#undef GNOMON_CORE

bool isNeeded(const Feature& feature, const FeatureUses& uses)
{
    return feature.use == kAlways || uses.*feature.use;
}

// Each use once; requiredFeatures() has a chain for every set of them.
constexpr bool FeatureUses::*kUses[] = {
    &FeatureUses::indirect_draws, &FeatureUses::depth_clamp, &FeatureUses::filterable,   &FeatureUses::sample_metric,
    &FeatureUses::layered,        &FeatureUses::clip_planes, &FeatureUses::depth_bounds, &FeatureUses::statistics};
constexpr std::size_t kUseCount = std::size(kUses);
static_assert(sizeof(FeatureUses) == kUseCount);

VkBaseOutStructure* findIn(const void* chain, VkStructureType type)
{
    auto* next = static_cast<VkBaseOutStructure*>(const_cast<void*>(chain));
    while (next != nullptr && next->sType != type) {
        next = next->pNext;
    }
    return next;
}

VkBool32& bitOf(void* structure, std::size_t offset)
{
    return *reinterpret_cast<VkBool32*>(static_cast<std::byte*>(structure) + offset);
}

VkBool32& bitIn(Chain& chain, const Feature& feature)
{
    return bitOf(findIn(&chain.core, feature.version), feature.bit);
}

/// A missing feature stays false.
void query(const DeviceView& view, Chain& chain)
{
    requireInstance(view);
    const auto get = reinterpret_cast<PFN_vkGetPhysicalDeviceFeatures2>(
        view.get_instance_proc_addr(view.instance, "vkGetPhysicalDeviceFeatures2"));
    if (get != nullptr) {
        get(view.physical_device, &chain.core);
    }
}

} // namespace

void requireInstance(const DeviceView& view)
{
    if (view.get_instance_proc_addr == nullptr || view.instance == VK_NULL_HANDLE ||
        view.physical_device == VK_NULL_HANDLE) {
        throw Error("ask what a device has",
                    "the DeviceView has no instance, physical device or get_instance_proc_addr", "fill in all three");
    }
}

const VkPhysicalDeviceFeatures2& requiredFeatures(const FeatureUses& uses)
{
    static std::array<Chain, std::size_t{1} << kUseCount> chains;
    static const bool filled = [] {
        for (std::size_t i = 0; i < chains.size(); ++i) {
            FeatureUses combination;
            for (std::size_t use = 0; use < kUseCount; ++use) {
                combination.*kUses[use] = (i >> use & 1U) != 0;
            }
            for (const Feature& feature : kFeatures) {
                bitIn(chains[i], feature) = isNeeded(feature, combination) ? VK_TRUE : VK_FALSE;
            }
        }
        return true;
    }();
    (void)filled;
    std::size_t wanted = 0;
    for (std::size_t use = 0; use < kUseCount; ++use) {
        wanted |= uses.*kUses[use] ? std::size_t{1} << use : 0;
    }
    return chains[wanted].core;
}

FeatureUses supportedFeatures(const DeviceView& view)
{
    Chain have;
    query(view, have);
    FeatureUses uses;
    for (const auto use : kUses) {
        uses.*use = std::all_of(std::begin(kFeatures), std::end(kFeatures), [&](const Feature& feature) {
            return feature.use != use || bitIn(have, feature) == VK_TRUE;
        });
    }
    return uses;
}

struct FeatureMerge::Impl {
    VkPhysicalDeviceFeatures enabled{}; // in place of VkDeviceCreateInfo::pEnabledFeatures
    VkPhysicalDeviceFeatures2 core{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2};
    VkPhysicalDeviceVulkan12Features v12{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES};
    VkPhysicalDeviceHostQueryResetFeatures query_reset{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_HOST_QUERY_RESET_FEATURES};
    VkPhysicalDeviceDynamicRenderingFeatures rendering{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DYNAMIC_RENDERING_FEATURES};
    VkPhysicalDeviceSynchronization2Features sync{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SYNCHRONIZATION_2_FEATURES};
    VkPhysicalDeviceMaintenance4Features maintenance{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_4_FEATURES};

    /// Ours of this type, put before the chain.
    void* add(VkDeviceCreateInfo& info, VkStructureType type)
    {
        for (void* const own :
             {static_cast<void*>(&core), static_cast<void*>(&v12), static_cast<void*>(&query_reset),
              static_cast<void*>(&rendering), static_cast<void*>(&sync), static_cast<void*>(&maintenance)}) {
            auto* const structure = static_cast<VkBaseOutStructure*>(own);
            if (structure->sType == type) {
                structure->pNext = static_cast<VkBaseOutStructure*>(const_cast<void*>(info.pNext));
                info.pNext = structure;
                return structure;
            }
        }
        return nullptr;
    }
};

namespace {

/// Structures of what VkPhysicalDeviceVulkan12Features has too.
bool hasSinglesOf12(const void* chain)
{
    constexpr VkStructureType kSingles[] = {VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_8BIT_STORAGE_FEATURES,
                                            VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SHADER_ATOMIC_INT64_FEATURES,
                                            VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SHADER_FLOAT16_INT8_FEATURES,
                                            VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DESCRIPTOR_INDEXING_FEATURES,
                                            VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SCALAR_BLOCK_LAYOUT_FEATURES,
                                            VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_IMAGELESS_FRAMEBUFFER_FEATURES,
                                            VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_UNIFORM_BUFFER_STANDARD_LAYOUT_FEATURES,
                                            VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SHADER_SUBGROUP_EXTENDED_TYPES_FEATURES,
                                            VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SEPARATE_DEPTH_STENCIL_LAYOUTS_FEATURES,
                                            VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_HOST_QUERY_RESET_FEATURES,
                                            VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_TIMELINE_SEMAPHORE_FEATURES,
                                            VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_BUFFER_DEVICE_ADDRESS_FEATURES,
                                            VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_MEMORY_MODEL_FEATURES};
    return std::any_of(std::begin(kSingles), std::end(kSingles),
                       [&](VkStructureType type) { return findIn(chain, type) != nullptr; });
}

} // namespace

FeatureMerge::FeatureMerge(VkDeviceCreateInfo& info, const FeatureUses& uses) : impl_(std::make_unique<Impl>())
{
    if (uses.layered && findIn(info.pNext, k12) == nullptr) {
        if (hasSinglesOf12(info.pNext)) {
            throw Error("add shaderOutputLayer to the features of a device",
                        "the chain has structures of single features of Vulkan 1.2",
                        "use VkPhysicalDeviceVulkan12Features in their place");
        }
        (void)impl_->add(info, k12);
    }
    if (info.pEnabledFeatures != nullptr) { // then the chain must not have them
        impl_->enabled = *info.pEnabledFeatures;
        info.pEnabledFeatures = &impl_->enabled;
    } else if (findIn(info.pNext, kCore) == nullptr) {
        (void)impl_->add(info, kCore);
    }
    for (const Feature& feature : kFeatures) {
        if (!isNeeded(feature, uses)) {
            continue;
        }
        if (feature.version == kCore && info.pEnabledFeatures != nullptr) {
            bitOf(&impl_->enabled, feature.bit - offsetof(VkPhysicalDeviceFeatures2, features)) = VK_TRUE;
        } else if (VkBaseOutStructure* const version = findIn(info.pNext, feature.version)) {
            bitOf(version, feature.bit) = VK_TRUE;
        } else {
            void* single = findIn(info.pNext, feature.alone);
            single = single != nullptr ? single : impl_->add(info, feature.alone);
            bitOf(single, feature.bit_alone) = VK_TRUE;
        }
    }
}

FeatureMerge::~FeatureMerge() = default;

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
        if (feature.use == kAlways && bitIn(have, feature) == VK_FALSE && length + more < capacity) {
            std::strcpy(text + length, separator);
            std::strcpy(text + length + std::strlen(separator), feature.name);
            length += static_cast<std::uint32_t>(more);
        }
    }
}

} // namespace gnomon::vulkan
