// SPDX-License-Identifier: Apache-2.0
#include "option_refusals.h"

#include <gnomon/converge.h>
#include <gnomon/error.h>

#include <gnomon/shared/pcf_weights.h>

#include <algorithm>
#include <cmath>

namespace gnomon {
namespace {

/// With a filter that compares depths, such a texel has two depths of 16 bits each.
bool holdsTwoMaps(const FilterTraits& traits, MapFormat format)
{
    return !traits.filterable && !traits.ids &&
           (format == MapFormat::rg16 || format == MapFormat::rg16f || format == MapFormat::rgba8);
}

} // namespace

std::uint32_t pixelsPerTexel(ScreenSize size)
{
    return 1U << static_cast<std::uint32_t>(size);
}

int kernelWidth(PcfKernel kernel)
{
    switch (kernel) {
    case PcfKernel::bilinear_2x2:
        return 1;
    case PcfKernel::gaussian_3x3:
        return 3;
    case PcfKernel::gaussian_5x5:
        return 5;
    case PcfKernel::gaussian_7x7:
        return 7;
    case PcfKernel::box_3x3:
        return shared::kBoxKernel;
    case PcfKernel::projected_3x3:
        return shared::kProjectedKernel;
    case PcfKernel::poisson:
    case PcfKernel::vogel:
        return 0;
    }
    return 0;
}

Filter filterOf(const ShadowOptions& options)
{
    if (options.technique.filter != Filter::automatic) {
        return options.technique.filter;
    }
    const bool plain = options.quality == Quality::fast || options.technique.partition == Partition::paraboloid ||
                       options.technique.soften == Soften::smoothies;
    return plain ? Filter::pcf : Filter::raymarch;
}

bool hasMaps(const ShadowOptions& options)
{
    const FilterTraits* const traits = filterTraits(filterOf(options));
    return traits == nullptr || traits->has_maps;
}

MapFormat formatOf(const ShadowOptions& options)
{
    const FilterTraits* const traits = filterTraits(filterOf(options));
    return options.format ? *options.format : traits != nullptr ? traits->formats.front() : MapFormat::d32f;
}

std::uint64_t texelsOf(const ShadowOptions& options, LightType type)
{
    constexpr double kBytesOfMiB = 1024.0 * 1024.0;
    constexpr double kMostTexels = 16384.0 * 16384.0;
    constexpr std::uint32_t kLeastBytes = 4; // a smaller texel is drawn beside its depth
    if (options.max_texels) {
        return *options.max_texels;
    }
    const double memory_mib = type == LightType::directional ? options.sun_memory_mib : options.lamp_memory_mib;
    const std::uint32_t bytes =
        std::max(texelBytes(formatOf(options)), kLeastBytes) * imageLayersPerMap(filterOf(options), options.moments);
    // Whatever the number, which resolve() may yet refuse.
    const double texels = memory_mib * kBytesOfMiB / std::max(bytes, kLeastBytes);
    return texels > 0.0 ? static_cast<std::uint64_t>(std::min(texels, kMostTexels)) : 0;
}

std::uint32_t largestSide(const ShadowOptions& options)
{
    constexpr std::uint32_t kMultiple = 8; // halved three times it is a whole number still
    if (options.map_size) {
        return *options.map_size;
    }
    const std::uint64_t most = std::max(texelsOf(options, LightType::directional), texelsOf(options, LightType::point));
    const std::uint64_t texels = options.budget_texels == 0 ? most : std::min(most, options.budget_texels);
    const auto side = static_cast<std::uint32_t>(std::sqrt(static_cast<double>(texels)));
    return std::max(side - side % kMultiple, kMultiple);
}

float reachTexels(const ShadowOptions& options)
{
    const FilterTraits* const traits = filterTraits(filterOf(options));
    if (traits != nullptr && traits->filterable) {
        return static_cast<float>(blurRadius(options.moments)) + 1.0F; // and a bilinear read of what was blurred
    }
    if (traits != nullptr && traits->integrates_light) {
        return 2.0F; // from where a ray may start; the way to the light has room of its own
    }
    if (traits != nullptr && traits->ids) {
        return 1.0F; // the four nearest
    }
    if (filterOf(options) != Filter::pcf && filterOf(options) != Filter::smoothies) {
        return hasSmoothies(options) ? 1.0F : 0.5F; // which are read as pcf 2x2 reads a map
    }
    const int width = kernelWidth(options.pcf.kernel);
    if (width < 0) {
        return 1.5F; // points, a texel away
    }
    return width > 0 ? static_cast<float>(width + 1) * 0.5F : options.pcf.radius_texels + 1.0F;
}

bool boundsDrawing(const ShadowOptions& options)
{
    return options.draw_budget_texels > 0 || options.draw_budget_ms > 0.0;
}

std::uint32_t segments(const ShadowOptions& options)
{
    return options.technique.fit == Fit::tsm ? options.tsm_segments : 1;
}

std::uint32_t ResolvedOptions::segments() const
{
    return gnomon::segments(asked_);
}

bool turnsByCascade(const ShadowOptions& options)
{
    return boundsDrawing(options) && options.technique.partition == Partition::cascades && options.cascades.room > 0.0;
}

bool fitsOnGpu(const ShadowOptions& options)
{
    const Technique& technique = options.technique;
    return hasMaps(options) && (technique.partition == Partition::sdsm ||
                                (technique.partition == Partition::automatic && options.quality == Quality::best &&
                                 technique.motion == Motion::free));
}

IdTest ResolvedOptions::idTest() const
{
    const IdTest given = asked_.ids.test;
    const IdTest own = filter() == Filter::depth_id ? IdTest::priority : IdTest::any;
    return given == IdTest::automatic ? own : given;
}

std::uint32_t ResolvedOptions::largestSide(LightType type) const
{
    std::uint64_t side = largest_side_;
    while (!asked_.map_size && side * side > texelsOf(asked_, type)) {
        side /= 2;
    }
    return static_cast<std::uint32_t>(side);
}

bool ResolvedOptions::fitsOnGpu() const
{
    return gnomon::fitsOnGpu(asked_);
}

bool integratesLight(const ShadowOptions& options)
{
    const FilterTraits* const traits = filterTraits(filterOf(options));
    return traits != nullptr &&
           (traits->integrates_light || hasSmoothies(options) || followsLight(traits->filter, options.moments));
}

bool hasSmoothies(const ShadowOptions& options)
{
    return options.technique.soften == Soften::smoothies || filterOf(options) == Filter::smoothies;
}

bool ResolvedOptions::integratesLight() const
{
    return gnomon::integratesLight(asked_);
}

Resolution resolve(const ShadowOptions& options)
{
    if (auto reason = refusalOfOptions(options)) {
        return {std::nullopt, std::move(*reason)};
    }
    constexpr double kLeastBorder_texels = 4.0;
    // The filter's reach, from wherever the grid is moved to.
    const double needed_texels = static_cast<double>(reachTexels(options)) +
                                 (options.technique.soften == Soften::converge ? kMostGridMove_texels : 0.0);
    ResolvedOptions made;
    made.asked_ = options;
    made.asked_.technique.filter = filterOf(options);
    if (options.technique.partition == Partition::paraboloid) {
        made.asked_.technique.fit = Fit::uniform; // auto
    }
    if (options.technique.partition == Partition::virtual_pages) {
        made.asked_.technique.fit = Fit::uniform; // auto
    }
    if (options.technique.fit == Fit::scene) {
        made.asked_.technique.partition = Partition::single; // auto
    }
    if (!hasMaps(options)) {
        made.asked_.technique.partition = Partition::single; // auto
        made.asked_.technique.fit = Fit::uniform;
    }
    made.traits_ = filterTraits(filterOf(options));
    made.format_ = formatOf(options);
    made.largest_side_ = largestSide(options);
    made.reach_texels_ = reachTexels(options);
    made.border_texels_ = options.border_texels.value_or(std::max(kLeastBorder_texels, std::ceil(needed_texels)));
    made.paired_maps_ = holdsTwoMaps(*made.traits_, made.format_);
    return {made, {}};
}

ResolvedOptions resolvedOrThrow(const ShadowOptions& options)
{
    Resolution resolution = resolve(options);
    if (!resolution) {
        throw Error("choose how shadows are made", resolution.refusal);
    }
    return *resolution;
}

} // namespace gnomon
