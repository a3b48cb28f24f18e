// SPDX-License-Identifier: Apache-2.0
#include "host/gpu.h"

#include "abandoned.h"
#include "check.h"
#include "pipeline_cache.h"
#include "threads.h"

#include <gnomon/error.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cctype>
#include <cstring>
#include <mutex>
#include <optional>

namespace gnomon::host {
namespace {

std::atomic<bool> any_abandoned{false};

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";
constexpr const char* kTried = "looking for a Vulkan device";
constexpr const char* kInstallDriver = "install a Vulkan driver; mesa-vulkan-drivers has one for the CPU";

std::string lower(std::string text)
{
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

bool hasExtension(const char* layer, const char* name)
{
    std::uint32_t count = 0;
    check(vkEnumerateInstanceExtensionProperties(layer, &count, nullptr), kTried);
    std::vector<VkExtensionProperties> all(count);
    check(vkEnumerateInstanceExtensionProperties(layer, &count, all.data()), kTried);
    return std::any_of(all.begin(), all.end(),
                       [name](const VkExtensionProperties& e) { return std::strcmp(e.extensionName, name) == 0; });
}

bool hasDeviceExtension(VkPhysicalDevice device, const char* name)
{
    std::uint32_t count = 0;
    check(vkEnumerateDeviceExtensionProperties(device, nullptr, &count, nullptr), kTried);
    std::vector<VkExtensionProperties> all(count);
    check(vkEnumerateDeviceExtensionProperties(device, nullptr, &count, all.data()), kTried);
    return std::any_of(all.begin(), all.end(),
                       [name](const VkExtensionProperties& e) { return std::strcmp(e.extensionName, name) == 0; });
}

bool hasLayer(const char* name)
{
    std::uint32_t count = 0;
    check(vkEnumerateInstanceLayerProperties(&count, nullptr), kTried);
    std::vector<VkLayerProperties> all(count);
    check(vkEnumerateInstanceLayerProperties(&count, all.data()), kTried);
    return std::any_of(all.begin(), all.end(),
                       [name](const VkLayerProperties& l) { return std::strcmp(l.layerName, name) == 0; });
}

std::optional<std::uint32_t> graphicsFamily(VkPhysicalDevice device)
{
    std::uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(device, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(device, &count, families.data());
    constexpr VkQueueFlags kNeeded = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
    for (std::uint32_t i = 0; i < count; ++i) {
        if ((families[i].queueFlags & kNeeded) == kNeeded) {
            return i;
        }
    }
    return std::nullopt;
}

VkPhysicalDeviceProperties propertiesOf(VkPhysicalDevice device)
{
    VkPhysicalDeviceProperties properties{};
    vkGetPhysicalDeviceProperties(device, &properties);
    return properties;
}

// Why a device cannot be used; empty when it can.
std::string refusalOf(VkInstance instance, VkPhysicalDevice device, const GpuOptions& options)
{
    const VkPhysicalDeviceProperties properties = propertiesOf(device);
    if (properties.apiVersion < VK_API_VERSION_1_3) {
        return "it has Vulkan " + std::to_string(VK_API_VERSION_MAJOR(properties.apiVersion)) + "." +
               std::to_string(VK_API_VERSION_MINOR(properties.apiVersion)) + ", 1.3 is needed";
    }
    vulkan::DeviceView view;
    view.instance = instance;
    view.physical_device = device;
    view.get_instance_proc_addr = vkGetInstanceProcAddr;
    std::array<char, 1024> missing{};
    vulkan::missingFeatures(view, missing.data(), missing.size(),
                            {.filterable = true, .caster_drawer = true, .clip_planes = true});
    if (missing[0] != '\0') {
        return std::string("it lacks ") + missing.data();
    }
    const auto family = graphicsFamily(device);
    if (!family.has_value()) {
        return "it has no queue for graphics and compute";
    }
    const bool shows = options.presents == nullptr || (hasDeviceExtension(device, VK_KHR_SWAPCHAIN_EXTENSION_NAME) &&
                                                       options.presents(instance, device, *family));
    return shows ? "" : "it cannot draw in windows";
}

bool isSoftware(const VkPhysicalDeviceProperties& properties)
{
    return properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU;
}

bool wanted(const std::string& gpu, const VkPhysicalDeviceProperties& properties)
{
    if (gpu.empty()) {
        return true;
    }
    return gpu == "software" ? isSoftware(properties)
                             : lower(properties.deviceName).find(lower(gpu)) != std::string::npos;
}

VkPhysicalDevice pickDevice(VkInstance instance, const GpuOptions& options)
{
    const std::string& gpu = options.gpu;
    std::uint32_t count = 0;
    check(vkEnumeratePhysicalDevices(instance, &count, nullptr), kTried);
    std::vector<VkPhysicalDevice> devices(count);
    check(vkEnumeratePhysicalDevices(instance, &count, devices.data()), kTried);
    if (count == 0) {
        throw Error(kTried, "no Vulkan driver offers one", kInstallDriver);
    }
    std::string reasons;
    VkPhysicalDevice best = VK_NULL_HANDLE;
    for (VkPhysicalDevice device : devices) {
        const VkPhysicalDeviceProperties properties = propertiesOf(device);
        std::string why =
            wanted(gpu, properties) ? refusalOf(instance, device, options) : "its name does not hold \"" + gpu + "\"";
        if (why.empty()) {
            // The first real GPU wins over any software rasteriser before it.
            if (best == VK_NULL_HANDLE || (isSoftware(propertiesOf(best)) && !isSoftware(properties))) {
                best = device;
            }
        } else {
            reasons += (reasons.empty() ? "" : "; ") + std::string(properties.deviceName) + ": " + why;
        }
    }
    if (best == VK_NULL_HANDLE) {
        throw Error(kTried, "none can be used (" + reasons + ")",
                    gpu.empty() ? kInstallDriver : "name another device, or none");
    }
    return best;
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
    std::filesystem::path cache_file;
    mutable std::mutex mutex; // validation may speak from any thread
    std::vector<std::string> messages;
    std::function<void()> while_waiting;
    double patience_s = 0.0;
    mutable std::atomic<bool> abandoned{false};

    ~Impl();
    void storeCache() const noexcept;
    void makeInstance(const GpuOptions& options);
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

void Gpu::Impl::makeInstance(const GpuOptions& options)
{
    const bool validate = options.validate;
    if (validate && !hasLayer(kValidationLayer)) {
        throw Error("switching on Vulkan validation", std::string(kValidationLayer) + " is not installed",
                    "install vulkan-validationlayers");
    }
    VkApplicationInfo app{VK_STRUCTURE_TYPE_APPLICATION_INFO};
    app.pApplicationName = "gnomon";
    app.apiVersion = VK_API_VERSION_1_3;
    std::vector<const char*> extensions = options.surface_extensions;
    view.debug_labels = hasExtension(nullptr, VK_EXT_DEBUG_UTILS_EXTENSION_NAME) ||
                        (validate && hasExtension(kValidationLayer, VK_EXT_DEBUG_UTILS_EXTENSION_NAME));
    if (view.debug_labels) {
        extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    }
    const std::array<VkValidationFeatureEnableEXT, 1> enables{
        VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT};
    VkValidationFeaturesEXT features{VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT};
    features.enabledValidationFeatureCount = enables.size();
    features.pEnabledValidationFeatures = enables.data();
    VkInstanceCreateInfo info{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
    info.pApplicationInfo = &app;
    if (validate) {
        extensions.push_back(VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME);
        info.pNext = &features;
        info.enabledLayerCount = 1;
        info.ppEnabledLayerNames = &kValidationLayer;
    }
    info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
    info.ppEnabledExtensionNames = extensions.data();
    const VkResult result = vkCreateInstance(&info, nullptr, &view.instance);
    if (result == VK_ERROR_INCOMPATIBLE_DRIVER) {
        throw Error(kTried, resultText(result), kInstallDriver);
    }
    check(result, "starting Vulkan");
    view.get_instance_proc_addr = vkGetInstanceProcAddr;
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
    family = *graphicsFamily(view.physical_device);
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
    const char* const swapchain = VK_KHR_SWAPCHAIN_EXTENSION_NAME;
    info.enabledExtensionCount = options.presents != nullptr ? 1 : 0;
    info.ppEnabledExtensionNames = &swapchain;
    const char* const opening = "opening the Vulkan device";
    vkGetPhysicalDeviceProperties(view.physical_device, &properties);
    if (isSoftware(properties)) {
        requireThreads(threadsOfSoftwareDriver(), opening);
    }
    check(vkCreateDevice(view.physical_device, &info, nullptr, &view.device), opening);
    vkGetDeviceQueue(view.device, family, 0, &queue);
    VkPhysicalDeviceDriverProperties driver_properties{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES};
    VkPhysicalDeviceProperties2 all{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, &driver_properties, {}};
    vkGetPhysicalDeviceProperties2(view.physical_device, &all);
    driver = std::string(driver_properties.driverName) + " " + driver_properties.driverInfo;
}

void Gpu::Impl::storeCache() const noexcept
{
    try {
        storePipelineCache(view.device, cache, cache_file);
    } catch (...) { // out of memory: then there is no file, on which nothing depends
    }
}

// Whoever submits waits for it, so the device is idle.
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
    impl_->makeInstance(options);
    if (options.validate) {
        impl_->makeMessenger();
    }
    impl_->view.physical_device = pickDevice(impl_->view.instance, options);
    impl_->makeDevice(options);
    impl_->cache_file = pipelineCacheFile(impl_->properties);
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
bool Gpu::formatCan(VkFormat format, VkFormatFeatureFlags uses) const
{
    VkFormatProperties properties{};
    vkGetPhysicalDeviceFormatProperties(impl_->view.physical_device, format, &properties);
    return (properties.optimalTilingFeatures & uses) == uses;
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
