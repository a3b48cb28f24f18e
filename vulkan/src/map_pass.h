// SPDX-License-Identifier: Apache-2.0
// The atlas of shadow maps and the passes that draw it.
#pragma once

#include "device.h"
#include "map_storage.h"

namespace gnomon::vulkan {

class MapPassRecorder {
public:
    MapPassRecorder(Device& device, const MapStorage& storage) : device_(device), storage_(storage) {}

    /// Makes the images if the plan's atlas does not fit; true when it did.
    bool prepare(const AtlasSize& atlas);
    /// Every view is drawn at the next record(), whatever it says.
    void forget() { redraw_all_ = true; }
    void record(VkCommandBuffer commands, const Plan& plan, const DrawCasters& draw);
    /// Brings layers that were never drawn into the layout that the mask pass reads them in.
    void makeReadable(VkCommandBuffer commands);

    [[nodiscard]] const Image& maps() const { return maps_; }

private:
    [[nodiscard]] bool layerIsDrawn(const Plan& plan, std::uint32_t layer) const;
    void toAttachment(VkCommandBuffer commands, std::uint32_t layer);
    void toReadable(VkCommandBuffer commands, std::uint32_t layer);
    void recordView(VkCommandBuffer commands, const Plan& plan, std::uint32_t index, const DrawCasters& draw);
    void beginRendering(VkCommandBuffer commands, const Tile& tile);

    Device& device_;
    const MapStorage& storage_;
    Image maps_;
    Image depth_; // of a map in a colour format: decides which fragment wins, then is forgotten
    std::vector<VkImageLayout> layouts_;
    bool redraw_all_ = true;
};

} // namespace gnomon::vulkan
