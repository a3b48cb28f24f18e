// SPDX-License-Identifier: Apache-2.0
#include "map_storage.h"

#include <gnomon/error.h>
#include <gnomon/pack/map_attachments.h>

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
    const pack::MapAttachments made = pack::mapAttachments(options, orthographic);
    return {made.colour ? mapStorage(*made.colour).colour : VK_FORMAT_UNDEFINED, mapStorage(made.depth).depth,
            static_cast<VkSampleCountFlagBits>(made.samples), made.write_depth};
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
    static_assert(VK_COLOR_COMPONENT_R_BIT == 1 && VK_COLOR_COMPONENT_A_BIT == 8);
    if (colour == VK_FORMAT_UNDEFINED) {
        return 0;
    }
    const auto* found = std::find_if(std::begin(kStorages), std::end(kStorages),
                                     [&](const MapStorage& storage) { return storage.colour == colour; });
    assert(found != std::end(kStorages));
    return pack::channelsOfPart(found->format, part);
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
