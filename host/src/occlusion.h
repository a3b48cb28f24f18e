// SPDX-License-Identifier: Apache-2.0
// The images of ambient occlusion; made only where it is wanted. The arithmetic is in host/shaders/ambient_occlusion.h.
#pragma once

#include "pipelines.h"

#include "scene/state.h"

namespace gnomon::host {

/// Half the picture's size, and a texel more (host/shaders/occlusion_texel.glsl).
struct Occlusion {
    /// `drawn`: of the depth that it is found from. Throws Error.
    Occlusion(Memory& memory, Pipelines& pipelines, VkExtent2D drawn);

    Image searched; // of every second pixel, as it was found
    Image smooth;   // what shading reads
    VkPipeline search = VK_NULL_HANDLE;
    VkPipeline smoothen = VK_NULL_HANDLE;
};

/// How far what hides the sky may be in this scene, metres: a quarter of the median of its objects' diagonals, and 0.03
/// of the whole at most, grounds that fade into the sky left out. Above 0. `state`: the scene at rest, so that it is
/// the same in every frame.
[[nodiscard]] double occlusionRadius(const scene::Scene& scene, const scene::State& state);

} // namespace gnomon::host
