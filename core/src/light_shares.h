// SPDX-License-Identifier: Apache-2.0
// The share of each light in the picture.
#pragma once

#include "auto/sight.h"

#include <gnomon/frame.h>

#include <span>
#include <vector>

namespace gnomon {

/// A light's share is how many of the points in sight it lights: of each point so much of one as it gives of what all
/// lights give there. That is screen area and brightness beside the other lights: a lamp in the sun counts for little.
/// Which way a surface faces is not known. A light whose reach is in view, but at none of the points, has a small
/// share.
class LightShares {
public:
    /// Takes time in proportion to the lights, and nothing from the heap once warm.
    void find(std::span<const Light> lights, const CameraView& camera, std::span<const SightPoint> points);
    /// By the lights of the last find(): 0 .. their points.
    [[nodiscard]] double shareOf(std::size_t light) const { return shares_[light]; }

private:
    std::vector<double> all_; // that arrives, by point
    std::vector<double> shares_;
};

/// The light that arrives at a place, unshadowed, on a surface that faces the light: lux, or the unit of
/// Light::brightness.
[[nodiscard]] double arrivesAt(const Light& light, const LightExtent& extent, const glm::dvec3& p_ws);

} // namespace gnomon
