// SPDX-License-Identifier: Apache-2.0
// Rays from surface points to one light.
#pragma once

#include "light_samples.h"
#include "scene_geometry.h"

#include "truth/visibility.h"

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

namespace gnomon::truth {

/// Where a shadow ray starts.
struct Receiver {
    glm::dvec3 rel{0.0};              // relative to SceneGeometry::originWs(), off the surface already
    glm::dvec3 normal{0.0, 1.0, 0.0}; // unit
    /// The normal of the smooth surface over the point; `normal` where there is none.
    glm::dvec3 smooth_normal{0.0, 1.0, 0.0};
    glm::dvec3 lifted_rel{0.0}; // `rel`, moved to it
    bool lifts = false;         // `lifted_rel` is over the triangle
    std::uint32_t object = 0;
    std::uint32_t triangle = 0;
    std::uint64_t pixel = 0; // number of the pixel, which chooses its random shifts
};

/// The point `rel`, known to be on `triangle` up to rounding, moved onto it and then off it along `normal` (unit, one
/// of the triangle's two).
[[nodiscard]] glm::dvec3 offSurface(const glm::dvec3& rel, const Triangle& triangle, const glm::dvec3& normal);

/// Immutable once made: threads share it.
class ShadowRays {
public:
    struct Result {
        double visibility = 1.0;
        double standard_error = 0.0;
        double first_blocker_m = 0.0; // +infinity where there is none
        std::uint64_t rays = 0;
    };

    ShadowRays(const SceneGeometry& geometry, const Light& light, const Options& options);

    /// Traces from the triangle, or from the smooth surface over it where the triangle does not face all of the light.
    [[nodiscard]] Result trace(const Receiver& receiver) const;

private:
    /// The light as one point sees it: a disc of radius `tangent` at distance 1, perpendicular to `direction`.
    struct Seen {
        glm::dvec3 direction{0.0}; // unit, to the centre
        double distance_m = 0.0;   // to the centre; +infinity for a directional light
        double tangent = 0.0;      // the tangent of half the angle that it fills
        double end_radius_m = 0.0; // rays end on this sphere around the centre, or before
        /// The normal of a spot's near plane, where rays end too: unit, away from the light; 0 where there is none.
        glm::dvec3 plane_normal{0.0};
        double above_plane_m = std::numeric_limits<double>::infinity(); // how far the point is beyond it
        bool inside = false;                                            // nothing can stand between

        /// The end of the ray to the centre, along it.
        [[nodiscard]] double centreEnd_m() const;
        /// The sine of half the angle that it fills.
        [[nodiscard]] double sine() const;
    };
    struct Packet;
    static constexpr std::uint32_t kBlockedKept = 4;
    /// Some blocked rays, in which the blocker is searched where the ray to the centre is free.
    struct Blocked {
        std::array<glm::vec4, kBlockedKept> rays; // direction, and where it ends in lengths of that
        std::uint32_t count = 0;
    };

    [[nodiscard]] Seen see(const glm::dvec3& rel) const;
    [[nodiscard]] Result traceFrom(const Receiver& receiver, const Seen& light) const;
    [[nodiscard]] Result traceCentre(const Receiver& receiver, const Seen& light) const;
    [[nodiscard]] Result traceDisc(const Receiver& receiver, const Seen& light) const;
    void findBlocker(const Receiver& receiver, const Seen& light, const Blocked& blocked, Result& result) const;
    struct Along {
        double blocker_m = 0.0;  // to the nearest caster; +infinity where there is none
        double visibility = 0.0; // the share of light that arrives from there
    };
    /// `end` is in lengths of `direction`.
    [[nodiscard]] Along lookAlong(const Receiver& receiver, const glm::dvec3& direction, double end) const;

    const SceneGeometry& geometry_;
    Light light_;
    glm::dvec3 light_rel_;
    bool area_;
    std::uint64_t seed_;
    std::vector<DiscPoint> set_; // empty for hard
};

} // namespace gnomon::truth
