// SPDX-License-Identifier: Apache-2.0
// How large the maps of a light's frustums are.
#include "partition/multi.h"

#include "auto/map_error.h"

#include <algorithm>
#include <limits>

namespace gnomon {
namespace {

/// TexelClaim::staying of a map that holds still. With another side its texels are other ones, too.
constexpr double kHoldsSide = 2.0;

} // namespace

std::uint32_t MultiPartition::largestSide(const Input& input)
{
    const std::uint32_t largest = input.recipe.resolved.largestSide(input.light.type);
    return input.light.map_size != 0 ? std::clamp(input.light.map_size, kSmallestMap, largest) : largest;
}

double MultiPartition::texelsPerPixel(const Input& input)
{
    return input.recipe.options().multi.texels_per_pixel.value_or(1.0);
}

bool MultiPartition::sharesRest(const Input& input)
{
    const MultiOptions& multi = input.recipe.options().multi;
    const bool bounded_times = multi.divide == MultiDivide::receivers || multi.most_times > 0.0;
    const bool bounded_texels = !input.recipe.options().map_size; // else a light may have any number, and none is left
    return bounded_texels && !multi.texels_per_pixel && !bounded_times && !takesTurns(input);
}

/// Halves of halves of the largest side, which fill squares of the pages.
void MultiPartition::sizeFrustums(const Input& input, Memory& memory, std::span<GrownFrustum> found)
{
    const ShadowOptions& options = input.recipe.options();
    claims_.clear();
    for (const GrownFrustum& frustum : found) {
        TexelClaim& claim = claims_.emplace_back();
        claim.weight = frustum.sum;
        claim.wanted = frustum.wanted;
        if (sharesRest(input)) {
            claim.useful = frustum.wanted / kFineEnough_px;
        }
        claim.largest = largestSide(input);
        claim.before = frustum.side_before;
        if (input.recipe.steady()) {
            claim.staying = memory.held.fading() ? std::numeric_limits<double>::infinity() : kHoldsSide;
        }
    }
    shares_.share(claims_, options.map_size ? std::numeric_limits<double>::infinity()
                                            : static_cast<double>(texelsOf(options, input.light.type)));
    for (std::size_t i = 0; i < found.size(); ++i) {
        found[i].side = claims_[i].side;
    }
    memory.frustums.clear();
    for (const GrownFrustum& frustum : found) {
        memory.frustums.push_back({frustum.id, frustum.side, frustum.strength});
    }
}

} // namespace gnomon
