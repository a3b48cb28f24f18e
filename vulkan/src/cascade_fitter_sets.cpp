// SPDX-License-Identifier: Apache-2.0
// The layouts, pipelines and descriptor sets of the passes that fit cascades.
#include "cascade_fitter.h"
#include "optional_parts.h"
#include "pipelines.h"

#include <gnomon_spirv.h>

namespace gnomon::vulkan {
namespace {

enum Binding : std::uint32_t { kLights, kKeys, kViews, kReport, kDepths, kObjectIds, kBindingCount };
constexpr std::array<VkDescriptorType, kBindingCount> kFitTypes{
    VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
    VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE,  VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE};
constexpr std::array kCompleteTypes{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                                    VK_DESCRIPTOR_TYPE_STORAGE_BUFFER}; // cascade_constants.comp

} // namespace

void CascadeFitter::makePipelines()
{
    requireLargeGroups(device_, "find cascades");
    constexpr VkShaderStageFlags kStage = VK_SHADER_STAGE_COMPUTE_BIT;
    fit_sets_ = DescriptorSets(device_, kFitTypes, kStage);
    complete_sets_ = DescriptorSets(device_, kCompleteTypes, kStage);
    fit_layout_ = makePipelineLayout(device_, fit_sets_.layout(), kStage, 0);
    complete_layout_ = makePipelineLayout(device_, complete_sets_.layout(), kStage, 0);
    const std::array<std::span<const std::uint32_t>, kPassCount> code{
        spirv::cascade_depth_comp, spirv::cascade_depth_ids_comp, spirv::cascade_bounds_comp,
        spirv::cascade_bounds_ids_comp, spirv::cascade_finish_comp};
    for (std::uint32_t i = 0; i < kPassCount; ++i) {
        passes_[i] = makeComputePipeline(device_, {code[i], nullptr, fit_layout_.get(), cache_, "cascade bounds"});
    }
    complete_ = makeComputePipeline(
        device_, {spirv::cascade_constants_comp, nullptr, complete_layout_.get(), cache_, "cascade constants"});
}

void CascadeFitter::makeSets()
{
    fit_sets_.reset(slot_count_);
    complete_sets_.reset(2 * slot_count_);
    slots_.resize(slot_count_);
    for (Slot& slot : slots_) {
        slot.fit = fit_sets_.take("cascade bounds");
        for (VkDescriptorSet& set : slot.complete) {
            set = complete_sets_.take("cascade views");
        }
    }
}

void CascadeFitter::writeFitSet(Slot& slot, const MaskInputs& inputs)
{
    // No shader reads ids that are not given; but a descriptor that was never written crashes lavapipe 22.3.
    const bool ids = inputs.object_id != VK_NULL_HANDLE;
    const std::array<DescriptorSets::Write, kBindingCount> writes{
        DescriptorSets::buffer(kLights, slot.lights.buffer()),
        DescriptorSets::buffer(kKeys, keys_.buffer()),
        DescriptorSets::buffer(kViews, views_.buffer()),
        DescriptorSets::buffer(kReport, slot.report.buffer()),
        DescriptorSets::image(kDepths, VK_NULL_HANDLE, inputs.depth, inputs.depth_layout),
        DescriptorSets::image(kObjectIds, VK_NULL_HANDLE, ids ? inputs.object_id : inputs.depth,
                              ids ? VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL : inputs.depth_layout)};
    fit_sets_.write(slot.fit, writes);
}

} // namespace gnomon::vulkan
