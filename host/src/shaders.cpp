// SPDX-License-Identifier: Apache-2.0
#include "shaders.h"

#include "gnomon_host_spirv.h"

#include <algorithm>
#include <array>
#include <cassert>

namespace gnomon::host {
namespace {

struct Shader {
    std::string_view name;
    const std::span<const std::uint32_t>& words;
};

constexpr std::array kShaders{
    Shader{"bloom_down.comp", spirv::bloom_down_comp},
    Shader{"bloom_first.comp", spirv::bloom_first_comp},
    Shader{"bloom_up.comp", spirv::bloom_up_comp},
    Shader{"depth.vert", spirv::depth_vert},
    Shader{"depth_clipped.vert", spirv::depth_clipped_vert},
    Shader{"depth_masked.frag", spirv::depth_masked_frag},
    Shader{"forward.frag", spirv::forward_frag},
    Shader{"forward_depth-id.frag", spirv::forward_depth_id_frag},
    Shader{"forward_depth-id_orthographic.frag", spirv::forward_depth_id_orthographic_frag},
    Shader{"forward_esm.frag", spirv::forward_esm_frag},
    Shader{"forward_esm_orthographic.frag", spirv::forward_esm_orthographic_frag},
    Shader{"forward_evsm.frag", spirv::forward_evsm_frag},
    Shader{"forward_evsm_orthographic.frag", spirv::forward_evsm_orthographic_frag},
    Shader{"forward_hard.frag", spirv::forward_hard_frag},
    Shader{"forward_hard_orthographic.frag", spirv::forward_hard_orthographic_frag},
    Shader{"forward_hard_smoothies.frag", spirv::forward_hard_smoothies_frag},
    Shader{"forward_hard_smoothies_orthographic.frag", spirv::forward_hard_smoothies_orthographic_frag},
    Shader{"forward_id.frag", spirv::forward_id_frag},
    Shader{"forward_id_orthographic.frag", spirv::forward_id_orthographic_frag},
    Shader{"forward_lvsm.frag", spirv::forward_lvsm_frag},
    Shader{"forward_lvsm_orthographic.frag", spirv::forward_lvsm_orthographic_frag},
    Shader{"forward_msm.frag", spirv::forward_msm_frag},
    Shader{"forward_msm_orthographic.frag", spirv::forward_msm_orthographic_frag},
    Shader{"forward_pcf.frag", spirv::forward_pcf_frag},
    Shader{"forward_pcf_orthographic.frag", spirv::forward_pcf_orthographic_frag},
    Shader{"forward_pcf_smoothies.frag", spirv::forward_pcf_smoothies_frag},
    Shader{"forward_pcf_smoothies_orthographic.frag", spirv::forward_pcf_smoothies_orthographic_frag},
    Shader{"forward_pcss.frag", spirv::forward_pcss_frag},
    Shader{"forward_pcss_orthographic.frag", spirv::forward_pcss_orthographic_frag},
    Shader{"forward_raymarch.frag", spirv::forward_raymarch_frag},
    Shader{"forward_raymarch_orthographic.frag", spirv::forward_raymarch_orthographic_frag},
    Shader{"forward_vsm.frag", spirv::forward_vsm_frag},
    Shader{"forward_vsm_orthographic.frag", spirv::forward_vsm_orthographic_frag},
    Shader{"fullscreen.vert", spirv::fullscreen_vert},
    Shader{"fxaa.frag", spirv::fxaa_frag},
    Shader{"gbuffer.frag", spirv::gbuffer_frag},
    Shader{"gbuffer_ids.frag", spirv::gbuffer_ids_frag},
    Shader{"gbuffer_ids_smooth.frag", spirv::gbuffer_ids_smooth_frag},
    Shader{"gbuffer_smooth.frag", spirv::gbuffer_smooth_frag},
    Shader{"scene.vert", spirv::scene_vert},
    Shader{"scene_clipped.vert", spirv::scene_clipped_vert},
    Shader{"screen.vert", spirv::screen_vert},
    Shader{"shade.frag", spirv::shade_frag},
    Shader{"shade_compact.frag", spirv::shade_compact_frag},
    Shader{"sky.frag", spirv::sky_frag},
    Shader{"tone.frag", spirv::tone_frag}};

} // namespace

std::span<const std::uint32_t> shaderWords(std::string_view name)
{
    const auto* const found =
        std::find_if(kShaders.begin(), kShaders.end(), [name](const Shader& one) { return one.name == name; });
    assert(found != kShaders.end());
    return found->words;
}

} // namespace gnomon::host
