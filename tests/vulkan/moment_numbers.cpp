// SPDX-License-Identifier: Apache-2.0
#include "moment_numbers.h"

#include <gnomon/pack/filter_rule.h>

namespace gnomon::test {

bool isFilterable(Filter filter)
{
    return filterTraits(filter)->filterable;
}

MomentNumbers momentNumbers(const ShadowOptions& filter)
{
    if (!isFilterable(filter.technique.filter)) {
        MomentNumbers none{}; // except for numbers that all filters have
        none.lighten = filter.lighten;
        none.lighten_cut = filter.lighten_as == LightenAs::remap ? filter.lighten : 0.0F;
        none.flags = pack::readingRuleOf(resolvedOrThrow(filter)).flags;
        return none;
    }
    const auto r = pack::momentRuleOf(resolvedOrThrow(filter));
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
            r.lighten_cut,
            r.anisotropy};
}

std::uint32_t levelsOf(const ShadowOptions& filter, const MapPages& atlas)
{
    return pack::mipLevels(resolvedOrThrow(filter), atlas.width, atlas.height);
}

double coarsestOf(const Tile& tile, std::uint32_t levels)
{
    return pack::coarsestLevel(tile, levels);
}

} // namespace gnomon::test
