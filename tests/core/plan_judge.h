// SPDX-License-Identifier: Apache-2.0
// Whether a plan is right, judged with points and rays and with the camera's matrix itself; no plane, no body and no
// tree is used.
#pragma once

#include "random_scenes.h"

#include <gnomon/plan.h>

#include <array>
#include <cstdint>
#include <string>

namespace gnomon::test {

/// What was there to be judged.
struct Tally {
    int seen = 0;    // points that the camera sees and a light reaches
    int blocked = 0; // casters on the way from such a point to the light
    int warped = 0;  // views
    std::array<int, 8> outcomes{};
    std::array<int, kAwkwardCount> seen_awkward{}; // scenes of each kind with such points
    std::array<int, kAwkwardCount> blocked_awkward{};

    [[nodiscard]] int count(OutcomeKind kind) const { return outcomes[static_cast<std::size_t>(kind)]; }
};

/// Looks at points of receivers; a point that the camera sees and the light reaches must be in the map of every view
/// that serves it, inside the border and before the far plane, and whatever casts on it must be drawn there and be
/// stored before it. All numbers must be finite. Fatal failures of the test that runs. Of a sun that moves in steps,
/// give a plan of one position.
void judge(const RandomScene& scene, const Plan& plan, Random& random, Tally& tally);

/// All that a plan says, byte for byte.
[[nodiscard]] std::string bytesOf(const Plan& plan);

} // namespace gnomon::test
