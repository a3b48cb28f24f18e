// SPDX-License-Identifier: Apache-2.0
// Which way depth is measured under parallel light, so that what receives shadow lies as level in it as it can.
#pragma once

#include "light_space.h"

#include <gnomon/object_set.h>

#include <span>

namespace gnomon {

/// The gradient of depth: LightSpace::forward_ws less a share of the two axes across it. The depth of a point, its dot
/// product with the gradient, grows by one metre per metre along a ray of light, whatever the share.
///
/// The share is the regression of the receivers' depths over their places across the light: each box counts as the
/// sheet across its thinnest side, by its area. Objects that are expected to move do not count, and the share is
/// rounded, so that the map of a scene that stands still is kept. Returns forward_ws where no plane can be told.
[[nodiscard]] glm::dvec3 levelDepth(const LightSpace& space, const ObjectSet& objects,
                                    std::span<const std::uint32_t> receivers);

} // namespace gnomon
