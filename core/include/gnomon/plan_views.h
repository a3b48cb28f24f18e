// SPDX-License-Identifier: Apache-2.0
// Which of a plan's views a picture is made of, for who asks what one pixel reads.
#pragma once

#include <gnomon/plan.h>

#include <span>

namespace gnomon {

/// The position of a sun that says more of this frame's picture; by turns, the one that is read.
[[nodiscard]] SunPosition strongerPosition(const SunSteps& steps);

/// What the later one of a stepping sun's positions counts for, 0 .. 1, at `x` from the picture's left edge (0) to its
/// right (1): the weight of SunSteps. Precondition: steps.paired.
[[nodiscard]] double laterWeight(const SunSteps& steps, double x);

/// The views of a light that belong to one of its sun's positions: a range of Plan::views, of which a receiver takes
/// the first that has it. Empty where there is no map.
[[nodiscard]] std::span<const View> viewsOf(const Plan& plan, std::uint32_t light, SunPosition sun);

} // namespace gnomon
