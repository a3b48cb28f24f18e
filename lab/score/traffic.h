// SPDX-License-Identifier: Apache-2.0
// The least that a technique must move to and from memory, by counting.
#pragma once

#include "lab/score/texel_density.h"

#include <gnomon/choices.h>
#include <gnomon/frame.h>
#include <gnomon/plan.h>

#include <cstdint>
#include <optional>
#include <span>

namespace gnomon::lab {

/// Texels of a view's map and of its kept layer that a frame renders; where a map is restored from a kept layer, only
/// the texels drawn over. `redraws_all`: all maps are drawn.
[[nodiscard]] std::uint64_t texelsRendered(const View& view, bool redraws_all);

/// The facts of a frame, besides plan and picture, that leastBytes() needs.
struct TrafficOptions {
    MapFormat format = MapFormat::d32f;
    double reach_texels = 0.5;      // how far the mask pass reads, along x and y each; >= 0.5
    std::uint32_t image_layers = 1; // image layers of one map
    std::uint32_t mip_levels = 1;
    bool redraws_all = true;      // false: only views that say `redraw` are drawn
    bool reads_object_ids = true; // the mask pass is given object ids
    std::uint32_t samples = 1;    // pixels of the mask for each pixel of the picture
    // For leastByPass() alone:
    bool filterable = false;         // the map is made of depths by a pass of its own
    std::uint32_t depth_samples = 1; // depths to each of its texels
    bool blurred = false;            // along rows and columns, a pass each
};

inline constexpr std::uint64_t kDepthBytes = 4;    // D32F
inline constexpr std::uint64_t kNormalBytes = 4;   // two 16-bit numbers, octahedral
inline constexpr std::uint64_t kObjectIdBytes = 4; // R32_UINT

/// The bytes that no way of drawing these maps and this mask can do without: each texel that is rendered, written once;
/// each texel that a pixel facing its light (facingPixels()) reads, read once; and for each pixel of the mask depth,
/// normal and object id read and the mask written once. Cache misses, depth tests, clearing, compression and the host's
/// own passes do not count. A texel of a filterable map is written in every image layer and in the mip levels above it
/// that its tile has, and read in one; its depths and the traffic of its blur do not count, for they could stay on the
/// chip: the blur has a minimum of its own (FilterCost). With several samples to a pixel, the texels are those that the
/// pixels' own places read. Reading the layer that a map is restored from does not count: the still casters could be
/// drawn again. 0 where the plan has no lights. `lights` are those of the plan's frame.
[[nodiscard]] std::uint64_t leastBytes(const Sight& seen, std::span<const Light> lights, const Plan& plan,
                                       const TrafficOptions& options);

/// The work of one pass of a frame, and the least bytes that it moves.
struct PassLeast {
    std::uint64_t texels = 0; // texels of the maps that it makes, or pixels of the mask
    std::uint64_t bytes = 0;
};
/// The least by pass. Nothing where the plan has no such pass, or where no least is known: the filter of maps of
/// depths.
struct LeastByPass {
    std::optional<PassLeast> maps;
    std::optional<PassLeast> filter;
    std::optional<PassLeast> mask;
};

/// The least that a filtered map moves between drawing and reading: each texel is of b bytes in each of L image layers,
/// made of s depths of kDepthBytes.
///
///     depths written by the map pass, read by the filter   2 * 4 s
///     the map written                                      b L
///     blurred along rows, then along columns               2 (b L read + b L written)
///     levels 1, 2, ...: 1/4 + 1/16 + ... = 1/3             b L / 3 written, 4 b L / 3 read: each level but the last
///
/// Together 8 s + (1 + 4 + 5/3) b L, which is 8 + 6.67 b of one layer and one sample. The depths' half that is written
/// is the map pass's, the rest the filter's. Levels end where a tile's texels are whole no more, so the sum is a little
/// less than 1/3. Unlike leastBytes(), which counts what any way must move, this counts a map that goes through memory
/// between its passes; one pass that does the work of two may stay below it.
///
/// A map of depths is written once, b bytes a texel. The mask needs the camera's depth (kDepthBytes) once for each of
/// its pixels, and writes a byte for each of their channels. With MaskSize::half a quarter as many bytes are written
/// before and read again.
///
/// `pixels`: of the picture. Views whose maps are not drawn do not count (TrafficOptions::redraws_all).
[[nodiscard]] LeastByPass leastByPass(const Plan& plan, std::uint64_t pixels, const TrafficOptions& options);

} // namespace gnomon::lab
