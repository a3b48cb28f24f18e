// SPDX-License-Identifier: Apache-2.0
// Cascades that take turns each by itself (CascadeOptions::room): their maps are made wider than what is seen, and one
// may stand in for as long as what is seen still lies in what it was made for.
#pragma once

#include "region.h"

#include <gnomon/plan.h>

#include <glm/vec2.hpp>

#include <span>
#include <vector>

namespace gnomon {

/// The ground that a map was planned for: the receivers that it can serve.
struct ViewGround {
    LightSpace space;
    std::vector<Plane> planes;       // the body's, inward
    std::vector<glm::dvec2> outline; // outline of its lit part, as Region::outline()
    double near_m = 0.0;             // depths of receivers, as LightSpace::depth_ws measures them
    double far_m = 0.0;

    /// After Region::gatherReceivers() said ok, before Region::widen(). Keeps its memory.
    void note(const Region& region, const LightSpace& of);
    /// Does what `seen` found by the same space lie in here? Then all that casts on it and has not moved since was
    /// found here too: its rays to the light leave through the same sides.
    [[nodiscard]] bool covers(const Region& seen, double pad_m) const;
};

/// Is it the same frustum of a light with a place? Parallel light has none: another direction is a change like any
/// other of a light that waits.
[[nodiscard]] bool sameFrustum(const LightSpace& a, const LightSpace& b);

/// The same camera with a picture that is `room` of its width and height larger on each side, and a far plane that is
/// as much farther away.
[[nodiscard]] Camera widened(const Camera& camera, double room);

/// A slice of the view, with `room` of its depth more at both ends. Precondition: it is not the first of the cascades.
/// `view` is measured or bounded.
[[nodiscard]] Slice widened(const Slice& slice, const CameraView& view, double room);
/// Where the widened slice ends at most.
[[nodiscard]] double widenedFar_m(const CameraView& view, double room);

} // namespace gnomon
