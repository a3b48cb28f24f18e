// SPDX-License-Identifier: Apache-2.0
// The functions of the null driver.
#include "functions.h"
#include "null_state.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <span>
#include <utility>

namespace gnomon::vulkan {
namespace {

using Driver = NullDriver::Impl;

// What the non-dispatchable handles of things with contents point to.
struct NullMemory {
    VkDeviceSize size = 0;
    void* mapped = nullptr;
};
struct NullBuffer {
    VkDeviceSize size = 0;
    NullMemory* memory = nullptr;
    VkDeviceSize offset = 0;
};

template <class Handle>
Driver& driverOf(Handle handle)
{
    return *reinterpret_cast<Driver*>(handle);
}

void log(Driver& driver, const NullEvent& event)
{
    if (driver.events.size() < kMostNullEvents) {
        driver.events.push_back(event);
    }
}

// --- Instance and physical device

VKAPI_ATTR void VKAPI_CALL getProperties(VkPhysicalDevice device, VkPhysicalDeviceProperties* properties)
{
    *properties = {};
    properties->apiVersion = VK_API_VERSION_1_3;
    std::strcpy(properties->deviceName, "null");
    properties->limits.maxImageDimension2D = driverOf(device).limits.max_image_size;
    properties->limits.maxImageArrayLayers = driverOf(device).limits.max_image_layers;
    properties->limits.minUniformBufferOffsetAlignment = 256;
    properties->limits.maxStorageBufferRange = 1U << 27U;
    properties->limits.timestampPeriod = 1.0F;
}

VKAPI_ATTR void VKAPI_CALL getMemory(VkPhysicalDevice, VkPhysicalDeviceMemoryProperties* properties)
{
    *properties = {};
    properties->memoryTypeCount = 1;
    properties->memoryTypes[0].propertyFlags = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT |
                                               VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT |
                                               VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    properties->memoryHeapCount = 1;
}

VKAPI_ATTR void VKAPI_CALL getFormat(VkPhysicalDevice device, VkFormat, VkFormatProperties* properties)
{
    *properties = {};
    properties->optimalTilingFeatures = ~driverOf(device).hidden_features;
}

// All that were asked for are there. A structure of features is its head and VkBool32s.
VKAPI_ATTR void VKAPI_CALL getFeatures(VkPhysicalDevice, VkPhysicalDeviceFeatures2* features)
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
    }
}

// --- Memory, buffers, images

VKAPI_ATTR VkResult VKAPI_CALL allocateMemory(VkDevice device, const VkMemoryAllocateInfo* info,
                                              const VkAllocationCallbacks*, VkDeviceMemory* memory)
{
    Driver& driver = driverOf(device);
    if (driver.counts.bytes + info->allocationSize > driver.limits.memory_bytes) {
        return VK_ERROR_OUT_OF_DEVICE_MEMORY;
    }
    ++driver.counts.allocations;
    driver.counts.bytes += info->allocationSize;
    *memory = reinterpret_cast<VkDeviceMemory>(new NullMemory{info->allocationSize, nullptr});
    return VK_SUCCESS;
}

VKAPI_ATTR void VKAPI_CALL freeMemory(VkDevice device, VkDeviceMemory memory, const VkAllocationCallbacks*)
{
    auto* null_memory = reinterpret_cast<NullMemory*>(memory);
    ++driverOf(device).counts.frees;
    driverOf(device).counts.bytes -= null_memory->size;
    std::free(null_memory->mapped);
    delete null_memory;
}

VKAPI_ATTR VkResult VKAPI_CALL mapMemory(VkDevice, VkDeviceMemory memory, VkDeviceSize offset, VkDeviceSize,
                                         VkMemoryMapFlags, void** data)
{
    auto* null_memory = reinterpret_cast<NullMemory*>(memory);
    if (null_memory->mapped == nullptr) {
        null_memory->mapped = std::calloc(1, null_memory->size);
    }
    *data = static_cast<char*>(null_memory->mapped) + offset;
    return null_memory->mapped != nullptr ? VK_SUCCESS : VK_ERROR_MEMORY_MAP_FAILED;
}

VKAPI_ATTR VkResult VKAPI_CALL createBuffer(VkDevice device, const VkBufferCreateInfo* info,
                                            const VkAllocationCallbacks*, VkBuffer* buffer)
{
    ++driverOf(device).counts.created;
    *buffer = reinterpret_cast<VkBuffer>(new NullBuffer{info->size, nullptr, 0});
    return VK_SUCCESS;
}

VKAPI_ATTR void VKAPI_CALL destroyBuffer(VkDevice device, VkBuffer buffer, const VkAllocationCallbacks*)
{
    ++driverOf(device).counts.destroyed;
    delete reinterpret_cast<NullBuffer*>(buffer);
}

VKAPI_ATTR void VKAPI_CALL getBufferNeeds(VkDevice, VkBuffer buffer, VkMemoryRequirements* needs)
{
    *needs = {reinterpret_cast<NullBuffer*>(buffer)->size, 16, 1};
}

VKAPI_ATTR VkResult VKAPI_CALL bindBuffer(VkDevice, VkBuffer buffer, VkDeviceMemory memory, VkDeviceSize offset)
{
    reinterpret_cast<NullBuffer*>(buffer)->memory = reinterpret_cast<NullMemory*>(memory);
    reinterpret_cast<NullBuffer*>(buffer)->offset = offset;
    return VK_SUCCESS;
}

// An image is its size in bytes, four for each texel.
VKAPI_ATTR VkResult VKAPI_CALL createImage(VkDevice device, const VkImageCreateInfo* info, const VkAllocationCallbacks*,
                                           VkImage* image)
{
    ++driverOf(device).counts.created;
    const VkDeviceSize bytes = VkDeviceSize{info->extent.width} * info->extent.height * info->arrayLayers * 4;
    *image = reinterpret_cast<VkImage>(new NullBuffer{bytes, nullptr, 0});
    return VK_SUCCESS;
}

VKAPI_ATTR void VKAPI_CALL destroyImage(VkDevice device, VkImage image, const VkAllocationCallbacks*)
{
    ++driverOf(device).counts.destroyed;
    delete reinterpret_cast<NullBuffer*>(image);
}

VKAPI_ATTR void VKAPI_CALL getImageNeeds(VkDevice, VkImage image, VkMemoryRequirements* needs)
{
    *needs = {reinterpret_cast<NullBuffer*>(image)->size, 16, 1};
}

VKAPI_ATTR VkResult VKAPI_CALL bindImage(VkDevice, VkImage, VkDeviceMemory, VkDeviceSize)
{
    return VK_SUCCESS;
}

// --- Objects without contents

template <class Info, class Handle>
VKAPI_ATTR VkResult VKAPI_CALL create(VkDevice device, const Info*, const VkAllocationCallbacks*, Handle* handle)
{
    ++driverOf(device).counts.created;
    *handle = freshHandle<Handle>(driverOf(device));
    return VK_SUCCESS;
}

template <class Handle>
VKAPI_ATTR void VKAPI_CALL destroy(VkDevice device, Handle, const VkAllocationCallbacks*)
{
    ++driverOf(device).counts.destroyed;
}

template <class Info>
VKAPI_ATTR VkResult VKAPI_CALL createPipelines(VkDevice device, VkPipelineCache, std::uint32_t count, const Info*,
                                               const VkAllocationCallbacks*, VkPipeline* pipelines)
{
    driverOf(device).counts.created += count;
    for (std::uint32_t i = 0; i < count; ++i) {
        pipelines[i] = freshHandle<VkPipeline>(driverOf(device));
    }
    return VK_SUCCESS;
}

VKAPI_ATTR VkResult VKAPI_CALL allocateSets(VkDevice device, const VkDescriptorSetAllocateInfo* info,
                                            VkDescriptorSet* sets)
{
    for (std::uint32_t i = 0; i < info->descriptorSetCount; ++i) {
        sets[i] = freshHandle<VkDescriptorSet>(driverOf(device));
    }
    return VK_SUCCESS;
}

VKAPI_ATTR void VKAPI_CALL updateSets(VkDevice device, std::uint32_t, const VkWriteDescriptorSet*, std::uint32_t,
                                      const VkCopyDescriptorSet*)
{
    ++driverOf(device).counts.descriptor_updates;
}

VKAPI_ATTR VkResult VKAPI_CALL getQueries(VkDevice, VkQueryPool, std::uint32_t, std::uint32_t, std::size_t bytes,
                                          void* data, VkDeviceSize, VkQueryResultFlags)
{
    std::memset(data, 0, bytes);
    return VK_SUCCESS;
}

VKAPI_ATTR void VKAPI_CALL resetQueries(VkDevice, VkQueryPool, std::uint32_t, std::uint32_t) {}

// --- Commands

VKAPI_ATTR void VKAPI_CALL cmdBarrier(VkCommandBuffer commands, const VkDependencyInfo* info)
{
    for (const auto& barrier : std::span(info->pImageMemoryBarriers, info->imageMemoryBarrierCount)) {
        log(driverOf(commands), {.layer = barrier.subresourceRange.baseArrayLayer,
                                 .old_layout = barrier.oldLayout,
                                 .new_layout = barrier.newLayout});
    }
    for (const auto& barrier : std::span(info->pMemoryBarriers, info->memoryBarrierCount)) {
        log(driverOf(commands), {.kind = NullEvent::Kind::memory_barrier,
                                 .target_stages = barrier.dstStageMask,
                                 .target_access = barrier.dstAccessMask});
    }
}

VKAPI_ATTR void VKAPI_CALL cmdBegin(VkCommandBuffer commands, const VkRenderingInfo* info)
{
    NullEvent event;
    event.kind = NullEvent::Kind::begin_rendering;
    event.area = info->renderArea;
    event.count = info->layerCount;
    log(driverOf(commands), event);
}

template <NullEvent::Kind kKind, class... Rest>
VKAPI_ATTR void VKAPI_CALL cmdLogged(VkCommandBuffer commands, Rest...)
{
    NullEvent event;
    event.kind = kKind;
    log(driverOf(commands), event);
}

template <class... Rest>
VKAPI_ATTR void VKAPI_CALL cmdIgnored(VkCommandBuffer, Rest...)
{
}

VKAPI_ATTR void VKAPI_CALL cmdDraw(VkCommandBuffer commands, std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t)
{
    ++driverOf(commands).counts.draws;
    cmdLogged<NullEvent::Kind::draw>(commands);
}

VKAPI_ATTR void VKAPI_CALL cmdDispatch(VkCommandBuffer commands, std::uint32_t x, std::uint32_t y, std::uint32_t z)
{
    ++driverOf(commands).counts.dispatches;
    NullEvent event;
    event.kind = NullEvent::Kind::dispatch;
    event.count = x * y * z;
    log(driverOf(commands), event);
}

// Reads the commands, as a GPU would.
VKAPI_ATTR void VKAPI_CALL cmdDrawIndirect(VkCommandBuffer commands, VkBuffer buffer, VkDeviceSize offset,
                                           std::uint32_t count, std::uint32_t stride)
{
    Driver& driver = driverOf(commands);
    const auto& source = *reinterpret_cast<NullBuffer*>(buffer);
    for (std::uint32_t i = 0; i < count; ++i) {
        VkDrawIndexedIndirectCommand command{};
        std::memcpy(&command,
                    static_cast<const char*>(source.memory->mapped) + source.offset + offset + std::size_t{i} * stride,
                    sizeof command);
        driver.counts.instances += command.instanceCount;
        driver.counts.indices += std::uint64_t{command.instanceCount} * command.indexCount;
    }
    driver.counts.indirect_draws += count;
    NullEvent event;
    event.kind = NullEvent::Kind::draw_indirect;
    event.count = count;
    log(driver, event);
}

// --- Look-up

PFN_vkVoidFunction VKAPI_CALL getDeviceProcAddr(VkDevice device, const char* name)
{
    return nullInstanceProcAddr(reinterpret_cast<VkInstance>(device), name);
}

struct Entry {
    const char* name;
    PFN_vkVoidFunction function;
};

// The assignment to the function's own type checks the signature; taking a template's address picks its parameters.
#define GNOMON_NULL(name, function)                                                                                    \
    Entry                                                                                                              \
    {                                                                                                                  \
        "vk" #name, reinterpret_cast<PFN_vkVoidFunction>(static_cast<PFN_vk##name>(function))                          \
    }

const Entry kEntries[] = {
    GNOMON_NULL(GetDeviceProcAddr, getDeviceProcAddr),
    GNOMON_NULL(GetPhysicalDeviceProperties, getProperties),
    GNOMON_NULL(GetPhysicalDeviceMemoryProperties, getMemory),
    GNOMON_NULL(GetPhysicalDeviceFormatProperties, getFormat),
    GNOMON_NULL(GetPhysicalDeviceFeatures2, getFeatures),
    GNOMON_NULL(AllocateMemory, allocateMemory),
    GNOMON_NULL(FreeMemory, freeMemory),
    GNOMON_NULL(MapMemory, mapMemory),
    GNOMON_NULL(BindImageMemory, bindImage),
    GNOMON_NULL(BindBufferMemory, bindBuffer),
    GNOMON_NULL(CreateImage, createImage),
    GNOMON_NULL(DestroyImage, destroyImage),
    GNOMON_NULL(GetImageMemoryRequirements, getImageNeeds),
    GNOMON_NULL(CreateImageView, create),
    GNOMON_NULL(DestroyImageView, destroy),
    GNOMON_NULL(CreateBuffer, createBuffer),
    GNOMON_NULL(DestroyBuffer, destroyBuffer),
    GNOMON_NULL(GetBufferMemoryRequirements, getBufferNeeds),
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
    GNOMON_NULL(CmdPipelineBarrier2, cmdBarrier),
    GNOMON_NULL(CmdBeginRendering, cmdBegin),
    GNOMON_NULL(CmdEndRendering, cmdLogged<NullEvent::Kind::end_rendering>),
    GNOMON_NULL(CmdBindPipeline, cmdLogged<NullEvent::Kind::bind_pipeline>),
    GNOMON_NULL(CmdBindDescriptorSets, cmdIgnored),
    GNOMON_NULL(CmdBindVertexBuffers, cmdIgnored),
    GNOMON_NULL(CmdBindIndexBuffer, cmdIgnored),
    GNOMON_NULL(CmdPushConstants, cmdIgnored),
    GNOMON_NULL(CmdSetViewport, cmdIgnored),
    GNOMON_NULL(CmdSetScissor, cmdIgnored),
    GNOMON_NULL(CmdDispatch, cmdDispatch),
    GNOMON_NULL(CmdFillBuffer, cmdIgnored),
    GNOMON_NULL(CmdClearColorImage, cmdIgnored),
    GNOMON_NULL(CmdCopyImage, cmdLogged<NullEvent::Kind::copy_image>),
    GNOMON_NULL(CmdDraw, cmdDraw),
    GNOMON_NULL(CmdDrawIndexedIndirect, cmdDrawIndirect),
    GNOMON_NULL(CmdBeginQuery, cmdLogged<NullEvent::Kind::begin_query>),
    GNOMON_NULL(CmdEndQuery, cmdLogged<NullEvent::Kind::end_query>),
    GNOMON_NULL(CmdWriteTimestamp2, cmdLogged<NullEvent::Kind::timestamp>),
};
#undef GNOMON_NULL

} // namespace

PFN_vkVoidFunction VKAPI_CALL nullInstanceProcAddr(VkInstance instance, const char* name)
{
    const char* hidden = driverOf(instance).hidden;
    if (hidden != nullptr && std::strcmp(hidden, name) == 0) {
        return nullptr;
    }
    for (const Entry& entry : kEntries) {
        if (std::strcmp(entry.name, name) == 0) {
            return entry.function;
        }
    }
    return nullptr;
}

} // namespace gnomon::vulkan
