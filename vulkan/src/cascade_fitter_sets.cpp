// SPDX-License-Identifier: Apache-2.0
// The layouts, pipelines and descriptor sets of the passes that fit cascades.
#include "cascade_fitter.h"
#include "optional_parts.h"
#include "pipelines.h"
#include "specialisation.h"

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
    struct HasIds {
        VkBool32 has_ids;
    };
    const auto make = [&](std::span<const std::uint32_t> code, bool has_ids) {
        const Specialisation constants(HasIds{has_ids ? VK_TRUE : VK_FALSE});
        return makeComputePipeline(device_, {code, constants.info(), fit_layout_.get(), cache_, "cascade bounds"});
    };
    passes_[kDepthPass] = make(spirv::cascade_depth_comp, false);
    passes_[kDepthIdsPass] = make(spirv::cascade_depth_comp, true);
    passes_[kBoundsPass] = make(spirv::cascade_bounds_comp, false);
    passes_[kBoundsIdsPass] = make(spirv::cascade_bounds_comp, true);
    passes_[kFinishPass] = make(spirv::cascade_finish_comp, false);
    complete_ = makeComputePipeline(
        device_, {spirv::cascade_constants_comp, nullptr, complete_layout_.get(), cache_, "cascade constants"});
}

void CascadeFitter::makeSets()
{
    fit_sets_.reset(slot_count_);
    complete_sets_.reset(2 * slot_count_);
    slots_.resize(slot_count_);
    no_ids_ = StandIn(device_);
    for (Slot& slot : slots_) {
        slot.fit = fit_sets_.take("cascade bounds");
        for (VkDescriptorSet& set : slot.complete) {
            set = complete_sets_.take("cascade views");
        }
    }
}

void CascadeFitter::writeFitSet(Slot& slot, const MaskInputs& inputs)
{
    const std::array<DescriptorSets::Write, kBindingCount> writes{
        DescriptorSets::buffer(kLights, slot.lights.buffer()),
        DescriptorSets::buffer(kKeys, keys_.buffer()),
        DescriptorSets::buffer(kViews, views_.buffer()),
        DescriptorSets::buffer(kReport, slot.report.buffer()),
        DescriptorSets::image(kDepths, VK_NULL_HANDLE, inputs.depth, inputs.depth_layout),
        DescriptorSets::image(kObjectIds, VK_NULL_HANDLE,
                              inputs.object_id != VK_NULL_HANDLE ? inputs.object_id : no_ids_.layer(),
                              VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL)};
    fit_sets_.write(slot.fit, writes);
}

} // namespace gnomon::vulkan
