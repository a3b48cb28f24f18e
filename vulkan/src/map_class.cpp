// SPDX-License-Identifier: Apache-2.0
#include "map_class.h"

#include "map_pass.h"
#include "moment_maps.h"
#include "optional_parts.h"

#include <gnomon/error.h>

namespace gnomon::vulkan {
namespace {

const MapStorage& storageFor(const Device& device, const ResolvedOptions& options)
{
    const MapStorage& storage = mapStorage(options.format());
    const VkFormatFeatureFlags attachment =
        storage.depthOnly() ? VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT : VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT;
    const VkFormatFeatureFlags needed = attachment | VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT;
    if ((device.features(storage.mapFormat()) & needed) != needed ||
        (device.features(storage.depth) & VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT) == 0) {
        throw Error("make shadow maps",
                    "the device cannot draw to and read maps of format " + std::string(nameOf(options.format())),
                    "choose another map format");
    }
    return storage;
}

/// Texels that they reach; 0: there are none.
std::uint32_t smoothiesOf(const ResolvedOptions& options)
{
    return options.hasSmoothies() ? options.asked().smoothies.reach_texels : 0;
}

std::unique_ptr<MapRecorder> makeRecorder(Device& device, const ResolvedOptions& options, LayerPlacer& placer,
                                          std::uint32_t slots, VkPipelineCache cache, const Classics* classics)
{
    const MapStorage& storage = storageFor(device, options);
    if (options.filterable()) {
        requirePart(device, "make filterable shadow maps", &FeatureUses::filterable);
        return std::make_unique<MomentMaps>(device, options, storage, placer, slots, cache);
    }
    return std::make_unique<DepthMaps>(device, storage, options, cache, classics);
}

} // namespace

MapClass::MapClass(Device& device, const ResolvedOptions& options, std::uint32_t slots, VkPipelineCache cache,
                   const Classics* classics)
    : placer(device, options, cache), recorder(makeRecorder(device, options, placer, slots, cache, classics)),
      tints(device), filterable_(options.filterable()), has_ids_(options.traits().ids), filter_(options.filter()),
      format_(options.format()), smoothies_(smoothiesOf(options)), moments_(options.moments())
{
}

bool MapClass::serves(const ResolvedOptions& options) const
{
    return filter_ == options.filter() && format_ == options.format() && smoothies_ == smoothiesOf(options) &&
           (!options.filterable() || moments_ == options.moments());
}

} // namespace gnomon::vulkan
