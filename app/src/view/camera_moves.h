// SPDX-License-Identifier: Apache-2.0
// How a hand moves the camera and the sun: from pixels of a pointer to places in the world. No window, no state.
#pragma once

#include "host/view.h"

#include <gnomon/geometry.h>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <optional>

namespace gnomon::app::view {

/// Around what the eye looks at, which keeps its distance. `turn`: radians to the right and upwards that the scene
/// seems to turn by. Never over the pole.
[[nodiscard]] host::Eye orbited(const host::Eye& eye, const glm::dvec2& turn);
/// The eye stays and looks elsewhere: radians to the right and upwards.
[[nodiscard]] host::Eye looked(const host::Eye& eye, const glm::dvec2& turn);
/// Eye and target move so that what is as far as the target follows the pointer; `pixels` to the right and downwards.
[[nodiscard]] host::Eye panned(const host::Eye& eye, const glm::dvec2& pixels, double picture_height_px);
/// Towards the target, and never to it: `steps` of a wheel, each a tenth of what is left. Below 0: away. An
/// orthographic eye stays, and its picture's height shrinks.
[[nodiscard]] host::Eye dollied(const host::Eye& eye, double steps);
/// Eye and target, by metres along right, up and forwards of the eye.
[[nodiscard]] host::Eye flown(const host::Eye& eye, const glm::dvec3& metres);

struct SightLine {
    glm::dvec3 from_ws{0.0}; // on the near plane
    glm::dvec3 along{0.0};   // unit
};
/// The line behind a point of the picture; the point in [0, 1] from its top left.
[[nodiscard]] SightLine lineThrough(const glm::dmat4& clip_from_world, const glm::dvec2& point);
/// A point of the world in the picture; nothing behind the eye.
[[nodiscard]] std::optional<glm::dvec2> pointOf(const glm::dmat4& clip_from_world, const glm::dvec3& place_ws);

/// The sun as a handle: a dome over what the eye looks at, on which the sun lies where its light comes from.
struct SunDome {
    glm::dvec3 centre_ws{0.0};
    double radius_m = 1.0;
};
/// Of a size that it has the same share of the picture wherever the eye is.
[[nodiscard]] SunDome domeOf(const host::Eye& eye);
/// Which way light travels from the place of the dome that a line meets first, or comes nearest to. Unit; never from
/// below the horizon.
[[nodiscard]] glm::dvec3 sunFrom(const SunDome& dome, const SightLine& line);

} // namespace gnomon::app::view
