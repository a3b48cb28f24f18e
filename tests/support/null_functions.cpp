// SPDX-License-Identifier: Apache-2.0
// The null driver's functions for the device, its memory and its objects, and the look-up of all.
#include "null_state.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <type_traits>
#include <utility>

namespace gnomon::test {
namespace {

// --- Instance and physical device

VKAPI_ATTR void VKAPI_CALL getProperties(VkPhysicalDevice device, VkPhysicalDeviceProperties* properties)
{
    *properties = {};
    properties->apiVersion = driverOf(device).api_version;
    std::strcpy(properties->deviceName, "null");
    properties->limits.maxImageDimension2D = driverOf(device).limits.max_image_size;
    properties->limits.maxImageArrayLayers = driverOf(device).limits.max_image_layers;
    properties->limits.minUniformBufferOffsetAlignment = 256;
    properties->limits.maxStorageBufferRange = 1U << 27U;
    properties->limits.timestampPeriod = 1.0F;
    properties->limits.maxComputeWorkGroupInvocations = driverOf(device).limits.group_threads;
    properties->limits.maxComputeWorkGroupSize[0] = driverOf(device).limits.group_threads;
    properties->limits.maxPerStageDescriptorStorageBuffers = driverOf(device).limits.storage_buffers;
}

VKAPI_ATTR void VKAPI_CALL getMemory(VkPhysicalDevice device, VkPhysicalDeviceMemoryProperties* properties)
{
    *properties = {};
    if (const auto types = driverOf(device).limits.memory_types; !types.empty()) {
        std::ranges::copy(types, properties->memoryTypes);
        properties->memoryTypeCount = static_cast<std::uint32_t>(types.size());
        properties->memoryHeapCount = static_cast<std::uint32_t>(driverOf(device).limits.heap_bytes.size());
        return;
    }
    properties->memoryTypeCount = 1;
    properties->memoryTypes[0].propertyFlags = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT |
                                               VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT |
                                               VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    properties->memoryHeapCount = 1;
}

VKAPI_ATTR void VKAPI_CALL getFormat(VkPhysicalDevice device, VkFormat format, VkFormatProperties* properties)
{
    *properties = {};
    properties->optimalTilingFeatures = driverOf(device).featuresOf(format);
}

VKAPI_ATTR void VKAPI_CALL getFamilies(VkPhysicalDevice device, std::uint32_t* count, VkQueueFamilyProperties* families)
{
    if (families != nullptr) {
        families[0] = {
            VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT, 1, driverOf(device).limits.timestamp_bits, {1, 1, 1}};
    }
    *count = 1;
}

void takeAway(const NullLimits& limits, VkBaseOutStructure* structure)
{
    if (structure->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2) {
        constexpr std::size_t kCount = sizeof(VkPhysicalDeviceFeatures) / sizeof(VkBool32);
        auto* const has =
            reinterpret_cast<VkBool32*>(&reinterpret_cast<VkPhysicalDeviceFeatures2*>(structure)->features);
        const auto* const lacks = reinterpret_cast<const VkBool32*>(&limits.lacks);
        std::transform(has, has + kCount, lacks, has,
                       [](VkBool32 there, VkBool32 lacking) { return lacking != VK_FALSE ? VK_FALSE : there; });
    } else if (structure->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES && limits.lacks_output_layer) {
        reinterpret_cast<VkPhysicalDeviceVulkan12Features*>(structure)->shaderOutputLayer = VK_FALSE;
    }
}

// All that were asked for are there, without those that the limits take away. A structure of features is its head and
// VkBool32s.
VKAPI_ATTR void VKAPI_CALL getFeatures(VkPhysicalDevice device, VkPhysicalDeviceFeatures2* features)
{
    constexpr std::pair<VkStructureType, std::size_t> kSizes[] = {
        {VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, sizeof(VkPhysicalDeviceFeatures2)},
        {VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_FEATURES, sizeof(VkPhysicalDeviceVulkan11Features)},
        {VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES, sizeof(VkPhysicalDeviceVulkan12Features)},
        {VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES, sizeof(VkPhysicalDeviceVulkan13Features)}};
    for (auto* next = reinterpret_cast<VkBaseOutStructure*>(features); next != nullptr; next = next->pNext) {
        for (const auto& [type, size] : kSizes) {
            if (next->sType == type) {
                std::fill_n(reinterpret_cast<VkBool32*>(next + 1), (size - sizeof *next) / sizeof(VkBool32), VK_TRUE);
            }
        }
        takeAway(driverOf(device).limits, next);
    }
}

// --- Memory, buffers, images

VKAPI_ATTR VkResult VKAPI_CALL allocateMemory(VkDevice device, const VkMemoryAllocateInfo* info,
                                              const VkAllocationCallbacks*, VkDeviceMemory* memory)
{
    if (const VkResult outcome = driverOf(device).outcome(); outcome != VK_SUCCESS) {
        return outcome;
    }
    NullDriver::Impl& driver = driverOf(device);
    if (driver.counts.bytes + info->allocationSize > driver.limits.memory_bytes) {
        return VK_ERROR_OUT_OF_DEVICE_MEMORY;
    }
    const NullLimits& limits = driver.limits;
    const std::uint32_t heap = limits.memory_types.empty() ? 0 : limits.memory_types[info->memoryTypeIndex].heapIndex;
    driver.heap_used.resize(std::max<std::size_t>(driver.heap_used.size(), heap + 1));
    if (!limits.heap_bytes.empty() && driver.heap_used[heap] + info->allocationSize > limits.heap_bytes[heap]) {
        return VK_ERROR_OUT_OF_DEVICE_MEMORY;
    }
    constexpr VkMemoryPropertyFlags kSpecial = VK_MEMORY_PROPERTY_PROTECTED_BIT |
                                               VK_MEMORY_PROPERTY_LAZILY_ALLOCATED_BIT |
                                               VK_MEMORY_PROPERTY_DEVICE_COHERENT_BIT_AMD;
    driver.lackIf(!limits.memory_types.empty() &&
                  (limits.memory_types[info->memoryTypeIndex].propertyFlags & kSpecial) != 0);
    driver.heap_used[heap] += info->allocationSize;
    ++driver.counts.allocations;
    driver.counts.bytes += info->allocationSize;
    *memory = makeObject<VkDeviceMemory>(driver);
    objectOf(*memory)->heap = heap;
    objectOf(*memory)->size = info->allocationSize;
    return VK_SUCCESS;
}

VKAPI_ATTR void VKAPI_CALL freeMemory(VkDevice device, VkDeviceMemory memory, const VkAllocationCallbacks*)
{
    NullObject* const object = objectOf(memory);
    ++driverOf(device).counts.frees;
    driverOf(device).counts.bytes -= object->size;
    driverOf(device).heap_used[object->heap] -= object->size;
    driverOf(device).destroy(object);
    std::free(std::exchange(object->mapped, nullptr));
}

VKAPI_ATTR VkResult VKAPI_CALL mapMemory(VkDevice device, VkDeviceMemory memory, VkDeviceSize offset, VkDeviceSize,
                                         VkMemoryMapFlags, void** data)
{
    if (const VkResult outcome = driverOf(device).outcome(); outcome != VK_SUCCESS) {
        return outcome;
    }
    NullObject* const object = objectOf(memory);
    if (object->mapped == nullptr) {
        object->mapped = std::calloc(1, object->size);
    }
    *data = static_cast<char*>(object->mapped) + offset;
    return object->mapped != nullptr ? VK_SUCCESS : VK_ERROR_MEMORY_MAP_FAILED;
}

VKAPI_ATTR VkResult VKAPI_CALL createBuffer(VkDevice device, const VkBufferCreateInfo* info,
                                            const VkAllocationCallbacks*, VkBuffer* buffer)
{
    if (const VkResult outcome = driverOf(device).outcome(); outcome != VK_SUCCESS) {
        return outcome;
    }
    ++driverOf(device).counts.created;
    *buffer = makeObject<VkBuffer>(driverOf(device));
    objectOf(*buffer)->size = info->size;
    return VK_SUCCESS;
}

// An image has four bytes for each texel.
VKAPI_ATTR VkResult VKAPI_CALL createImage(VkDevice device, const VkImageCreateInfo* info, const VkAllocationCallbacks*,
                                           VkImage* image)
{
    if (const VkResult outcome = driverOf(device).outcome(); outcome != VK_SUCCESS) {
        return outcome;
    }
    ++driverOf(device).counts.created;
    driverOf(device).checkImage(*info);
    *image = makeObject<VkImage>(driverOf(device));
    objectOf(*image)->size = VkDeviceSize{info->extent.width} * info->extent.height * info->arrayLayers * 4;
    return VK_SUCCESS;
}

VKAPI_ATTR VkResult VKAPI_CALL createView(VkDevice device, const VkImageViewCreateInfo* info,
                                          const VkAllocationCallbacks*, VkImageView* view)
{
    if (const VkResult outcome = driverOf(device).outcome(); outcome != VK_SUCCESS) {
        return outcome;
    }
    ++driverOf(device).counts.created;
    *view = makeObject<VkImageView>(driverOf(device));
    objectOf(*view)->parts.push_back(objectOf(info->image));
    return VK_SUCCESS;
}

void describeNeeds(VkDevice device, const NullObject& object, bool dedicated, VkMemoryRequirements2& needs)
{
    const std::size_t types = std::max<std::size_t>(driverOf(device).limits.memory_types.size(), 1);
    needs.memoryRequirements = {object.size, 16, (1U << types) - 1U};
    auto* const more = static_cast<VkMemoryDedicatedRequirements*>(needs.pNext);
    if (more != nullptr && more->sType == VK_STRUCTURE_TYPE_MEMORY_DEDICATED_REQUIREMENTS) {
        more->prefersDedicatedAllocation = dedicated ? VK_TRUE : VK_FALSE;
    }
}

VKAPI_ATTR void VKAPI_CALL getBufferNeeds(VkDevice device, const VkBufferMemoryRequirementsInfo2* info,
                                          VkMemoryRequirements2* needs)
{
    describeNeeds(device, *objectOf(info->buffer), false, *needs);
}

VKAPI_ATTR void VKAPI_CALL getImageNeeds(VkDevice device, const VkImageMemoryRequirementsInfo2* info,
                                         VkMemoryRequirements2* needs)
{
    describeNeeds(device, *objectOf(info->image), true, *needs);
}

template <class Handle>
VKAPI_ATTR VkResult VKAPI_CALL bind(VkDevice device, Handle resource, VkDeviceMemory memory, VkDeviceSize offset)
{
    if (const VkResult outcome = driverOf(device).outcome(); outcome != VK_SUCCESS) {
        return outcome;
    }
    objectOf(resource)->memory = objectOf(memory);
    objectOf(resource)->offset = offset;
    return VK_SUCCESS;
}

// --- Other objects

template <class Info, class Handle>
VKAPI_ATTR VkResult VKAPI_CALL create(VkDevice device, const Info* info, const VkAllocationCallbacks*, Handle* handle)
{
    if (const VkResult outcome = driverOf(device).outcome(); outcome != VK_SUCCESS) {
        return outcome;
    }
    NullDriver::Impl& driver = driverOf(device);
    if constexpr (std::is_same_v<Info, VkShaderModuleCreateInfo>) {
        driver.checkShader({info->pCode, info->codeSize / sizeof *info->pCode});
    } else if constexpr (std::is_same_v<Info, VkDescriptorSetLayoutCreateInfo>) {
        driver.checkLayout(*info);
    } else if constexpr (std::is_same_v<Info, VkQueryPoolCreateInfo>) {
        driver.lackIf(info->queryType == VK_QUERY_TYPE_PIPELINE_STATISTICS &&
                      driver.limits.lacks.pipelineStatisticsQuery != VK_FALSE);
        driver.lackIf(info->queryType == VK_QUERY_TYPE_TIMESTAMP && driver.limits.timestamp_bits == 0);
    }
    ++driver.counts.created;
    *handle = makeObject<Handle>(driver);
    return VK_SUCCESS;
}

template <class Handle>
VKAPI_ATTR void VKAPI_CALL destroy(VkDevice device, Handle handle, const VkAllocationCallbacks*)
{
    ++driverOf(device).counts.destroyed;
    driverOf(device).destroy(objectOf(handle));
}

template <class Info>
VKAPI_ATTR VkResult VKAPI_CALL createPipelines(VkDevice device, VkPipelineCache, std::uint32_t count, const Info* infos,
                                               const VkAllocationCallbacks*, VkPipeline* pipelines)
{
    std::fill_n(pipelines, count, VkPipeline{VK_NULL_HANDLE}); // as the specification wants it where one fails
    if (const VkResult outcome = driverOf(device).outcome(); outcome != VK_SUCCESS) {
        return outcome;
    }
    driverOf(device).counts.created += count;
    driverOf(device).counts.pipelines += count;
    for (std::uint32_t i = 0; i < count; ++i) {
        driverOf(device).checkPipeline(infos[i]);
        pipelines[i] = makeObject<VkPipeline>(driverOf(device));
    }
    return VK_SUCCESS;
}

constexpr std::size_t kMostElements = 4;  // of one binding
constexpr std::size_t kMostBindings = 16; // of one set

// The first part of a set is its pool; the others are what was written to it, binding after binding. There is room for
// them, so that writing allocates nothing.
VKAPI_ATTR VkResult VKAPI_CALL allocateSets(VkDevice device, const VkDescriptorSetAllocateInfo* info,
                                            VkDescriptorSet* sets)
{
    if (const VkResult outcome = driverOf(device).outcome(); outcome != VK_SUCCESS) {
        return outcome;
    }
    for (std::uint32_t i = 0; i < info->descriptorSetCount; ++i) {
        sets[i] = makeObject<VkDescriptorSet>(driverOf(device));
        objectOf(sets[i])->parts.reserve(1 + kMostBindings * kMostElements);
        objectOf(sets[i])->parts.push_back(objectOf(info->descriptorPool));
    }
    return VK_SUCCESS;
}

NullObject* writtenObject(const VkWriteDescriptorSet& write, std::uint32_t i)
{
    switch (write.descriptorType) {
    case VK_DESCRIPTOR_TYPE_SAMPLER:
        return objectOf(write.pImageInfo[i].sampler);
    case VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER:
    case VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE:
    case VK_DESCRIPTOR_TYPE_STORAGE_IMAGE:
        return objectOf(write.pImageInfo[i].imageView);
    default:
        return objectOf(write.pBufferInfo[i].buffer);
    }
}

VKAPI_ATTR void VKAPI_CALL updateSets(VkDevice device, std::uint32_t count, const VkWriteDescriptorSet* writes,
                                      std::uint32_t, const VkCopyDescriptorSet*)
{
    NullDriver::Impl& driver = driverOf(device);
    ++driver.counts.descriptor_updates;
    for (const VkWriteDescriptorSet& write : std::span(writes, count)) {
        NullObject& set = *objectOf(write.dstSet);
        driver.counts.written_in_use += set.slots != 0 ? 1 : 0;
        for (std::uint32_t i = 0; i < write.descriptorCount; ++i) {
            const std::size_t place = 1 + write.dstBinding * kMostElements + write.dstArrayElement + i;
            set.parts.resize(std::max(set.parts.size(), place + 1));
            set.parts[place] = writtenObject(write, i);
        }
    }
}

VKAPI_ATTR VkResult VKAPI_CALL getQueries(VkDevice device, VkQueryPool, std::uint32_t, std::uint32_t, std::size_t bytes,
                                          void* data, VkDeviceSize, VkQueryResultFlags)
{
    if (const VkResult outcome = driverOf(device).outcome(); outcome != VK_SUCCESS) {
        return outcome;
    }
    std::memset(data, 0, bytes);
    const std::span<const std::uint64_t> results = driverOf(device).limits.query_results;
    if (!results.empty()) {
        std::memcpy(data, results.data(), std::min(bytes, results.size_bytes()));
    }
    return VK_SUCCESS;
}

VKAPI_ATTR void VKAPI_CALL resetQueries(VkDevice, VkQueryPool, std::uint32_t, std::uint32_t) {}

// --- Look-up

PFN_vkVoidFunction VKAPI_CALL getDeviceProcAddr(VkDevice device, const char* name)
{
    return nullInstanceProcAddr(reinterpret_cast<VkInstance>(device), name);
}

const NullEntry kEntries[] = {
    GNOMON_NULL(GetDeviceProcAddr, getDeviceProcAddr),
    GNOMON_NULL(GetPhysicalDeviceProperties, getProperties),
    GNOMON_NULL(GetPhysicalDeviceMemoryProperties, getMemory),
    GNOMON_NULL(GetPhysicalDeviceFormatProperties, getFormat),
    GNOMON_NULL(GetPhysicalDeviceFeatures2, getFeatures),
    GNOMON_NULL(GetPhysicalDeviceQueueFamilyProperties, getFamilies),
    GNOMON_NULL(AllocateMemory, allocateMemory),
    GNOMON_NULL(FreeMemory, freeMemory),
    GNOMON_NULL(MapMemory, mapMemory),
    GNOMON_NULL(BindImageMemory, bind),
    GNOMON_NULL(BindBufferMemory, bind),
    GNOMON_NULL(CreateImage, createImage),
    GNOMON_NULL(DestroyImage, destroy),
    GNOMON_NULL(GetImageMemoryRequirements2, getImageNeeds),
    GNOMON_NULL(CreateImageView, createView),
    GNOMON_NULL(DestroyImageView, destroy),
    GNOMON_NULL(CreateBuffer, createBuffer),
    GNOMON_NULL(DestroyBuffer, destroy),
    GNOMON_NULL(GetBufferMemoryRequirements2, getBufferNeeds),
    GNOMON_NULL(CreateSampler, create),
    GNOMON_NULL(DestroySampler, destroy),
    GNOMON_NULL(CreateShaderModule, create),
    GNOMON_NULL(DestroyShaderModule, destroy),
    GNOMON_NULL(CreatePipelineLayout, create),
    GNOMON_NULL(DestroyPipelineLayout, destroy),
    GNOMON_NULL(CreateGraphicsPipelines, createPipelines),
    GNOMON_NULL(CreateComputePipelines, createPipelines),
    GNOMON_NULL(DestroyPipeline, destroy),
    GNOMON_NULL(CreateDescriptorSetLayout, create),
    GNOMON_NULL(DestroyDescriptorSetLayout, destroy),
    GNOMON_NULL(CreateDescriptorPool, create),
    GNOMON_NULL(DestroyDescriptorPool, destroy),
    GNOMON_NULL(AllocateDescriptorSets, allocateSets),
    GNOMON_NULL(UpdateDescriptorSets, updateSets),
    GNOMON_NULL(CreateQueryPool, create),
    GNOMON_NULL(DestroyQueryPool, destroy),
    GNOMON_NULL(GetQueryPoolResults, getQueries),
    GNOMON_NULL(ResetQueryPool, resetQueries),
};

} // namespace

PFN_vkVoidFunction VKAPI_CALL nullInstanceProcAddr(VkInstance instance, const char* name)
{
    const char* hidden = driverOf(instance).hidden;
    if (hidden != nullptr && std::strcmp(hidden, name) == 0) {
        return nullptr;
    }
    for (const std::span<const NullEntry> entries : {std::span<const NullEntry>(kEntries), nullCommandEntries()}) {
        for (const NullEntry& entry : entries) {
            if (std::strcmp(entry.name, name) == 0) {
                return entry.function;
            }
        }
    }
    return nullptr;
}

} // namespace gnomon::test
