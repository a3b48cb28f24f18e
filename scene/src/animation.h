// SPDX-License-Identifier: Apache-2.0
// Keyframe interpolation as glTF 2.0 defines it (appendix C).
#pragma once

#include "scene/model.h"

#include <span>
#include <string>

namespace gnomon::scene {

/// The animation called `name`, the first one for an empty name, null when the scene has none and none is asked for.
/// Throws Error naming those there are when `name` is none of them.
[[nodiscard]] const Animation* findAnimation(const Scene& scene, const std::string& name);

/// Value of a channel at `time_s`, held at the first and last key outside their range. `out` has as many floats as
/// one key has components. Rotations come out normalised. A channel without keys leaves `out` as it is.
void sampleChannel(const AnimationChannel& channel, float time_s, std::span<float> out);

/// Sets the transforms and morph weights that `animation` drives. Beyond its duration the animation starts anew.
/// Morph weights of driven nodes must have their size already.
void applyAnimation(const Animation& animation, double time_s, std::vector<Node>& nodes);

} // namespace gnomon::scene
