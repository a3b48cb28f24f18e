// SPDX-License-Identifier: Apache-2.0
// Devices that have a subset of Vulkan (MoltenVK).
#pragma once

#include <vulkan/vulkan_core.h>

#include <memory>
#include <vector>

namespace gnomon::host {

/// A device with a subset of Vulkan has an extension, which must be on, with a feature for each optional part that it
/// has. This turns on the extension and all these features where the device has it. It must live until vkCreateDevice()
/// has returned.
class PortabilitySubset {
public:
    PortabilitySubset(VkPhysicalDevice device, VkDeviceCreateInfo& info, std::vector<const char*>& extensions);
    ~PortabilitySubset();
    PortabilitySubset(const PortabilitySubset&) = delete;
    PortabilitySubset& operator=(const PortabilitySubset&) = delete;

private:
    struct Features;
    std::unique_ptr<Features> features_;
};

} // namespace gnomon::host
