// SPDX-License-Identifier: Apache-2.0
// The images of ambient occlusion; made only where it is wanted. The arithmetic is in host/shaders/ambient_occlusion.h.
#pragma once

#include "pipelines.h"

#include "scene/state.h"

namespace gnomon::host {

/// Half the picture's size, and a texel more (host/shaders/occlusion_texel.glsl).
struct Occlusion {
    /// `drawn` is the extent of the depth that it reads. Throws Error.
    Occlusion(Memory& memory, Pipelines& pipelines, VkExtent2D drawn);

    Image searched; // the occlusion at every second pixel, as it was found
    Image smooth;   // the image that shading reads
    VkPipeline search = VK_NULL_HANDLE;
    VkPipeline smoothen = VK_NULL_HANDLE;
};

/// The largest distance of a surface that hides the sky, metres: a quarter of the median of the objects' diagonals, at
/// most 0.03 of the whole, without grounds that fade into the sky. Above 0. `state` is the scene at rest, so that it is
/// the same in every frame.
[[nodiscard]] double occlusionRadius(const scene::Scene& scene, const scene::State& state);

} // namespace gnomon::host
