// SPDX-License-Identifier: Apache-2.0
// Judges a plan with points, rays and the camera's matrix itself; uses no plane, no body and no tree.
#pragma once

#include "random_scenes.h"

#include <gnomon/plan.h>

#include <array>
#include <cstdint>
#include <string>

namespace gnomon::test {

/// The points and casters that were judged.
struct Tally {
    int seen = 0;    // points that the camera sees and a light reaches
    int blocked = 0; // casters on the way from such a point to the light
    int warped = 0;  // views
    std::array<int, 8> outcomes{};
    std::array<int, kAwkwardCount> seen_awkward{}; // scenes of each kind with such points
    std::array<int, kAwkwardCount> blocked_awkward{};

    [[nodiscard]] int count(OutcomeKind kind) const { return outcomes[static_cast<std::size_t>(kind)]; }
};

/// Looks at points of receivers. A point that the camera sees and the light reaches must be in the map of every view
/// that serves it, inside the border and before the far plane. Its casters must be drawn there and be stored before it.
/// All numbers must be finite. Failures are fatal to the running test. For a sun that moves in steps, give a plan of
/// one position.
void judge(const RandomScene& scene, const Plan& plan, Random& random, Tally& tally);

/// All content of a plan, byte for byte.
[[nodiscard]] std::string bytesOf(const Plan& plan);

} // namespace gnomon::test
