// SPDX-License-Identifier: Apache-2.0
#include <gnomon/pack/technique_constants.h>

#include <gnomon/pack/filter_rule.h>

#include <gnomon/shared/gpu_structs.h>

#include <algorithm>
#include <array>

namespace gnomon::pack {

std::string_view nameOf(FilterModule module)
{
    constexpr std::array<std::string_view, static_cast<std::size_t>(FilterModule::count)> kNames{
        "hard", "pcf", "pcss", "raymarch", "moments", "warped", "ids"};
    return kNames[static_cast<std::size_t>(module)];
}

FilterModule filterModule(const ResolvedOptions& options)
{
    switch (readingFilter(options)) {
    case Filter::hard:
        return FilterModule::hard;
    case Filter::pcss:
        return FilterModule::pcss;
    case Filter::raymarch:
        return FilterModule::raymarch;
    case Filter::vsm:
    case Filter::msm:
        return FilterModule::moments;
    case Filter::lvsm:
    case Filter::esm:
    case Filter::evsm:
        return FilterModule::warped;
    case Filter::id:
    case Filter::depth_id:
        return FilterModule::ids;
    case Filter::pcf:
    case Filter::volumes:   // counts no texels: what it has of a map is never read
    case Filter::smoothies: // read as pcf, and its edges beside it
    case Filter::automatic: // never comes here: a plan has the one that was chosen
        break;
    }
    return FilterModule::pcf;
}

TechniqueConstants techniqueConstants(const ResolvedOptions& options)
{
    const shared::MomentRule moments = readingRuleOf(options);
    TechniqueConstants constants;
    constants.kernel_width = kernelWidth(options.pcf().kernel);
    constants.disc_taps = static_cast<std::int32_t>(options.pcf().taps);
    constants.automatic_bias = options.bias().automatic ? 1 : 0;
    constants.moment_flags = moments.flags;
    constants.moment_sampling = moments.sampling;
    constants.moment_layers = moments.layers;
    constants.depth_holding = depthHolding(options);
    constants.filter = static_cast<std::int32_t>(readingFilter(options));
    return constants;
}

std::uint32_t fewViews(const ResolvedOptions& options)
{
    const Technique& technique = options.technique();
    const bool steps = technique.motion != Motion::free && technique.motion != Motion::snap;
    const bool around = technique.partition == Partition::cube || technique.partition == Partition::paraboloid ||
                        technique.partition == Partition::multi || technique.partition == Partition::automatic;
    const std::uint32_t cascades = std::min(static_cast<std::uint32_t>(options.cascades().count), shared::kFewViews);
    const bool divided = technique.partition != Partition::single && cascades > 1;
    return steps ? 0 : around ? shared::kFewViews : divided ? cascades : options.segments();
}

std::uint32_t fewViewsOf(const Plan& plan)
{
    return plan.lights.size() == 1 ? fewViewsOf(plan, plan.lights.front()) : 0;
}

// Which view it is is known beforehand only where the light has all of the plan's.
std::uint32_t fewViewsOf(const Plan& plan, const LightPlan& light)
{
    const std::size_t count = plan.views.size();
    if (count == 0 || light.steps.paired || light.view_count != count || count > shared::kFewViews) {
        return 0;
    }
    const std::uint32_t few = fewViews((*plan.options)[light.options]);
    return few == 0 ? 0 : count == 1 ? 1 : count <= few ? few : shared::kFewViews;
}

} // namespace gnomon::pack
