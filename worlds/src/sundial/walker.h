// SPDX-License-Identifier: Apache-2.0
// The walker on the path of the world `sundial`. It walks all day long in whole rounds, so that days repeat.
#pragma once

#include "meadow.h"
#include "things.h"

#include <vector>

namespace gnomon::worlds {

class Walker {
public:
    Walker(Scene& scene, const SundialPalette& palette, const Loop& path);
    /// A pure function of the time.
    void pose(double time_s, const Meadow& meadow, const Loop& path, std::vector<Node>& nodes) const;

private:
    enum Limb : std::uint32_t { kBody, kRightLeg, kLeftLeg, kRightArm, kLeftArm }; // nodes, one after another
    std::uint32_t body_ = 0;
    float start_m_ = 0.0F;
    double rounds_per_day_ = 1.0;
    double strides_per_day_ = 1.0;
};

} // namespace gnomon::worlds
