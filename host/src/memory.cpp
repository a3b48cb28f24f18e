// SPDX-License-Identifier: Apache-2.0
#include "memory.h"

#include <gnomon/error.h>

#include <algorithm>
#include <bit>
#include <string>
#include <string_view>
#include <utility>

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
    : gpu_(gpu), device_(gpu.view().device), limits_(gpu.properties().limits),
      names_(gpu.view().instance, gpu.view().device)
{
    vkGetPhysicalDeviceMemoryProperties(gpu.view().physical_device, &properties_);
}

std::vector<std::uint32_t> Memory::typesFor(std::uint32_t bits, Place place) const
{
    // Others (protected, lazily allocated, uncached by AMD's extension) are for uses that ours are not.
    constexpr VkMemoryPropertyFlags kPlain =
        VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT | VK_MEMORY_PROPERTY_HOST_CACHED_BIT | kHostFlags;
    std::vector<std::uint32_t> types;
    const auto add = [&](VkMemoryPropertyFlags properties) {
        for (std::uint32_t i = 0; i < properties_.memoryTypeCount; ++i) {
            const VkMemoryPropertyFlags type = properties_.memoryTypes[i].propertyFlags;
            const bool fits = (bits & (1U << i)) != 0 && (type & ~kPlain) == 0 && (type & properties) == properties;
            if (fits && std::ranges::find(types, i) == types.end()) {
                types.push_back(i);
            }
        }
    };
    switch (place) {
    case Place::device:
        add(VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
        add(0); // the host's, where the device's is full: slower, and there
        break;
    case Place::read_back: // from uncached memory the host reads many times more slowly
        add(VK_MEMORY_PROPERTY_HOST_CACHED_BIT | kHostFlags);
        add(VK_MEMORY_PROPERTY_HOST_CACHED_BIT | VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT);
        [[fallthrough]];
    case Place::host:
        add(kHostFlags);
        break;
    }
    if (types.empty()) {
        throw Error("allocating device memory", "no memory type fits");
    }
    return types;
}

OwnedMemory Memory::allocateBlock(VkDeviceSize size, std::uint32_t type, bool is_last) const
{
    VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
    info.allocationSize = size;
    info.memoryTypeIndex = type;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    const VkResult result = vkAllocateMemory(device_, &info, nullptr, &memory);
    if (result == VK_ERROR_OUT_OF_DEVICE_MEMORY && !is_last) {
        return {};
    }
    check(result, "allocating device memory");
    return {gpu_, memory};
}

void* Memory::map(VkDeviceMemory memory) const
{
    void* address = nullptr;
    check(vkMapMemory(device_, memory, 0, VK_WHOLE_SIZE, 0, &address), "mapping device memory");
    return address;
}

namespace {

VkDeviceSize aligned(VkDeviceSize offset, VkDeviceSize alignment)
{
    return (offset + alignment - 1) / alignment * alignment;
}

} // namespace

// Buffers and images keep to blocks of their own, so bufferImageGranularity never matters.
Memory::Block* Memory::blockFor(const VkMemoryRequirements& needs, std::uint32_t type, bool images, bool mapped,
                                bool is_last)
{
    const auto block = std::find_if(blocks_.begin(), blocks_.end(), [&](const Block& b) {
        return b.type == type && b.images == images && (b.mapped != nullptr) == mapped &&
               aligned(b.used, needs.alignment) + needs.size <= kBlockBytes;
    });
    if (block != blocks_.end()) {
        return &*block;
    }
    Block fresh;
    fresh.memory = allocateBlock(kBlockBytes, type, is_last);
    if (!fresh.memory) {
        return nullptr;
    }
    fresh.type = type;
    fresh.images = images;
    fresh.mapped = mapped ? static_cast<char*>(map(fresh.memory.get())) : nullptr;
    return &blocks_.emplace_back(std::move(fresh));
}

Memory::Piece Memory::allocateFrom(const VkMemoryRequirements& needs, std::uint32_t type, bool images, bool mapped,
                                   bool is_last)
{
    Piece piece;
    piece.type = type;
    if (needs.size >= kOwnFromBytes) {
        piece.own = allocateBlock(needs.size, type, is_last);
        piece.memory = piece.own.get();
        piece.mapped = mapped && piece.own ? map(piece.memory) : nullptr;
    } else if (Block* const block = blockFor(needs, type, images, mapped, is_last)) {
        piece.memory = block->memory.get();
        piece.offset = aligned(block->used, needs.alignment);
        piece.mapped = mapped ? block->mapped + piece.offset : nullptr;
        block->used = piece.offset + needs.size;
    }
    return piece;
}

Memory::Piece Memory::allocate(const VkMemoryRequirements& needs, Place place, bool images)
{
    const std::vector<std::uint32_t> types = typesFor(needs.memoryTypeBits, place);
    Piece piece;
    for (std::size_t i = 0; piece.memory == VK_NULL_HANDLE; ++i) {
        piece = allocateFrom(needs, types[i], images, place != Place::device, i + 1 == types.size());
    }
    return piece;
}

vulkan::MemoryUse& Memory::useFor(const char* purpose)
{
    const auto same = [purpose](const vulkan::MemoryUse& use) {
        return std::string_view(use.purpose) == purpose;
    };
    const auto found = std::find_if(uses_.begin(), uses_.end(), same);
    return found != uses_.end() ? *found : uses_.emplace_back(vulkan::MemoryUse{purpose, 0});
}

namespace {

/// Room for one more, so that it can be put there without fail.
template <class Some>
void makeRoom(std::vector<Some>& all)
{
    if (all.size() == all.capacity()) {
        all.reserve(2 * all.size() + 8);
    }
}

} // namespace

Buffer Memory::buffer(const char* purpose, VkDeviceSize size, VkBufferUsageFlags usage, Place place)
{
    vulkan::MemoryUse& use = useFor(purpose);
    makeRoom(buffers_);
    makeRoom(own_);
    Buffer result;
    result.size = std::max<VkDeviceSize>(size, 16);
    result.purpose = purpose;
    VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
    info.size = result.size;
    info.usage = usage;
    check(vkCreateBuffer(device_, &info, nullptr, &result.handle), "making a buffer");
    OwnedBuffer owned(gpu_, result.handle);
    names_.name(VK_OBJECT_TYPE_BUFFER, result.handle, purpose);
    VkMemoryRequirements needs{};
    vkGetBufferMemoryRequirements(device_, result.handle, &needs);
    Piece piece = allocate(needs, place, false);
    check(vkBindBufferMemory(device_, result.handle, piece.memory, piece.offset), "binding a buffer's memory");
    result.mapped = piece.mapped;
    const bool coherent =
        (properties_.memoryTypes[piece.type].propertyFlags & VK_MEMORY_PROPERTY_HOST_COHERENT_BIT) != 0;
    result.unseen = place == Place::read_back && !coherent ? piece.memory : VK_NULL_HANDLE;
    result.own_memory = piece.own.get();
    buffers_.push_back(std::move(owned));
    if (piece.own) {
        own_.push_back(std::move(piece.own));
    }
    use.bytes += result.size;
    return result;
}

void Memory::release(Buffer& buffer) noexcept
{
    if (buffer.handle == VK_NULL_HANDLE) {
        return;
    }
    std::erase_if(buffers_, [&](const OwnedBuffer& one) { return one.get() == buffer.handle; });
    if (buffer.own_memory != VK_NULL_HANDLE) {
        std::erase_if(own_, [&](const OwnedMemory& one) { return one.get() == buffer.own_memory; });
    }
    for (vulkan::MemoryUse& use : uses_) {
        use.bytes -= std::string_view(use.purpose) == buffer.purpose ? buffer.size : 0;
    }
    buffer = {};
}

bool Memory::grow(Buffer& buffer, VkDeviceSize size, VkBufferUsageFlags usage, const char* purpose, Place place)
{
    if (buffer.handle != VK_NULL_HANDLE && buffer.size >= size) {
        return false;
    }
    release(buffer);
    buffer = this->buffer(purpose, std::bit_ceil(std::max<VkDeviceSize>(size, 4096)), usage, place);
    return true;
}

void Memory::makeVisible(const Buffer& buffer) const
{
    if (buffer.unseen != VK_NULL_HANDLE) {
        const VkMappedMemoryRange all{VK_STRUCTURE_TYPE_MAPPED_MEMORY_RANGE, nullptr, buffer.unseen, 0, VK_WHOLE_SIZE};
        check(vkInvalidateMappedMemoryRanges(device_, 1, &all), "reading what the GPU has written");
    }
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
    vulkan::MemoryUse& use = useFor(wish.purpose);
    makeRoom(images_);
    makeRoom(views_);
    makeRoom(own_);
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
    OwnedImage image(gpu_, result.handle);
    names_.name(VK_OBJECT_TYPE_IMAGE, result.handle, wish.name);
    VkMemoryRequirements needs{};
    vkGetImageMemoryRequirements(device_, result.handle, &needs);
    Piece piece = allocate(needs, Place::device, true);
    check(vkBindImageMemory(device_, result.handle, piece.memory, piece.offset), "binding an image's memory");
    OwnedImageView view = makeView(result, wish);
    result.view = view.get();
    if (piece.own) {
        own_.push_back(std::move(piece.own));
    }
    images_.push_back(std::move(image));
    views_.push_back(std::move(view));
    use.bytes += needs.size;
    return result;
}

OwnedImageView Memory::makeView(const Image& image, const ImageWish& wish) const
{
    VkImageViewCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
    info.image = image.handle;
    info.viewType = wish.array_view ? VK_IMAGE_VIEW_TYPE_2D_ARRAY : VK_IMAGE_VIEW_TYPE_2D;
    info.format = wish.format;
    const VkImageAspectFlags aspect = isDepth(wish.format) ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
    info.subresourceRange = {aspect, 0, wish.mips, 0, wish.layers};
    VkImageView view = VK_NULL_HANDLE;
    check(vkCreateImageView(device_, &info, nullptr, &view), "making an image view");
    names_.name(VK_OBJECT_TYPE_IMAGE_VIEW, view, wish.name);
    return {gpu_, view};
}

} // namespace gnomon::host
