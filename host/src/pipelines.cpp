// SPDX-License-Identifier: Apache-2.0
#include "pipelines.h"

#include "devices.h"
#include "geometry.h"
#include "pipeline_wish.h"
#include "shaders.h"

#include <gnomon/error.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <tuple>

namespace gnomon::host {
namespace {

constexpr std::array<VkVertexInputBindingDescription, 4> kBindings{
    {{0, sizeof(glm::vec3), VK_VERTEX_INPUT_RATE_VERTEX},
     {1, sizeof(glm::vec2), VK_VERTEX_INPUT_RATE_VERTEX},
     {2, sizeof(VertexAttributes), VK_VERTEX_INPUT_RATE_VERTEX},
     {3, sizeof(InstanceData), VK_VERTEX_INPUT_RATE_INSTANCE}}};
constexpr std::array<VkVertexInputAttributeDescription, 10> kAttributes{
    {{0, 0, VK_FORMAT_R32G32B32_SFLOAT, 0},
     {1, 1, VK_FORMAT_R32G32_SFLOAT, 0},
     {2, 2, VK_FORMAT_R16G16B16A16_SNORM, offsetof(VertexAttributes, normal)},
     {3, 2, VK_FORMAT_R8G8B8A8_SNORM, offsetof(VertexAttributes, tangent)},
     {4, 2, VK_FORMAT_R16G16B16A16_UNORM, offsetof(VertexAttributes, colour)},
     {5, 2, VK_FORMAT_R32G32_SFLOAT, offsetof(VertexAttributes, uv_other)},
     {6, 3, VK_FORMAT_R32G32B32A32_SFLOAT, offsetof(InstanceData, row_x)},
     {7, 3, VK_FORMAT_R32G32B32A32_SFLOAT, offsetof(InstanceData, row_y)},
     {8, 3, VK_FORMAT_R32G32B32A32_SFLOAT, offsetof(InstanceData, row_z)},
     {9, 3, VK_FORMAT_R32G32B32_UINT, offsetof(InstanceData, id)}}};

VkPipelineColorBlendAttachmentState blendState(bool add)
{
    VkPipelineColorBlendAttachmentState state{};
    state.colorWriteMask =
        VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT | VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT;
    // Premultiplied; light that is only added has an alpha of 0.
    state.blendEnable = add ? VK_TRUE : VK_FALSE;
    state.srcColorBlendFactor = VK_BLEND_FACTOR_ONE;
    state.dstColorBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA;
    state.colorBlendOp = VK_BLEND_OP_ADD;
    state.srcAlphaBlendFactor = VK_BLEND_FACTOR_ONE;
    state.dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA;
    state.alphaBlendOp = VK_BLEND_OP_ADD;
    return state;
}

constexpr std::array<VkDynamicState, 4> kDynamic{VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR,
                                                 VK_DYNAMIC_STATE_CULL_MODE, VK_DYNAMIC_STATE_FRONT_FACE};

// State that hardly differs from pipeline to pipeline. Points into itself, so it must not move.
struct FixedState {
    FixedState(bool scene, std::size_t colours, bool blends)
    {
        if (scene) {
            input.vertexBindingDescriptionCount = kBindings.size();
            input.pVertexBindingDescriptions = kBindings.data();
            input.vertexAttributeDescriptionCount = kAttributes.size();
            input.pVertexAttributeDescriptions = kAttributes.data();
        }
        assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
        viewport.viewportCount = 1;
        viewport.scissorCount = 1;
        raster.frontFace = VK_FRONT_FACE_COUNTER_CLOCKWISE;
        raster.lineWidth = 1.0F;
        samples.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
        attachments.fill(blendState(blends));
        blend.attachmentCount = static_cast<std::uint32_t>(colours);
        blend.pAttachments = attachments.data();
        dynamic.dynamicStateCount = scene ? 4 : 2; // a full-screen triangle has no side
        dynamic.pDynamicStates = kDynamic.data();
    }
    FixedState(const FixedState&) = delete;
    FixedState& operator=(const FixedState&) = delete;

    VkPipelineVertexInputStateCreateInfo input{VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO};
    VkPipelineInputAssemblyStateCreateInfo assembly{VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO};
    VkPipelineViewportStateCreateInfo viewport{VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO};
    VkPipelineRasterizationStateCreateInfo raster{VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO};
    VkPipelineMultisampleStateCreateInfo samples{VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO};
    std::array<VkPipelineColorBlendAttachmentState, std::tuple_size_v<GBufferFormats>> attachments{};
    VkPipelineColorBlendStateCreateInfo blend{VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO};
    VkPipelineDynamicStateCreateInfo dynamic{VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO};
};

} // namespace

GBufferFormats gbufferFormats(const Gpu& gpu)
{
    constexpr VkFormatFeatureFlags kUses = VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT | VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT;
    const auto first = [&](VkFormat small, VkFormat promised) {
        return gpu.formatCan(small, kUses) ? small : promised;
    };
    return {VK_FORMAT_R32G32B32A32_UINT, first(VK_FORMAT_R16G16_SNORM, VK_FORMAT_R32G32_SFLOAT), VK_FORMAT_R32_UINT,
            first(VK_FORMAT_R16G16B16A16_SNORM, VK_FORMAT_R32G32B32A32_SFLOAT)};
}

Pipelines::Pipelines(const Gpu& gpu, const DebugNames& names, const Materials& materials, const DrawTable& table)
    : gbuffer_formats(gbufferFormats(gpu)), gpu_(gpu), names_(names), table_(table)
{
    makeLayouts(materials.layout());
    physical_only_ =
        std::all_of(materials.all().begin(), materials.all().end(), [](const MaterialFacts& m) { return m.physical; });
    fades_ =
        std::any_of(materials.all().begin(), materials.all().end(), [](const MaterialFacts& m) { return m.fades; });
    if (hasForwardSamplers(gpu.properties().limits)) {
        makeShadowedLayout(materials.layout());
    }
    makeScene(materials);
    makeDepthAlone();
    sky = makeSky({});
}

void Pipelines::makeLayouts(VkDescriptorSetLayout material)
{
    VkDevice device = gpu_.view().device;
    std::array<VkDescriptorSetLayoutBinding, kFrameBindings> bindings{};
    for (std::uint32_t i = 0; i < bindings.size(); ++i) {
        bindings[i] = {i, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1, VK_SHADER_STAGE_FRAGMENT_BIT, nullptr};
    }
    bindings[0].descriptorType = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
    bindings[0].stageFlags |= VK_SHADER_STAGE_VERTEX_BIT;
    VkDescriptorSetLayoutCreateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
    info.bindingCount = bindings.size();
    info.pBindings = bindings.data();
    VkDescriptorSetLayout frame = VK_NULL_HANDLE;
    check(vkCreateDescriptorSetLayout(device, &info, nullptr, &frame), "making a descriptor set layout");
    frame_layout = {gpu_, frame};
    names_.name(VK_OBJECT_TYPE_DESCRIPTOR_SET_LAYOUT, frame, "frame");
    const std::array<VkDescriptorSetLayout, 2> sets{frame, material};
    scene_layout = makeLayout(sets, true);
    screen_layout = makeLayout(std::span(sets).first(1));
    names_.name(VK_OBJECT_TYPE_PIPELINE_LAYOUT, scene_layout.get(), "scene");
    names_.name(VK_OBJECT_TYPE_PIPELINE_LAYOUT, screen_layout.get(), "screen");
    makeCompactLayout();
}

void Pipelines::makeCompactLayout()
{
    const VkDescriptorSetLayoutBinding tiles{0, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, VK_SHADER_STAGE_FRAGMENT_BIT,
                                             nullptr};
    VkDescriptorSetLayoutCreateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
    info.bindingCount = 1;
    info.pBindings = &tiles;
    VkDescriptorSetLayout layout = VK_NULL_HANDLE;
    check(vkCreateDescriptorSetLayout(gpu_.view().device, &info, nullptr, &layout), "making a descriptor set layout");
    tiles_layout = {gpu_, layout};
    names_.name(VK_OBJECT_TYPE_DESCRIPTOR_SET_LAYOUT, layout, "mask tiles");
    const std::array<VkDescriptorSetLayout, 2> sets{frame_layout.get(), layout};
    compact_layout = makeLayout(sets);
    names_.name(VK_OBJECT_TYPE_PIPELINE_LAYOUT, compact_layout.get(), "compact");
}

void Pipelines::makeShadowedLayout(VkDescriptorSetLayout material)
{
    std::array<VkDescriptorSetLayoutBinding, kMapsBindings.size()> bindings{};
    for (std::uint32_t i = 0; i < bindings.size(); ++i) {
        bindings[i] = {i, kMapsBindings[i], 1, VK_SHADER_STAGE_FRAGMENT_BIT, nullptr};
    }
    VkDescriptorSetLayoutCreateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
    info.bindingCount = bindings.size();
    info.pBindings = bindings.data();
    VkDescriptorSetLayout maps = VK_NULL_HANDLE;
    check(vkCreateDescriptorSetLayout(gpu_.view().device, &info, nullptr, &maps), "making a descriptor set layout");
    maps_layout = {gpu_, maps};
    names_.name(VK_OBJECT_TYPE_DESCRIPTOR_SET_LAYOUT, maps, "maps");
    const std::array<VkDescriptorSetLayout, 3> sets{frame_layout.get(), material, maps};
    shadowed_layout = makeLayout(sets, true);
    names_.name(VK_OBJECT_TYPE_PIPELINE_LAYOUT, shadowed_layout.get(), "shadowed");
}

OwnedPipelineLayout Pipelines::makeLayout(std::span<const VkDescriptorSetLayout> sets, bool of_scene) const
{
    const VkPushConstantRange cut{VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof(scene::ClipPlanes)};
    VkPipelineLayoutCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
    info.setLayoutCount = static_cast<std::uint32_t>(sets.size());
    info.pSetLayouts = sets.data();
    info.pushConstantRangeCount = of_scene ? 1 : 0;
    info.pPushConstantRanges = &cut;
    VkPipelineLayout layout = VK_NULL_HANDLE;
    check(vkCreatePipelineLayout(gpu_.view().device, &info, nullptr, &layout), "making a pipeline layout");
    return {gpu_, layout};
}

OwnedShader Pipelines::module(std::string_view name) const
{
    const std::span<const std::uint32_t> words = shaderWords(gpu_.view().shaders, name);
    VkShaderModuleCreateInfo info{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
    info.codeSize = words.size_bytes();
    info.pCode = words.data();
    VkShaderModule result = VK_NULL_HANDLE;
    check(vkCreateShaderModule(gpu_.view().device, &info, nullptr, &result), "making a shader");
    return {gpu_, result};
}

VkPipeline Pipelines::make(const Wish& wish)
{
    std::array<VkSpecializationMapEntry, kMostConstants> entries{};
    for (std::uint32_t i = 0; i < entries.size(); ++i) {
        entries[i] = {i, i * 4, 4};
    }
    std::array<VkBool32, kMostConstants> values = wish.constants;
    values[kInSoftware] = gpu_.software() ? VK_TRUE : VK_FALSE;
    const VkSpecializationInfo constants{entries.size(), entries.data(), sizeof values, values.data()};
    std::array<VkPipelineShaderStageCreateInfo, 2> stages{};
    const std::size_t stage_count = wish.fragment.empty() ? 1 : 2;
    std::array<OwnedShader, 2> modules{module(wish.vertex), {}};
    if (stage_count == 2) {
        modules[1] = module(wish.fragment);
    }
    for (std::size_t i = 0; i < stage_count; ++i) {
        stages[i].sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
        stages[i].stage = i == 0 ? VK_SHADER_STAGE_VERTEX_BIT : VK_SHADER_STAGE_FRAGMENT_BIT;
        stages[i].module = modules[i].get();
        stages[i].pName = "main";
        stages[i].pSpecializationInfo = &constants;
    }
    const FixedState fixed(wish.scene, wish.colours.size(), wish.blend);
    VkPipelineDepthStencilStateCreateInfo depth{VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO};
    depth.depthTestEnable = wish.depth ? VK_TRUE : VK_FALSE;
    depth.depthWriteEnable = wish.depth_write ? VK_TRUE : VK_FALSE;
    depth.depthCompareOp = wish.compare;
    VkPipelineRenderingCreateInfo rendering{VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO};
    rendering.colorAttachmentCount = static_cast<std::uint32_t>(wish.colours.size());
    rendering.pColorAttachmentFormats = wish.colours.data();
    rendering.depthAttachmentFormat = wish.depth ? kDepthFormat : VK_FORMAT_UNDEFINED;

    VkGraphicsPipelineCreateInfo info{VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO};
    info.pNext = &rendering;
    info.stageCount = static_cast<std::uint32_t>(stage_count);
    info.pStages = stages.data();
    info.pVertexInputState = &fixed.input;
    info.pInputAssemblyState = &fixed.assembly;
    info.pViewportState = &fixed.viewport;
    info.pRasterizationState = &fixed.raster;
    info.pMultisampleState = &fixed.samples;
    info.pDepthStencilState = &depth;
    info.pColorBlendState = &fixed.blend;
    info.pDynamicState = &fixed.dynamic;
    info.layout = wish.layout != VK_NULL_HANDLE ? wish.layout : (wish.scene ? scene_layout : screen_layout).get();
    VkPipeline pipeline = VK_NULL_HANDLE;
    check(vkCreateGraphicsPipelines(gpu_.view().device, gpu_.pipelineCache(), 1, &info, nullptr, &pipeline),
          "compiling shaders");
    all_.push_back(OwnedPipeline(gpu_, pipeline));
    names_.name(VK_OBJECT_TYPE_PIPELINE, pipeline, wish.name);
    return pipeline;
}

SurfacePipelines Pipelines::makeSurface(Wish wish, bool cut)
{
    const bool without_colour = wish.vertex == "depth.vert";
    SurfacePipelines pipelines;
    wish.vertex = without_colour ? "depth.vert" : "scene.vert";
    pipelines.whole = make(wish);
    if (cut) {
        if (!gpu_.view().features.clip_planes) {
            throw Error("drawing objects that planes cut", "the device has no shaderClipDistance",
                        "draw a scene without such objects");
        }
        wish.vertex = without_colour ? "depth_clipped.vert" : "scene_clipped.vert";
        pipelines.cut = make(wish);
    }
    return pipelines;
}

void Pipelines::makeScene(const Materials& materials)
{
    const auto any = [&materials](auto&& says) {
        return std::any_of(materials.all().begin(), materials.all().end(), says);
    };
    const auto anyCut = [&](auto&& says) {
        return std::ranges::any_of(table_.batches, [&](const Batch& batch) {
            return batch.cut != 0 && says(materials.all()[batch.material]);
        });
    };
    for (std::size_t i = 0; i < opaque_kinds_.size(); ++i) {
        const auto kind = static_cast<SurfaceKind>(i);
        const auto isOpaque = [kind](const MaterialFacts& m) {
            return m.kind == kind && !m.blended;
        };
        if (any(isOpaque)) {
            opaque_kinds_[i] = anyCut(isOpaque) ? Kind::cut : Kind::whole;
        }
    }
    Wish wish = blendedWish();
    const auto isBlended = [](const MaterialFacts& m) {
        return m.blended;
    };
    if (any(isBlended)) {
        blended_is_cut_ = anyCut(isBlended);
        blended = makeSurface(wish, blended_is_cut_);
    }
    const auto emitsOnly = [](const MaterialFacts& m) {
        return m.emits && !m.blended;
    };
    if (any(emitsOnly)) {
        wish.name = "emissive";
        wish.constants = {};
        wish.constants[kAllTextures] = VK_TRUE;
        wish.constants[kEmits] = VK_TRUE;
        wish.constants[kEmissiveOnly] = VK_TRUE;
        emissive = makeSurface(wish, anyCut(emitsOnly));
    }
}

const KindPipelines& Pipelines::gbufferFor(const GBufferShape& shape)
{
    const std::size_t number = (shape.ids ? 1U : 0U) + (shape.smooth ? 2U : 0U);
    std::optional<KindPipelines>& known = gbuffer_[number];
    if (known) {
        return *known;
    }
    std::array<VkFormat, std::tuple_size_v<GBufferFormats>> formats{};
    for (std::size_t i = 0; i < shape.count(); ++i) {
        formats[i] = gbuffer_formats[shape.image(i)];
    }
    Wish wish;
    wish.scene = true;
    wish.depth = true;
    wish.compare = VK_COMPARE_OP_EQUAL; // with what depth_alone drew
    wish.colours = std::span(formats).first(shape.count());
    wish.name = "g-buffer";
    constexpr std::array<const char*, 4> kFragments{"gbuffer.frag", "gbuffer_ids.frag", "gbuffer_smooth.frag",
                                                    "gbuffer_ids_smooth.frag"};
    wish.fragment = kFragments[number];
    KindPipelines made{};
    for (std::size_t i = 0; i < made.size(); ++i) {
        if (opaque_kinds_[i] != Kind::none) {
            setKind(wish, static_cast<SurfaceKind>(i));
            made[i] = makeSurface(wish, opaque_kinds_[i] == Kind::cut);
        }
    }
    return known.emplace(made);
}

Pipelines::Wish Pipelines::blendedWish()
{
    Wish wish;
    wish.name = "blended";
    wish.fragment = "forward.frag";
    wish.constants[kBaseTexture] = VK_TRUE;
    wish.constants[kAllTextures] = VK_TRUE;
    wish.constants[kTints] = VK_TRUE;
    wish.constants[kEmits] = VK_TRUE;
    wish.colours = {&kLightFormat, 1};
    wish.scene = true;
    wish.blend = true;
    wish.depth = true;
    wish.compare = VK_COMPARE_OP_GREATER_OR_EQUAL;
    return wish;
}

void Pipelines::setKind(Wish& wish, SurfaceKind kind)
{
    wish.constants[kBaseTexture] = kind != SurfaceKind::plain;
    wish.constants[kAllTextures] = kind == SurfaceKind::full || kind == SurfaceKind::full_masked;
}

} // namespace gnomon::host
