// SPDX-License-Identifier: Apache-2.0
#include "host/gpu.h"

#include "abandoned.h"
#include "cache_file.h"
#include "check.h"
#include "devices.h"
#include "instance.h"
#include "pipeline_cache.h"
#include "portability.h"
#include "stored_rates.h"
#include "threads.h"

#include <gnomon/error.h>

#include <atomic>
#include <mutex>

namespace gnomon::host {
namespace {

std::atomic<bool> any_abandoned{false};

bool isSoftware(const VkPhysicalDeviceProperties& properties)
{
    return properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU;
}

} // namespace

struct Gpu::Impl {
    vulkan::DeviceView view;
    VkQueue queue = VK_NULL_HANDLE;
    std::uint32_t family = 0;
    VkPhysicalDeviceProperties properties{};
    std::string driver;
    VkDebugUtilsMessengerEXT messenger = VK_NULL_HANDLE;
    VkPipelineCache cache = VK_NULL_HANDLE;
    DeviceRates rates;
    std::filesystem::path cache_file;
    mutable std::mutex mutex; // validation may speak from any thread
    std::vector<std::string> messages;
    std::function<void()> while_waiting;
    double patience_s = 0.0;
    mutable std::atomic<bool> abandoned{false};

    ~Impl();
    void storeCache() const noexcept;
    void makeMessenger();
    void makeDevice(const GpuOptions& options);
    static VKAPI_ATTR VkBool32 VKAPI_CALL hear(VkDebugUtilsMessageSeverityFlagBitsEXT severity,
                                               VkDebugUtilsMessageTypeFlagsEXT types,
                                               const VkDebugUtilsMessengerCallbackDataEXT* data, void* user);
};

VkBool32 Gpu::Impl::hear(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                         const VkDebugUtilsMessengerCallbackDataEXT* data, void* user)
{
    auto& self = *static_cast<Impl*>(user);
    const std::scoped_lock lock(self.mutex);
    self.messages.emplace_back(data->pMessage != nullptr ? data->pMessage : "");
    return VK_FALSE;
}

void Gpu::Impl::makeMessenger()
{
    VkDebugUtilsMessengerCreateInfoEXT info{VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT};
    info.messageSeverity =
        VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    info.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT;
    info.pfnUserCallback = &Impl::hear;
    info.pUserData = this;
    const auto create = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
        vkGetInstanceProcAddr(view.instance, "vkCreateDebugUtilsMessengerEXT"));
    if (create == nullptr) {
        throw Error("switching on Vulkan validation", "VK_EXT_debug_utils is not there", "update the Vulkan loader");
    }
    check(create(view.instance, &info, nullptr, &messenger), "listening to Vulkan validation");
}

void Gpu::Impl::makeDevice(const GpuOptions& options)
{
    family = *familyFor(view.instance, view.physical_device, options);
    const float priority = 1.0F;
    VkDeviceQueueCreateInfo queue_info{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
    queue_info.queueFamilyIndex = family;
    queue_info.queueCount = 1;
    queue_info.pQueuePriorities = &priority;
    VkDeviceCreateInfo info{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO};
    view.features = vulkan::supportedFeatures(view);
    view.queue_family = family;
    info.pNext = &vulkan::requiredFeatures(view.features);
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queue_info;
    std::vector<const char*> extensions;
    if (options.presents != nullptr) {
        extensions.push_back(VK_KHR_SWAPCHAIN_EXTENSION_NAME);
    }
    const PortabilitySubset subset(view.physical_device, info, extensions);
    info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
    info.ppEnabledExtensionNames = extensions.data();
    const char* const opening = "opening the Vulkan device";
    vkGetPhysicalDeviceProperties(view.physical_device, &properties);
    if (isSoftware(properties)) {
        requireThreads(threadsOfSoftwareDriver(), opening);
    }
    check(vkCreateDevice(view.physical_device, &info, nullptr, &view.device), opening);
    vkGetDeviceQueue(view.device, family, 0, &queue);
    driver = driverOf(view.physical_device);
}

void Gpu::Impl::storeCache() const noexcept
{
    try {
        storePipelineCache(view.device, cache, cache_file);
    } catch (...) { // out of memory: then there is no file, on which nothing depends
    }
}

// Each submission is waited for, so the device is idle.
Gpu::Impl::~Impl()
{
    if (view.device != VK_NULL_HANDLE) {
        if (cache != VK_NULL_HANDLE) {
            storeCache();
            vkDestroyPipelineCache(view.device, cache, nullptr);
        }
        vkDestroyDevice(view.device, nullptr);
    }
    if (messenger != VK_NULL_HANDLE) {
        const auto destroy = reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
            vkGetInstanceProcAddr(view.instance, "vkDestroyDebugUtilsMessengerEXT"));
        destroy(view.instance, messenger, nullptr);
    }
    if (view.instance != VK_NULL_HANDLE) {
        vkDestroyInstance(view.instance, nullptr);
    }
}

Gpu::Gpu(const GpuOptions& options) : impl_(std::make_unique<Impl>())
{
    impl_->while_waiting = options.while_waiting;
    impl_->patience_s = options.patience_s;
    impl_->view.shaders = options.shaders;
    impl_->view.instance = makeInstance(options, impl_->view.debug_labels);
    impl_->view.get_instance_proc_addr = vkGetInstanceProcAddr;
    if (options.validate) {
        impl_->makeMessenger();
    }
    impl_->view.physical_device = pickDevice(impl_->view.instance, options);
    impl_->makeDevice(options);
    impl_->cache_file = cacheFile(impl_->properties, "pipelines");
    const DeviceRates of_kind = ratesOf(software() ? RateSource::software : RateSource::gpu);
    impl_->rates = options.rates.value_or(loadRates(cacheFile(impl_->properties, "rates")).value_or(of_kind));
    impl_->cache = loadPipelineCache(impl_->view.device, impl_->cache_file);
}

Gpu::~Gpu()
{
    if (abandoned()) {
        keepForGood(std::move(impl_));
    }
}

const vulkan::DeviceView& Gpu::view() const
{
    return impl_->view;
}
VkQueue Gpu::queue() const
{
    return impl_->queue;
}
std::uint32_t Gpu::queueFamily() const
{
    return impl_->family;
}
const VkPhysicalDeviceProperties& Gpu::properties() const
{
    return impl_->properties;
}
const std::string& Gpu::driver() const
{
    return impl_->driver;
}
bool Gpu::software() const
{
    return isSoftware(impl_->properties);
}
const DeviceRates& Gpu::rates() const
{
    return impl_->rates;
}

std::filesystem::path Gpu::keepRates(const DeviceRates& rates) const
{
    std::filesystem::path file = cacheFile(impl_->properties, "rates");
    storeRates(rates, file);
    return file;
}

bool Gpu::formatCan(VkFormat format, VkFormatFeatureFlags uses) const
{
    return canBe(impl_->view.physical_device, format, uses);
}

VkPipelineCache Gpu::pipelineCache() const
{
    return impl_->cache;
}

double Gpu::patience_s() const
{
    return impl_->patience_s;
}

void Gpu::lookUp() const
{
    if (impl_->while_waiting) {
        impl_->while_waiting();
    }
}

void Gpu::abandon() const noexcept
{
    impl_->abandoned = true;
    any_abandoned = true;
}

bool Gpu::abandoned() const noexcept
{
    return impl_->abandoned;
}

bool anyDeviceAbandoned() noexcept
{
    return any_abandoned;
}

std::vector<std::string> Gpu::messages() const
{
    const std::scoped_lock lock(impl_->mutex);
    return impl_->messages;
}

} // namespace gnomon::host
