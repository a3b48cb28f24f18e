// SPDX-License-Identifier: Apache-2.0
#include "recipe.h"

#include "light_space.h"

#include <algorithm>
#include <cassert>

namespace gnomon {
namespace {

constexpr std::uint32_t kSmallestMap = 16;
constexpr std::uint32_t kLargestMap = 16384;

[[maybe_unused]] bool usable(const CascadeOptions& options)
{
    if (options.count < 1 || options.count > kMaxCascades || !(options.lambda >= 0.0 && options.lambda <= 1.0) ||
        !(options.blend >= 0.0 && options.blend <= 0.5))
        return false;
    double last_m = 0.0;
    for (std::uint32_t i = 0; options.explicitEnds() && i + 1 < options.count; ++i) {
        if (!(options.ends_m[i] > last_m))
            return false;
        last_m = options.ends_m[i];
    }
    return true;
}

[[maybe_unused]] bool usable(const StepOptions& options)
{
    return options.angle_rad >= 0.0001 && options.angle_rad <= 0.5 && options.interval_s >= 0.01 &&
           options.interval_s <= 86400.0 && options.band >= 0.01 && options.band <= 1.0;
}

} // namespace

Recipe::Recipe(const PlanOptions& given)
    : options(given), partition(partitionTraits(given.technique.partition)), fit(fitFunction(given.technique.fit)),
      motion(motionTraits(given.technique.motion)), filter(filterTraits(given.technique.filter))
{
    assert(options.map_size >= kSmallestMap && options.map_size <= kLargestMap);
    assert(options.max_layers >= 1 && options.max_layers <= 2048);
    assert(options.border_texels >= 0.0 && options.border_texels <= 64.0);
    assert(options.fade >= 0.0 && options.fade <= 1.0);
    assert(usable(options.cascades));
    assert(usable(options.steps));
}

Outcome Recipe::check(const Light& light) const
{
    if (!light.casts_shadow)
        return {OutcomeKind::no_shadow_wanted, "the light casts no shadow"};
    if (const auto reason = refusal(light.type, options.technique))
        return {OutcomeKind::refused, *reason};
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

MapWish Recipe::wishOf(const Light& light, std::uint32_t index) const
{
    MapWish wish;
    wish.options = index;
    wish.side = light.map_size == 0 ? options.map_size : std::clamp(light.map_size, kSmallestMap, options.map_size);
    wish.count = partition->cascades ? options.cascades.count : 1;
    wish.positions = pairs(light) ? 2 : 1;
    wish.shares_texels = options.paired_maps;
    // What the GPU fits is another map in each frame.
    wish.keeps_still = !partition->fits_on_gpu && (options.keep_still == KeepStill::always ||
                                                   (options.keep_still == KeepStill::automatic && steps(light)));
    return wish;
}

bool Recipe::levelsDepth() const
{
    return options.level_depth && filter != nullptr && filter->filterable;
}

} // namespace gnomon
