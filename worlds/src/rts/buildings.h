// SPDX-License-Identifier: Apache-2.0
// The buildings of the world `rts`. Each stands on y = 0 around the origin with its door towards +z, is about 1:1 in
// metres and stays under some 400 triangles.
#pragma once

#include "palette.h"

namespace gnomon::worlds {

[[nodiscard]] Mesh makeKeep(const Palette& palette);
[[nodiscard]] Mesh makeGatehouse(const Palette& palette);
[[nodiscard]] Mesh makeWatchtower(const Palette& palette);
[[nodiscard]] Mesh makeBarracks(const Palette& palette);
/// `variant` changes roof and size: 0 shingled, 1 thatched.
[[nodiscard]] Mesh makeCottage(const Palette& palette, int variant);
[[nodiscard]] Mesh makeRoundhouse(const Palette& palette);
[[nodiscard]] Mesh makePavilion(const Palette& palette, std::uint32_t srgb);
/// A windmill without its sails, whose hub is at kSailHub.
[[nodiscard]] Mesh makeWindmill(const Palette& palette);
[[nodiscard]] Mesh makeSails(const Palette& palette);
inline constexpr glm::vec3 kSailHub{0.0F, 9.6F, 2.55F};

/// A stretch of palisade along x, `length_m` long.
[[nodiscard]] Mesh makePalisade(const Palette& palette, float length_m);
/// A flag on the +x side of a pole, without the pole; it waves about +y.
[[nodiscard]] Mesh makeFlag(const Palette& palette, std::uint32_t srgb);
[[nodiscard]] Mesh makeFlagpole(const Palette& palette, float height_m);
inline constexpr float kKeepFlag_m = 17.5F; // where the keep's flag flies

[[nodiscard]] Mesh makeCampfire(const Palette& palette);
[[nodiscard]] Mesh makeCrates(const Palette& palette);
[[nodiscard]] Mesh makeBarrels(const Palette& palette);
[[nodiscard]] Mesh makeHay(const Palette& palette);
[[nodiscard]] Mesh makeFence(const Palette& palette);
[[nodiscard]] Mesh makeCart(const Palette& palette);
[[nodiscard]] Mesh makeWell(const Palette& palette);

} // namespace gnomon::worlds
