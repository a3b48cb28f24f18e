// SPDX-License-Identifier: Apache-2.0
#include "moment_numbers.h"

#include <mip_level.h>
#include <moment_rule_of.h>

namespace gnomon::test {

bool isFilterable(Filter filter)
{
    return vulkan::isFilterable(filter);
}

MomentNumbers momentNumbers(const vulkan::FilterOptions& filter)
{
    if (!isFilterable(filter.filter)) {
        return {};
    }
    const auto r = vulkan::momentRuleOf(filter);
    return {r.flags,
            r.sampling,
            r.layers,
            r.exponent,
            r.exponent_negative,
            r.moment_bias,
            r.min_variance,
            r.min_variance_texels,
            r.rounding,
            r.rounding_negative,
            r.linstep,
            r.power,
            r.lighten,
            r.anisotropy};
}

std::uint32_t levelsOf(const vulkan::FilterOptions& filter, const MapPages& atlas)
{
    return vulkan::mipLevels(filter, atlas.width, atlas.height);
}

double coarsestOf(const Tile& tile, std::uint32_t levels)
{
    return vulkan::coarsestLevel(tile, levels);
}

} // namespace gnomon::test
