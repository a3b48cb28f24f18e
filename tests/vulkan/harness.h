// SPDX-License-Identifier: Apache-2.0
// A real device with the validation layer, synchronization validation included, or without. Any message fails the test
// that is running.
#pragma once

#include <gnomon/vulkan/shadow_renderer.h>

#include <vulkan/vulkan.h>

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace gnomon::test {

struct TestImage {
    VkImage image = VK_NULL_HANDLE;
    VkImageView view = VK_NULL_HANDLE;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    VkFormat format = VK_FORMAT_UNDEFINED;
};

struct TestBuffer {
    VkBuffer buffer = VK_NULL_HANDLE;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    void* mapped = nullptr;
};

/// Memory of objects that reuses the block freed last, so that a new object gets the handle of a destroyed one where
/// handles are addresses.
class ReusedMemory {
public:
    ReusedMemory();
    ~ReusedMemory();
    ReusedMemory(const ReusedMemory&) = delete;
    ReusedMemory& operator=(const ReusedMemory&) = delete;

    [[nodiscard]] const VkAllocationCallbacks* callbacks() const { return &callbacks_; }

private:
    [[nodiscard]] void* take(std::size_t bytes);

    VkAllocationCallbacks callbacks_{};
    std::vector<void*> free_;
};

class Gpu {
public:
    /// Throws std::runtime_error where there is no device or no validation layer: these tests fail then, they do not
    /// skip. Layers give every object a handle of its own; without them, as hosts run, a driver may give out one again.
    explicit Gpu(bool validated = true);
    ~Gpu();
    Gpu(const Gpu&) = delete;
    Gpu& operator=(const Gpu&) = delete;

    [[nodiscard]] vulkan::DeviceView view() const;
    [[nodiscard]] VkPhysicalDeviceLimits limits() const;
    /// Records, submits and waits.
    void run(const std::function<void(VkCommandBuffer)>& record);
    [[nodiscard]] TestBuffer makeBuffer(VkDeviceSize bytes, VkBufferUsageFlags usage);
    /// A sampled 2D image with these texels, in SHADER_READ_ONLY_OPTIMAL. Lives as long as the Gpu.
    [[nodiscard]] TestImage makeImage(VkFormat format, VkExtent2D extent, std::span<const std::byte> texels);
    /// Destroys `old`, which no run() uses any more, and makes the view of `image` anew: it has the handle of the old
    /// view, unless layers are in between. Both are of makeImage().
    void replaceImage(const TestImage& old, TestImage& image);
    /// A set with this texture, nearest and repeated, for CasterBatch::texture.
    [[nodiscard]] VkDescriptorSet makeTextureSet(VkDescriptorSetLayout layout, VkImageView view);
    /// Texels of one layer and mip level, tightly packed. The image is in ref.layout before and after.
    [[nodiscard]] std::vector<std::byte> read(const vulkan::ImageRef& ref, std::uint32_t layer,
                                              std::uint32_t texel_bytes, VkImageAspectFlags aspect,
                                              std::uint32_t level = 0);
    /// The reverse: colour texels of one layer and mip level, which must be as many as it has.
    void write(const vulkan::ImageRef& ref, std::uint32_t layer, std::uint32_t level,
               std::span<const std::byte> texels);
    /// All of an image over all of another, through a linear filter; both are of makeImage().
    void blit(const TestImage& from, VkExtent2D of, const TestImage& to, VkExtent2D size);
    /// Validation messages since the last call.
    [[nodiscard]] std::vector<std::string> takeMessages();

private:
    void makeInstance();
    void makeDevice();
    void dropLastBuffer();
    [[nodiscard]] VkImageView makeView(const TestImage& image) const;
    [[nodiscard]] VkDeviceMemory allocate(const VkMemoryRequirements& needs, VkMemoryPropertyFlags properties);

    ReusedMemory view_memory_;
    VkInstance instance_ = VK_NULL_HANDLE;
    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
    VkPhysicalDevice physical_device_ = VK_NULL_HANDLE;
    VkDevice device_ = VK_NULL_HANDLE;
    bool validated_ = true;
    vulkan::FeatureUses features_;
    VkQueue queue_ = VK_NULL_HANDLE;
    VkCommandPool pool_ = VK_NULL_HANDLE;
    VkCommandBuffer commands_ = VK_NULL_HANDLE; // one for all: the layers keep data of each one ever made
    VkDescriptorPool texture_pool_ = VK_NULL_HANDLE;
    VkSampler sampler_ = VK_NULL_HANDLE;
    std::vector<TestImage> images_;
    std::vector<TestBuffer> buffers_;
    std::vector<std::string> messages_;
};

/// The one device of the test program.
[[nodiscard]] Gpu& gpu();

} // namespace gnomon::test
