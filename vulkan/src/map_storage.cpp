// SPDX-License-Identifier: Apache-2.0
#include "map_storage.h"

#include "moment_rule_of.h"

#include <gnomon/error.h>

#include <paired_depth.h>

#include <algorithm>
#include <iterator>
#include <string>

namespace gnomon::vulkan {
namespace {

// Single precision carries about 4e-6 through matrix, interpolation and comparison; 16 bits add one step and a half.
constexpr float kArithmetic = 4e-6F;
constexpr MapStorage kStorages[] = {
    {MapFormat::d16, VK_FORMAT_UNDEFINED, VK_FORMAT_D16_UNORM, 1.5F / 65535.0F + kArithmetic},
    {MapFormat::d32f, VK_FORMAT_UNDEFINED, VK_FORMAT_D32_SFLOAT, kArithmetic},
    {MapFormat::r32f, VK_FORMAT_R32_SFLOAT, VK_FORMAT_D32_SFLOAT, kArithmetic},
    {MapFormat::rg16, VK_FORMAT_R16G16_UNORM, VK_FORMAT_D32_SFLOAT, 1.5F / 65535.0F + kArithmetic},
    {MapFormat::rg16f, VK_FORMAT_R16G16_SFLOAT, VK_FORMAT_D32_SFLOAT, 1.0F / 2048.0F},
    {MapFormat::rg32f, VK_FORMAT_R32G32_SFLOAT, VK_FORMAT_D32_SFLOAT, kArithmetic},
    {MapFormat::rgba16, VK_FORMAT_R16G16B16A16_UNORM, VK_FORMAT_D32_SFLOAT, 1.5F / 65535.0F + kArithmetic},
    {MapFormat::rgba16f, VK_FORMAT_R16G16B16A16_SFLOAT, VK_FORMAT_D32_SFLOAT, 1.0F / 2048.0F},
    {MapFormat::rgba32f, VK_FORMAT_R32G32B32A32_SFLOAT, VK_FORMAT_D32_SFLOAT, kArithmetic},
    {MapFormat::r16f, VK_FORMAT_R16_SFLOAT, VK_FORMAT_D32_SFLOAT, 1.0F / 2048.0F},
    {MapFormat::rgba8, VK_FORMAT_R8G8B8A8_UNORM, VK_FORMAT_D32_SFLOAT, 1.5F / 65535.0F + kArithmetic},
};

} // namespace

const MapStorage* findMapStorage(MapFormat format)
{
    const auto* found = std::find_if(std::begin(kStorages), std::end(kStorages),
                                     [&](const MapStorage& storage) { return storage.format == format; });
    return found != std::end(kStorages) ? found : nullptr;
}

int depthHolding(Filter filter, MapFormat format)
{
    if (isFilterable(filter)) {
        return shared::kDepthAlone;
    }
    return format == MapFormat::rg16    ? shared::kDepthChannel
           : format == MapFormat::rgba8 ? shared::kDepthBytes
                                        : shared::kDepthAlone;
}

VkColorComponentFlags colourMaskOf(VkFormat colour, TexelPart part)
{
    constexpr VkColorComponentFlags kFirst = VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT;
    constexpr VkColorComponentFlags kSecond = VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT;
    if (colour == VK_FORMAT_UNDEFINED) {
        return 0;
    }
    const bool is_first = part == TexelPart::first;
    if (part != TexelPart::whole && colour == VK_FORMAT_R16G16_UNORM) {
        return is_first ? VK_COLOR_COMPONENT_R_BIT : VK_COLOR_COMPONENT_G_BIT;
    }
    if (part != TexelPart::whole && colour == VK_FORMAT_R8G8B8A8_UNORM) {
        return is_first ? kFirst : kSecond;
    }
    return kFirst | kSecond;
}

void requireAveraging(VkFormatFeatureFlags features, Filter filter, MapFormat format, const char* what)
{
    struct Need {
        VkFormatFeatureFlags feature;
        const char* verb;
    };
    constexpr Need kNeeds[] = {{VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT, "write in shaders to"},
                               {VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT, "draw to"},
                               {VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT, "filter linearly"}};
    for (const Need& need : kNeeds) {
        if ((features & need.feature) == 0) {
            // Of all formats here, Vulkan asks every device for all three of this one alone.
            const bool is_usable = !refusal(filter, MapFormat::rgba16f);
            throw Error(
                what, std::string("the device cannot ") + need.verb + " maps of format " + std::string(nameOf(format)),
                is_usable ? "choose map format rgba16f, which every device can do this with"
                          : "choose another map format, or filter evsm with rgba16f, which every device can do "
                            "this with");
        }
    }
}

} // namespace gnomon::vulkan
