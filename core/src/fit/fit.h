// SPDX-License-Identifier: Apache-2.0
// How one frustum's projection is shaped. A fit is one file and one line in fits.cpp. The depth metric is none of its
// business: whatever the projection does to z, a map stores metres along the light's axis.
#pragma once

#include "light_space.h"

#include <span>

namespace gnomon {

struct FitInput {
    const LightSpace& space;
    const ConvexBody& body; // what is seen and lit: it has to be in the map
    LightRect rect;         // of it across the light
    double near_m = 0.0;    // depths to cover, by space.depth_ws from space.origin_ws
    double far_m = 1.0;
    double least_size = 0.0; // no side of the map is shorter (as rect has it)
    const ObjectSet& objects;
    std::span<const std::uint32_t> casters;
    const Camera& camera;
    std::uint32_t map_size = 0;
    double border_texels = 0.0;
};

struct FitResult {
    glm::dmat4 clip_from_world{1.0};
    bool orthographic = true;
    glm::dvec2 texel_xy{0.0}; // sides of a texel, as rect has them
    Outcome outcome;          // ok, or fallback with what was done instead
};
using FitFunction = FitResult (*)(const FitInput& input);

/// Null for a fit that is not available.
[[nodiscard]] FitFunction fitFunction(Fit fit);

/// The border that a map of this size can afford, so that at least half of it is left.
[[nodiscard]] double usableBorder(double border_texels, std::uint32_t map_size);

FitResult fitUniform(const FitInput& input);

} // namespace gnomon
