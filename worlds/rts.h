// SPDX-License-Identifier: Apache-2.0
// A strategy game's map, after Marinescu 2011. Views `camp` (the usual three-quarter view), `unit` (on the ground
// beside a squad), `map` (everything) and `giant` (one with a skin over joints). The first light, "sun", is the only
// one. Node names tell the kind of a thing: "terrain/…", "unit/…", "building/…", "debris/…", "grove/…".
#pragma once

namespace gnomon::worlds {

/// Terrain chunks too flat to shade anything while the sun stands higher than this have casts = false: along a ray that
/// meets a height field from above, the field must rise at least as steeply as the ray falls. Rise over run, 15
/// degrees.
inline constexpr float kFlatChunkSlope = 0.27F;

} // namespace gnomon::worlds
