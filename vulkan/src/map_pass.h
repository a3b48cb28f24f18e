// SPDX-License-Identifier: Apache-2.0
// Maps that are drawn and then read as they are: an atlas of depths, in a depth format or a colour format. A view with
// a kept layer is drawn in two parts: what stands still into the kept layer, from which the map is restored where
// something moves, and what moves over that. Views of one light's cascades can be drawn in one pass.
#pragma once

#include "barriers.h"
#include "layered_target.h"
#include "map_recorder.h"
#include "map_restore.h"
#include "map_step.h"
#include "map_storage.h"

#include <memory>
#include <optional>

namespace gnomon::vulkan {

class Classics;

// An image that grows is copied into the larger one; hosts may copy maps, too.
inline constexpr VkImageUsageFlags kCopiedUsage = VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;

class DepthMaps final : public MapRecorder {
public:
    /// `classics`: not null where the options need them.
    DepthMaps(Device& device, const MapStorage& storage, const ResolvedOptions& options, VkPipelineCache cache,
              const Classics* classics);

    void warmUp(const ResolvedOptions& options) override;
    Prepared prepare(const Plan& plan, std::uint32_t options) override;
    void record(const MapJob& job) override;
    void makeReadable(VkCommandBuffer commands) override;
    [[nodiscard]] const Image& maps() const override { return maps_.image(); }
    [[nodiscard]] const Image* blocks() const override { return step_ ? &step_->image() : nullptr; }
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
    void makeKept(std::uint32_t layers, bool depths);
    [[nodiscard]] bool prepareKept(const Plan& plan, std::uint32_t options);
    void prepareTogether(const Plan& plan, std::uint32_t options);
    void copyOutgrown(VkCommandBuffer commands);
    void drawKept(const MapJob& job);
    void drawMaps(const MapJob& job);
    void drawMap(const MapJob& job, std::uint32_t index);
    void drawTogether(const MapJob& job, std::uint32_t first, std::uint32_t count);
    void beginRendering(VkCommandBuffer commands, const Tile& tile, const Target& target);
    [[nodiscard]] Target mapTarget(const View& view, const pack::ViewWork& work) const;
    [[nodiscard]] bool keepsDepth(const View& view) const;
    [[nodiscard]] MapRestorer::Source sourceFor(const View& view) const;
    [[nodiscard]] Target keptTarget(const View& view) const;
    void drawKept(const MapJob& job, std::uint32_t index);
    [[nodiscard]] Target targetOf(const Tile& tile, std::uint32_t count) const;
    [[nodiscard]] const Layers* layersFrom(std::uint32_t first) const;
    void waitForDepth(BarrierBatch& barriers);

    Device& device_;
    const MapStorage& storage_;
    float clear_; // value of a texel of a map in a colour format where nothing is drawn, in all channels
    VkPipelineCache cache_;
    const Classics* classics_;
    LayeredTarget maps_;
    Image depth_; // for maps in a colour format: decides which fragment wins, then is discarded; a layer for each view
    std::vector<Layers> layers_; // views of maps_
    LayeredTarget kept_colours_;
    LayeredTarget kept_depths_; // depths of views whose colours do not hold them (keepsDepth()); none where there is no
                                // such view
    std::optional<MapRestorer> restorer_;  // made when first needed
    std::unique_ptr<ViewPainter> painter_; // made when first needed
    std::unique_ptr<MapStep> step_;
};

} // namespace gnomon::vulkan
