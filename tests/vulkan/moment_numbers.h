// SPDX-License-Identifier: Apache-2.0
// The numbers that the library derives from a filterable map's options, as plain numbers: the library counts in single
// precision and the reference in double, and one file cannot include the shaders' headers for both.
#pragma once

#include <gnomon/plan.h>
#include <gnomon/vulkan/shadow_renderer.h>

namespace gnomon::test {

struct MomentNumbers {
    int flags = 0;
    int sampling = 0;
    int layers = 0;
    double exponent = 0.0;
    double exponent_negative = 0.0;
    double moment_bias = 0.0;
    double min_variance = 0.0;
    double min_variance_texels = 0.0;
    double rounding = 0.0;
    double rounding_negative = 0.0;
    double linstep = 0.0;
    double power = 0.0;
    double lighten = 0.0;
    double lighten_cut = 0.0;
    double anisotropy = 0.0;
};
[[nodiscard]] bool isFilterable(Filter filter);
/// Zeros for a filter that is not filterable.
[[nodiscard]] MomentNumbers momentNumbers(const ShadowOptions& filter);
/// Mip levels of the maps' image.
[[nodiscard]] std::uint32_t levelsOf(const ShadowOptions& filter, const MapPages& atlas);
/// The last of them that a tile may be read at.
[[nodiscard]] double coarsestOf(const Tile& tile, std::uint32_t levels);

} // namespace gnomon::test
