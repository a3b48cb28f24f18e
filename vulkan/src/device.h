// SPDX-License-Identifier: Apache-2.0
// The caller's device with its functions, limits and memory policy; and the two kinds of resource that live in memory.
#pragma once

#include "functions.h"
#include "retirement.h"

#include <gnomon/vulkan/shadow_renderer.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace gnomon::vulkan {

/// Throws Error("tried", name of the result, advice) unless the result is VK_SUCCESS.
void check(VkResult result, const char* tried);

/// Which purposes hold how many bytes. The device hands its owner's account to every resource.
class MemoryAccount {
public:
    /// Before the first add() of a purpose, which then cannot fail.
    void open(const char* purpose);
    void add(const char* purpose, VkDeviceSize bytes);
    void remove(const char* purpose, VkDeviceSize bytes);
    [[nodiscard]] std::span<const MemoryUse> uses() const { return uses_; }

private:
    std::vector<MemoryUse> uses_;
};

/// Shader modules that a library embeds (gnomon_shaders() in cmake/shaders.cmake), and what each is called.
struct ShaderList {
    std::span<const std::span<const std::uint32_t>* const> modules;
    std::span<const char* const> names; // of the same length
};

class Device {
public:
    /// `further`: modules beside the library's own.
    explicit Device(const DeviceView& view, const ShaderList& further = {});
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    [[nodiscard]] VkDevice handle() const { return view_.device; }
    [[nodiscard]] const VkPhysicalDeviceLimits& limits() const { return limits_; }
    [[nodiscard]] const FeatureUses& uses() const { return view_.features; }
    /// By which it places vertices within a pixel: pack::DrawPrecision::sub_pixel_bits.
    [[nodiscard]] std::uint32_t subPixelBits() const { return std::clamp(limits_.subPixelPrecisionBits, 4U, 24U); }
    [[nodiscard]] const DeviceView& view() const { return view_; }
    [[nodiscard]] bool software() const { return software_; } // a CPU draws
    [[nodiscard]] VkFormatFeatureFlags features(VkFormat format) const;
    /// The module to make of this one: itself, or the host's in its place.
    [[nodiscard]] std::span<const std::uint32_t> hooked(std::span<const std::uint32_t> spirv) const;
    /// The module of this name (shaders/CMakeLists.txt); empty: there is none.
    [[nodiscard]] std::span<const std::uint32_t> shaderCalled(std::string_view name) const;
    [[nodiscard]] const MemoryAccount& account() const { return account_; }

    /// Throws Error when there is none.
    [[nodiscard]] MemoryBlock allocate(const MemoryRequest& request);
    void release(const MemoryBlock& block, const char* purpose, VkDeviceSize bytes);

    void name(VkObjectType type, std::uint64_t handle, const char* text) const;
    void beginLabel(VkCommandBuffer commands, const char* text) const;
    void endLabel(VkCommandBuffer commands) const;

    /// See Retirement.
    void enter(std::uint32_t slot, Retirement::Work work) { retirement_.enter(slot, work); }
    /// To be freed when no frame in flight can use it any more; empty afterwards.
    template <class Resource>
    void retire(Resource&& resource)
    {
        static_assert(!std::is_lvalue_reference_v<Resource>);
        if (resource) {
            retirement_.keep(std::forward<Resource>(resource));
        }
        resource = std::decay_t<Resource>{};
    }

    Functions vk;

private:
    [[nodiscard]] std::vector<std::uint32_t> memoryTypesFor(const MemoryRequest& request) const;
    [[nodiscard]] VkDeviceMemory allocateOwn(const MemoryRequest& request, const char* tried);

    DeviceView view_;
    std::array<ShaderList, 2> shaders_; // the library's own, and further ones
    VkPhysicalDeviceLimits limits_{};
    bool software_ = false;
    VkPhysicalDeviceMemoryProperties memory_{};
    MemoryAccount account_;
    Retirement retirement_; // the last: what it frees goes back to the others
};

template <class Handle>
std::uint64_t handleBits(Handle handle)
{
    return reinterpret_cast<std::uint64_t>(handle);
}

/// Owns one handle; `Destroy` is a member of Functions.
template <class Handle, auto Destroy>
class Owned {
public:
    Owned() = default;
    Owned(Device& device, Handle handle) : device_(&device), handle_(handle) {}
    Owned(Owned&& other) noexcept
        : device_(other.device_), handle_(std::exchange(other.handle_, Handle{VK_NULL_HANDLE}))
    {
    }
    Owned& operator=(Owned&& other) noexcept
    {
        std::swap(device_, other.device_);
        std::swap(handle_, other.handle_);
        return *this;
    }
    ~Owned()
    {
        if (handle_ != VK_NULL_HANDLE) {
            (device_->vk.*Destroy)(device_->handle(), handle_, nullptr);
        }
    }
    [[nodiscard]] Handle get() const { return handle_; }
    explicit operator bool() const { return handle_ != VK_NULL_HANDLE; }

private:
    Device* device_ = nullptr;
    Handle handle_ = VK_NULL_HANDLE;
};

using ShaderModule = Owned<VkShaderModule, &Functions::DestroyShaderModule>;
using PipelineLayout = Owned<VkPipelineLayout, &Functions::DestroyPipelineLayout>;
using Pipeline = Owned<VkPipeline, &Functions::DestroyPipeline>;
using SetLayout = Owned<VkDescriptorSetLayout, &Functions::DestroyDescriptorSetLayout>;
using DescriptorPool = Owned<VkDescriptorPool, &Functions::DestroyDescriptorPool>;
using Sampler = Owned<VkSampler, &Functions::DestroySampler>;
using QueryPool = Owned<VkQueryPool, &Functions::DestroyQueryPool>;
using ImageView = Owned<VkImageView, &Functions::DestroyImageView>;

/// A block of memory that goes back to where it came from.
class Memory {
public:
    Memory() = default;
    Memory(Device& device, const MemoryRequest& request);
    Memory(Memory&& other) noexcept;
    Memory& operator=(Memory&& other) noexcept;
    ~Memory();
    [[nodiscard]] const MemoryBlock& block() const { return block_; }

private:
    Device* device_ = nullptr;
    MemoryBlock block_;
    const char* purpose_ = "";
    VkDeviceSize bytes_ = 0;
};

struct ImageInfo {
    VkFormat format = VK_FORMAT_UNDEFINED;
    VkExtent2D extent{};
    std::uint32_t layers = 1;
    VkImageUsageFlags usage = 0;
    VkImageAspectFlags aspect = VK_IMAGE_ASPECT_COLOR_BIT;
    const char* purpose = "";
    std::uint32_t levels = 1;
    VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
};

/// A 2D array image with a view of all of it, one of each layer's finest level and, if shaders write to
/// it, one of all layers at each level.
class Image {
public:
    Image() = default;
    /// Throws Error beyond the device's limits or memory.
    Image(Device& device, const ImageInfo& info);
    [[nodiscard]] VkImage image() const { return image_.get(); }
    [[nodiscard]] VkImageView view() const { return all_.get(); }
    [[nodiscard]] VkImageView layer(std::uint32_t index) const { return layers_[index].get(); } // 2D
    [[nodiscard]] VkImageView level(std::uint32_t index) const
    {
        return levels_[index].get();
    } // 2D array; of storage images
    /// A further view, of the finest level of some layers: 2D array. To be gone before the image.
    [[nodiscard]] ImageView range(Device& device, std::uint32_t first, std::uint32_t count) const;
    [[nodiscard]] const ImageInfo& info() const { return info_; }
    explicit operator bool() const { return static_cast<bool>(image_); }

private:
    ImageInfo info_;
    Memory memory_; // declared first: freed after the image that is bound to it
    Owned<VkImage, &Functions::DestroyImage> image_;
    ImageView all_;
    std::vector<ImageView> layers_;
    std::vector<ImageView> levels_;
};

class Buffer {
public:
    [[nodiscard]] VkBuffer buffer() const { return buffer_.get(); }
    [[nodiscard]] VkDeviceSize size() const { return size_; }
    explicit operator bool() const { return static_cast<bool>(buffer_); }

protected:
    Buffer() = default;
    Buffer(Device& device, VkDeviceSize bytes, VkBufferUsageFlags usage, VkMemoryPropertyFlags properties,
           const char* purpose);
    Memory memory_;

private:
    Owned<VkBuffer, &Functions::DestroyBuffer> buffer_;
    VkDeviceSize size_ = 0;
};

/// Mapped for as long as it lives; coherent.
class HostBuffer : public Buffer {
public:
    HostBuffer() = default;
    HostBuffer(Device& device, VkDeviceSize bytes, VkBufferUsageFlags usage, const char* purpose);
    [[nodiscard]] void* data() const { return memory_.block().mapped; }
};

/// For the GPU alone.
class DeviceBuffer : public Buffer {
public:
    DeviceBuffer() = default;
    DeviceBuffer(Device& device, VkDeviceSize bytes, VkBufferUsageFlags usage, const char* purpose);
};

/// For one of the device's modules.
[[nodiscard]] ShaderModule makeShader(Device& device, std::span<const std::uint32_t> spirv);

} // namespace gnomon::vulkan
