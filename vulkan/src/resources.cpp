// SPDX-License-Identifier: Apache-2.0
// Images, buffers and shader modules.
#include "device.h"

#include <gnomon/error.h>

#include <algorithm>
#include <cassert>

namespace gnomon::vulkan {
namespace {

ImageView makeView(Device& device, VkImage image, const ImageInfo& info, VkImageViewType type,
                   const VkImageSubresourceRange& range)
{
    VkImageViewCreateInfo create{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
    create.image = image;
    create.viewType = type;
    create.format = info.format;
    create.subresourceRange = range;
    VkImageView view = VK_NULL_HANDLE;
    check(device.vk.CreateImageView(device.handle(), &create, nullptr, &view), "create an image view");
    device.name(VK_OBJECT_TYPE_IMAGE_VIEW, handleBits(view), info.purpose);
    return {device, view};
}

/// The memory that a resource needs, with the driver's wish for memory of its own.
struct Needs {
    VkMemoryDedicatedRequirements dedicated{VK_STRUCTURE_TYPE_MEMORY_DEDICATED_REQUIREMENTS};
    VkMemoryRequirements2 all{VK_STRUCTURE_TYPE_MEMORY_REQUIREMENTS_2, &dedicated};

    Needs() = default;
    Needs(const Needs&) = delete;
    Needs& operator=(const Needs&) = delete;
};

MemoryRequest requestOf(const Needs& needs, VkMemoryPropertyFlags properties, const char* purpose)
{
    MemoryRequest request;
    request.needs = needs.all.memoryRequirements;
    request.properties = properties;
    request.purpose = purpose;
    request.prefers_dedicated = needs.dedicated.prefersDedicatedAllocation == VK_TRUE;
    request.requires_dedicated = needs.dedicated.requiresDedicatedAllocation == VK_TRUE;
    return request;
}

void checkLimits(const Device& device, const ImageInfo& info)
{
    const VkPhysicalDeviceLimits& limits = device.limits();
    const auto size = [](std::uint32_t w, std::uint32_t h, std::uint32_t layers) {
        return std::to_string(w) + " x " + std::to_string(h) + " in " + std::to_string(layers) + " layers";
    };
    if (info.extent.width > limits.maxImageDimension2D || info.extent.height > limits.maxImageDimension2D ||
        info.layers > limits.maxImageArrayLayers) {
        throw Error(std::string("create the image for ") + info.purpose + ", " +
                        size(info.extent.width, info.extent.height, info.layers),
                    "the device goes up to " +
                        size(limits.maxImageDimension2D, limits.maxImageDimension2D, limits.maxImageArrayLayers),
                    "choose a smaller size");
    }
}

} // namespace

Image::Image(Device& device, const ImageInfo& info) : info_(info)
{
    checkLimits(device, info);
    VkImageCreateInfo create{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
    create.imageType = VK_IMAGE_TYPE_2D;
    create.format = info.format;
    create.extent = {info.extent.width, info.extent.height, 1};
    create.mipLevels = info.levels;
    create.arrayLayers = info.layers;
    create.samples = info.samples;
    create.tiling = VK_IMAGE_TILING_OPTIMAL;
    create.usage = info.usage;
    VkImage image = VK_NULL_HANDLE;
    check(device.vk.CreateImage(device.handle(), &create, nullptr, &image), "create an image");
    image_ = {device, image};
    device.name(VK_OBJECT_TYPE_IMAGE, handleBits(image), info.purpose);

    const VkImageMemoryRequirementsInfo2 asked{VK_STRUCTURE_TYPE_IMAGE_MEMORY_REQUIREMENTS_INFO_2, nullptr, image};
    Needs needs;
    device.vk.GetImageMemoryRequirements2(device.handle(), &asked, &needs.all);
    MemoryRequest request = requestOf(needs, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, info.purpose);
    request.image = image;
    memory_ = Memory(device, request);
    check(device.vk.BindImageMemory(device.handle(), image, memory_.block().memory, memory_.block().offset),
          "bind image memory");

    all_ = makeView(device, image, info, VK_IMAGE_VIEW_TYPE_2D_ARRAY, {info.aspect, 0, info.levels, 0, info.layers});
    layers_.reserve(info.layers);
    for (std::uint32_t i = 0; i < info.layers; ++i) {
        layers_.push_back(makeView(device, image, info, VK_IMAGE_VIEW_TYPE_2D, {info.aspect, 0, 1, i, 1}));
    }
    const bool written_by_shaders = (info.usage & VK_IMAGE_USAGE_STORAGE_BIT) != 0;
    levels_.reserve(info.levels);
    for (std::uint32_t i = 0; written_by_shaders && i < info.levels; ++i) {
        levels_.push_back(
            makeView(device, image, info, VK_IMAGE_VIEW_TYPE_2D_ARRAY, {info.aspect, i, 1, 0, info.layers}));
    }
}

ImageView Image::range(Device& device, std::uint32_t first, std::uint32_t count) const
{
    return makeView(device, image_.get(), info_, VK_IMAGE_VIEW_TYPE_2D_ARRAY, {info_.aspect, 0, 1, first, count});
}

Buffer::Buffer(Device& device, VkDeviceSize bytes, VkBufferUsageFlags usage, VkMemoryPropertyFlags properties,
               const char* purpose)
    : size_(bytes)
{
    VkBufferCreateInfo create{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
    create.size = bytes;
    create.usage = usage;
    VkBuffer buffer = VK_NULL_HANDLE;
    check(device.vk.CreateBuffer(device.handle(), &create, nullptr, &buffer), "create a buffer");
    buffer_ = {device, buffer};
    device.name(VK_OBJECT_TYPE_BUFFER, handleBits(buffer), purpose);

    const VkBufferMemoryRequirementsInfo2 asked{VK_STRUCTURE_TYPE_BUFFER_MEMORY_REQUIREMENTS_INFO_2, nullptr, buffer};
    Needs needs;
    device.vk.GetBufferMemoryRequirements2(device.handle(), &asked, &needs.all);
    MemoryRequest request = requestOf(needs, properties, purpose);
    request.buffer = buffer;
    memory_ = Memory(device, request);
    check(device.vk.BindBufferMemory(device.handle(), buffer, memory_.block().memory, memory_.block().offset),
          "bind buffer memory");
}

HostBuffer::HostBuffer(Device& device, VkDeviceSize bytes, VkBufferUsageFlags usage, const char* purpose)
    : Buffer(device, bytes, usage, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT, purpose)
{
}

DeviceBuffer::DeviceBuffer(Device& device, VkDeviceSize bytes, VkBufferUsageFlags usage, const char* purpose)
    : Buffer(device, bytes, usage, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, purpose)
{
}

std::span<const std::uint32_t> Device::hooked(std::span<const std::uint32_t> spirv) const
{
    if (view_.shaders.words == nullptr) {
        return spirv;
    }
    for (const ShaderList& list : shaders_) {
        for (std::size_t i = 0; i < list.modules.size(); ++i) {
            if (list.modules[i]->data() == spirv.data()) {
                const std::span<const std::uint32_t> other = view_.shaders.words(view_.shaders.user, list.names[i]);
                return other.empty() ? spirv : other;
            }
        }
    }
    assert(false && "a module that is in no list");
    return spirv;
}

std::span<const std::uint32_t> Device::shaderCalled(std::string_view name) const
{
    for (const ShaderList& list : shaders_) {
        const auto found = std::ranges::find(list.names, name);
        if (found != list.names.end()) {
            return *list.modules[static_cast<std::size_t>(found - list.names.begin())];
        }
    }
    return {};
}

ShaderModule makeShader(Device& device, std::span<const std::uint32_t> spirv)
{
    spirv = device.hooked(spirv);
    const VkShaderModuleCreateInfo create{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO, nullptr, 0, spirv.size_bytes(),
                                          spirv.data()};
    VkShaderModule module = VK_NULL_HANDLE;
    check(device.vk.CreateShaderModule(device.handle(), &create, nullptr, &module), "create a shader module");
    return {device, module};
}

} // namespace gnomon::vulkan
