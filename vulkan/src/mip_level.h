// SPDX-License-Identifier: Apache-2.0
// Which mip levels of its tile a view has.
#pragma once

#include <gnomon/plan.h>

#include <algorithm>
#include <bit>
#include <cstdint>

namespace gnomon::vulkan {

/// The coarsest mip level whose texels lie in one tile, each over whole texels of the next finer level. `levels`: of
/// the map's image, at least 1.
[[nodiscard]] inline std::uint32_t coarsestLevel(const Tile& tile, std::uint32_t levels)
{
    const std::uint32_t edges = tile.x | tile.y | tile.width | tile.height;
    return std::min(static_cast<std::uint32_t>(std::countr_zero(edges)), levels - 1);
}

} // namespace gnomon::vulkan
