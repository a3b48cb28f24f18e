// SPDX-License-Identifier: Apache-2.0
// The draws of filter volumes: for each light the casters' shadow volumes, counted in a stencil buffer behind what is
// seen (z-fail), and then the light's channel of the mask by that count.
// Based on: M. McGuire, J. F. Hughes, K. T. Egan, M. J. Kilgard, C. Everitt, "Fast, Practical and Robust Shadows",
// 2003.
//
// Another backend does this for each draw: clear the stencil within `pixels`; draw every caster's volume
// (gnomon/shared/shadow_volume.h) with depth clamped, not clipped, depth tested and not written. Where the test fails,
// add 1 for faces that turn away from the eye and take 1 away for those that turn to it, both wrapping. The light does
// not reach pixels whose count is not 0.
#pragma once

#include <gnomon/export.h>
#include <gnomon/pack/light_lists.h>
#include <gnomon/plan.h>

#include <glm/vec4.hpp>

#include <vector>

namespace gnomon::pack {

/// One light's volumes.
struct VolumeDraw {
    std::uint32_t light = 0;    // index into Plan::lights, which has the casters
    std::uint32_t layer = 0;    // layer of the mask
    std::uint32_t channels = 0; // bit i: channel i is the light's
    ScreenBounds pixels;        // pixels that may show a point in the light's reach; never empty
    /// The range of the camera's depth buffer in which such points lie: 0 .. 1, the lesser first.
    float least_depth = 0.0F;
    float most_depth = 1.0F; // the greater
    glm::vec4 place{0.0F};   // w = 0: xyz is the unit direction to the light; w = 1: its eye-relative position
};

/// Lists the lights that have volumes, in their order. Keeps what `out` has allocated. Throws Error where
/// Plan::made_for has other lights.
GNOMON_API void listVolumeDraws(const Plan& plan, glm::uvec2 size_px, std::vector<VolumeDraw>& out);

} // namespace gnomon::pack
