// SPDX-License-Identifier: Apache-2.0
// The least that a technique must move to and from memory, by counting.
#pragma once

#include "lab/score/texel_density.h"

#include <gnomon/choices.h>
#include <gnomon/frame.h>
#include <gnomon/plan.h>

#include <cstdint>
#include <span>

namespace gnomon::lab {

/// Of one texel of a map, colour or depth as the filter reads it.
[[nodiscard]] std::uint32_t texelBytes(MapFormat format);

/// Texels of a view's map and of its kept layer that a frame renders; where a map is restored from a kept layer, what
/// is drawn over. `redraws_all`: whatever they hold.
[[nodiscard]] std::uint64_t texelsRendered(const View& view, bool redraws_all);

/// What leastBytes() needs to know of a frame besides plan and picture.
struct TrafficOptions {
    MapFormat format = MapFormat::d32f;
    double reach_texels = 0.5;      // how far the mask pass reads, along x and y each; >= 0.5
    std::uint32_t image_layers = 1; // of one map
    std::uint32_t mip_levels = 1;
    bool redraws_all = true;      // false: of the views only those that say `redraw` are drawn
    bool reads_object_ids = true; // the mask pass is given object ids
    std::uint32_t samples = 1;    // pixels of the mask for each pixel of the picture
};

inline constexpr std::uint64_t kDepthBytes = 4;    // D32F
inline constexpr std::uint64_t kNormalBytes = 4;   // two 16-bit numbers, octahedral
inline constexpr std::uint64_t kObjectIdBytes = 4; // R32_UINT

/// The bytes that no way of drawing these maps and this mask can do without: each texel that is rendered, written once;
/// each texel that a pixel facing its light (facingPixels()) reads, read once; and for each pixel of the mask depth,
/// normal and object id read and the mask written once. Caches that miss, depth tests, clearing and compression play no
/// part; nor does anything of the host's. A texel of a filterable map is written in every image layer and in the mip
/// levels above it that its tile has, and read in one; the depths that it is made of and what its blur moves in between
/// do not count, for they could stay on the chip: the blur has a minimum of its own (FilterCost). With several samples
/// to a pixel, the texels are those that the pixels' own places read. What a map is restored from is not read here: the
/// still casters could be drawn again. 0 where the plan has no lights. `lights` are
/// those of the plan's frame.
[[nodiscard]] std::uint64_t leastBytes(const Sight& seen, std::span<const Light> lights, const Plan& plan,
                                       const TrafficOptions& options);

} // namespace gnomon::lab
