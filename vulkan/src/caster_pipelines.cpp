// SPDX-License-Identifier: Apache-2.0
#include "caster_pipelines.h"

#include "caster_instances.h"
#include "map_storage.h"
#include "optional_parts.h"
#include "pipelines.h"
#include "specialisation.h"
#include "usage.h"

#include <gnomon/error.h>

#include <gnomon/shared/paired_depth.h>
#include <gnomon_spirv.h>

#include <algorithm>
#include <string>

namespace gnomon::vulkan {
namespace {

using Code = std::span<const std::uint32_t>;

Code vertexCode(const CasterPipelineKey& key)
{
    if (key.layered && key.placed) {
        return key.clipped ? spirv::caster_layered_placed_clipped_vert : spirv::caster_layered_placed_vert;
    }
    if (key.layered) {
        return key.clipped ? spirv::caster_layered_clipped_vert : spirv::caster_layered_vert;
    }
    return key.clipped ? spirv::caster_clipped_vert : spirv::caster_vert;
}

/// The fragment shaders of a caster without and with the holes of a texture.
struct FragmentCodes {
    Code whole;
    Code masked;
};

// The code is empty where the rasteriser alone does the work.
FragmentCodes fragmentCodes(const CasterPipelineKey& key, bool per_sample)
{
    using namespace spirv;
    const MapPassFormats& formats = key.formats;
    const bool coloured = formats.colour != VK_FORMAT_UNDEFINED;
    if (formats.blended) {
        return {caster_tint_frag, caster_tint_frag};
    }
    if (key.classic.behind_first) {
        return {caster_behind_frag, caster_behind_masked_frag};
    }
    if (key.classic.paraboloid && coloured) {
        return {caster_colour_depth_frag, caster_colour_depth_masked_frag};
    }
    if (coloured) {
        return {caster_colour_frag, caster_colour_masked_frag};
    }
    if (formats.write_frag_depth && per_sample && !key.classic.paraboloid) {
        return {caster_depth_samples_frag, caster_depth_samples_masked_frag};
    }
    if (formats.write_frag_depth || key.classic.paraboloid) {
        return {caster_depth_frag, caster_depth_masked_frag};
    }
    // Alpha is tested once for all samples of a texel: testing each would run the shader four times for what is
    // otherwise a depth write.
    return {{}, caster_masked_frag};
}

/// The constant_ids of the casters' shaders, four bytes each, in their order.
struct CasterConstants {
    std::int32_t holding = 0;
    float quantum = 0.0F;
    VkBool32 coloured = VK_FALSE;
    VkBool32 masked = VK_FALSE;
    VkBool32 perspective = VK_FALSE;
    VkBool32 metric = VK_FALSE;
    VkBool32 ids = VK_FALSE;
    VkBool32 paraboloid = VK_FALSE;
    VkBool32 placed = VK_FALSE;
    VkBool32 own_depth = VK_FALSE;
};

VkBool32 asBool32(bool value)
{
    return value ? VK_TRUE : VK_FALSE;
}

CasterConstants constantsOf(const CasterPipelineKey& key, bool has_fragment)
{
    const MapPassFormats& formats = key.formats;
    return {formats.colour == VK_FORMAT_R8G8B8A8_UNORM ? shared::kDepthBytes : shared::kDepthAlone,
            depthRounding(formats.depth),
            asBool32(key.coloured),
            asBool32(key.masked),
            asBool32(key.perspective),
            asBool32(has_fragment),
            asBool32(key.classic.ids),
            asBool32(key.classic.paraboloid),
            asBool32(key.placed),
            asBool32(formats.write_frag_depth)};
}

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

    void bind(std::uint32_t binding, std::uint32_t stride, VkVertexInputRate rate)
    {
        bindings[binding_count++] = {binding, stride, rate};
    }
    void read(std::uint32_t location, std::uint32_t binding, VkFormat format, std::uint32_t offset)
    {
        attributes[location] = {location, binding, format, offset};
    }
};

// Vulkan wants something for every input that a module declares: of what the pipeline does not read, the first row.
VertexInput vertexInput(const CasterPipelineKey& key, const CasterVertices& vertices)
{
    constexpr std::uint32_t kRowBytes = sizeof(glm::vec4);
    constexpr VkFormat kRow = VK_FORMAT_R32G32B32A32_SFLOAT;
    constexpr std::uint32_t kUv = 6;
    constexpr std::uint32_t kPlace = 7;
    constexpr std::uint32_t kOwn = 8;
    constexpr std::uint32_t kId = 9;
    constexpr std::uint32_t kPiece = 10;
    constexpr std::uint32_t kColour = 11;
    const std::uint32_t rows = pack::casterRowCount(!key.perspective);
    VertexInput input;
    for (std::uint32_t location = 1; location < input.attributes.size(); ++location) {
        const bool whole = location == kPiece || (location == kPlace && key.layered);
        input.read(location, 1, whole ? VK_FORMAT_R32_UINT : kRow, 0);
    }
    input.bind(0, vertices.position.stride, VK_VERTEX_INPUT_RATE_VERTEX);
    input.bind(1, instanceBytes(key.perspective, key.layered, key.classic.ids), VK_VERTEX_INPUT_RATE_INSTANCE);
    input.read(0, 0, vertices.position.format, vertices.position.offset);
    for (std::uint32_t i = 0; i < rows; ++i) {
        input.read(1 + i, 1, kRow, i * kRowBytes);
    }
    if (key.masked) {
        input.bind(2, vertices.uv.stride, VK_VERTEX_INPUT_RATE_VERTEX);
        input.read(kUv, 2, vertices.uv.format, vertices.uv.offset);
    }
    if (key.masked && key.coloured) {
        input.bind(kColourBinding, vertices.colour.stride, VK_VERTEX_INPUT_RATE_VERTEX);
        input.read(kColour, kColourBinding, vertices.colour.format, vertices.colour.offset);
    }
    if (key.classic.ids) {
        input.read(kOwn, 1, kRow, rows * kRowBytes);
        input.read(kId, 1, VK_FORMAT_R32G32_SFLOAT, (rows + 1) * kRowBytes);
        input.read(kPiece, 1, VK_FORMAT_R32_UINT, (rows + 1) * kRowBytes + kRowBytes / 2); // a zero
    }
    if (key.classic.pieces) {
        input.bind(kPieceBinding, vertices.piece.stride, VK_VERTEX_INPUT_RATE_VERTEX);
        input.read(kPiece, kPieceBinding, vertices.piece.format, vertices.piece.offset);
    }
    if (key.layered) {
        input.read(kPlace, 1, VK_FORMAT_R32_UINT, rows * kRowBytes);
    } else if (key.placed) {
        // A stride of 0: all instances read the same.
        input.bind(kPlacementBinding, 0, VK_VERTEX_INPUT_RATE_INSTANCE);
        input.read(kPlace, kPlacementBinding, kRow, 0);
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
    if (key.classic.pieces && options_.vertices.piece.format == VK_FORMAT_UNDEFINED) {
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
    const ShaderModule vertex = makeShader(device_, vertexCode(key));
    const bool per_sample = formats.samples != VK_SAMPLE_COUNT_1_BIT && device_.uses().sample_metric;
    const FragmentCodes codes = fragmentCodes(key, per_sample);
    const Code fragment_code = key.masked ? codes.masked : codes.whole;
    const Specialisation specialisation(constantsOf(key, !fragment_code.empty()));
    ShaderModule fragment;
    if (!fragment_code.empty()) {
        fragment = makeShader(device_, fragment_code);
    }
    TwoStages stages = stagesOf(vertex, fragment, specialisation.info());
    stages[0].pSpecializationInfo = specialisation.info();
    const VertexInput input = vertexInput(key, options_.vertices);

    GraphicsState state;
    state.stages = std::span(stages).first(fragment ? 2 : 1);
    state.layout = layout_.get();
    state.bindings = std::span(input.bindings).first(input.binding_count);
    state.attributes = input.attributes;
    state.colour_format = formats.colour;
    state.colour_mask = colourMaskOf(formats.colour, key.part);
    state.tints = formats.blended;
    state.depth_format = formats.depth;
    state.samples = formats.samples;
    // The shader's inputs say so already (caster.frag) [drivers: per-sample].
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
