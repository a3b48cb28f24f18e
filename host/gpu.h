// SPDX-License-Identifier: Apache-2.0
// The program's own Vulkan device: picks it, makes it, hears its validation messages.
#pragma once

#include <gnomon/vulkan/device_view.h>

#include <memory>
#include <string>
#include <vector>

namespace gnomon::host {

struct GpuOptions {
    /// Part of a device's name, "software" for a CPU rasteriser, or empty: the first real GPU, else software.
    std::string gpu;
    bool validate = false; // validation layer with synchronization validation; Error when it is not installed
};

class Gpu {
public:
    /// Throws Error that lists every device found and why it was not taken.
    explicit Gpu(const GpuOptions& options);
    ~Gpu();
    Gpu(const Gpu&) = delete;
    Gpu& operator=(const Gpu&) = delete;

    [[nodiscard]] const vulkan::DeviceView& view() const;
    [[nodiscard]] VkQueue queue() const;
    [[nodiscard]] std::uint32_t queueFamily() const;
    [[nodiscard]] const VkPhysicalDeviceProperties& properties() const;
    [[nodiscard]] const std::string& driver() const; // name and version, for reports
    [[nodiscard]] bool software() const;
    /// Validation messages so far (warnings and errors), in order. With `validate`, the program fails if any.
    [[nodiscard]] std::vector<std::string> messages() const;
    /// On-disk pipeline cache, loaded from and stored to the user's cache folder; VK_NULL_HANDLE never.
    [[nodiscard]] VkPipelineCache pipelineCache() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace gnomon::host
