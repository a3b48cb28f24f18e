// SPDX-License-Identifier: Apache-2.0
// Buffers and images with their memory, accounted for by purpose. Everything is freed with the Memory object.
#pragma once

#include "check.h"
#include "host/gpu.h"
#include "owned.h"

#include <gnomon/vulkan/shadow_renderer.h>

#include <array>
#include <vector>

namespace gnomon::host {

struct Buffer {
    VkBuffer handle = VK_NULL_HANDLE;
    VkDeviceSize size = 0;
    void* mapped = nullptr; // host-visible buffers: for good
    VkDeviceMemory own_memory = VK_NULL_HANDLE;
    VkDeviceMemory unseen = VK_NULL_HANDLE; // set where the host does not see the GPU's writes by itself
    const char* purpose = "";
};

struct Image {
    VkImage handle = VK_NULL_HANDLE;
    VkImageView view = VK_NULL_HANDLE;
    VkFormat format = VK_FORMAT_UNDEFINED;
    VkExtent2D extent{};
    std::uint32_t mips = 1;
    std::uint32_t layers = 1;
};

struct ImageWish {
    const char* name = ""; // for debuggers
    const char* purpose = "";
    VkFormat format = VK_FORMAT_UNDEFINED;
    VkExtent2D extent{};
    VkImageUsageFlags usage = 0;
    std::uint32_t mips = 1;
    std::uint32_t layers = 1;
    bool array_view = false;
};

/// `read_back`: the host reads what the GPU has written, after makeVisible().
enum class Place : std::uint8_t { device, host, read_back };

class Memory {
public:
    explicit Memory(const Gpu& gpu);
    ~Memory() = default;
    Memory(const Memory&) = delete;
    Memory& operator=(const Memory&) = delete;

    /// `size` of 0 is taken as 16 bytes, so that an empty scene needs no special case. Throws Error.
    [[nodiscard]] Buffer buffer(const char* purpose, VkDeviceSize size, VkBufferUsageFlags usage, Place place);
    [[nodiscard]] Image image(const ImageWish& wish);
    void release(Buffer& buffer) noexcept;
    /// Grows a host-visible buffer to at least `size` (in powers of two); its content is lost. True when it did.
    bool grow(Buffer& buffer, VkDeviceSize size, VkBufferUsageFlags usage, const char* purpose,
              Place place = Place::host);
    /// Lets the host see what the GPU has written and finished. Throws Error.
    void makeVisible(const Buffer& buffer) const;
    [[nodiscard]] const Gpu& gpu() const { return gpu_; }
    [[nodiscard]] const std::vector<vulkan::MemoryUse>& uses() const { return uses_; }
    [[nodiscard]] const DebugNames& names() const { return names_; }
    [[nodiscard]] const VkPhysicalDeviceLimits& limits() const { return limits_; }

private:
    struct Block {
        OwnedMemory memory;
        std::uint32_t type = 0;
        bool images = false;
        VkDeviceSize used = 0;
        char* mapped = nullptr;
    };
    struct Piece {
        VkDeviceMemory memory = VK_NULL_HANDLE;
        VkDeviceSize offset = 0;
        void* mapped = nullptr;
        OwnedMemory own; // where it is no part of a block
        std::uint32_t type = 0;
    };
    Piece allocate(const VkMemoryRequirements& needs, Place place, bool images);
    /// Nothing where the type has no more room and is not the last that fits.
    [[nodiscard]] Piece allocateFrom(const VkMemoryRequirements& needs, std::uint32_t type, bool images, bool mapped,
                                     bool is_last);
    [[nodiscard]] Block* blockFor(const VkMemoryRequirements& needs, std::uint32_t type, bool images, bool mapped,
                                  bool is_last);
    [[nodiscard]] OwnedMemory allocateBlock(VkDeviceSize size, std::uint32_t type, bool is_last) const;
    [[nodiscard]] void* map(VkDeviceMemory memory) const;
    [[nodiscard]] OwnedImageView makeView(const Image& image, const ImageWish& wish) const;
    /// The memory types that fit, the best ones first. Throws Error when none does.
    [[nodiscard]] std::vector<std::uint32_t> typesFor(std::uint32_t bits, Place place) const;
    /// Finds or makes a purpose's entry. Call it before an allocation that would have to be released if this threw.
    [[nodiscard]] vulkan::MemoryUse& useFor(const char* purpose);

    const Gpu& gpu_;
    VkDevice device_;
    VkPhysicalDeviceMemoryProperties properties_{};
    VkPhysicalDeviceLimits limits_;
    DebugNames names_;
    std::vector<vulkan::MemoryUse> uses_;
    // Memory first: it goes after what is bound to it.
    std::vector<Block> blocks_;
    std::vector<OwnedMemory> own_;
    std::vector<OwnedBuffer> buffers_;
    std::vector<OwnedImage> images_;
    std::vector<OwnedImageView> views_;
};

} // namespace gnomon::host
