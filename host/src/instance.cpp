// SPDX-License-Identifier: Apache-2.0
#include "instance.h"

#include "check.h"

#include <gnomon/error.h>

#include <algorithm>
#include <array>
#include <cstring>

namespace gnomon::host {
namespace {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";

bool hasExtension(const char* layer, const char* name)
{
    std::uint32_t count = 0;
    check(vkEnumerateInstanceExtensionProperties(layer, &count, nullptr), kLookingForDevice);
    std::vector<VkExtensionProperties> all(count);
    check(vkEnumerateInstanceExtensionProperties(layer, &count, all.data()), kLookingForDevice);
    return std::any_of(all.begin(), all.end(),
                       [name](const VkExtensionProperties& e) { return std::strcmp(e.extensionName, name) == 0; });
}

bool hasLayer(const char* name)
{
    std::uint32_t count = 0;
    check(vkEnumerateInstanceLayerProperties(&count, nullptr), kLookingForDevice);
    std::vector<VkLayerProperties> all(count);
    check(vkEnumerateInstanceLayerProperties(&count, all.data()), kLookingForDevice);
    return std::any_of(all.begin(), all.end(),
                       [name](const VkLayerProperties& l) { return std::strcmp(l.layerName, name) == 0; });
}

} // namespace

VkInstance makeInstance(const GpuOptions& options, bool& debug_labels)
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
    debug_labels = hasExtension(nullptr, VK_EXT_DEBUG_UTILS_EXTENSION_NAME) ||
                   (validate && hasExtension(kValidationLayer, VK_EXT_DEBUG_UTILS_EXTENSION_NAME));
    if (debug_labels) {
        extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    }
    VkInstanceCreateInfo info{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
    if (hasExtension(nullptr, VK_KHR_PORTABILITY_ENUMERATION_EXTENSION_NAME)) { // else macOS shows no device
        extensions.push_back(VK_KHR_PORTABILITY_ENUMERATION_EXTENSION_NAME);
        info.flags |= VK_INSTANCE_CREATE_ENUMERATE_PORTABILITY_BIT_KHR;
    }
    const std::array<VkValidationFeatureEnableEXT, 1> enables{
        VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT};
    VkValidationFeaturesEXT features{VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT};
    features.enabledValidationFeatureCount = enables.size();
    features.pEnabledValidationFeatures = enables.data();
    info.pApplicationInfo = &app;
    if (validate) {
        extensions.push_back(VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME);
        info.pNext = &features;
        info.enabledLayerCount = 1;
        info.ppEnabledLayerNames = &kValidationLayer;
    }
    info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
    info.ppEnabledExtensionNames = extensions.data();
    VkInstance instance = VK_NULL_HANDLE;
    const VkResult result = vkCreateInstance(&info, nullptr, &instance);
    if (result == VK_ERROR_INCOMPATIBLE_DRIVER) {
        throw Error(kLookingForDevice, resultText(result), kInstallDriver);
    }
    check(result, "starting Vulkan");
    return instance;
}

} // namespace gnomon::host
