// SPDX-License-Identifier: Apache-2.0
#include "device.h"

#include <gnomon/error.h>

#include <gnomon_spirv.h>

#include <cstring>

namespace gnomon::vulkan {
namespace {

std::string resultName(VkResult result)
{
    switch (result) {
    case VK_ERROR_OUT_OF_HOST_MEMORY:
        return "out of host memory";
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
        return "out of device memory";
    case VK_ERROR_OUT_OF_POOL_MEMORY:
    case VK_ERROR_FRAGMENTED_POOL:
        return "out of memory for descriptors";
    case VK_ERROR_DEVICE_LOST:
        return "the device was lost";
    case VK_ERROR_FORMAT_NOT_SUPPORTED:
        return "the format is not supported";
    case VK_ERROR_TOO_MANY_OBJECTS:
        return "too many objects";
    default:
        return "VkResult " + std::to_string(static_cast<int>(result));
    }
}

ErrorKind kindOf(VkResult result)
{
    switch (result) {
    case VK_ERROR_OUT_OF_HOST_MEMORY:
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
    case VK_ERROR_OUT_OF_POOL_MEMORY:
    case VK_ERROR_FRAGMENTED_POOL:
        return ErrorKind::out_of_memory;
    case VK_ERROR_DEVICE_LOST:
        return ErrorKind::device_lost;
    default:
        return ErrorKind::other;
    }
}

const char* adviceFor(ErrorKind kind)
{
    switch (kind) {
    case ErrorKind::out_of_memory:
        return "use smaller or fewer shadow maps, or a smaller picture";
    case ErrorKind::device_lost:
        return "make a new device, and with it what was made with this one";
    case ErrorKind::other:
        break;
    }
    return "";
}

} // namespace

void check(VkResult result, const char* tried)
{
    if (result != VK_SUCCESS) {
        const ErrorKind kind = kindOf(result);
        throw Error(tried, resultName(result), adviceFor(kind), kind);
    }
}

void MemoryAccount::open(const char* purpose)
{
    for (const MemoryUse& use : uses_) {
        if (std::strcmp(use.purpose, purpose) == 0) {
            return;
        }
    }
    uses_.push_back({purpose, 0});
}

void MemoryAccount::add(const char* purpose, VkDeviceSize bytes)
{
    for (MemoryUse& use : uses_) {
        if (std::strcmp(use.purpose, purpose) == 0) {
            use.bytes += bytes;
        }
    }
}

void MemoryAccount::remove(const char* purpose, VkDeviceSize bytes)
{
    for (MemoryUse& use : uses_) {
        if (std::strcmp(use.purpose, purpose) == 0) {
            use.bytes -= bytes;
        }
    }
}

Device::Device(const DeviceView& view, const ShaderList& further)
    : vk(loadFunctions(view)),
      view_(view), shaders_{ShaderList{spirv::all_of_gnomon_spirv, spirv::names_of_gnomon_spirv}, further}
{
    VkPhysicalDeviceProperties properties{};
    vk.GetPhysicalDeviceProperties(view.physical_device, &properties);
    limits_ = properties.limits;
    software_ = properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU;
    vk.GetPhysicalDeviceMemoryProperties(view.physical_device, &memory_);
}

VkFormatFeatureFlags Device::features(VkFormat format) const
{
    VkFormatProperties properties{};
    vk.GetPhysicalDeviceFormatProperties(view_.physical_device, format, &properties);
    return properties.optimalTilingFeatures;
}

/// Memory for the GPU alone may lie in the host's memory where the device's is full. It is slower, but available.
std::vector<std::uint32_t> Device::memoryTypesFor(const MemoryRequest& request) const
{
    // Others (protected, lazily allocated, uncached by AMD's extension) are for uses that ours are not.
    constexpr VkMemoryPropertyFlags kPlain = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT | VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT |
                                             VK_MEMORY_PROPERTY_HOST_COHERENT_BIT | VK_MEMORY_PROPERTY_HOST_CACHED_BIT;
    std::vector<std::uint32_t> types;
    const auto add = [&](bool with_properties) {
        for (std::uint32_t i = 0; i < memory_.memoryTypeCount; ++i) {
            const VkMemoryPropertyFlags type = memory_.memoryTypes[i].propertyFlags;
            const bool fits = (request.needs.memoryTypeBits & (1U << i)) != 0 && (type & ~kPlain) == 0;
            if (fits && ((type & request.properties) == request.properties) == with_properties) {
                types.push_back(i);
            }
        }
    };
    add(true);
    if (request.properties == VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT) {
        add(false);
    }
    return types;
}

VkDeviceMemory Device::allocateOwn(const MemoryRequest& request, const char* tried)
{
    const VkMemoryDedicatedAllocateInfo dedicated{VK_STRUCTURE_TYPE_MEMORY_DEDICATED_ALLOCATE_INFO, nullptr,
                                                  request.image, request.buffer};
    VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
    info.pNext = request.prefers_dedicated || request.requires_dedicated ? &dedicated : nullptr;
    info.allocationSize = request.needs.size;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    VkResult result = VK_ERROR_FORMAT_NOT_SUPPORTED; // there is no type
    for (const std::uint32_t type : memoryTypesFor(request)) {
        info.memoryTypeIndex = type;
        result = vk.AllocateMemory(view_.device, &info, nullptr, &memory);
        if (result != VK_ERROR_OUT_OF_DEVICE_MEMORY) {
            break;
        }
    }
    if (result == VK_ERROR_FORMAT_NOT_SUPPORTED) {
        throw Error(tried, "the device has no memory type with the properties it needs");
    }
    check(result, tried);
    return memory;
}

MemoryBlock Device::allocate(const MemoryRequest& request)
{
    MemoryBlock block;
    const VkMemoryRequirements& needs = request.needs;
    const std::string tried = std::string("allocate memory for ") + request.purpose;
    account_.open(request.purpose); // calls that may throw come before there is anything to lose
    if (view_.memory.allocate != nullptr) {
        check(view_.memory.allocate(view_.memory.user, request, &block), tried.c_str());
        account_.add(request.purpose, needs.size);
        return block;
    }
    block.memory = allocateOwn(request, tried.c_str());
    if ((request.properties & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT) != 0) {
        const VkResult mapped = vk.MapMemory(view_.device, block.memory, 0, VK_WHOLE_SIZE, 0, &block.mapped);
        if (mapped != VK_SUCCESS) {
            vk.FreeMemory(view_.device, block.memory, nullptr);
            check(mapped, tried.c_str());
        }
    }
    account_.add(request.purpose, needs.size);
    return block;
}

void Device::release(const MemoryBlock& block, const char* purpose, VkDeviceSize bytes)
{
    account_.remove(purpose, bytes);
    if (view_.memory.allocate != nullptr) {
        view_.memory.release(view_.memory.user, block);
    } else {
        vk.FreeMemory(view_.device, block.memory, nullptr);
    }
}

void Device::name(VkObjectType type, std::uint64_t handle, const char* text) const
{
    if (vk.SetDebugUtilsObjectNameEXT != nullptr) {
        const VkDebugUtilsObjectNameInfoEXT info{VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT, nullptr, type,
                                                 handle, text};
        vk.SetDebugUtilsObjectNameEXT(view_.device, &info);
    }
}

void Device::beginLabel(VkCommandBuffer commands, const char* text) const
{
    if (vk.CmdBeginDebugUtilsLabelEXT != nullptr) {
        const VkDebugUtilsLabelEXT label{VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT, nullptr, text, {}};
        vk.CmdBeginDebugUtilsLabelEXT(commands, &label);
    }
}

void Device::endLabel(VkCommandBuffer commands) const
{
    if (vk.CmdEndDebugUtilsLabelEXT != nullptr) {
        vk.CmdEndDebugUtilsLabelEXT(commands);
    }
}

Memory::Memory(Device& device, const MemoryRequest& request)
    : device_(&device), block_(device.allocate(request)), purpose_(request.purpose), bytes_(request.needs.size)
{
}

Memory::Memory(Memory&& other) noexcept
    : device_(std::exchange(other.device_, nullptr)), block_(other.block_), purpose_(other.purpose_),
      bytes_(other.bytes_)
{
}

Memory& Memory::operator=(Memory&& other) noexcept
{
    std::swap(device_, other.device_);
    std::swap(block_, other.block_);
    std::swap(purpose_, other.purpose_);
    std::swap(bytes_, other.bytes_);
    return *this;
}

Memory::~Memory()
{
    if (device_ != nullptr) {
        device_->release(block_, purpose_, bytes_);
    }
}

} // namespace gnomon::vulkan
