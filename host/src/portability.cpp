// SPDX-License-Identifier: Apache-2.0
// Compiled alone: the macro says what Vulkan's headers declare, wherever they are included first.
#define VK_ENABLE_BETA_EXTENSIONS
#include "portability.h"

#include "devices.h"

#include <vulkan/vulkan_beta.h>

namespace gnomon::host {

struct PortabilitySubset::Features {
    VkPhysicalDevicePortabilitySubsetFeaturesKHR have{
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PORTABILITY_SUBSET_FEATURES_KHR};
};

PortabilitySubset::PortabilitySubset(VkPhysicalDevice device, VkDeviceCreateInfo& info,
                                     std::vector<const char*>& extensions)
{
    if (!hasDeviceExtension(device, VK_KHR_PORTABILITY_SUBSET_EXTENSION_NAME)) {
        return;
    }
    extensions.push_back(VK_KHR_PORTABILITY_SUBSET_EXTENSION_NAME);
    features_ = std::make_unique<Features>();
    VkPhysicalDeviceFeatures2 all{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, &features_->have, {}};
    vkGetPhysicalDeviceFeatures2(device, &all);
    features_->have.pNext = const_cast<void*>(info.pNext);
    info.pNext = &features_->have;
}

PortabilitySubset::~PortabilitySubset() = default;

} // namespace gnomon::host
