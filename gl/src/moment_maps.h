// SPDX-License-Identifier: Apache-2.0
// Filterable maps: casters are drawn as depths, which become the filter's stored values, blurred or not, and mip
// levels. Layers of lvsm are placed between. All of a tile is made, however little of it has changed.
#pragma once

#include "map_recorder.h"

#include <gnomon/pack/filter_passes.h>

namespace gnomon::gl {

class MomentMaps final : public MapRecorder {
public:
    /// Throws Error where the context cannot filter the format.
    MomentMaps(const Context& context, Programs& programs, const ResolvedOptions& options);

    Prepared prepare(const Plan& plan, std::uint32_t options) override;
    void draw(const MapJob& job) override;
    [[nodiscard]] bool covers(const Plan& plan, const View& view) const override;
    [[nodiscard]] const Image& maps() const override { return maps_; }
    [[nodiscard]] GLuint depthLayers() const override { return layers_.name(); }

private:
    void growMaps(const Plan& plan, std::uint32_t options, Prepared& prepared);
    void growWorking(const Plan& plan, std::uint32_t options);
    void growLayers(const Plan& plan);
    void drawDepth(const MapJob& job, std::uint32_t view);
    void placeLayers(const MapJob& job, std::uint32_t view, std::uint32_t slot);
    void filter(const pack::FilterStep& step);
    /// Binds the source of a pass, and the image that it writes at this level.
    void bind(GLuint source, const Sampler& sampler, const Image& target, std::uint32_t level);
    void run(const char* module, const shared::FilterPassPlace& place, std::uint32_t x, std::uint32_t y,
             std::uint32_t z);

    const Context& context_;
    Programs& programs_;
    ResolvedOptions options_;
    MapStorage storage_;
    std::uint32_t layers_per_map_;
    Target target_;
    Sampler nearest_;
    Sampler linear_;
    Image maps_;
    std::vector<Texture> levels_; // of the maps, as textures of their own
    Image depth_;                 // drawn and read view by view, each from the first texel on
    Image kept_;                  // depths of still casters
    Image scratch_;               // a tile blurred along x
    pack::ScratchStrips strips_;
    Buffer blocks_; // flags of the tile's blocks
    Buffer kernel_;
    Buffer counts_; // of what was blurred, which nobody asks for here
    Buffer layers_; // GpuDepthLayers by slot
    Buffer sums_;   // histogram of depths
    std::uint32_t layer_slots_ = 0;
    pack::LayerSteps steps_;
    std::vector<std::uint32_t> constants_;
};

} // namespace gnomon::gl
