// SPDX-License-Identifier: Apache-2.0
#include "mask_pipelines.h"

#include "mask_spread.h"
#include "pipelines.h"
#include "specialisation.h"

#include <gnomon_spirv.h>

#include <algorithm>
#include <array>

namespace gnomon::vulkan {
namespace {

/// By what a module is made for. Alone: one view of any kind, whose numbers come from the vertex shader.
enum class MaskModule : std::uint8_t { any, orthographic, alone };

std::span<const std::uint32_t> fragmentCode(Filter filter, MaskModule module)
{
    using namespace spirv;
    using Codes = std::array<std::span<const std::uint32_t>, 3>; // by MaskModule
    const auto of = [&](const Codes& codes) {
        return codes[static_cast<std::size_t>(module)];
    };
#define GN_CODES(NAME)                                                                                                 \
    {                                                                                                                  \
        mask_##NAME##_frag, mask_##NAME##_orthographic_frag, mask_##NAME##_one_frag                                    \
    }
    switch (filter) {
    case Filter::hard:
        return of(GN_CODES(hard));
    case Filter::pcss:
        return of(GN_CODES(pcss));
    case Filter::raymarch:
        return of(GN_CODES(raymarch));
    case Filter::vsm:
        return of(GN_CODES(vsm));
    case Filter::lvsm:
        return of(GN_CODES(lvsm));
    case Filter::esm:
        return of({mask_esm_frag, mask_esm_orthographic_frag, {}});
    case Filter::evsm:
        return of(GN_CODES(evsm));
    case Filter::msm:
        return of(GN_CODES(msm));
    case Filter::id:
        return of({mask_id_frag, mask_id_orthographic_frag, {}});
    case Filter::depth_id:
        return of({mask_depth_id_frag, mask_depth_id_orthographic_frag, {}});
    case Filter::pcf:
    case Filter::volumes:   // counts no texels: what it has of a map is never read
    case Filter::smoothies: // pcf, and its edges beside it
    case Filter::automatic: // never comes here: a plan has the one that was chosen
        break;
    }
    return of(GN_CODES(pcf));
#undef GN_CODES
}

} // namespace

MaskPipelineKey maskPipelineKey(const ResolvedOptions& options, MaskShape shape)
{
    MaskPipelineKey key;
    key.filter = options.filter();
    key.constants.technique = pack::techniqueConstants(options);
    key.constants.has_normals = shape.normals ? VK_TRUE : VK_FALSE;
    key.constants.has_smooth = shape.smooth ? VK_TRUE : VK_FALSE;
    key.constants.paraboloid = options.technique().partition == Partition::paraboloid ? VK_TRUE : VK_FALSE;
    key.constants.has_ids = shape.ids ? VK_TRUE : VK_FALSE;
    const bool layered =
        options.technique().partition == Partition::multi && options.multi().divide == MultiDivide::receivers;
    key.constants.layered = layered ? VK_TRUE : VK_FALSE;
    return key;
}

MaskPipelineKey drawnAs(MaskPipelineKey key, DrawnAs as)
{
    key.as = as;
    key.constants.pixels_per_texel = as == DrawnAs::half ? 2 : 1;
    return key;
}

MaskPipelines::MaskPipelines(Device& device, const ShadowRendererOptions& options)
    : device_(device), cache_(options.pipeline_cache), shows_rays_(options.shows_rays),
      vertex_(makeShader(device, spirv::mask_numbers_vert))
{
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
        const bool pairs = key.filter == Filter::hard || key.filter == Filter::pcf; // mask.frag
        const bool few_take_it = // so it has no module for one view: shaders/CMakeLists.txt
            key.filter == Filter::esm || key.filter == Filter::id || key.filter == Filter::depth_id;
        const bool has_module = vertex_one_ && !few_take_it && (pairs || key.constants.paired == VK_FALSE);
        key.told_apart = has_module ? pack::ToldApart::alone : pack::ToldApart::tests;
        key.orthographic = key.orthographic && !has_module;
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
    MaskConstants constants = key.constants;
    constants.in_software = device_.software() ? VK_TRUE : VK_FALSE;
    constants.shows_rays = shows_rays_ ? VK_TRUE : VK_FALSE;
    constants.slices_alone = key.told_apart == pack::ToldApart::slices ? VK_TRUE : VK_FALSE;
    const Specialisation specialisation(constants);
    const bool alone = key.told_apart == pack::ToldApart::alone;
    const MaskModule module = alone ? MaskModule::alone : key.orthographic ? MaskModule::orthographic : MaskModule::any;
    const ShaderModule fragment = makeShader(device_, fragmentCode(key.filter, module));
    const TwoStages stages = stagesOf(alone ? vertex_one_ : vertex_, fragment, specialisation.info());
    GraphicsState state;
    state.stages = stages;
    state.layout = layout;
    state.colour_format = key.format;
    state.takes_away = key.constants.takes_away == VK_TRUE;
    state.keeps_least = key.shares && !state.takes_away; // what a draw has not to do with it writes as 1
    const VkPipelineDepthStencilStateCreateInfo where_left = MaskSpread::whereLeft();
    if (key.as == DrawnAs::left) {
        state.depth_format = MaskSpread::kMarkFormat;
        state.depth_stencil = &where_left;
    }
    state.cache = cache_;
    state.name = "mask";
    return makeGraphicsPipeline(device_, state);
}

} // namespace gnomon::vulkan
