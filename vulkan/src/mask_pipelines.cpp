// SPDX-License-Identifier: Apache-2.0
#include "mask_pipelines.h"

#include "mask_marks.h"
#include "pipelines.h"
#include "specialisation.h"

#include <gnomon_spirv.h>

#include <algorithm>
#include <string>

namespace gnomon::vulkan {
namespace {

MaskCode codeOf(const Device& device, Filter module)
{
    std::string name(nameOf(module));
    std::ranges::replace(name, '-', '_');
    return {device.shaderCalled("mask_" + name + ".frag"), device.shaderCalled("mask_" + name + "_one.frag")};
}

} // namespace

MaskPipelineKey maskPipelineKey(const ResolvedOptions& options, MaskShape shape)
{
    MaskPipelineKey key;
    key.module = pack::filterModule(options);
    key.constants = pack::maskConstants(options, {shape.normals, shape.ids, shape.smooth});
    return key;
}

MaskPipelineKey drawnAs(MaskPipelineKey key, DrawnAs as)
{
    key.as = as;
    key.constants.pixels_per_texel = as == DrawnAs::half ? 2 : 1;
    key.constants.settles = as == DrawnAs::settled ? VK_TRUE : VK_FALSE;
    return key;
}

DrawnAs drawnFirst(const ResolvedOptions& options)
{
    if (options.halvesMask()) {
        return DrawnAs::half;
    }
    return options.traits().integrates_light ? DrawnAs::settled : DrawnAs::whole;
}

MaskPipelines::MaskPipelines(Device& device, const ShadowRendererOptions& options)
    : device_(device), cache_(options.pipeline_cache), shows_rays_(options.shows_rays),
      vertex_(makeShader(device, spirv::mask_numbers_vert))
{
    for (std::size_t i = 0; i < codes_.size(); ++i) {
        codes_[i] = codeOf(device, static_cast<Filter>(i));
    }
    const VkPhysicalDeviceLimits& limits = device.limits();
    constexpr std::uint32_t kComponents = 128; // 120 of mask_numbers.glsl, and up to 7 of gl_PerVertex
    if (device.software() && limits.maxVertexOutputComponents >= kComponents &&
        limits.maxFragmentInputComponents >= kComponents) {
        vertex_one_ = makeShader(device, spirv::mask_numbers_one_vert);
    }
}

VkPipeline MaskPipelines::get(MaskPipelineKey key, VkPipelineLayout layout)
{
    if (key.told_apart == pack::ToldApart::alone) { // one module for both kinds of view, where there is one
        const bool pairs = key.module == Filter::hard || key.module == Filter::pcf; // mask.frag
        const bool has_module =
            vertex_one_ && !codesOf(key).alone.empty() && (pairs || key.constants.paired == VK_FALSE);
        key.told_apart = has_module ? pack::ToldApart::alone : pack::ToldApart::tests;
        key.constants.orthographic = has_module ? VK_FALSE : key.constants.orthographic;
        key.constants.paired = has_module ? key.constants.paired : VK_FALSE;
    }
    const auto found = std::ranges::find(made_, key, &Made::key);
    if (found != made_.end()) {
        return found->pipeline.get();
    }
    return made_.emplace_back(Made{key, make(key, layout)}).pipeline.get();
}

Pipeline MaskPipelines::make(const MaskPipelineKey& key, VkPipelineLayout layout)
{
    pack::MaskConstants constants = key.constants;
    constants.in_software = device_.software() ? VK_TRUE : VK_FALSE;
    constants.shows_rays = shows_rays_ ? VK_TRUE : VK_FALSE;
    constants.slices_alone = key.told_apart == pack::ToldApart::slices ? VK_TRUE : VK_FALSE;
    const Specialisation specialisation(constants);
    const bool alone = key.told_apart == pack::ToldApart::alone;
    const MaskCode& code = codesOf(key);
    const ShaderModule fragment = makeShader(device_, alone ? code.alone : code.any);
    const TwoStages stages = stagesOf(alone ? vertex_one_ : vertex_, fragment, specialisation.info());
    GraphicsState state;
    state.stages = stages;
    state.layout = layout;
    state.colour_format = key.format;
    state.takes_away = key.constants.takes_away == VK_TRUE;
    state.keeps_least = key.shares && !state.takes_away; // a draw writes 1 to channels that are not its own
    const VkPipelineDepthStencilStateCreateInfo marks =
        key.as == DrawnAs::settled ? MaskMarks::marking() : MaskMarks::whereLeft();
    if (key.as == DrawnAs::settled || key.as == DrawnAs::left) {
        state.depth_format = MaskMarks::kFormat;
        state.depth_stencil = &marks;
    }
    state.cache = cache_;
    state.name = "mask";
    return makeGraphicsPipeline(device_, state);
}

} // namespace gnomon::vulkan
