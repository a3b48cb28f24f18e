// SPDX-License-Identifier: Apache-2.0
// Mesa's driver for AMD's GPUs, RADV, as a compiler: it makes pipelines for a chip that need not be there. Such a
// device has no memory, so it makes no images and no buffers.
#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace gnomon::compiled {

/// The compiler's figures of one stage: VGPRs and SGPRs, spilled VGPRs and SGPRs, scratch bytes and LDS bytes, waves
/// that fit in a SIMD, instructions, code bytes.
using Figures = std::map<std::string, std::uint64_t>;

struct CompiledStage {
    VkShaderStageFlags stages = 0;
    Figures figures;
};

class AmdDevice {
public:
    /// `chip` as RADV_FORCE_FAMILY has it: "NAVI21". Null where there is no such driver: then `why` is one line.
    [[nodiscard]] static std::unique_ptr<AmdDevice> open(const std::string& chip, std::string& why);
    ~AmdDevice();
    AmdDevice(const AmdDevice&) = delete;
    AmdDevice& operator=(const AmdDevice&) = delete;

    [[nodiscard]] VkPhysicalDevice physicalDevice() const { return physical_device_; }
    [[nodiscard]] VkDevice device() const { return device_; }
    [[nodiscard]] const std::string& driver() const { return driver_; } // "Mesa 22.3.6"

    /// A pipeline that was made with VK_PIPELINE_CREATE_CAPTURE_STATISTICS_BIT_KHR.
    [[nodiscard]] std::vector<CompiledStage> stagesOf(VkPipeline pipeline) const;

private:
    AmdDevice() = default;
    [[nodiscard]] bool makeDevice(std::string& why);
    [[nodiscard]] Figures figuresOf(VkPipeline pipeline, std::uint32_t executable) const;

    VkInstance instance_ = VK_NULL_HANDLE;
    VkPhysicalDevice physical_device_ = VK_NULL_HANDLE;
    VkDevice device_ = VK_NULL_HANDLE;
    std::string driver_;
    PFN_vkGetPipelineExecutablePropertiesKHR executables_ = nullptr;
    PFN_vkGetPipelineExecutableStatisticsKHR statistics_ = nullptr;
};

} // namespace gnomon::compiled
