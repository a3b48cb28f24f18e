// SPDX-License-Identifier: Apache-2.0
// The mask pass's layouts, descriptor sets and pipelines.
#include "map_storage.h"
#include "mask_constants.h"
#include "mask_pass.h"
#include "moment_rule_of.h"
#include "pipelines.h"
#include "samplers.h"
#include "specialisation.h"

#include <gnomon_spirv.h>

#include <algorithm>
#include <array>

namespace gnomon::vulkan {
namespace {

enum Binding : std::uint32_t {
    kConstants,
    kMaps,
    kLights,
    kViews,
    kLayers,
    kDepth,
    kNormal,
    kObjectId,
    kFewViews,
    kBindingCount
};

// The constant_ids of mask.frag, four bytes each, in their order.
struct Constants {
    std::int32_t kernel_width;
    std::int32_t disc_taps;
    VkBool32 has_normals;
    VkBool32 automatic_bias;
    std::int32_t moment_flags;
    std::int32_t moment_sampling;
    std::int32_t moment_layers;
    std::int32_t depth_holding;
    std::uint32_t view_count;
    VkBool32 by_vertex;
};

constexpr std::array<VkDescriptorType, kBindingCount> kTypes{
    VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER,         VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
    VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,         VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
    VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,         VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
    VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
    VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER};

std::span<const std::uint32_t> fragmentCode(Filter filter, bool orthographic, bool ids)
{
    using namespace spirv;
    // By orthographic, ids.
    using Codes = std::array<std::span<const std::uint32_t>, 4>;
    const auto of = [&](const Codes& codes) {
        return codes[(orthographic ? 1U : 0U) + (ids ? 2U : 0U)];
    };
#define GN_CODES(NAME)                                                                                                 \
    {                                                                                                                  \
        mask_##NAME##_frag, mask_##NAME##_orthographic_frag, mask_##NAME##_ids_frag,                                   \
            mask_##NAME##_orthographic_ids_frag                                                                        \
    }
    switch (filter) {
    case Filter::hard:
        return of(GN_CODES(hard));
    case Filter::vsm:
        return of(GN_CODES(vsm));
    case Filter::lvsm:
        return of(GN_CODES(lvsm));
    case Filter::esm:
        return of(GN_CODES(esm));
    case Filter::evsm:
        return of(GN_CODES(evsm));
    case Filter::msm:
        return of(GN_CODES(msm));
    default:
        return of(GN_CODES(pcf));
    }
#undef GN_CODES
}

} // namespace

void MaskPassRecorder::makeLayouts()
{
    sets_ = DescriptorSets(device_, kTypes, VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT);
    layout_ = makePipelineLayout(device_, sets_.layout(), VK_SHADER_STAGE_FRAGMENT_BIT, sizeof(MaskPush));
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

void MaskPassRecorder::writeSet(Slot& slot, const MaskInputs& inputs, VkImageView maps, VkBuffer layers)
{
    constexpr VkImageLayout kRead = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    const VkSampler sampler = sampler_.get();
    // The shaders name the normals whether they read them or not, and lavapipe 22.3 crashes on a descriptor that was
    // never written even if no shader names it; so what is absent is filled with the depth.
    const auto orDepth = [&](std::uint32_t binding, VkImageView view) {
        return view != VK_NULL_HANDLE ? DescriptorSets::image(binding, sampler, view, kRead)
                                      : DescriptorSets::image(binding, sampler, inputs.depth, inputs.depth_layout);
    };
    const VkBuffer constants = slot.constants.buffer();
    const std::array<DescriptorSets::Write, kBindingCount> writes{
        DescriptorSets::buffer(kConstants, constants, sizeof(shared::GpuConstants)),
        DescriptorSets::image(kMaps, map_sampler_.get(), maps, kRead),
        DescriptorSets::buffer(kLights, constants, room_.lights * sizeof(shared::GpuLight), room_.lights_at),
        DescriptorSets::buffer(kViews, constants, room_.views * sizeof(shared::GpuView), room_.views_at),
        DescriptorSets::buffer(kLayers, layers),
        DescriptorSets::image(kDepth, sampler, inputs.depth, inputs.depth_layout),
        orDepth(kNormal, inputs.normal),
        orDepth(kObjectId, inputs.object_id),
        DescriptorSets::buffer(kFewViews, constants, shared::kFewViews * sizeof(shared::GpuView), room_.views_at)};
    sets_.write(slot.set, writes);
}

void MaskPassRecorder::makePipelines(const Plan& plan, MaskShape shape)
{
    const bool perspective =
        std::any_of(plan.views.begin(), plan.views.end(), [](const View& view) { return !view.orthographic; });
    const std::uint32_t few = fewViews(plan);
    if (few > 0) {
        (void)pipeline({!perspective, shape.normals, shape.ids, few});
        return;
    }
    // A draw of lights without maps is as one of orthographic maps.
    (void)pipeline({true, shape.normals, shape.ids});
    if (perspective) {
        (void)pipeline({false, shape.normals, shape.ids});
    }
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
    const Constants values{kernelWidth(filter.pcf_kernel),
                           static_cast<std::int32_t>(filter.disc_taps),
                           variant.normals ? VK_TRUE : VK_FALSE,
                           filter.bias.automatic ? VK_TRUE : VK_FALSE,
                           moments.flags,
                           moments.sampling,
                           moments.layers,
                           depthHolding(filter.filter, filter.format),
                           variant.few_views,
                           device_.software() ? VK_TRUE : VK_FALSE};
    const Specialisation specialisation(values);
    const ShaderModule fragment = makeShader(device_, fragmentCode(filter.filter, variant.orthographic, variant.ids));
    const TwoStages stages = stagesOf(vertex_, fragment, specialisation.info());
    GraphicsState state;
    state.stages = stages;
    state.layout = layout_.get();
    state.colour_format = mask_.info().format;
    state.cache = options_.pipeline_cache;
    state.name = "mask";
    return makeGraphicsPipeline(device_, state);
}

} // namespace gnomon::vulkan
