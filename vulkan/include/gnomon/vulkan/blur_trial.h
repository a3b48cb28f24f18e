// SPDX-License-Identifier: Apache-2.0
// Which shaders blur a filterable map faster on this device: found out by doing it, once for a format and radius. What
// MomentOptions::blur_path = automatic leaves to the host.
#pragma once

#include <gnomon/vulkan/shadow_renderer.h>

namespace gnomon::vulkan {

class BlurTrial {
public:
    /// Precondition: the filter is filterable and has a blur. Throws Error as ShadowRenderer does. Needs the feature
    /// hostQueryReset, and a queue with timestamps to run on.
    BlurTrial(const DeviceView& device, const FilterOptions& filter, VkPipelineCache cache = VK_NULL_HANDLE);
    ~BlurTrial();
    BlurTrial(const BlurTrial&) = delete;
    BlurTrial& operator=(const BlurTrial&) = delete;

    /// Both ways by turns, on an image of its own. The caller submits and waits.
    void record(VkCommandBuffer commands);
    /// The shortest of its turns, once the GPU has finished; 0 without timestamps. `path` is not automatic.
    [[nodiscard]] double milliseconds(BlurPath path) const;
    /// Compute where both take as long.
    [[nodiscard]] BlurPath faster() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace gnomon::vulkan
