// SPDX-License-Identifier: Apache-2.0
// The mask of one light, computed on the CPU in double precision from the plan and the texels of the map, by the same
// files that the GPU runs. The way from frame and plan to the filter's input is written anew here, in world space.
#pragma once

#include "cpu_map.h"
#include "scene.h"

namespace gnomon::test {

struct ReferenceScene {
    const Picture& picture;
    const Camera& camera;
    std::span<const Light> lights;
    const Plan& plan;
    std::span<const CpuMap> maps; // by layer of the image
    /// The rounding error of each channel read from a filterable map, absolute; relative_nudge has the relative part.
    glm::dvec4 nudge{0.0};
    glm::dvec4 relative_nudge{0.0};
    const Scene* scene = nullptr; // for filter smoothies: it has the edges
};

/// Visibility per pixel of the picture for light `index` of the plan: by its first view, or of a sun between two
/// positions by the first two, which are one of each. `layers`: of depth, of the light's view (lvsm).
[[nodiscard]] std::vector<double> referenceMask(const ReferenceScene& scene, std::uint32_t index,
                                                const ShadowOptions& options,
                                                std::span<const pack::DepthLayer> layers = {});

} // namespace gnomon::test
