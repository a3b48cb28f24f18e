// SPDX-License-Identifier: Apache-2.0
// The mask pass's layouts, descriptor sets and pipelines.
#include "map_storage.h"
#include "mask_constants.h"
#include "mask_pass.h"
#include "moment_rule_of.h"
#include "pipelines.h"
#include "samplers.h"
#include "specialisation.h"

#include <array>

namespace gnomon::vulkan {
namespace {

enum Binding : std::uint32_t { kConstants, kMaps, kDepth, kNormal, kObjectId, kLayers, kBindingCount };

// The constant_ids of mask_fragment.glsl, four bytes each, in their order.
struct Constants {
    std::int32_t filter;
    std::int32_t kernel_width;
    std::int32_t disc_taps;
    VkBool32 has_normals;
    std::int32_t lights;
    VkBool32 many_views;
    VkBool32 automatic_bias;
    std::int32_t moment_flags;
    std::int32_t moment_sampling;
    std::int32_t moment_layers;
    std::int32_t depth_holding;
    std::int32_t steps;
};

constexpr std::array<VkDescriptorType, kBindingCount> kTypes{
    VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
    VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
    VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER};

} // namespace

void MaskPassRecorder::makeLayouts()
{
    sets_ = DescriptorSets(device_, kTypes, VK_SHADER_STAGE_FRAGMENT_BIT);
    layout_ = makePipelineLayout(device_, sets_.layout(), VK_SHADER_STAGE_FRAGMENT_BIT, 0);
    sampler_ = makeSampler(device_, VK_FILTER_NEAREST);
    // Depths must not be averaged, and filtering them is not a feature that formats of depth need have.
    map_sampler_ = makeSampler(device_, isFilterable(options_.filter.filter) ? VK_FILTER_LINEAR : VK_FILTER_NEAREST);
}

void MaskPassRecorder::makeSlots()
{
    sets_.reset(options_.frames_in_flight);
    slots_.resize(options_.frames_in_flight);
    for (Slot& slot : slots_) {
        slot.set = sets_.take("mask");
    }
}

void MaskPassRecorder::writeConstants(Slot& slot) const
{
    const std::array writes{DescriptorSets::buffer(kConstants, slot.constants.buffer(), sizeof(shared::GpuMaskLayer))};
    sets_.write(slot.set, writes);
}

void MaskPassRecorder::updateSet(Slot& slot, const MaskInputs& inputs, VkImageView maps, VkBuffer layers)
{
    if (slot.maps == maps && slot.layers == layers && slot.depth == inputs.depth &&
        slot.depth_layout == inputs.depth_layout && slot.normal == inputs.normal &&
        slot.object_id == inputs.object_id) {
        return;
    }
    constexpr VkImageLayout kRead = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    const VkSampler sampler = sampler_.get();
    // The shaders name the normals whether they read them or not, and lavapipe 22.3 crashes on a descriptor that was
    // never written even if no shader names it; so what is absent is filled with the depth.
    const auto orDepth = [&](std::uint32_t binding, VkImageView view) {
        return view != VK_NULL_HANDLE ? DescriptorSets::image(binding, sampler, view, kRead)
                                      : DescriptorSets::image(binding, sampler, inputs.depth, inputs.depth_layout);
    };
    const std::array writes{DescriptorSets::image(kMaps, map_sampler_.get(), maps, kRead),
                            DescriptorSets::image(kDepth, sampler, inputs.depth, inputs.depth_layout),
                            orDepth(kNormal, inputs.normal), orDepth(kObjectId, inputs.object_id),
                            DescriptorSets::buffer(kLayers, layers)};
    sets_.write(slot.set, writes);
    slot.maps = maps;
    slot.layers = layers;
    slot.depth = inputs.depth;
    slot.depth_layout = inputs.depth_layout;
    slot.normal = inputs.normal;
    slot.object_id = inputs.object_id;
}

VkPipeline MaskPassRecorder::pipeline(Variant variant)
{
    Pipeline& pipeline = pipelines_[variant.index()];
    if (!pipeline) {
        pipeline = makePipeline(variant);
    }
    return pipeline.get();
}

Pipeline MaskPassRecorder::makePipeline(Variant variant)
{
    const FilterOptions& filter = options_.filter;
    const shared::MomentRule moments = isFilterable(filter.filter) ? momentRuleOf(filter) : shared::MomentRule{};
    const Constants values{static_cast<std::int32_t>(filter.filter),
                           kernelWidth(filter),
                           static_cast<std::int32_t>(filter.disc_taps),
                           variant.normals ? VK_TRUE : VK_FALSE,
                           static_cast<std::int32_t>(variant.lights),
                           variant.many_views ? VK_TRUE : VK_FALSE,
                           filter.bias.automatic ? VK_TRUE : VK_FALSE,
                           moments.flags,
                           moments.sampling,
                           moments.layers,
                           depthHolding(filter.filter, filter.format),
                           static_cast<std::int32_t>(variant.paired)};
    const Specialisation specialisation(values);
    const std::size_t fragment =
        (variant.orthographic ? 1U : 0U) + (variant.ids ? 2U : 0U) + (variant.paired != 0 ? 4U : 0U);
    const TwoStages stages = stagesOf(vertex_, fragments_[fragment], specialisation.info());
    GraphicsState state;
    state.stages = stages;
    state.layout = layout_.get();
    state.colour_format = mask_.info().format;
    state.cache = options_.pipeline_cache;
    state.name = "mask";
    return makeGraphicsPipeline(device_, state);
}

} // namespace gnomon::vulkan
