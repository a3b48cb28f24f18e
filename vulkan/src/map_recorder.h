// SPDX-License-Identifier: Apache-2.0
// What the renderer knows of the passes that draw maps. Two kinds: DepthMaps (map_pass.h) draws them and is done;
// MomentMaps (moment_maps.h) draws depth and makes a filterable map of it.
#pragma once

#include "device.h"

namespace gnomon::vulkan {

class MapRecorder {
public:
    MapRecorder() = default;
    virtual ~MapRecorder() = default;
    MapRecorder(const MapRecorder&) = delete;
    MapRecorder& operator=(const MapRecorder&) = delete;

    /// Makes the images and buffers if the plan does not fit; true when it did.
    virtual bool prepare(const Plan& plan) = 0;
    /// See ShadowRenderer::setCascadePass. Never layered where drawsTogether() is false.
    virtual void setPass(CascadePass /*pass*/) {}
    [[nodiscard]] virtual bool drawsTogether() const { return false; }
    /// Every view is drawn at the next record(), whatever it says.
    virtual void forget() = 0;
    [[nodiscard]] virtual bool redrawsAll() const = 0;
    virtual void record(VkCommandBuffer commands, std::uint32_t slot, const Plan& plan, const DrawCasters& draw,
                        Profiler* profiler) = 0;
    /// Brings layers that were never drawn into the layout that the mask pass reads them in.
    virtual void makeReadable(VkCommandBuffer commands) = 0;
    [[nodiscard]] virtual const Image& maps() const = 0;
    [[nodiscard]] virtual MapPassFormats formats(bool orthographic) const = 0;
    [[nodiscard]] virtual FilterCost cost(std::uint32_t slot) const = 0;
};

} // namespace gnomon::vulkan
