// SPDX-License-Identifier: Apache-2.0
// Filterable maps: casters are drawn as depths, which become what a filter's texels store (moment_pass.h), are blurred
// (blur_pass.h) and averaged into mip levels (mip_pass.h). Of a view with a kept layer the depths of what stands still
// are drawn into that layer and copied from there; then what moves is drawn over them. All of the tile is copied and
// filtered, however little of it has changed.
#pragma once

#include "blur_pass.h"
#include "kept_depth.h"
#include "layer_placer.h"
#include "map_recorder.h"
#include "map_storage.h"
#include "mip_pass.h"
#include "moment_pass.h"

#include <optional>

namespace gnomon::vulkan {

class MomentMaps final : public MapRecorder {
public:
    /// Throws Error when the device cannot do with the format what these passes do.
    MomentMaps(Device& device, const ShadowRendererOptions& options, const MapStorage& storage, LayerPlacer& placer);

    /// Prepares the layers of depth, too.
    bool prepare(const Plan& plan) override;
    void forget() override { redraw_all_ = true; }
    [[nodiscard]] bool redrawsAll() const override { return redraw_all_; }
    void record(VkCommandBuffer commands, std::uint32_t slot, const Plan& plan, const DrawCasters& draw,
                Profiler* profiler) override;
    void makeReadable(VkCommandBuffer commands) override;
    [[nodiscard]] const Image& maps() const override { return images_.maps; }
    [[nodiscard]] MapPassFormats formats(bool orthographic) const override;
    [[nodiscard]] FilterCost cost(std::uint32_t slot) const override;

private:
    struct Need {
        MapPages atlas;
        VkExtent2D tile{}; // that all tiles fit into
        std::uint32_t kept_layers = 0;
    };

    [[nodiscard]] static Need needOf(const Plan& plan);
    [[nodiscard]] bool fits(const Need& need) const;
    void makeImages(const Need& need);
    void makeSets();
    void toLayout(VkCommandBuffer commands, VkImageLayout layout);
    void clearNewImages(VkCommandBuffer commands);
    void recordDepth(VkCommandBuffer commands, const Plan& plan, std::uint32_t view, const DrawCasters& draw);
    void recordFilter(VkCommandBuffer commands, std::uint32_t slot, const Plan& plan, std::uint32_t view);
    [[nodiscard]] shared::BlurCounts& counts(std::uint32_t slot) const;

    Device& device_;
    FilterOptions filter_;
    const MapStorage& storage_;
    LayerPlacer& placer_;
    std::uint32_t slots_;
    std::uint32_t counts_stride_;
    std::uint32_t layers_per_map_;
    FilterLayout layout_;
    MomentPass moments_;
    std::optional<BlurPass> blur_;
    MipPass mips_;
    MomentImages images_;
    KeptDepth kept_;
    bool ready_ = false; // images and sets are all there
    VkImageLayout layout_of_maps_ = VK_IMAGE_LAYOUT_UNDEFINED;
    bool cleared_ = false;
    bool redraw_all_ = true;
};

} // namespace gnomon::vulkan
