// SPDX-License-Identifier: Apache-2.0
// Rays from a camera through its pixels.
#pragma once

#include "scene_geometry.h"

#include "truth/visibility.h"

#include <optional>

namespace gnomon::truth {

/// Immutable once made: threads share it.
class CameraRays {
public:
    struct Seen {
        std::uint32_t object = 0; // index into State::objects
        std::uint32_t triangle = 0;
        glm::dvec3 point{0.0};         // relative to the eye
        glm::dvec3 normal{0.0};        // unit, towards the eye
        glm::dvec3 smooth_normal{0.0}; // unit, SmoothPoint::normal
    };

    CameraRays(const SceneGeometry& geometry, const View& view);

    /// Through a point of the picture, in pixels: (x + 0.5, y + 0.5) is the centre of pixel (x, y). Nothing at
    /// background.
    [[nodiscard]] std::optional<Seen> trace(const glm::dvec2& point_px) const;

private:
    struct Ray {
        glm::dvec3 from{0.0};      // relative to the eye: the eye itself, or a point beside it for an orthographic
                                   // camera
        glm::dvec3 direction{0.0}; // unit
        double near_m = 0.0;
        double far_m = 0.0; // may be +infinity
    };
    [[nodiscard]] Ray through(double clip_x, double clip_y) const;
    [[nodiscard]] Ray parallelThrough(double clip_x, double clip_y) const;
    [[nodiscard]] std::optional<Seen> surfaceAt(const Ray& ray, const RTCHit& hit) const;

    const SceneGeometry& geometry_;
    View view_;
    glm::dvec3 eye_rel_;
};

} // namespace gnomon::truth
