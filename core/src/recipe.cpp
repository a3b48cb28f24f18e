// SPDX-License-Identifier: Apache-2.0
#include "recipe.h"

#include "light_space.h"

#include <gnomon/choice_rules.h>

#include <algorithm>
#include <mutex>
#include <set>
#include <string>

namespace gnomon {
namespace {

/// A copy that lasts as long as the program, as Outcome::reason must: plans outlive their planners.
std::string_view lasting(const std::string& sentence)
{
    static std::mutex mutex;
    static std::set<std::string> sentences;
    const std::lock_guard lock(mutex);
    return *sentences.insert(sentence).first;
}

/// The side of each of `count` maps that share the texels of one.
std::uint32_t sideOfShared(std::uint32_t side, std::uint32_t count)
{
    std::uint32_t level = 0;
    while ((1U << (2 * level)) < count) {
        ++level;
    }
    return std::max(side >> level, kSmallestMap);
}

/// Options that can be had, whatever was asked for: nobody plans by those that were refused.
ResolvedOptions usable(const Resolution& resolution)
{
    return resolution ? *resolution : resolvedOrThrow({});
}

} // namespace

Recipe::Recipe(const ShadowOptions& given, const Resolution& resolution)
    : asked(given), refused(lasting(resolution.refusal)), resolved(usable(resolution)),
      partition(partitionTraits(options().technique.partition)), fit(fitFunction(options().technique.fit)),
      motion(motionTraits(options().technique.motion))
{
}

Outcome Recipe::check(const Light& light) const
{
    if (!light.casts_shadow) {
        return {OutcomeKind::no_shadow_wanted, "the light casts no shadow"};
    }
    if (const auto reason = refusal(layoutOf(light), asked)) {
        return {OutcomeKind::refused, *reason};
    }
    if (!refused.empty()) {
        return {OutcomeKind::refused, refused};
    }
    return checkLight(light);
}

bool Recipe::steps(const Light& light) const
{
    return motion != nullptr && motion->stepping != Stepping::none && light.type == LightType::directional;
}

bool Recipe::pairs(const Light& light) const
{
    return steps(light) && paired(motion->stepping);
}

MapWish Recipe::wishOf(const Light& light, std::uint32_t index, const PartitionTraits& divided,
                       std::uint32_t halvings) const
{
    const std::uint32_t largest = resolved.largestSide(light.type);
    MapWish wish;
    wish.options = index;
    wish.side = light.map_size == 0 ? largest : std::clamp(light.map_size, kSmallestMap, largest);
    wish.count = mapsOf(divided);
    wish.stacked = divided.maps == 0; // cascades may be drawn by one pass
    if (choosesPartition() || !options().map_size) {
        wish.side = sideOfShared(wish.side, wish.count);
    }
    if (light.map_size == 0) {
        wish.side = std::max(wish.side >> halvings, std::min(wish.side, kSmallestMap));
    }
    wish.positions = pairs(light) ? 2 : 1;
    wish.shares_texels = resolved.paired_maps();
    // A map that the GPU fits changes in each frame. A midpoint map needs all casters at once.
    wish.keeps_still =
        !divided.fits_on_gpu && options().faces != CasterFaces::midpoint &&
        (options().keep_still == KeepStill::always || (options().keep_still == KeepStill::automatic && steps(light)));
    return wish;
}

std::uint32_t Recipe::mapsOf(const PartitionTraits& divided) const
{
    if (divided.maps != 0) {
        return std::max(divided.maps, resolved.segments());
    }
    return divided.fits_on_gpu && choosesPartition() ? 1 : options().cascades.count; // one, as takesDepth() has it
}

bool Recipe::levelsDepth() const
{
    return options().level_depth && resolved.filterable() && !layersWorld();
}

} // namespace gnomon
