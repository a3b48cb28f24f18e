// SPDX-License-Identifier: Apache-2.0
#include "mip_pass.h"

#include <gnomon/pack/filter_rule.h>

#include <gnomon_spirv.h>

namespace gnomon::vulkan {

MipPass::MipPass(FilterLayout& layout, const pack::FilterConstants& constants)
    : layout_(layout), pipeline_(layout.makeCompute(spirv::mip_comp, constants, "mip levels"))
{
}

void MipPass::makeSets(const MomentImages& images)
{
    sets_.clear();
    for (std::uint32_t level = 1; level < images.maps.info().levels; ++level) {
        sets_.push_back(layout_.makeSet(images.between(images.maps.level(level - 1), images.maps.level(level))));
    }
}

void MipPass::record(const FilterStep& step) const
{
    const Tile& tile = step.tile;
    const std::uint32_t coarsest = pack::coarsestLevel(tile, static_cast<std::uint32_t>(sets_.size()) + 1);
    for (std::uint32_t level = 1; level <= coarsest; ++level) {
        if (level > 1) {
            waitForShaders(layout_.device(), step.commands);
        }
        const std::uint32_t fine = level - 1;
        const shared::FilterPassPlace place = pack::placeOfLevel(step, level);
        layout_.bind(step.commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_.get(), sets_[fine], step.counts_offset,
                     place);
        layout_.device().vk.CmdDispatch(step.commands, pack::groupsOf(tile.width >> level, 32),
                                        pack::groupsOf(tile.height >> level, shared::kWalkTexels), step.image_layers);
    }
}

} // namespace gnomon::vulkan
