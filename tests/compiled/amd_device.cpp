// SPDX-License-Identifier: Apache-2.0
#include "amd_device.h"

#include <gnomon/vulkan/device_view.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <optional>
#include <utility>

namespace gnomon::compiled {
namespace {

namespace fs = std::filesystem;

/// Sets a variable of the environment for as long as it lives.
class Setting {
public:
    Setting(const char* name, const std::string& value) : name_(name)
    {
        if (const char* const before = std::getenv(name)) {
            before_ = before;
        }
        setenv(name, value.c_str(), 1);
    }
    Setting(const Setting&) = delete;
    Setting& operator=(const Setting&) = delete;
    ~Setting()
    {
        if (before_) {
            setenv(name_, before_->c_str(), 1);
        } else {
            unsetenv(name_);
        }
    }

private:
    const char* name_;
    std::optional<std::string> before_;
};

/// The file that tells Vulkan's loader of RADV; empty where there is none.
fs::path manifest()
{
    for (const char* folder : {"/usr/share/vulkan/icd.d", "/usr/local/share/vulkan/icd.d", "/etc/vulkan/icd.d"}) {
        std::error_code none;
        for (const fs::directory_entry& entry : fs::directory_iterator(folder, none)) {
            if (entry.path().filename().string().starts_with("radeon_icd")) {
                return entry.path();
            }
        }
    }
    return {};
}

/// Our names of the figures, and RADV's.
constexpr std::pair<const char*, const char*> kFigures[] = {{"VGPRs", "VGPRs"},
                                                            {"SGPRs", "SGPRs"},
                                                            {"spilled VGPRs", "Spilled VGPRs"},
                                                            {"spilled SGPRs", "Spilled SGPRs"},
                                                            {"scratch bytes", "Scratch size"},
                                                            {"LDS bytes", "LDS size"},
                                                            {"waves", "Subgroups per SIMD"},
                                                            {"instructions", "Instructions"},
                                                            {"code bytes", "Code size"}};

bool hasExtension(VkPhysicalDevice device, const char* name)
{
    std::uint32_t count = 0;
    vkEnumerateDeviceExtensionProperties(device, nullptr, &count, nullptr);
    std::vector<VkExtensionProperties> all(count);
    vkEnumerateDeviceExtensionProperties(device, nullptr, &count, all.data());
    return std::ranges::any_of(all, [&](const auto& one) { return std::strcmp(one.extensionName, name) == 0; });
}

} // namespace

std::unique_ptr<AmdDevice> AmdDevice::open(const std::string& chip, std::string& why)
{
    const fs::path file = manifest();
    if (file.empty()) {
        why = "there is no RADV on this machine (Debian: mesa-vulkan-drivers)";
        return nullptr;
    }
    // The loader and the driver read these while an instance and its devices are listed. The cache of shaders is off,
    // so that a figure never comes from another build's run.
    const std::array<Setting, 4> settings{{{"VK_DRIVER_FILES", file.string()},
                                           {"VK_ICD_FILENAMES", file.string()},
                                           {"RADV_FORCE_FAMILY", chip},
                                           {"MESA_SHADER_CACHE_DISABLE", "true"}}};
    std::unique_ptr<AmdDevice> made(new AmdDevice);
    VkApplicationInfo app{VK_STRUCTURE_TYPE_APPLICATION_INFO};
    app.apiVersion = VK_API_VERSION_1_3;
    VkInstanceCreateInfo info{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
    info.pApplicationInfo = &app;
    if (vkCreateInstance(&info, nullptr, &made->instance_) != VK_SUCCESS) {
        why = "RADV makes no instance of Vulkan";
        return nullptr;
    }
    std::uint32_t count = 1;
    vkEnumeratePhysicalDevices(made->instance_, &count, &made->physical_device_);
    if (count == 0) {
        why = "RADV has no chip " + chip;
        return nullptr;
    }
    return made->makeDevice(why) ? std::move(made) : nullptr;
}

bool AmdDevice::makeDevice(std::string& why)
{
    const char* const extension = VK_KHR_PIPELINE_EXECUTABLE_PROPERTIES_EXTENSION_NAME;
    if (!hasExtension(physical_device_, extension)) {
        why = std::string("RADV has no ") + extension;
        return false;
    }
    VkPhysicalDeviceDriverProperties driver{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES};
    VkPhysicalDeviceProperties2 properties{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, &driver, {}};
    vkGetPhysicalDeviceProperties2(physical_device_, &properties);
    driver_ = driver.driverInfo;
    // The features of a host that follows the library's advice, and no more: robust access would cost instructions.
    VkPhysicalDevicePipelineExecutablePropertiesFeaturesKHR says{
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PIPELINE_EXECUTABLE_PROPERTIES_FEATURES_KHR};
    says.pipelineExecutableInfo = VK_TRUE;
    const float priority = 1.0F;
    VkDeviceQueueCreateInfo queue{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    VkDeviceCreateInfo info{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO, &says};
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queue;
    info.enabledExtensionCount = 1;
    info.ppEnabledExtensionNames = &extension;
    const vulkan::FeatureMerge merge(info, {.layered = true, .clip_planes = true, .depth_bounds = true});
    if (vkCreateDevice(physical_device_, &info, nullptr, &device_) != VK_SUCCESS) {
        why = "RADV opens no device";
        return false;
    }
    executables_ = reinterpret_cast<PFN_vkGetPipelineExecutablePropertiesKHR>(
        vkGetDeviceProcAddr(device_, "vkGetPipelineExecutablePropertiesKHR"));
    statistics_ = reinterpret_cast<PFN_vkGetPipelineExecutableStatisticsKHR>(
        vkGetDeviceProcAddr(device_, "vkGetPipelineExecutableStatisticsKHR"));
    return true;
}

AmdDevice::~AmdDevice()
{
    if (device_ != VK_NULL_HANDLE) {
        vkDestroyDevice(device_, nullptr);
    }
    if (instance_ != VK_NULL_HANDLE) {
        vkDestroyInstance(instance_, nullptr);
    }
}

Figures AmdDevice::figuresOf(VkPipeline pipeline, std::uint32_t executable) const
{
    const VkPipelineExecutableInfoKHR info{VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_INFO_KHR, nullptr, pipeline,
                                           executable};
    std::uint32_t count = 0;
    statistics_(device_, &info, &count, nullptr);
    std::vector<VkPipelineExecutableStatisticKHR> all(count, {VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_STATISTIC_KHR});
    statistics_(device_, &info, &count, all.data());
    Figures figures;
    for (const auto& [name, said] : kFigures) {
        const auto found =
            std::ranges::find_if(all, [wanted = said](const auto& one) { return std::strcmp(one.name, wanted) == 0; });
        if (found != all.end()) {
            figures[name] = found->value.u64; // RADV counts everything in whole numbers
        }
    }
    return figures;
}

std::vector<CompiledStage> AmdDevice::stagesOf(VkPipeline pipeline) const
{
    const VkPipelineInfoKHR info{VK_STRUCTURE_TYPE_PIPELINE_INFO_KHR, nullptr, pipeline};
    std::uint32_t count = 0;
    executables_(device_, &info, &count, nullptr);
    std::vector<VkPipelineExecutablePropertiesKHR> all(count, {VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_PROPERTIES_KHR});
    executables_(device_, &info, &count, all.data());
    std::vector<CompiledStage> stages;
    for (std::uint32_t i = 0; i < count; ++i) {
        stages.push_back({all[i].stages, figuresOf(pipeline, i)});
    }
    return stages;
}

} // namespace gnomon::compiled
