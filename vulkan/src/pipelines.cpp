// SPDX-License-Identifier: Apache-2.0
#include "pipelines.h"

#include <algorithm>

namespace gnomon::vulkan {

TwoStages stagesOf(const ShaderModule& vertex, const ShaderModule& fragment, const VkSpecializationInfo* specialisation)
{
    TwoStages stages{};
    for (VkPipelineShaderStageCreateInfo& stage : stages) {
        stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
        stage.pName = "main";
    }
    stages[0].stage = VK_SHADER_STAGE_VERTEX_BIT;
    stages[0].module = vertex.get();
    stages[1].stage = VK_SHADER_STAGE_FRAGMENT_BIT;
    stages[1].module = fragment.get();
    stages[1].pSpecializationInfo = specialisation;
    return stages;
}

Pipeline makeGraphicsPipeline(Device& device, const GraphicsState& state)
{
    VkPipelineVertexInputStateCreateInfo input{VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO};
    input.vertexBindingDescriptionCount = static_cast<std::uint32_t>(state.bindings.size());
    input.pVertexBindingDescriptions = state.bindings.data();
    input.vertexAttributeDescriptionCount = static_cast<std::uint32_t>(state.attributes.size());
    input.pVertexAttributeDescriptions = state.attributes.data();
    VkPipelineInputAssemblyStateCreateInfo assembly{VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO};
    assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    VkPipelineViewportStateCreateInfo viewport{VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO};
    viewport.viewportCount = 1;
    viewport.scissorCount = 1;
    VkPipelineRasterizationStateCreateInfo raster{VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO};
    raster.depthBiasEnable = state.depth_bias_slope != 0.0F ? VK_TRUE : VK_FALSE;
    raster.depthBiasSlopeFactor = state.depth_bias_slope;
    raster.depthClampEnable = state.depth_clamp ? VK_TRUE : VK_FALSE;
    raster.cullMode = state.cull;
    raster.frontFace = VK_FRONT_FACE_COUNTER_CLOCKWISE;
    raster.lineWidth = 1.0F;
    VkPipelineMultisampleStateCreateInfo multisample{VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO};
    multisample.rasterizationSamples = state.samples;
    multisample.sampleShadingEnable = state.shade_samples ? VK_TRUE : VK_FALSE;
    multisample.minSampleShading = state.shade_samples ? 1.0F : 0.0F;
    VkPipelineDepthStencilStateCreateInfo depth{VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO};
    depth.depthTestEnable = state.depth_format != VK_FORMAT_UNDEFINED ? VK_TRUE : VK_FALSE;
    depth.depthWriteEnable = state.tints ? VK_FALSE : depth.depthTestEnable;
    depth.depthCompareOp = VK_COMPARE_OP_LESS_OR_EQUAL;
    if (state.depth_stencil != nullptr) {
        depth = *state.depth_stencil;
    }
    std::array<VkPipelineColorBlendAttachmentState, 3> attachments{};
    attachments[0].colorWriteMask = state.colour_mask;
    attachments[0].blendEnable = state.keeps_least ? VK_TRUE : VK_FALSE;
    attachments[0].colorBlendOp = state.keeps_least ? VK_BLEND_OP_MIN : VK_BLEND_OP_ADD;
    attachments[0].alphaBlendOp = attachments[0].colorBlendOp;
    if (state.takes_away) {
        attachments[0].blendEnable = VK_TRUE;
        attachments[0].srcColorBlendFactor = attachments[0].dstColorBlendFactor = VK_BLEND_FACTOR_ONE;
        attachments[0].srcAlphaBlendFactor = attachments[0].dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE;
        attachments[0].colorBlendOp = attachments[0].alphaBlendOp = VK_BLEND_OP_REVERSE_SUBTRACT;
    }
    if (state.chooses_channels) {
        attachments[0].blendEnable = VK_TRUE;
        attachments[0].srcColorBlendFactor = VK_BLEND_FACTOR_CONSTANT_COLOR;
        attachments[0].dstColorBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_CONSTANT_COLOR;
        attachments[0].srcAlphaBlendFactor = VK_BLEND_FACTOR_CONSTANT_ALPHA;
        attachments[0].dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_CONSTANT_ALPHA;
    }
    if (state.tints) {
        attachments[0].blendEnable = VK_TRUE;
        attachments[0].dstColorBlendFactor = VK_BLEND_FACTOR_SRC_COLOR;
        attachments[0].alphaBlendOp = VK_BLEND_OP_MIN;
    }
    attachments[1].colorWriteMask =
        VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT | VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT;
    attachments[2].colorWriteMask = attachments[1].colorWriteMask;
    const std::array<VkFormat, 3> colour_formats{state.colour_format, state.second_format, state.third_format};
    const auto colours =
        static_cast<std::uint32_t>(std::ranges::find(colour_formats, VK_FORMAT_UNDEFINED) - colour_formats.begin());
    VkPipelineColorBlendStateCreateInfo blend{VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO};
    blend.attachmentCount = colours;
    blend.pAttachments = attachments.data();
    std::array<VkDynamicState, 4> dynamic_states{VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
    VkPipelineDynamicStateCreateInfo dynamic{VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO};
    dynamic.dynamicStateCount = 2;
    if (state.chooses_channels) {
        dynamic_states[dynamic.dynamicStateCount++] = VK_DYNAMIC_STATE_BLEND_CONSTANTS;
    }
    if (depth.depthBoundsTestEnable == VK_TRUE) {
        dynamic_states[dynamic.dynamicStateCount++] = VK_DYNAMIC_STATE_DEPTH_BOUNDS;
    }
    dynamic.pDynamicStates = dynamic_states.data();
    VkPipelineRenderingCreateInfo rendering{VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO};
    rendering.colorAttachmentCount = colours;
    rendering.pColorAttachmentFormats = colour_formats.data();
    rendering.depthAttachmentFormat = state.depth_format;
    rendering.stencilAttachmentFormat = state.stencil_format;

    VkGraphicsPipelineCreateInfo create{VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO, &rendering};
    create.stageCount = static_cast<std::uint32_t>(state.stages.size());
    create.pStages = state.stages.data();
    create.pVertexInputState = &input;
    create.pInputAssemblyState = &assembly;
    create.pViewportState = &viewport;
    create.pRasterizationState = &raster;
    create.pMultisampleState = &multisample;
    create.pDepthStencilState = &depth;
    create.pColorBlendState = &blend;
    create.pDynamicState = &dynamic;
    create.layout = state.layout;
    VkPipeline pipeline = VK_NULL_HANDLE;
    check(device.vk.CreateGraphicsPipelines(device.handle(), state.cache, 1, &create, nullptr, &pipeline),
          "create a graphics pipeline");
    device.name(VK_OBJECT_TYPE_PIPELINE, handleBits(pipeline), state.name);
    return {device, pipeline};
}

Pipeline makeComputePipeline(Device& device, const ComputeState& state)
{
    const ShaderModule module = makeShader(device, state.spirv);
    VkComputePipelineCreateInfo create{VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO};
    create.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    create.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    create.stage.module = module.get();
    create.stage.pName = "main";
    create.stage.pSpecializationInfo = state.specialisation;
    create.layout = state.layout;
    VkPipeline pipeline = VK_NULL_HANDLE;
    check(device.vk.CreateComputePipelines(device.handle(), state.cache, 1, &create, nullptr, &pipeline),
          "create a compute pipeline");
    device.name(VK_OBJECT_TYPE_PIPELINE, handleBits(pipeline), state.name);
    return {device, pipeline};
}

} // namespace gnomon::vulkan
