// SPDX-License-Identifier: Apache-2.0
// Maps that are drawn and then read as they are: an atlas of depths, in a depth format or a colour format.
#pragma once

#include "map_recorder.h"
#include "map_storage.h"

namespace gnomon::vulkan {

class DepthMaps final : public MapRecorder {
public:
    DepthMaps(Device& device, const MapStorage& storage) : device_(device), storage_(storage) {}

    bool prepare(const Plan& plan) override;
    void forget() override { redraw_all_ = true; }
    void record(VkCommandBuffer commands, std::uint32_t slot, const Plan& plan, const DrawCasters& draw,
                Profiler* profiler) override;
    void makeReadable(VkCommandBuffer commands) override;
    [[nodiscard]] const Image& maps() const override { return maps_; }
    [[nodiscard]] MapPassFormats formats(bool orthographic) const override;
    [[nodiscard]] FilterCost cost(std::uint32_t) const override { return {}; }

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
