// SPDX-License-Identifier: Apache-2.0
// Places on a light's disc for the rays of one pixel.
#pragma once

#include "truth/visibility.h"

#include <glm/vec2.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::truth {

/// A place on the unit disc: sqrt(area) * direction. `area` is the share of the disc that lies nearer to its centre.
struct DiscPoint {
    float area = 0.0F; // [0, 1)
    glm::vec2 direction{1.0F, 0.0F};
};

/// How one pixel turns and shifts a set, so that each of its points is uniform on the disc.
struct DiscShift {
    float area = 0.0F;          // added to DiscPoint::area, modulo 1
    glm::vec2 turn{1.0F, 0.0F}; // cosine and sine of an angle
};

/// `count` >= 1 points spread over the disc; neighbours in the list lie in about the same direction.
[[nodiscard]] std::vector<DiscPoint> makeDiscSet(std::uint32_t count);

/// The shift of set `set` of pixel number `pixel`: random, equal for equal arguments, independent for different ones.
[[nodiscard]] DiscShift shiftOf(std::uint64_t seed, std::uint64_t pixel, std::uint32_t set);

[[nodiscard]] DiscPoint moved(const DiscPoint& point, const DiscShift& shift);

/// Standard error of the mean of independent estimates of one quantity.
[[nodiscard]] double standardError(std::span<const double, kSampleSets> estimates);

} // namespace gnomon::truth
