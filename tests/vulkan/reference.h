// SPDX-License-Identifier: Apache-2.0
// The mask of one light, worked out on the CPU in double precision from the plan and the texels of the map, by the same
// files that the GPU runs. The way from frame and plan to the filter's input is written anew here, in world space.
#pragma once

#include "scene.h"

namespace gnomon::test {

struct CpuMap {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<float> texels;
};

/// Visibility per pixel of `picture` for light `index` of the plan.
[[nodiscard]] std::vector<double> referenceMask(const Picture& picture, std::span<const Light> lights, const Plan& plan,
                                                std::uint32_t index, const CpuMap& map,
                                                const vulkan::FilterOptions& options);

} // namespace gnomon::test
