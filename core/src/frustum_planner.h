// SPDX-License-Identifier: Apache-2.0
// From one slice of a light to a view: what matters to it, how that is put into a map, and who is drawn.
#pragma once

#include "depth_range.h"
#include "recipe.h"
#include "region.h"

#include <span>
#include <vector>

namespace gnomon {

struct FrustumInput {
    const Frame& frame;
    const Recipe& recipe;
    const CameraView& camera;                 // measured or bounded, as the recipe needs it
    std::span<const std::uint32_t> receivers; // that the camera sees
    std::span<const std::uint32_t> levellers; // by whom level depth is measured
    const Light& light;                       // shining from where the map is drawn
    const Slice& slice;
    std::uint32_t map_size = 0; // texels on a side
};

class FrustumPlanner {
public:
    /// ok or fallback: fills in all of `view` but whose it is, where its map is and what of it is to be drawn, and
    /// appends its casters, ascending. Else both are as they were. Keeps its memory.
    Outcome plan(const FrustumInput& input, View& view, std::vector<std::uint32_t>& casters);

private:
    [[nodiscard]] Warp warpOf(const FrustumInput& input, const LightSpace& space, double border_texels) const;
    void measureDepth(const LightSpace& space, const DepthRange& range, View& view) const;

    Region region_;
};

} // namespace gnomon
