// SPDX-License-Identifier: Apache-2.0
// The inputs of the passes that turn drawn depths into a filterable map, of those that place layers of lvsm, and of
// those that make blocks of depths: constants and push constants of shaders/passes/moments.comp, blur_moments.comp,
// blur.comp, mip.comp, depth_layers*.comp and depth_blocks.comp.
#pragma once

#include <gnomon/export.h>
#include <gnomon/options.h>
#include <gnomon/plan.h>

#include <gnomon/shared/filter_pass.h>
#include <gnomon/shared/layer_placing.h>

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace gnomon::pack {

/// The constant_ids of gnomon/lib/filter_pass.glsl, four bytes each, in their order.
struct FilterConstants {
    std::int32_t filter = 0;        // gnomon::Filter
    std::int32_t flags = 0;         // MomentRule::flags
    std::int32_t layers = 0;        // of lvsm
    float exponent = 0.0F;          // MomentRule::exponent
    float exponent_negative = 0.0F; // MomentRule::exponent_negative
    float moment_bias = 0.0F;       // MomentRule::moment_bias
    std::int32_t radius = 0;        // blurRadius()
    std::int32_t channels = 4;      // channels of the format
};
/// The constants of these options. Precondition: options.filterable().
[[nodiscard]] GNOMON_API FilterConstants filterConstants(const ResolvedOptions& options);

/// How a tile lies in the scratch image of a blur: cut into strips of this width, each in a layer
/// (gnomon/lib/scratch.glsl).
struct ScratchStrips {
    std::uint32_t width = shared::kBlockTexels; // texels
    std::uint32_t count = 1;                    // for each image layer of the map
};
/// As narrow as blocks, or as wide as it takes for all strips to have a layer.
[[nodiscard]] GNOMON_API ScratchStrips stripsOf(std::uint32_t tile_width, std::uint32_t image_layers,
                                                std::uint32_t most_layers);
/// How many groups of `size` it takes for `count`.
[[nodiscard]] constexpr std::uint32_t groupsOf(std::uint32_t count, std::uint32_t size)
{
    return (count + size - 1) / size;
}

/// One view's map.
struct FilterStep {
    Tile tile;                      // in the maps' image
    std::uint32_t first_layer = 0;  // layer of the maps' image
    std::uint32_t image_layers = 1; // imageLayersPerMap()
    ScratchStrips strips;           // of the scratch image
    std::uint32_t depth_slot = 0;   // depthLayersSlot() for lvsm, else 0
    float near_over_far = 1.0F;     // of the view's metric; 1 under a parallel light
};
/// nearOverFar for FilterStep and the passes of layers.
[[nodiscard]] GNOMON_API float nearOverFar(const View& view, const DepthMetric& metric);
/// From and to the view's tile in the maps.
[[nodiscard]] GNOMON_API shared::FilterPassPlace placeOf(const FilterStep& step);
/// From the image that the view's depths were drawn to, from its first texel on, to the tile.
[[nodiscard]] GNOMON_API shared::FilterPassPlace placeFromDepths(const FilterStep& step);
/// From mip level `level` - 1 to `level`, 1 to coarsestLevel().
[[nodiscard]] GNOMON_API shared::FilterPassPlace placeOfLevel(const FilterStep& step, std::uint32_t level);

/// Places the layers of lvsm maps from frame to frame: push constants of the passes that find them in the drawn
/// depths, and a note of the metric that each slot's layers were placed in. Not thread-safe.
class GNOMON_API LayerSteps {
public:
    /// The steps of maps with these options.
    explicit LayerSteps(const ResolvedOptions& options) : options_(options) {}

    /// Does a pass look for the layers in what was drawn?
    [[nodiscard]] bool finds() const;
    /// Are they layers of the world, which worldDepthLayers() has?
    [[nodiscard]] bool areOfWorld() const;
    /// Makes room for this many slots. Was any placed before?
    bool resize(std::uint32_t slots);
    /// The push constants of depth_layers_histogram.comp or depth_layers_gaps.comp, for depths that begin at texel 0.
    [[nodiscard]] shared::GpuHistogramPush histogram(const View& view) const;
    /// The push constants of depth_layers_place.comp or depth_layers_part.comp. `now`: the options of this plan, whose
    /// motion may be another one. Precondition: there is such a slot.
    [[nodiscard]] shared::GpuPlacePush place(const ResolvedOptions& now, const View& view, std::uint32_t slot) const;
    /// The layers of this slot are placed for this view.
    void note(const View& view, std::uint32_t slot);

private:
    // The map that layers were placed for; nothing is placed yet without a metric.
    struct Slot {
        MapId map;
        std::uint32_t light = kNoIndex; // tells maps without a name apart
        std::optional<DepthMetric> metric;
    };

    ResolvedOptions options_;
    std::vector<Slot> slots_;
};

/// A pass that makes two levels of blocks of a map's depths, or the last one alone.
struct BlockPass {
    std::array<std::int32_t, 4> first{}; // push constant of depth_blocks.comp: the first group, the layer, levels made
    std::array<std::int32_t, 4> last{};  // the next: the last texel, or block, to be read, along x and y
    std::uint32_t first_level = 0;       // mip level that is made, the next with it. 0: from the maps' texels
    std::uint32_t groups_x = 0;          // groups to dispatch along x
    std::uint32_t groups_y = 0;          // groups to dispatch along y
};
/// How many passes make `levels` levels (blockLevels()).
[[nodiscard]] GNOMON_API std::uint32_t blockPassCount(std::uint32_t levels);
/// Pass `index` of them over this part of a page of maps of `size_px`.
[[nodiscard]] GNOMON_API BlockPass blockPass(std::uint32_t index, const glm::uvec2& size_px, const Tile& part);

} // namespace gnomon::pack
