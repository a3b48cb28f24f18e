// SPDX-License-Identifier: Apache-2.0
// Devices that have a subset of Vulkan (MoltenVK).
#pragma once

#include <vulkan/vulkan_core.h>

#include <memory>
#include <vector>

namespace gnomon::host {

/// A device that lacks what Vulkan else promises says so by an extension, which must be on then, and lists by features
/// what of that it has. Of such a device this turns on the extension and all these features; of others nothing. To live
/// until vkCreateDevice() has returned.
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
