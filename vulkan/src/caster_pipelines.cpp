// SPDX-License-Identifier: Apache-2.0
#include "caster_pipelines.h"

#include "caster_instances.h"
#include "map_storage.h"
#include "optional_parts.h"
#include "pipelines.h"
#include "usage.h"

#include <gnomon/error.h>

#include <gnomon/shared/paired_depth.h>
#include <gnomon_spirv.h>

#include <algorithm>
#include <string>

namespace gnomon::vulkan {
namespace {

using Code = std::span<const std::uint32_t>;

/// Plain, masked, clipped, both.
struct VertexCodes {
    std::array<Code, 4> orthographic, metric, perspective;
};

#define GNOMON_MASKED_AND_CLIPPED(name)                                                                                \
    {                                                                                                                  \
        spirv::name##_vert, spirv::name##_masked_vert, spirv::name##_clipped_vert, spirv::name##_masked_clipped_vert   \
    }
// Vertex shaders of masked or clipped casters hand on the metric, whether a fragment shader takes it or not.
#define GNOMON_ORTHOGRAPHIC(name)                                                                                      \
    {                                                                                                                  \
        spirv::name##_vert, spirv::name##_metric_masked_vert, spirv::name##_metric_clipped_vert,                       \
            spirv::name##_metric_masked_clipped_vert                                                                   \
    }
#define GNOMON_VERTEX_CODES(name)                                                                                      \
    {                                                                                                                  \
        GNOMON_ORTHOGRAPHIC(name##_orthographic), GNOMON_MASKED_AND_CLIPPED(name##_orthographic_metric),               \
            GNOMON_MASKED_AND_CLIPPED(name##_perspective)                                                              \
    }
VertexCodes vertexCodes(const CasterPipelineKey& key)
{
    if (key.layered && key.placed) {
        return GNOMON_VERTEX_CODES(caster_layered_placed);
    }
    if (key.layered) {
        return GNOMON_VERTEX_CODES(caster_layered);
    }
    if (key.placed) {
        return GNOMON_VERTEX_CODES(caster_placed);
    }
    return GNOMON_VERTEX_CODES(caster);
}
#undef GNOMON_VERTEX_CODES
#undef GNOMON_ORTHOGRAPHIC

// Of maps that hold ids.
std::array<Code, 4> idVertexCodes(const CasterPipelineKey& key)
{
    if (key.placed) {
        return key.perspective ? std::array<Code, 4> GNOMON_MASKED_AND_CLIPPED(caster_ids_placed_perspective)
                               : std::array<Code, 4>
                                     GNOMON_MASKED_AND_CLIPPED(caster_ids_placed_orthographic_metric);
    }
    return key.perspective ? std::array<Code, 4> GNOMON_MASKED_AND_CLIPPED(caster_ids_perspective)
                           : std::array<Code, 4>
                                 GNOMON_MASKED_AND_CLIPPED(caster_ids_orthographic_metric);
}

Code vertexCode(const MapPassFormats& formats, const CasterPipelineKey& key)
{
    const std::size_t which = (key.masked ? 1U : 0U) + (key.clipped ? 2U : 0U);
    if (formats.paraboloid) {
        return std::array<Code, 4> GNOMON_MASKED_AND_CLIPPED(caster_paraboloid)[which];
    }
    if (formats.ids) {
        return idVertexCodes(key)[which];
    }
    const VertexCodes codes = vertexCodes(key);
    if (key.perspective) {
        return codes.perspective[which];
    }
    return formats.colour != VK_FORMAT_UNDEFINED ? codes.metric[which] : codes.orthographic[which];
}
#undef GNOMON_MASKED_AND_CLIPPED

std::span<const std::uint32_t> paraboloidFragmentCode(const MapPassFormats& formats, bool masked)
{
    if (formats.blended) {
        return spirv::caster_tint_paraboloid_frag;
    }
    if (formats.colour != VK_FORMAT_UNDEFINED) {
        return masked ? spirv::caster_paraboloid_colour_masked_frag : spirv::caster_paraboloid_colour_frag;
    }
    return masked ? spirv::caster_paraboloid_masked_frag : spirv::caster_paraboloid_frag;
}

// Empty where the rasteriser alone does the work.
std::span<const std::uint32_t> fragmentCode(const MapPassFormats& formats, bool masked, bool per_sample)
{
    if (formats.paraboloid) {
        return paraboloidFragmentCode(formats, masked);
    }
    if (formats.blended) {
        return spirv::caster_tint_frag;
    }
    if (formats.ids) {
        return masked ? spirv::caster_ids_masked_frag : spirv::caster_ids_frag;
    }
    if (formats.behind_first && formats.write_frag_depth) {
        return masked ? spirv::caster_behind_depth_masked_frag : spirv::caster_behind_depth_frag;
    }
    if (formats.behind_first) {
        return masked ? spirv::caster_behind_masked_frag : spirv::caster_behind_frag;
    }
    if (formats.colour != VK_FORMAT_UNDEFINED) {
        return masked ? spirv::caster_colour_masked_frag : spirv::caster_colour_frag;
    }
    if (formats.write_frag_depth && per_sample) {
        return masked ? spirv::caster_depth_samples_masked_frag : spirv::caster_depth_samples_frag;
    }
    if (formats.write_frag_depth) {
        return masked ? spirv::caster_depth_masked_frag : spirv::caster_depth_frag;
    }
    // Alpha is tested once for all samples of a texel: testing each would run the shader four times for what is a
    // depth write else.
    return masked ? spirv::caster_masked_frag : std::span<const std::uint32_t>{};
}

// The constants of the casters' shaders, by constant_id.
struct CasterConstants {
    std::int32_t holding = 0;
    float quantum = 0.0F;
    VkBool32 coloured = VK_FALSE;
};

void checkVertices(const CasterVertices& vertices)
{
    constexpr std::array kPositions{VK_FORMAT_R32G32B32_SFLOAT, VK_FORMAT_R32G32B32A32_SFLOAT,
                                    VK_FORMAT_R16G16B16A16_SFLOAT, VK_FORMAT_R16G16B16A16_SNORM,
                                    VK_FORMAT_R16G16B16A16_UNORM};
    constexpr std::array kUvs{VK_FORMAT_UNDEFINED, VK_FORMAT_R32G32_SFLOAT, VK_FORMAT_R16G16_SFLOAT,
                              VK_FORMAT_R16G16_UNORM};
    const auto require = [](const auto& list, auto value, const char* what, const char* remedy) {
        if (std::find(list.begin(), list.end(), value) == list.end()) {
            throw Error("create the caster drawer",
                        std::string(what) + " of Vulkan's number " + std::to_string(static_cast<int>(value)), remedy);
        }
    };
    require(kPositions, vertices.position.format, "a format of positions",
            "choose three or four floats of 32 bits, or four numbers of 16 bits, float, snorm or unorm");
    require(kUvs, vertices.uv.format, "a format of texture coordinates",
            "choose two floats of 32 or 16 bits, or two unorm of 16 bits");
    require(std::array{VK_FORMAT_UNDEFINED, VK_FORMAT_R8G8B8A8_UNORM, VK_FORMAT_R16G16B16A16_UNORM,
                       VK_FORMAT_R16G16B16A16_SFLOAT, VK_FORMAT_R32G32B32A32_SFLOAT},
            vertices.colour.format, "a format of vertex colours",
            "choose four unorm of 8 or 16 bits, or four floats of 16 or 32 bits");
    require(std::array{VK_FORMAT_UNDEFINED, VK_FORMAT_R16_UINT, VK_FORMAT_R32_UINT}, vertices.piece.format,
            "a format of pieces", "choose 16 or 32 bits of unsigned integers");
    require(std::array{VK_INDEX_TYPE_UINT32, VK_INDEX_TYPE_UINT16}, vertices.index, "a type of indices",
            "choose 16 or 32 bits");
}

struct VertexInput {
    std::array<VkVertexInputBindingDescription, 6> bindings{};
    std::array<VkVertexInputAttributeDescription, 12> attributes{};
    std::uint32_t binding_count = 0;
    std::uint32_t attribute_count = 0;
};

VertexInput vertexInput(const CasterPipelineKey& key, const CasterVertices& vertices)
{
    constexpr std::uint32_t kRowBytes = sizeof(glm::vec4);
    const std::uint32_t rows = pack::casterRowCount(!key.perspective);
    VertexInput input;
    input.bindings[input.binding_count++] = {0, vertices.position.stride, VK_VERTEX_INPUT_RATE_VERTEX};
    input.bindings[input.binding_count++] = {1, instanceBytes(key.perspective, key.layered, key.formats.ids),
                                             VK_VERTEX_INPUT_RATE_INSTANCE};
    input.attributes[input.attribute_count++] = {0, 0, vertices.position.format, vertices.position.offset};
    for (std::uint32_t i = 0; i < rows; ++i) {
        input.attributes[input.attribute_count++] = {1 + i, 1, VK_FORMAT_R32G32B32A32_SFLOAT, i * kRowBytes};
    }
    if (key.masked) {
        input.bindings[input.binding_count++] = {2, vertices.uv.stride, VK_VERTEX_INPUT_RATE_VERTEX};
        input.attributes[input.attribute_count++] = {1 + rows, 2, vertices.uv.format, vertices.uv.offset};
        if (key.coloured) {
            input.bindings[input.binding_count++] = {kColourBinding, vertices.colour.stride,
                                                     VK_VERTEX_INPUT_RATE_VERTEX};
            input.attributes[input.attribute_count++] = {11, kColourBinding, vertices.colour.format,
                                                         vertices.colour.offset};
        } else { // Vulkan wants something for every input that a module declares
            input.attributes[input.attribute_count++] = {11, 0, vertices.position.format, vertices.position.offset};
        }
    }
    if (key.formats.ids) {
        input.attributes[input.attribute_count++] = {8, 1, VK_FORMAT_R32G32B32A32_SFLOAT, rows * kRowBytes};
        input.attributes[input.attribute_count++] = {9, 1, VK_FORMAT_R32G32_SFLOAT, (rows + 1) * kRowBytes};
        if (key.formats.pieces) {
            input.bindings[input.binding_count++] = {kPieceBinding, vertices.piece.stride, VK_VERTEX_INPUT_RATE_VERTEX};
            input.attributes[input.attribute_count++] = {10, kPieceBinding, vertices.piece.format,
                                                         vertices.piece.offset};
        } else { // a zero of the instance's own
            input.attributes[input.attribute_count++] = {10, 1, VK_FORMAT_R32_UINT,
                                                         (rows + 1) * kRowBytes + kRowBytes / 2};
        }
    }
    if (key.layered) {
        input.attributes[input.attribute_count++] = {7, 1, VK_FORMAT_R32_UINT, rows * kRowBytes};
    } else if (key.placed) {
        // A stride of 0: all instances read the same.
        input.bindings[input.binding_count++] = {kPlacementBinding, 0, VK_VERTEX_INPUT_RATE_INSTANCE};
        input.attributes[input.attribute_count++] = {7, kPlacementBinding, VK_FORMAT_R32G32B32A32_SFLOAT, 0};
    }
    return input;
}

} // namespace

CasterPipelines::CasterPipelines(Device& device, const CasterDrawerOptions& options)
    : device_(device), options_(options)
{
    checkVertices(options.vertices);
    constexpr std::array kTexture{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER};
    constexpr std::array kPlaces{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER};
    textures_ = DescriptorSets(device, kTexture, VK_SHADER_STAGE_FRAGMENT_BIT);
    places_ = DescriptorSets(device, kPlaces, VK_SHADER_STAGE_VERTEX_BIT);
    first_surface_ = DescriptorSets(device, kTexture, VK_SHADER_STAGE_FRAGMENT_BIT);
    const std::array set_layouts{textures_.layout(), places_.layout(), first_surface_.layout()};
    const VkPushConstantRange range{kMaterialStages, 0, sizeof(CasterMaterial)};
    const VkPipelineLayoutCreateInfo layout_info{
        VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO, nullptr, 0, set_layouts.size(), set_layouts.data(), 1, &range};
    VkPipelineLayout layout = VK_NULL_HANDLE;
    check(device.vk.CreatePipelineLayout(device.handle(), &layout_info, nullptr, &layout), "create a pipeline layout");
    layout_ = {device, layout};
}

void CasterPipelines::ensure(const CasterPipelineKey& key)
{
    if (key.formats.pieces && options_.vertices.piece.format == VK_FORMAT_UNDEFINED) {
        refuseUse("make the pipelines of casters", "id.of face tells pieces of objects apart, and vertices have none",
                  "say where they have them: CasterVertices::piece");
    }
    if (get(key) == VK_NULL_HANDLE) {
        made_.push_back({key, make(key)});
    }
}

VkPipeline CasterPipelines::get(const CasterPipelineKey& key) const
{
    const auto found = std::ranges::find(made_, key, &Made::key);
    return found != made_.end() ? found->pipeline.get() : VK_NULL_HANDLE;
}

Pipeline CasterPipelines::make(const CasterPipelineKey& key)
{
    const MapPassFormats& formats = key.formats;
    const ShaderModule vertex = makeShader(device_, vertexCode(formats, key));
    const bool per_sample = formats.samples != VK_SAMPLE_COUNT_1_BIT && device_.uses().sample_metric;
    const std::span<const std::uint32_t> fragment_code = fragmentCode(formats, key.masked, per_sample);
    ShaderModule fragment;
    const CasterConstants constants{formats.colour == VK_FORMAT_R8G8B8A8_UNORM ? shared::kDepthBytes
                                                                               : shared::kDepthAlone,
                                    depthRounding(formats.depth), key.coloured ? VK_TRUE : VK_FALSE};
    const std::array entries{
        VkSpecializationMapEntry{0, offsetof(CasterConstants, holding), sizeof constants.holding},
        VkSpecializationMapEntry{1, offsetof(CasterConstants, quantum), sizeof constants.quantum},
        VkSpecializationMapEntry{2, offsetof(CasterConstants, coloured), sizeof constants.coloured}};
    const VkSpecializationInfo specialisation{entries.size(), entries.data(), sizeof constants, &constants};
    std::array<VkPipelineShaderStageCreateInfo, 2> stages{};
    stages[0].sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    stages[0].stage = VK_SHADER_STAGE_VERTEX_BIT;
    stages[0].module = vertex.get();
    stages[0].pName = "main";
    stages[0].pSpecializationInfo = key.coloured ? &specialisation : nullptr;
    if (!fragment_code.empty()) {
        fragment = makeShader(device_, fragment_code);
        stages[1] = stages[0];
        stages[1].stage = VK_SHADER_STAGE_FRAGMENT_BIT;
        stages[1].module = fragment.get();
        if ((formats.colour != VK_FORMAT_UNDEFINED && !formats.blended) || formats.behind_first || key.coloured) {
            stages[1].pSpecializationInfo = &specialisation;
        }
    }
    const VertexInput input = vertexInput(key, options_.vertices);

    GraphicsState state;
    state.stages = std::span(stages).first(fragment ? 2 : 1);
    state.layout = layout_.get();
    state.bindings = std::span(input.bindings).first(input.binding_count);
    state.attributes = std::span(input.attributes).first(input.attribute_count);
    state.colour_format = formats.colour;
    state.colour_mask = colourMaskOf(formats.colour, key.part);
    state.tints = formats.blended;
    state.depth_format = formats.depth;
    state.samples = formats.samples;
    // The shader's inputs say so already (caster.frag); Mesa 22.3 wants to hear it here.
    state.shade_samples = formats.write_frag_depth && per_sample;
    state.cull = key.cull;
    if (key.clamp) {
        requirePart(device_, "draw casters that are clamped onto a near plane", &FeatureUses::depth_clamp);
    }
    if (key.clipped) {
        requirePart(device_, "draw casters that planes cut", &FeatureUses::clip_planes);
    }
    state.depth_clamp = key.clamp;
    state.cache = options_.pipeline_cache;
    state.name = key.masked ? "masked casters" : "casters";
    return makeGraphicsPipeline(device_, state);
}

} // namespace gnomon::vulkan
