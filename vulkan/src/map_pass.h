// SPDX-License-Identifier: Apache-2.0
// Maps that are drawn and then read as they are: an atlas of depths, in a depth format or a colour format. A view with
// a kept layer is drawn in two parts: what stands still into the kept layer, from which the map is restored where
// something moves, and what moves over that. Views of one light's cascades can be drawn in one pass.
#pragma once

#include "layered_target.h"
#include "map_recorder.h"
#include "map_restore.h"
#include "map_storage.h"

#include <optional>

namespace gnomon::vulkan {

class DepthMaps final : public MapRecorder {
public:
    DepthMaps(Device& device, const ShadowRendererOptions& options, const MapStorage& storage);

    bool prepare(const Plan& plan) override;
    void setPass(CascadePass pass) override { pass_ = pass; }
    [[nodiscard]] bool drawsTogether() const override { return true; }
    void forget() override { redraw_all_ = true; }
    [[nodiscard]] bool redrawsAll() const override { return redraw_all_; }
    void record(VkCommandBuffer commands, std::uint32_t slot, const Plan& plan, const DrawCasters& draw,
                Profiler* profiler) override;
    void makeReadable(VkCommandBuffer commands) override { maps_.makeReadable(commands); }
    [[nodiscard]] const Image& maps() const override { return maps_.image(); }
    [[nodiscard]] MapPassFormats formats(bool orthographic) const override;
    [[nodiscard]] FilterCost cost(std::uint32_t) const override { return {}; }

private:
    // Where a view is drawn to, or several.
    struct Target {
        VkImageView colour = VK_NULL_HANDLE;
        VkImageView depth = VK_NULL_HANDLE;
        bool clears_colour = false; // all that was there
        bool keeps_depth = false;   // it is needed after the pass
        VkRect2D area{};
        std::uint32_t layer_count = 1;
    };
    // Layers of the maps that are drawn together.
    struct Layers {
        std::uint32_t first = 0;
        std::uint32_t count = 0;
        ImageView view;
    };

    void makeMaps(const MapPages& size);
    void makeKept(std::uint32_t layers);
    void prepareTogether(const Plan& plan);
    [[nodiscard]] std::uint32_t together(const Plan& plan, std::uint32_t first, bool all) const;
    void drawKept(VkCommandBuffer commands, const Plan& plan, const DrawCasters& draw);
    void drawMaps(VkCommandBuffer commands, const Plan& plan, const DrawCasters& draw);
    void drawMap(VkCommandBuffer commands, const Plan& plan, std::uint32_t index, const DrawCasters& draw);
    void drawTogether(VkCommandBuffer commands, const Plan& plan, std::uint32_t first, std::uint32_t count,
                      const DrawCasters& draw);
    void beginRendering(VkCommandBuffer commands, const Tile& tile, const Target& target);
    [[nodiscard]] Target mapTarget(const View& view) const;
    [[nodiscard]] Target keptTarget(const View& view) const;
    [[nodiscard]] Target targetOf(const Tile& tile, std::uint32_t count) const;
    [[nodiscard]] const Layers* layersFrom(std::uint32_t first) const;
    void waitForDepth(VkCommandBuffer commands);

    Device& device_;
    const MapStorage& storage_;
    VkPipelineCache cache_;
    LayeredTarget maps_;
    Image depth_; // of a map in a colour format: decides which fragment wins, then is forgotten; a layer for each view
    std::vector<Layers> layers_; // views of maps_
    CascadePass pass_ = CascadePass::each;
    LayeredTarget kept_colours_;
    LayeredTarget kept_depths_;
    std::optional<MapRestorer> restorer_; // made when first needed
    bool redraw_all_ = true;
};

} // namespace gnomon::vulkan
