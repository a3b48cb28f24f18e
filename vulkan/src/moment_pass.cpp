// SPDX-License-Identifier: Apache-2.0
#include "moment_pass.h"

#include <gnomon_spirv.h>

namespace gnomon::vulkan {

MomentPass::MomentPass(FilterLayout& layout, const ResolvedOptions& options) : layout_(layout)
{
    const auto code = options.moments().samples == 1 ? spirv::moments_comp : spirv::moments_samples_comp;
    pipeline_ = layout.makeCompute(code, pack::filterConstants(options), "moments");
}

void MomentPass::makeSets(const MomentImages& images)
{
    FilterBindings bindings = images.between(images.depth.layer(0), images.maps.level(0));
    bindings.source_is_depth = true;
    set_ = layout_.makeSet(bindings);
}

void MomentPass::record(const FilterStep& step) const
{
    const shared::FilterPassPlace place = pack::placeFromDepths(step);
    layout_.bind(step.commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_.get(), set_, step.counts_offset, place);
    layout_.device().vk.CmdDispatch(step.commands, pack::groupsOf(step.tile.width, 32),
                                    pack::groupsOf(step.tile.height, shared::kWalkTexels), step.image_layers);
}

} // namespace gnomon::vulkan
