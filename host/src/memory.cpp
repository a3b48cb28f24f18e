// SPDX-License-Identifier: Apache-2.0
#include "memory.h"

#include <gnomon/error.h>

#include <algorithm>
#include <bit>
#include <string>
#include <string_view>

namespace gnomon::host {
namespace {

// Devices allow few allocations (4096 is common), so what is small shares blocks.
constexpr VkDeviceSize kBlockBytes = 8ULL << 20;
constexpr VkDeviceSize kOwnFromBytes = 2ULL << 20;
constexpr VkMemoryPropertyFlags kHostFlags = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;

bool isDepth(VkFormat format)
{
    return format == VK_FORMAT_D32_SFLOAT;
}

} // namespace

Memory::Memory(const Gpu& gpu)
    : device_(gpu.view().device), limits_(gpu.properties().limits), names_(gpu.view().instance, gpu.view().device)
{
    vkGetPhysicalDeviceMemoryProperties(gpu.view().physical_device, &properties_);
}

Memory::~Memory()
{
    for (VkImageView view : views_) {
        vkDestroyImageView(device_, view, nullptr);
    }
    for (VkImage image : images_) {
        vkDestroyImage(device_, image, nullptr);
    }
    for (VkBuffer buffer : buffers_) {
        vkDestroyBuffer(device_, buffer, nullptr);
    }
    for (const Block& block : blocks_) {
        vkFreeMemory(device_, block.memory, nullptr);
    }
    for (VkDeviceMemory memory : own_) {
        vkFreeMemory(device_, memory, nullptr);
    }
}

std::uint32_t Memory::typeFor(std::uint32_t bits, VkMemoryPropertyFlags properties) const
{
    for (std::uint32_t i = 0; i < properties_.memoryTypeCount; ++i) {
        if ((bits & (1U << i)) != 0 && (properties_.memoryTypes[i].propertyFlags & properties) == properties) {
            return i;
        }
    }
    throw Error("allocating device memory", "no memory type fits");
}

VkDeviceMemory Memory::allocateBlock(VkDeviceSize size, std::uint32_t type, const char* tried) const
{
    VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
    info.allocationSize = size;
    info.memoryTypeIndex = type;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    check(vkAllocateMemory(device_, &info, nullptr, &memory), tried);
    return memory;
}

Memory::Piece Memory::allocate(const VkMemoryRequirements& needs, VkMemoryPropertyFlags properties, bool images)
{
    const std::uint32_t type = typeFor(needs.memoryTypeBits, properties);
    const bool mapped = (properties & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT) != 0;
    Piece piece;
    if (needs.size >= kOwnFromBytes) {
        piece.memory = allocateBlock(needs.size, type, "allocating device memory");
        own_.push_back(piece.memory);
        piece.own = true;
        if (mapped) {
            check(vkMapMemory(device_, piece.memory, 0, VK_WHOLE_SIZE, 0, &piece.mapped), "mapping device memory");
        }
        return piece;
    }
    const auto aligned = [&needs](const Block& b) {
        return (b.used + needs.alignment - 1) / needs.alignment * needs.alignment;
    };
    // Buffers and images keep to blocks of their own, so bufferImageGranularity never matters.
    auto block = std::find_if(blocks_.begin(), blocks_.end(), [&](const Block& b) {
        return b.type == type && b.images == images && (b.mapped != nullptr) == mapped &&
               aligned(b) + needs.size <= kBlockBytes;
    });
    if (block == blocks_.end()) {
        Block fresh;
        fresh.memory = allocateBlock(kBlockBytes, type, "allocating device memory");
        fresh.type = type;
        fresh.images = images;
        block = blocks_.insert(blocks_.end(), fresh);
        if (mapped) {
            void* address = nullptr;
            check(vkMapMemory(device_, fresh.memory, 0, VK_WHOLE_SIZE, 0, &address), "mapping device memory");
            block->mapped = static_cast<char*>(address);
        }
    }
    piece.memory = block->memory;
    piece.offset = aligned(*block);
    piece.mapped = mapped ? block->mapped + piece.offset : nullptr;
    block->used = piece.offset + needs.size;
    return piece;
}

void Memory::account(const char* purpose, VkDeviceSize bytes)
{
    const auto same = [purpose](const vulkan::MemoryUse& use) {
        return std::string_view(use.purpose) == purpose;
    };
    auto found = std::find_if(uses_.begin(), uses_.end(), same);
    if (found == uses_.end()) {
        uses_.push_back({purpose, 0});
        found = uses_.end() - 1;
    }
    found->bytes += bytes;
}

Buffer Memory::buffer(const char* purpose, VkDeviceSize size, VkBufferUsageFlags usage, Place place)
{
    Buffer result;
    result.size = std::max<VkDeviceSize>(size, 16);
    result.purpose = purpose;
    VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
    info.size = result.size;
    info.usage = usage;
    check(vkCreateBuffer(device_, &info, nullptr, &result.handle), "making a buffer");
    buffers_.push_back(result.handle);
    names_.name(VK_OBJECT_TYPE_BUFFER, result.handle, purpose);
    VkMemoryRequirements needs{};
    vkGetBufferMemoryRequirements(device_, result.handle, &needs);
    const VkMemoryPropertyFlags properties =
        place == Place::host ? kHostFlags : VkMemoryPropertyFlags{VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT};
    const Piece piece = allocate(needs, properties, false);
    check(vkBindBufferMemory(device_, result.handle, piece.memory, piece.offset), "binding a buffer's memory");
    result.mapped = place == Place::host ? piece.mapped : nullptr;
    result.own_memory = piece.own ? piece.memory : VK_NULL_HANDLE;
    account(purpose, result.size);
    return result;
}

void Memory::release(Buffer& buffer)
{
    if (buffer.handle == VK_NULL_HANDLE) {
        return;
    }
    vkDestroyBuffer(device_, buffer.handle, nullptr);
    std::erase(buffers_, buffer.handle);
    if (buffer.own_memory != VK_NULL_HANDLE) {
        vkFreeMemory(device_, buffer.own_memory, nullptr);
        std::erase(own_, buffer.own_memory);
    }
    account(buffer.purpose, VkDeviceSize{0} - buffer.size);
    buffer = {};
}

bool Memory::grow(Buffer& buffer, VkDeviceSize size, VkBufferUsageFlags usage, const char* purpose)
{
    if (buffer.handle != VK_NULL_HANDLE && buffer.size >= size) {
        return false;
    }
    release(buffer);
    buffer = this->buffer(purpose, std::bit_ceil(std::max<VkDeviceSize>(size, 4096)), usage, Place::host);
    return true;
}

Image Memory::image(const ImageWish& wish)
{
    const std::uint32_t side = std::max(wish.extent.width, wish.extent.height);
    if (side > limits_.maxImageDimension2D || wish.layers > limits_.maxImageArrayLayers) {
        throw Error(std::string("making the image \"") + wish.name + "\"",
                    std::to_string(wish.extent.width) + "x" + std::to_string(wish.extent.height) + " with " +
                        std::to_string(wish.layers) + " layers is beyond this device's limit of " +
                        std::to_string(limits_.maxImageDimension2D),
                    "choose a smaller size");
    }
    Image result{VK_NULL_HANDLE, VK_NULL_HANDLE, wish.format, wish.extent, wish.mips, wish.layers};
    VkImageCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = wish.format;
    info.extent = {wish.extent.width, wish.extent.height, 1};
    info.mipLevels = wish.mips;
    info.arrayLayers = wish.layers;
    info.samples = VK_SAMPLE_COUNT_1_BIT;
    info.tiling = VK_IMAGE_TILING_OPTIMAL;
    info.usage = wish.usage;
    check(vkCreateImage(device_, &info, nullptr, &result.handle), "making an image");
    images_.push_back(result.handle);
    names_.name(VK_OBJECT_TYPE_IMAGE, result.handle, wish.name);
    VkMemoryRequirements needs{};
    vkGetImageMemoryRequirements(device_, result.handle, &needs);
    const Piece piece = allocate(needs, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, true);
    check(vkBindImageMemory(device_, result.handle, piece.memory, piece.offset), "binding an image's memory");
    account(wish.purpose, needs.size);
    VkImageViewCreateInfo view{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
    view.image = result.handle;
    view.viewType = wish.array_view ? VK_IMAGE_VIEW_TYPE_2D_ARRAY : VK_IMAGE_VIEW_TYPE_2D;
    view.format = wish.format;
    const VkImageAspectFlags aspect = isDepth(wish.format) ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
    view.subresourceRange = {aspect, 0, wish.mips, 0, wish.layers};
    check(vkCreateImageView(device_, &view, nullptr, &result.view), "making an image view");
    views_.push_back(result.view);
    names_.name(VK_OBJECT_TYPE_IMAGE_VIEW, result.view, wish.name);
    return result;
}

} // namespace gnomon::host
