// SPDX-License-Identifier: Apache-2.0
// Handles that are destroyed with their owner, whatever throws.
#pragma once

#include "host/gpu.h"

#include <vulkan/vulkan.h>

#include <utility>

namespace gnomon::host {

/// Owns one handle of a device. Destroys nothing of an abandoned device: the GPU may still use it.
template <class Handle, auto Destroy>
class Owned {
public:
    Owned() = default;
    Owned(const Gpu& gpu, Handle handle) : gpu_(&gpu), handle_(handle) {}
    Owned(Owned&& other) noexcept : gpu_(other.gpu_), handle_(std::exchange(other.handle_, Handle{VK_NULL_HANDLE})) {}
    Owned& operator=(Owned&& other) noexcept
    {
        std::swap(gpu_, other.gpu_);
        std::swap(handle_, other.handle_);
        return *this;
    }
    ~Owned()
    {
        if (handle_ != VK_NULL_HANDLE && !gpu_->abandoned()) {
            Destroy(gpu_->view().device, handle_, nullptr);
        }
    }
    [[nodiscard]] Handle get() const { return handle_; }
    explicit operator bool() const { return handle_ != VK_NULL_HANDLE; }

private:
    const Gpu* gpu_ = nullptr;
    Handle handle_ = VK_NULL_HANDLE;
};

using OwnedMemory = Owned<VkDeviceMemory, vkFreeMemory>;
using OwnedBuffer = Owned<VkBuffer, vkDestroyBuffer>;
using OwnedImage = Owned<VkImage, vkDestroyImage>;
using OwnedImageView = Owned<VkImageView, vkDestroyImageView>;
using OwnedSampler = Owned<VkSampler, vkDestroySampler>;
using OwnedShader = Owned<VkShaderModule, vkDestroyShaderModule>;
using OwnedPipeline = Owned<VkPipeline, vkDestroyPipeline>;
using OwnedPipelineLayout = Owned<VkPipelineLayout, vkDestroyPipelineLayout>;
using OwnedSetLayout = Owned<VkDescriptorSetLayout, vkDestroyDescriptorSetLayout>;
using OwnedDescriptorPool = Owned<VkDescriptorPool, vkDestroyDescriptorPool>;
using OwnedCommandPool = Owned<VkCommandPool, vkDestroyCommandPool>;
using OwnedFence = Owned<VkFence, vkDestroyFence>;

} // namespace gnomon::host
