// SPDX-License-Identifier: Apache-2.0
#include "devices.h"

#include "check.h"
#include "instance.h"
#include "pipelines.h"

#include <gnomon/error.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>
#include <memory>

namespace gnomon::host {
namespace {

std::string lower(std::string text)
{
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

VkPhysicalDeviceProperties propertiesOf(VkPhysicalDevice device)
{
    VkPhysicalDeviceProperties properties{};
    vkGetPhysicalDeviceProperties(device, &properties);
    return properties;
}

vulkan::DeviceView viewOf(VkInstance instance, VkPhysicalDevice device)
{
    vulkan::DeviceView view;
    view.instance = instance;
    view.physical_device = device;
    view.get_instance_proc_addr = vkGetInstanceProcAddr;
    return view;
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

// Why a device cannot be used; empty when it can.
std::string refusalOf(VkInstance instance, VkPhysicalDevice device, const GpuOptions& options)
{
    const VkPhysicalDeviceProperties properties = propertiesOf(device);
    if (properties.apiVersion < VK_API_VERSION_1_3) {
        return "it has Vulkan " + std::to_string(VK_API_VERSION_MAJOR(properties.apiVersion)) + "." +
               std::to_string(VK_API_VERSION_MINOR(properties.apiVersion)) + ", 1.3 is needed";
    }
    std::array<char, 1024> missing{};
    vulkan::missingFeatures(viewOf(instance, device), missing.data(), missing.size());
    if (missing[0] != '\0') {
        return std::string("it lacks ") + missing.data();
    }
    // Vulkan promises either this or 24 bits, and the program does not draw to the latter.
    if (!canBe(device, kDepthFormat, VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT)) {
        return "it draws to no depth buffer of 32-bit floats";
    }
    if (familyFor(instance, device, options)) {
        return {};
    }
    GpuOptions no_window = options;
    no_window.presents = nullptr;
    return familyFor(instance, device, no_window) ? "it cannot draw in windows"
                                                  : "it has no queue for graphics and compute";
}

/// The first real GPU comes before any software rasteriser.
bool isBetter(VkPhysicalDevice device, VkPhysicalDevice best)
{
    return best == VK_NULL_HANDLE || (isSoftware(propertiesOf(best)) && !isSoftware(propertiesOf(device)));
}

std::vector<VkPhysicalDevice> allDevices(VkInstance instance)
{
    std::uint32_t count = 0;
    check(vkEnumeratePhysicalDevices(instance, &count, nullptr), kLookingForDevice);
    std::vector<VkPhysicalDevice> devices(count);
    check(vkEnumeratePhysicalDevices(instance, &count, devices.data()), kLookingForDevice);
    if (count == 0) {
        throw Error(kLookingForDevice, "no Vulkan driver offers one", kInstallDriver);
    }
    return devices;
}

bool hasCachedMemory(VkPhysicalDevice device)
{
    constexpr VkMemoryPropertyFlags kCached = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_CACHED_BIT;
    VkPhysicalDeviceMemoryProperties memory{};
    vkGetPhysicalDeviceMemoryProperties(device, &memory);
    return std::any_of(memory.memoryTypes, memory.memoryTypes + memory.memoryTypeCount,
                       [](const VkMemoryType& type) { return (type.propertyFlags & kCached) == kCached; });
}

/// Adds the optional parts of a device that the program itself uses.
void addOwnParts(VkPhysicalDevice device, std::vector<GpuPart>& parts)
{
    constexpr VkFormatFeatureFlags kTarget =
        VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT | VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT;
    parts.push_back(
        {"drawing to R16G16_SNORM and R16G16B16A16_SNORM", "a smaller G-buffer of the program", "it has 32-bit floats",
         canBe(device, VK_FORMAT_R16G16_SNORM, kTarget) && canBe(device, VK_FORMAT_R16G16B16A16_SNORM, kTarget)});
    parts.push_back({"maxPerStageDescriptorSamplers of 19", "--shading forward, and blended surfaces in shadow",
                     "the first is refused, and the second are lit", hasForwardSamplers(propertiesOf(device).limits)});
    parts.push_back(
        {"HOST_CACHED memory", "pictures read back fast", "they are read more slowly", hasCachedMemory(device)});
    parts.push_back({VK_KHR_SWAPCHAIN_EXTENSION_NAME, "gnomon view", "there is no window",
                     hasDeviceExtension(device, VK_KHR_SWAPCHAIN_EXTENSION_NAME)});
}

GpuReport reportOf(VkInstance instance, VkPhysicalDevice device, const GpuOptions& options)
{
    const VkPhysicalDeviceProperties properties = propertiesOf(device);
    GpuReport report;
    report.name = properties.deviceName;
    report.software = isSoftware(properties);
    report.api_version = properties.apiVersion;
    report.sub_pixel_bits = properties.limits.subPixelPrecisionBits;
    report.refusal = refusalOf(instance, device, options);
    if (properties.apiVersion < VK_API_VERSION_1_3) {
        return report; // which may not know the functions that tell more
    }
    report.driver = driverOf(device);
    vulkan::DeviceView view = viewOf(instance, device);
    view.queue_family = familyFor(instance, device, options).value_or(0);
    for (const vulkan::OptionalPart& part : vulkan::optionalParts()) {
        report.parts.push_back({part.name, part.serves, part.without, part.has(view)});
    }
    addOwnParts(device, report.parts);
    return report;
}

} // namespace

bool hasDeviceExtension(VkPhysicalDevice device, const char* name)
{
    std::uint32_t count = 0;
    check(vkEnumerateDeviceExtensionProperties(device, nullptr, &count, nullptr), kLookingForDevice);
    std::vector<VkExtensionProperties> all(count);
    check(vkEnumerateDeviceExtensionProperties(device, nullptr, &count, all.data()), kLookingForDevice);
    return std::any_of(all.begin(), all.end(),
                       [name](const VkExtensionProperties& e) { return std::strcmp(e.extensionName, name) == 0; });
}

bool canBe(VkPhysicalDevice device, VkFormat format, VkFormatFeatureFlags uses)
{
    VkFormatProperties properties{};
    vkGetPhysicalDeviceFormatProperties(device, format, &properties);
    return (properties.optimalTilingFeatures & uses) == uses;
}

std::string driverOf(VkPhysicalDevice device)
{
    VkPhysicalDeviceDriverProperties driver{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES};
    VkPhysicalDeviceProperties2 all{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, &driver, {}};
    vkGetPhysicalDeviceProperties2(device, &all);
    return std::string(driver.driverName) + (driver.driverInfo[0] != '\0' ? " " : "") + driver.driverInfo;
}

bool hasForwardSamplers(const VkPhysicalDeviceLimits& limits)
{
    return std::min(limits.maxPerStageDescriptorSamplers, limits.maxPerStageDescriptorSampledImages) >=
           kForwardSamplers;
}

std::optional<std::uint32_t> familyFor(VkInstance instance, VkPhysicalDevice device, const GpuOptions& options)
{
    std::uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(device, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(device, &count, families.data());
    constexpr VkQueueFlags kNeeded = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
    const bool shows = options.presents == nullptr || hasDeviceExtension(device, VK_KHR_SWAPCHAIN_EXTENSION_NAME);
    for (std::uint32_t i = 0; i < count && shows; ++i) {
        if ((families[i].queueFlags & kNeeded) == kNeeded &&
            (options.presents == nullptr || options.presents(instance, device, i))) {
            return i;
        }
    }
    return std::nullopt;
}

VkPhysicalDevice pickDevice(VkInstance instance, const GpuOptions& options)
{
    const std::string& gpu = options.gpu;
    std::string reasons;
    VkPhysicalDevice best = VK_NULL_HANDLE;
    for (VkPhysicalDevice device : allDevices(instance)) {
        const VkPhysicalDeviceProperties properties = propertiesOf(device);
        std::string why =
            wanted(gpu, properties) ? refusalOf(instance, device, options) : "its name does not hold \"" + gpu + "\"";
        if (why.empty()) {
            best = isBetter(device, best) ? device : best;
        } else {
            reasons += (reasons.empty() ? "" : "; ") + std::string(properties.deviceName) + ": " + why;
        }
    }
    if (best == VK_NULL_HANDLE) {
        throw Error(kLookingForDevice, "none can be used (" + reasons + ")",
                    gpu.empty() ? kInstallDriver : "name another device, or none");
    }
    return best;
}

std::vector<GpuReport> reportGpus(const GpuOptions& options)
{
    bool debug_labels = false;
    const std::unique_ptr<VkInstance_T, void (*)(VkInstance)> instance(
        makeInstance(options, debug_labels), [](VkInstance one) { vkDestroyInstance(one, nullptr); });
    std::vector<GpuReport> reports;
    std::optional<std::size_t> taken;
    VkPhysicalDevice best = VK_NULL_HANDLE;
    for (VkPhysicalDevice device : allDevices(instance.get())) {
        reports.push_back(reportOf(instance.get(), device, options));
        if (reports.back().refusal.empty() && isBetter(device, best)) {
            best = device;
            taken = reports.size() - 1;
        }
    }
    if (taken) {
        reports[*taken].taken = true;
    }
    return reports;
}

} // namespace gnomon::host
