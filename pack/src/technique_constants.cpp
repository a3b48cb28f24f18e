// SPDX-License-Identifier: Apache-2.0
#include <gnomon/pack/technique_constants.h>

#include <gnomon/pack/filter_rule.h>
#include <gnomon/pack/page_table.h>

#include <gnomon/shared/gpu_structs.h>

#include <algorithm>
#include <array>

namespace gnomon::pack {

Filter filterModule(const ResolvedOptions& options)
{
    const Filter filter = readingFilter(options);
    if (filter == Filter::depth_id) {
        return Filter::id;
    }
    return filter == Filter::volumes ? Filter::pcf : filter; // volumes read no map: any module does
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
    return steps || hasPages(options) ? 0 : around ? shared::kFewViews : divided ? cascades : options.segments();
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

MaskConstants maskConstants(const ResolvedOptions& options, const MaskImages& images)
{
    const Partition partition = options.technique().partition;
    MaskConstants constants;
    constants.technique = techniqueConstants(options);
    constants.has_normals = images.normals ? 1 : 0;
    constants.has_smooth = images.smooth ? 1 : 0;
    constants.has_ids = images.ids ? 1 : 0;
    constants.paraboloid = partition == Partition::paraboloid ? 1 : 0;
    constants.layered = partition == Partition::multi && options.multi().divide == MultiDivide::receivers ? 1 : 0;
    constants.pages = hasPages(options) ? 1 : 0;
    return constants;
}

} // namespace gnomon::pack
