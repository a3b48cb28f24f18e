// SPDX-License-Identifier: Apache-2.0
#include "harness.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <iterator>
#include <stdexcept>
#include <utility>

namespace gnomon::test {
namespace {

void require(VkResult result, const char* what)
{
    if (result != VK_SUCCESS) {
        throw std::runtime_error(std::string(what) + ": VkResult " + std::to_string(result));
    }
}

VKAPI_ATTR VkBool32 VKAPI_CALL onMessage(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                         const VkDebugUtilsMessengerCallbackDataEXT* data, void* user)
{
    // Layers that look within shaders turn on what they need, and say so.
    if (std::strstr(data->pMessage, "validation is adjusting settings") == nullptr) {
        static_cast<std::vector<std::string>*>(user)->emplace_back(data->pMessage);
    }
    return VK_FALSE;
}

void recordTransition(VkCommandBuffer commands, VkImage image, VkImageAspectFlags aspect, std::uint32_t layer,
                      VkImageLayout from, VkImageLayout to, std::uint32_t level = 0)
{
    VkImageMemoryBarrier2 barrier{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2};
    barrier.srcStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    barrier.srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT;
    barrier.dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    barrier.dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT;
    barrier.oldLayout = from;
    barrier.newLayout = to;
    barrier.image = image;
    barrier.subresourceRange = {aspect, level, 1, layer, 1};
    VkDependencyInfo info{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
    info.imageMemoryBarrierCount = 1;
    info.pImageMemoryBarriers = &barrier;
    vkCmdPipelineBarrier2(commands, &info);
}

VkExtent3D extentOf(const vulkan::ImageRef& ref, std::uint32_t level)
{
    return {std::max(ref.extent.width >> level, 1U), std::max(ref.extent.height >> level, 1U), 1};
}

} // namespace

namespace {

constexpr std::size_t kHead = 64; // bytes before a block, which begin with its size; any object is aligned to less

std::size_t& sizeOf(void* block)
{
    return *reinterpret_cast<std::size_t*>(static_cast<std::byte*>(block) - kHead);
}

} // namespace

ReusedMemory::ReusedMemory()
{
    callbacks_.pUserData = this;
    callbacks_.pfnAllocation = [](void* user, std::size_t bytes, std::size_t, VkSystemAllocationScope) {
        return static_cast<ReusedMemory*>(user)->take(bytes);
    };
    callbacks_.pfnReallocation = [](void*, void*, std::size_t, std::size_t, VkSystemAllocationScope) -> void* {
        return nullptr; // no object of one piece asks for it
    };
    callbacks_.pfnFree = [](void* user, void* block) {
        if (block != nullptr) {
            static_cast<ReusedMemory*>(user)->free_.push_back(block);
        }
    };
}

ReusedMemory::~ReusedMemory()
{
    for (void* const block : free_) {
        std::free(static_cast<std::byte*>(block) - kHead);
    }
}

void* ReusedMemory::take(std::size_t bytes)
{
    const auto found = std::find_if(free_.rbegin(), free_.rend(), [&](void* block) { return sizeOf(block) == bytes; });
    if (found != free_.rend()) {
        void* const block = *found;
        free_.erase(std::next(found).base());
        return block;
    }
    void* const whole = std::aligned_alloc(kHead, kHead + (bytes + kHead - 1) / kHead * kHead);
    if (whole == nullptr) {
        return nullptr;
    }
    void* const block = static_cast<std::byte*>(whole) + kHead;
    sizeOf(block) = bytes;
    return block;
}

Gpu& gpu()
{
    static Gpu the;
    return the;
}

Gpu::Gpu(bool validated) : validated_(validated)
{
    makeInstance();
    makeDevice();
}

void Gpu::makeInstance()
{
    VkApplicationInfo app{VK_STRUCTURE_TYPE_APPLICATION_INFO};
    app.apiVersion = VK_API_VERSION_1_3;
    VkInstanceCreateInfo create{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
    create.pApplicationInfo = &app;
    if (!validated_) {
        require(vkCreateInstance(&create, nullptr, &instance_), "vkCreateInstance");
        return;
    }
    std::uint32_t count = 0;
    vkEnumerateInstanceLayerProperties(&count, nullptr);
    std::vector<VkLayerProperties> layers(count);
    vkEnumerateInstanceLayerProperties(&count, layers.data());
    const char* const layer = "VK_LAYER_KHRONOS_validation";
    if (std::none_of(layers.begin(), layers.end(), [&](auto& l) { return std::strcmp(l.layerName, layer) == 0; })) {
        throw std::runtime_error("no VK_LAYER_KHRONOS_validation: install vulkan-validationlayers");
    }
    const std::array<const char*, 2> extensions{VK_EXT_DEBUG_UTILS_EXTENSION_NAME,
                                                VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME};
    const VkValidationFeatureEnableEXT enable = VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
    VkValidationFeaturesEXT features{VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT};
    features.enabledValidationFeatureCount = 1;
    features.pEnabledValidationFeatures = &enable;
    create.pNext = &features;
    create.enabledLayerCount = 1;
    create.ppEnabledLayerNames = &layer;
    create.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
    create.ppEnabledExtensionNames = extensions.data();
    require(vkCreateInstance(&create, nullptr, &instance_), "vkCreateInstance");

    VkDebugUtilsMessengerCreateInfoEXT messenger{VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT};
    messenger.messageSeverity =
        VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    messenger.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_GENERAL_BIT_EXT |
                            VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT |
                            VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
    messenger.pfnUserCallback = onMessage;
    messenger.pUserData = &messages_;
    const auto make = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
        vkGetInstanceProcAddr(instance_, "vkCreateDebugUtilsMessengerEXT"));
    require(make(instance_, &messenger, nullptr, &messenger_), "vkCreateDebugUtilsMessengerEXT");
}

void Gpu::makeDevice()
{
    std::uint32_t count = 0;
    vkEnumeratePhysicalDevices(instance_, &count, nullptr);
    if (count == 0) {
        throw std::runtime_error("no Vulkan device: install mesa-vulkan-drivers");
    }
    std::vector<VkPhysicalDevice> devices(count);
    vkEnumeratePhysicalDevices(instance_, &count, devices.data());
    // As `--gpu` does: part of its name. Unless GNOMON_GPU says one, the first.
    const char* const wanted = std::getenv("GNOMON_GPU");
    const auto named = std::find_if(devices.begin(), devices.end(), [&](VkPhysicalDevice device) {
        VkPhysicalDeviceProperties properties{};
        vkGetPhysicalDeviceProperties(device, &properties);
        return wanted != nullptr && std::strstr(properties.deviceName, wanted) != nullptr;
    });
    physical_device_ = named != devices.end() ? *named : devices[0];
    char missing[256];
    vulkan::missingFeatures(view(), missing, sizeof missing);
    if (missing[0] != '\0') {
        throw std::runtime_error(std::string("the device lacks ") + missing);
    }
    features_ = vulkan::supportedFeatures(view());
    const float priority = 1.0F;
    VkDeviceQueueCreateInfo queue{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    VkDeviceCreateInfo create{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO, &vulkan::requiredFeatures(features_)};
    create.queueCreateInfoCount = 1;
    create.pQueueCreateInfos = &queue;
    require(vkCreateDevice(physical_device_, &create, nullptr, &device_), "vkCreateDevice");
    vkGetDeviceQueue(device_, 0, 0, &queue_);
    const VkCommandPoolCreateInfo pool{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
    require(vkCreateCommandPool(device_, &pool, nullptr, &pool_), "vkCreateCommandPool");
    const VkCommandBufferAllocateInfo info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO, nullptr, pool_,
                                           VK_COMMAND_BUFFER_LEVEL_PRIMARY, 1};
    require(vkAllocateCommandBuffers(device_, &info, &commands_), "vkAllocateCommandBuffers");
}

Gpu::~Gpu()
{
    vkDestroyCommandPool(device_, pool_, nullptr);
    vkDestroyDescriptorPool(device_, texture_pool_, nullptr);
    vkDestroySampler(device_, sampler_, nullptr);
    for (const TestImage& image : images_) {
        vkDestroyImageView(device_, image.view, view_memory_.callbacks());
        vkDestroyImage(device_, image.image, nullptr);
        vkFreeMemory(device_, image.memory, nullptr);
    }
    for (const TestBuffer& buffer : buffers_) {
        vkDestroyBuffer(device_, buffer.buffer, nullptr);
        vkFreeMemory(device_, buffer.memory, nullptr);
    }
    vkDestroyDevice(device_, nullptr);
    const auto destroy = reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
        vkGetInstanceProcAddr(instance_, "vkDestroyDebugUtilsMessengerEXT"));
    if (validated_) {
        destroy(instance_, messenger_, nullptr);
    }
    vkDestroyInstance(instance_, nullptr);
}

VkPhysicalDeviceLimits Gpu::limits() const
{
    VkPhysicalDeviceProperties properties{};
    vkGetPhysicalDeviceProperties(physical_device_, &properties);
    return properties.limits;
}

vulkan::DeviceView Gpu::view() const
{
    vulkan::DeviceView view;
    view.instance = instance_;
    view.physical_device = physical_device_;
    view.device = device_;
    view.get_instance_proc_addr = vkGetInstanceProcAddr;
    view.debug_labels = validated_;
    view.features = features_;
    return view;
}

std::vector<std::string> Gpu::takeMessages()
{
    return std::exchange(messages_, {});
}

void Gpu::run(const std::function<void(VkCommandBuffer)>& record)
{
    require(vkResetCommandPool(device_, pool_, 0), "vkResetCommandPool");
    const VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    require(vkBeginCommandBuffer(commands_, &begin), "vkBeginCommandBuffer");
    record(commands_);
    require(vkEndCommandBuffer(commands_), "vkEndCommandBuffer");
    VkSubmitInfo submit{VK_STRUCTURE_TYPE_SUBMIT_INFO};
    submit.commandBufferCount = 1;
    submit.pCommandBuffers = &commands_;
    require(vkQueueSubmit(queue_, 1, &submit, VK_NULL_HANDLE), "vkQueueSubmit");
    require(vkQueueWaitIdle(queue_), "vkQueueWaitIdle");
}

VkDeviceMemory Gpu::allocate(const VkMemoryRequirements& needs, VkMemoryPropertyFlags properties)
{
    VkPhysicalDeviceMemoryProperties memory{};
    vkGetPhysicalDeviceMemoryProperties(physical_device_, &memory);
    for (std::uint32_t i = 0; i < memory.memoryTypeCount; ++i) {
        if ((needs.memoryTypeBits & (1U << i)) != 0 &&
            (memory.memoryTypes[i].propertyFlags & properties) == properties) {
            const VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, nullptr, needs.size, i};
            VkDeviceMemory result = VK_NULL_HANDLE;
            require(vkAllocateMemory(device_, &info, nullptr, &result), "vkAllocateMemory");
            return result;
        }
    }
    throw std::runtime_error("no memory type");
}

TestBuffer Gpu::makeBuffer(VkDeviceSize bytes, VkBufferUsageFlags usage)
{
    TestBuffer result;
    VkBufferCreateInfo create{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
    create.size = bytes;
    create.usage = usage;
    require(vkCreateBuffer(device_, &create, nullptr, &result.buffer), "vkCreateBuffer");
    VkMemoryRequirements needs{};
    vkGetBufferMemoryRequirements(device_, result.buffer, &needs);
    result.memory = allocate(needs, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
    require(vkBindBufferMemory(device_, result.buffer, result.memory, 0), "vkBindBufferMemory");
    require(vkMapMemory(device_, result.memory, 0, VK_WHOLE_SIZE, 0, &result.mapped), "vkMapMemory");
    buffers_.push_back(result);
    return result;
}

TestImage Gpu::makeImage(VkFormat format, VkExtent2D extent, std::span<const std::byte> texels)
{
    TestImage result;
    VkImageCreateInfo create{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
    create.imageType = VK_IMAGE_TYPE_2D;
    create.format = format;
    create.extent = {extent.width, extent.height, 1};
    create.mipLevels = 1;
    create.arrayLayers = 1;
    create.samples = VK_SAMPLE_COUNT_1_BIT;
    create.usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
    require(vkCreateImage(device_, &create, nullptr, &result.image), "vkCreateImage");
    VkMemoryRequirements needs{};
    vkGetImageMemoryRequirements(device_, result.image, &needs);
    result.memory = allocate(needs, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
    require(vkBindImageMemory(device_, result.image, result.memory, 0), "vkBindImageMemory");
    result.format = format;
    result.view = makeView(result);
    images_.push_back(result);

    const TestBuffer staging = makeBuffer(texels.size(), VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
    std::memcpy(staging.mapped, texels.data(), texels.size());
    run([&](VkCommandBuffer commands) {
        recordTransition(commands, result.image, VK_IMAGE_ASPECT_COLOR_BIT, 0, VK_IMAGE_LAYOUT_UNDEFINED,
                         VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
        VkBufferImageCopy copy{};
        copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
        copy.imageExtent = {extent.width, extent.height, 1};
        vkCmdCopyBufferToImage(commands, staging.buffer, result.image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &copy);
        recordTransition(commands, result.image, VK_IMAGE_ASPECT_COLOR_BIT, 0, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                         VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    });
    dropLastBuffer();
    return result;
}

VkImageView Gpu::makeView(const TestImage& image) const
{
    VkImageViewCreateInfo create{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
    create.image = image.image;
    create.viewType = VK_IMAGE_VIEW_TYPE_2D;
    create.format = image.format;
    create.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    VkImageView view = VK_NULL_HANDLE;
    require(vkCreateImageView(device_, &create, view_memory_.callbacks(), &view), "vkCreateImageView");
    return view;
}

void Gpu::replaceImage(const TestImage& old, TestImage& image)
{
    const auto listed =
        std::find_if(images_.begin(), images_.end(), [&](const TestImage& one) { return one.image == image.image; });
    vkDestroyImageView(device_, image.view, view_memory_.callbacks());
    vkDestroyImageView(device_, old.view, view_memory_.callbacks()); // the last that goes is the first that comes
    image.view = makeView(image);
    *listed = image;
    vkDestroyImage(device_, old.image, nullptr);
    vkFreeMemory(device_, old.memory, nullptr);
    std::erase_if(images_, [&](const TestImage& one) { return one.image == old.image; });
}

VkDescriptorSet Gpu::makeTextureSet(VkDescriptorSetLayout layout, VkImageView view)
{
    if (texture_pool_ == VK_NULL_HANDLE) {
        constexpr std::uint32_t kSets = 256; // for all tests of a process
        const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, kSets};
        const VkDescriptorPoolCreateInfo pool{
            VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO, nullptr, 0, kSets, 1, &size};
        require(vkCreateDescriptorPool(device_, &pool, nullptr, &texture_pool_), "vkCreateDescriptorPool");
        const VkSamplerCreateInfo sampler{VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO};
        require(vkCreateSampler(device_, &sampler, nullptr, &sampler_), "vkCreateSampler");
    }
    const VkDescriptorSetAllocateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO, nullptr, texture_pool_, 1,
                                           &layout};
    VkDescriptorSet set = VK_NULL_HANDLE;
    require(vkAllocateDescriptorSets(device_, &info, &set), "vkAllocateDescriptorSets");
    const VkDescriptorImageInfo image{sampler_, view, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
    VkWriteDescriptorSet write{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
    write.dstSet = set;
    write.descriptorCount = 1;
    write.descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    write.pImageInfo = &image;
    vkUpdateDescriptorSets(device_, 1, &write, 0, nullptr);
    return set;
}

std::vector<std::byte> Gpu::read(const vulkan::ImageRef& ref, std::uint32_t layer, std::uint32_t texel_bytes,
                                 VkImageAspectFlags aspect, std::uint32_t level)
{
    VkBufferImageCopy copy{};
    copy.imageSubresource = {aspect, level, layer, 1};
    copy.imageExtent = extentOf(ref, level);
    const std::size_t bytes = std::size_t{copy.imageExtent.width} * copy.imageExtent.height * texel_bytes;
    const TestBuffer buffer = makeBuffer(bytes, VK_BUFFER_USAGE_TRANSFER_DST_BIT);
    run([&](VkCommandBuffer commands) {
        recordTransition(commands, ref.image, aspect, layer, ref.layout, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, level);
        vkCmdCopyImageToBuffer(commands, ref.image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, buffer.buffer, 1, &copy);
        recordTransition(commands, ref.image, aspect, layer, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, ref.layout, level);
    });
    const auto* first = static_cast<const std::byte*>(buffer.mapped);
    std::vector<std::byte> result(first, first + bytes);
    dropLastBuffer();
    return result;
}

void Gpu::write(const vulkan::ImageRef& ref, std::uint32_t layer, std::uint32_t level,
                std::span<const std::byte> texels)
{
    const TestBuffer buffer = makeBuffer(texels.size(), VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
    std::memcpy(buffer.mapped, texels.data(), texels.size());
    constexpr VkImageAspectFlags kColour = VK_IMAGE_ASPECT_COLOR_BIT;
    VkBufferImageCopy copy{};
    copy.imageSubresource = {kColour, level, layer, 1};
    copy.imageExtent = extentOf(ref, level);
    run([&](VkCommandBuffer commands) {
        recordTransition(commands, ref.image, kColour, layer, ref.layout, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, level);
        vkCmdCopyBufferToImage(commands, buffer.buffer, ref.image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &copy);
        recordTransition(commands, ref.image, kColour, layer, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, ref.layout, level);
    });
    dropLastBuffer();
}

void Gpu::blit(const TestImage& from, VkExtent2D of, const TestImage& to, VkExtent2D size)
{
    VkImageBlit blit{};
    blit.srcSubresource = blit.dstSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    blit.srcOffsets[1] = {static_cast<std::int32_t>(of.width), static_cast<std::int32_t>(of.height), 1};
    blit.dstOffsets[1] = {static_cast<std::int32_t>(size.width), static_cast<std::int32_t>(size.height), 1};
    run([&](VkCommandBuffer commands) {
        constexpr VkImageLayout kRead = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
        constexpr VkImageLayout kFrom = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
        constexpr VkImageLayout kTo = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
        recordTransition(commands, from.image, VK_IMAGE_ASPECT_COLOR_BIT, 0, kRead, kFrom);
        recordTransition(commands, to.image, VK_IMAGE_ASPECT_COLOR_BIT, 0, kRead, kTo);
        vkCmdBlitImage(commands, from.image, kFrom, to.image, kTo, 1, &blit, VK_FILTER_LINEAR);
        recordTransition(commands, from.image, VK_IMAGE_ASPECT_COLOR_BIT, 0, kFrom, kRead);
        recordTransition(commands, to.image, VK_IMAGE_ASPECT_COLOR_BIT, 0, kTo, kRead);
    });
}

void Gpu::dropLastBuffer()
{
    vkDestroyBuffer(device_, buffers_.back().buffer, nullptr);
    vkFreeMemory(device_, buffers_.back().memory, nullptr);
    buffers_.pop_back();
}

} // namespace gnomon::test
