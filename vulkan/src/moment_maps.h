// SPDX-License-Identifier: Apache-2.0
// Filterable maps: casters are drawn as depths. These become the filter's stored values, unblurred (moment_pass.h) or
// blurred (blur_pass.h), and are averaged into mip levels (mip_pass.h). For a view with a kept layer the still casters'
// depths are drawn into that layer and copied from there; then the moving casters are drawn over them. All of the tile
// is copied and filtered, however little of it has changed.
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
    MomentMaps(Device& device, const ResolvedOptions& options, const MapStorage& storage, LayerPlacer& placer,
               std::uint32_t slots, VkPipelineCache cache);

    /// Prepares the layers of depth, too.
    Prepared prepare(const Plan& plan, std::uint32_t options) override;
    void record(const MapJob& job) override;
    void makeReadable(VkCommandBuffer commands) override;
    [[nodiscard]] const Image& maps() const override { return images_.maps; }
    [[nodiscard]] FilterCost cost(std::uint32_t slot) const override;

private:
    struct Need {
        MapPages atlas;
        VkExtent2D tile{1, 1}; // that all tiles fit into
        std::uint32_t kept_layers = 0;
    };

    [[nodiscard]] static Need needOf(const Plan& plan, std::uint32_t options);
    [[nodiscard]] VkSampleCountFlagBits samples() const
    {
        return static_cast<VkSampleCountFlagBits>(options_.moments().samples);
    }
    /// Did what maps held get lost?
    [[nodiscard]] bool growMaps(const MapPages& atlas);
    void growWorking(VkExtent2D tile);
    void makeSets();
    void toLayout(VkCommandBuffer commands, VkImageLayout layout);
    void fillNewImages(VkCommandBuffer commands);
    void recordDepth(const MapJob& job, std::uint32_t view);
    void recordFilter(const MapJob& job, std::uint32_t view);
    [[nodiscard]] shared::BlurCounts& counts(std::uint32_t slot) const;

    Device& device_;
    ResolvedOptions options_;
    const MapStorage& storage_;
    LayerPlacer& placer_;
    std::uint32_t slots_;
    std::uint32_t counts_stride_;
    std::uint32_t layers_per_map_;
    FilterLayout layout_;
    std::optional<MomentPass> moments_; // or else
    std::optional<BlurPass> blur_;
    MipPass mips_;
    MomentImages images_;
    KeptDepth kept_;
    bool ready_ = false; // images and sets are all there
    VkImageLayout layout_of_maps_ = VK_IMAGE_LAYOUT_UNDEFINED;
    OutgrownImage outgrown_; // maps
    bool clear_maps_ = false;
    bool clear_scratch_ = false;
};

} // namespace gnomon::vulkan
