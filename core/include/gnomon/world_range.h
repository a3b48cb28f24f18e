// SPDX-License-Identifier: Apache-2.0
// How large a world may be, and how far it may lie from the origin. Within these limits a world that is scaled by a
// power of two has the same shadows. Beyond them single precision is too coarse, and there are no shadows: a plan's
// lights get Outcome degenerate, and program and ray tracer throw Error.
#pragma once

#include <gnomon/export.h>
#include <gnomon/geometry.h>

#include <string_view>

namespace gnomon {

/// No coordinate of a caster, receiver, light or camera may be larger, nor a light's reach; metres.
inline constexpr double kFarthestPlace_m = 1e9;
/// The least that the longest edge of the box around a scene may be; metres.
inline constexpr double kSmallestScene_m = 1e-6;
/// The least that this edge may be as a share of the largest coordinate in the scene. There, a step of single precision
/// is up to a hundredth of the edge.
inline constexpr double kSmallestShare = 1e-5;

/// Why a scene with this box around it is beyond the limits: a sentence with static lifetime. Empty when it is not, for
/// an empty box, and for a point, whose shadows have no size to lose.
[[nodiscard]] GNOMON_API std::string_view rangeFault(const Aabb& scene_ws);
/// Is a coordinate larger than kFarthestPlace_m, or not a number?
[[nodiscard]] GNOMON_API bool isTooFar(const glm::dvec3& place_ws);

} // namespace gnomon
