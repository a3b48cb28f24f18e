// SPDX-License-Identifier: Apache-2.0
// How each MapFormat is stored. A new format is one line of the table in map_storage.cpp.
#pragma once

#include <gnomon/plan.h>
#include <gnomon/vulkan/classic_pass.h>
#include <gnomon/vulkan/shadow_renderer.h>

#include <vulkan/vulkan_core.h>

namespace gnomon::vulkan {

struct MapStorage {
    MapFormat format;
    VkFormat colour; // UNDEFINED: the depth image is the map
    VkFormat depth;

    [[nodiscard]] bool depthOnly() const { return colour == VK_FORMAT_UNDEFINED; }
    [[nodiscard]] VkFormat mapFormat() const { return depthOnly() ? depth : colour; }
    [[nodiscard]] VkImageAspectFlags aspect() const
    {
        return depthOnly() ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
    }
};

/// The wishes of a pass for its callback beside MapPass::formats.
[[nodiscard]] inline ClassicFormats classicFormats(const MapPass& pass)
{
    return pass.classic != nullptr ? pass.classic->formats : ClassicFormats{};
}
/// There is one for every format.
[[nodiscard]] const MapStorage& mapStorage(MapFormat format);
/// The channels of a colour attachment that are written for one part of its texels; 0 for no attachment. A format that
/// holds one map a texel has only the whole.
[[nodiscard]] VkColorComponentFlags colourMaskOf(VkFormat colour, TexelPart part);
/// The largest rounding of a depth below 1 in this format.
[[nodiscard]] float depthRounding(VkFormat depth);
/// Throws Error when images with these features cannot hold the filter's averages; `what` is the step that was tried:
/// they are written by compute shaders, drawn to by a blur of fragment shaders, and read between texels.
void requireAveraging(VkFormatFeatureFlags features, Filter filter, MapFormat format, const char* what);

} // namespace gnomon::vulkan
