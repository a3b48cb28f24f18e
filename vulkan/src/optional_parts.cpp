// SPDX-License-Identifier: Apache-2.0
#include "optional_parts.h"

#include <gnomon/error.h>

#include <algorithm>
#include <string>

namespace gnomon::vulkan {
namespace {

template <class Function>
Function functionOf(const DeviceView& view, const char* name)
{
    requireInstance(view);
    return reinterpret_cast<Function>(view.get_instance_proc_addr(view.instance, name));
}

VkFormatFeatureFlags formatFeatures(const DeviceView& view, VkFormat format)
{
    VkFormatProperties properties{};
    if (const auto get =
            functionOf<PFN_vkGetPhysicalDeviceFormatProperties>(view, "vkGetPhysicalDeviceFormatProperties")) {
        get(view.physical_device, format, &properties);
    }
    return properties.optimalTilingFeatures;
}

VkPhysicalDeviceLimits limitsOf(const DeviceView& view)
{
    VkPhysicalDeviceProperties properties{};
    if (const auto get = functionOf<PFN_vkGetPhysicalDeviceProperties>(view, "vkGetPhysicalDeviceProperties")) {
        get(view.physical_device, &properties);
    }
    return properties.limits;
}

template <bool FeatureUses::*kUse>
constexpr OptionalPart feature(const char* name, const char* serves, const char* without, const char* instead = "")
{
    return {name, serves, without, instead, kUse, [](const DeviceView& view) {
                return supportedFeatures(view).*kUse;
            }};
}

constexpr const char* kLargeGroups = "maxComputeWorkGroupInvocations of 256";

constexpr OptionalPart kParts[] = {
    feature<&FeatureUses::indirect_draws>("multiDrawIndirect and drawIndirectFirstInstance",
                                          "few commands for many casters",
                                          "each mesh is drawn by a command of its own"),
    feature<&FeatureUses::depth_clamp>(
        "depthClamp", "maps whose near plane casters may be before, and filter volumes",
        "near planes lie before all casters (Frame::clamps_depth), and filter volumes is refused",
        "set Frame::clamps_depth to false, and take a filter with maps"),
    feature<&FeatureUses::filterable>("shaderStorageImageWriteWithoutFormat", "maps of vsm, lvsm, esm, evsm and msm",
                                      "these filters are refused", "take hard, pcf, pcss or raymarch"),
    feature<&FeatureUses::sample_metric>("sampleRateShading",
                                         "depths of each sample in filterable maps of perspective views",
                                         "the samples of a texel share one depth there"),
    feature<&FeatureUses::layered>("shaderOutputLayer", "cascades.pass=layered",
                                   "it is refused, and cascades are drawn one after the other"),
    feature<&FeatureUses::clip_planes>("shaderClipDistance", "casters that planes cut", "they are refused",
                                       "cut them before they are handed over"),
    feature<&FeatureUses::depth_bounds>("depthBounds", "shadow volumes counted no farther than lamps reach",
                                        "they are counted wherever they are seen"),
    feature<&FeatureUses::statistics>("pipelineStatisticsQuery", "counts of shaders run in each pass",
                                      "they are not measured"),
    {"timestamps", "GPU times of passes", "they are not measured, and draw-budget bounds nothing", "", nullptr,
     [](const DeviceView& view) {
         return timestampBits(view) > 0;
     }},
    {"D32_SFLOAT_S8_UINT", "shadow volumes counted at depths of 32 bits", "they are counted at depths of 24 bits", "",
     nullptr,
     [](const DeviceView& view) {
         return stencilFormat(view) == VK_FORMAT_D32_SFLOAT_S8_UINT;
     }},
    {kLargeGroups, "partition sdsm, and layers of lvsm that are found", "they are refused",
     "take partition cascades, and give lvsm its layers", nullptr,
     [](const DeviceView& view) {
         return hasLargeGroups(limitsOf(view));
     }},
};

[[noreturn]] void refusePart(const char* tried, const OptionalPart& part, const char* because)
{
    throw Error(tried, std::string(because) + part.name + ", which is for " + part.serves, part.instead);
}

const OptionalPart& namedPart(const char* name)
{
    return *std::ranges::find(kParts, name, &OptionalPart::name);
}

} // namespace

std::span<const OptionalPart> optionalParts()
{
    return kParts;
}

std::uint32_t timestampBits(const DeviceView& view)
{
    const auto get =
        functionOf<PFN_vkGetPhysicalDeviceQueueFamilyProperties>(view, "vkGetPhysicalDeviceQueueFamilyProperties");
    std::uint32_t count = 0;
    if (get == nullptr) {
        return 0;
    }
    get(view.physical_device, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    get(view.physical_device, &count, families.data());
    return view.queue_family < count ? families[view.queue_family].timestampValidBits : 0;
}

VkFormat stencilFormat(const DeviceView& view)
{
    const bool has =
        (formatFeatures(view, VK_FORMAT_D32_SFLOAT_S8_UINT) & VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT) != 0;
    return has ? VK_FORMAT_D32_SFLOAT_S8_UINT : VK_FORMAT_D24_UNORM_S8_UINT;
}

bool hasLargeGroups(const VkPhysicalDeviceLimits& limits)
{
    return limits.maxComputeWorkGroupInvocations >= kLargeGroup && limits.maxComputeWorkGroupSize[0] >= kLargeGroup;
}

void requirePart(const Device& device, const char* tried, bool FeatureUses::*use)
{
    if (!(device.uses().*use)) {
        refusePart(tried, *std::ranges::find(kParts, use, &OptionalPart::use), "the device has not, or not on, ");
    }
}

void requireLargeGroups(const Device& device, const char* tried)
{
    if (!hasLargeGroups(device.limits())) {
        refusePart(tried, namedPart(kLargeGroups), "the device has no ");
    }
}

} // namespace gnomon::vulkan
