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

constexpr std::array kShaders{Shader{"bloom_down.comp", spirv::bloom_down_comp},
                              Shader{"bloom_first.comp", spirv::bloom_first_comp},
                              Shader{"bloom_up.comp", spirv::bloom_up_comp},
                              Shader{"forward.frag", spirv::forward_frag},
                              Shader{"fullscreen.vert", spirv::fullscreen_vert},
                              Shader{"fxaa.frag", spirv::fxaa_frag},
                              Shader{"gbuffer.frag", spirv::gbuffer_frag},
                              Shader{"scene.vert", spirv::scene_vert},
                              Shader{"shade.frag", spirv::shade_frag},
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
