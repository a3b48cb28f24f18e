// SPDX-License-Identifier: Apache-2.0
// The program's own Vulkan device: picks it, makes it, hears its validation messages.
#pragma once

#include <gnomon/device_rates.h>
#include <gnomon/vulkan/device_view.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::host {

struct GpuOptions {
    /// Part of a device's name, "software" for a CPU rasteriser, or empty: the first real GPU, else software.
    std::string gpu;
    bool validate = false; // validation layer with synchronization validation; Error when it is not installed
    /// Called some ten times a second by a thread that waits for the GPU. An exception from it ends the wait and leaves
    /// it, a few seconds later where the GPU is busy. It must not call the host's functions.
    std::function<void()> while_waiting;
    /// Seconds without an answer after which the GPU counts as hanging (Error, ErrorKind::device_lost). Drivers that
    /// watch their GPU give up after some ten seconds by themselves. For a software rasteriser only time in which this
    /// process does nothing counts. Above 0.
    double patience_s = 120.0;
    /// Instance extensions for drawing in a window, and whether a queue family can do so; forWindow() of
    /// host/window/interface.h fills them in. Empty: no window.
    std::vector<const char*> surface_extensions;
    bool (*presents)(VkInstance instance, VkPhysicalDevice device, std::uint32_t queue_family) = nullptr;
    /// Nothing: those that were kept, or else the table's for this kind of device.
    std::optional<DeviceRates> rates;
    vulkan::ShaderHook shaders; // for the host's shaders too
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
    /// Whether images of this format can be used in all these ways, with optimal tiling.
    [[nodiscard]] bool formatCan(VkFormat format, VkFormatFeatureFlags uses) const;
    /// On-disk pipeline cache, loaded from and stored to the user's cache folder. Never VK_NULL_HANDLE.
    [[nodiscard]] VkPipelineCache pipelineCache() const;

    /// GpuOptions::rates.
    [[nodiscard]] const DeviceRates& rates() const;
    /// Keeps rates for later runs on this device with this driver, and gives the file. Throws Error where it cannot be
    /// written.
    std::filesystem::path keepRates(const DeviceRates& rates) const; // NOLINT(modernize-use-nodiscard)

    [[nodiscard]] double patience_s() const;
    void lookUp() const; // calls GpuOptions::while_waiting
    /// To be called when the GPU did not finish its work. From then on neither the device nor anything of it is
    /// destroyed: the GPU may still use it.
    void abandon() const noexcept;
    [[nodiscard]] bool abandoned() const noexcept;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// An optional part of a device: vulkan::OptionalPart, or one of the program's own.
struct GpuPart {
    std::string name;
    std::string serves;  // its purpose
    std::string without; // the consequence where it is lacking
    bool there = false;
};

/// A device of this machine.
struct GpuReport {
    std::string name;
    std::string driver; // name and version; empty of a device before Vulkan 1.3
    std::uint32_t api_version = 0;
    bool software = false;
    std::uint32_t sub_pixel_bits = 0; // pack::DrawPrecision::sub_pixel_bits
    std::string refusal;              // why the program cannot use it; empty: it can
    bool taken = false;               // by a Gpu of no name
    std::vector<GpuPart> parts;
};
/// All devices, in the drivers' order. Uses only those `options` that starting Vulkan needs. Throws Error when there is
/// no device.
[[nodiscard]] std::vector<GpuReport> reportGpus(const GpuOptions& options);

/// Has this process abandoned any device? Then it had better end by std::_Exit(): the driver's threads may be at work.
[[nodiscard]] bool anyDeviceAbandoned() noexcept;

} // namespace gnomon::host
