// SPDX-License-Identifier: Apache-2.0
#include "map_storage.h"

#include <gnomon/error.h>

#include <algorithm>
#include <cassert>
#include <iterator>
#include <string>

namespace gnomon::vulkan {
namespace {

constexpr MapStorage kStorages[] = {
    {MapFormat::d16, VK_FORMAT_UNDEFINED, VK_FORMAT_D16_UNORM},
    {MapFormat::d32f, VK_FORMAT_UNDEFINED, VK_FORMAT_D32_SFLOAT},
    {MapFormat::r32f, VK_FORMAT_R32_SFLOAT, VK_FORMAT_D32_SFLOAT},
    {MapFormat::rg16, VK_FORMAT_R16G16_UNORM, VK_FORMAT_D32_SFLOAT},
    {MapFormat::rg16f, VK_FORMAT_R16G16_SFLOAT, VK_FORMAT_D32_SFLOAT},
    {MapFormat::rg32f, VK_FORMAT_R32G32_SFLOAT, VK_FORMAT_D32_SFLOAT},
    {MapFormat::rgba16, VK_FORMAT_R16G16B16A16_UNORM, VK_FORMAT_D32_SFLOAT},
    {MapFormat::rgba16f, VK_FORMAT_R16G16B16A16_SFLOAT, VK_FORMAT_D32_SFLOAT},
    {MapFormat::rgba32f, VK_FORMAT_R32G32B32A32_SFLOAT, VK_FORMAT_D32_SFLOAT},
    {MapFormat::r16f, VK_FORMAT_R16_SFLOAT, VK_FORMAT_D32_SFLOAT},
    {MapFormat::rgba8, VK_FORMAT_R8G8B8A8_UNORM, VK_FORMAT_D32_SFLOAT},
    {MapFormat::d24, VK_FORMAT_UNDEFINED, VK_FORMAT_X8_D24_UNORM_PACK32},
    {MapFormat::r8, VK_FORMAT_R8_UNORM, VK_FORMAT_D32_SFLOAT},
    {MapFormat::r16, VK_FORMAT_R16_UNORM, VK_FORMAT_D32_SFLOAT},
    {MapFormat::rg8, VK_FORMAT_R8G8_UNORM, VK_FORMAT_D32_SFLOAT},
};

} // namespace

const MapStorage& mapStorage(MapFormat format)
{
    const auto* found = std::find_if(std::begin(kStorages), std::end(kStorages),
                                     [&](const MapStorage& storage) { return storage.format == format; });
    assert(found != std::end(kStorages));
    return *found;
}

MapPassFormats mapFormats(const ResolvedOptions& options, bool orthographic)
{
    const MapStorage& storage = mapStorage(options.format());
    if (options.filterable()) { // moments are made of the depths
        return {VK_FORMAT_UNDEFINED, storage.depth, static_cast<VkSampleCountFlagBits>(options.moments().samples),
                !orthographic};
    }
    const bool paraboloid = options.technique().partition == Partition::paraboloid; // the rasteriser's own says nothing
    const bool over_w = options.metric() == DepthMetricKind::z_over_w;              // the rasteriser's own
    return {storage.colour, storage.depth, VK_SAMPLE_COUNT_1_BIT,
            paraboloid || (storage.depthOnly() && !orthographic && !over_w)};
}

ClassicFormats classicFormats(const ResolvedOptions& options)
{
    ClassicFormats formats;
    formats.back_faces = options.asked().faces == CasterFaces::back;
    formats.cull = options.asked().cull;
    if (!options.filterable()) {
        formats.ids = options.traits().ids;
        formats.pieces = formats.ids && options.ids().of == IdOf::face;
        formats.paraboloid = options.technique().partition == Partition::paraboloid;
    }
    return formats;
}

float depthRounding(VkFormat depth)
{
    return depth == VK_FORMAT_D16_UNORM ? 1.0F / 65535.0F : 1.0F / 8388608.0F; // a step; two steps of a float below 1
}

VkColorComponentFlags colourMaskOf(VkFormat colour, TexelPart part)
{
    constexpr VkColorComponentFlags kFirst = VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT;
    constexpr VkColorComponentFlags kSecond = VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT;
    if (colour == VK_FORMAT_UNDEFINED) {
        return 0;
    }
    const bool is_first = part == TexelPart::first;
    if (part != TexelPart::whole && (colour == VK_FORMAT_R16G16_UNORM || colour == VK_FORMAT_R16G16_SFLOAT)) {
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
            // Vulkan requires all three only for this one of the formats here.
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
