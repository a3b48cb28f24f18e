// SPDX-License-Identifier: Apache-2.0
// The maps of one of a plan's options: how they are stored, what draws and filters them, and where their layers of
// depth lie.
#pragma once

#include "layer_placer.h"
#include "map_recorder.h"
#include "map_storage.h"
#include "tint_maps.h"

#include <memory>

namespace gnomon::vulkan {

class Classics;

class MapClass {
public:
    /// Throws Error where the device cannot do what the options ask for.
    /// `classics`: not null where the options need them.
    MapClass(Device& device, const ResolvedOptions& options, std::uint32_t slots, VkPipelineCache cache,
             const Classics* classics);

    /// Can it go on with other options? Only what their maps are made by counts.
    [[nodiscard]] bool serves(const ResolvedOptions& options) const;

    [[nodiscard]] bool filterable() const { return filterable_; }
    [[nodiscard]] bool hasIds() const { return has_ids_; }

    LayerPlacer placer;
    std::unique_ptr<MapRecorder> recorder;
    TintMaps tints;

private:
    bool filterable_;
    bool has_ids_;
    Filter filter_;
    MapFormat format_;
    std::uint32_t smoothies_;
    MomentOptions moments_;
};

} // namespace gnomon::vulkan
