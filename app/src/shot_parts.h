// SPDX-License-Identifier: Apache-2.0
// The steps in which makeShot() (app/shot.h) makes a shot, each in the file of its subject.
#pragma once

#include "app/shot.h"
#include "lab/waits.h"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::app {

// The camera, and an outlook where a scene has none.

/// Sets eye and camera from the settings and the state. Throws UsageError when the named camera is not there.
void placeEye(Shot& shot, const Settings& settings);

/// The names that --camera takes, in the order of its search: the scene's views, then its placed cameras.
[[nodiscard]] std::vector<std::string> cameraNames(const Shot& shot);

/// The outlook that shows most of a scene: obliquely, flat things from higher up, tall ones from lower, long ones from
/// their longer side. Surroundings of its detail do not count. The light comes over the viewer's left shoulder.
[[nodiscard]] Outlook outlookOn(const scene::Scene& scene, const scene::State& state);

/// An orthographic eye so far back from its target that nothing of the scene is behind it.
[[nodiscard]] host::Eye standingBack(const host::Eye& eye, const Aabb& scene_bounds_ws);

/// The direction in which the sun's light travels, unit.
[[nodiscard]] glm::dvec3 sunOf(const Outlook& outlook);

/// The objects without the surroundings of a scene's detail: a wide ground, a sky's dome, a backdrop. These are the
/// largest ones, where all of the others together are small beside each of those, lie amid them and have more
/// triangles. A view of such a whole scene would show only its surroundings. In order of size.
[[nodiscard]] std::vector<const scene::Object*> withoutSurroundings(const scene::Scene& scene,
                                                                    std::vector<const scene::Object*> objects);

// The lights.

/// Keeps the lights in sight (host::lightsInSight), where there are more than a frame can have. It comes after camera
/// and lights are placed.
void chooseLights(Shot& shot, const Settings& settings);
/// The notice where Shot::lights_left_out is not 0.
[[nodiscard]] std::string leftOutSentence(const Shot& shot);

/// A light of the shot by its name, or by that of a file's node that holds it. Before chooseLights().
[[nodiscard]] std::optional<std::size_t> lightNamed(const Shot& shot, const Settings& settings, std::string_view name);
[[nodiscard]] std::vector<std::string_view> lightNames(const Shot& shot);

/// Whether a surface comes nearer to `centre_ws` than `radius_m`. Blended surfaces do not count. Looks at every
/// triangle of the objects whose bounds the sphere meets.
[[nodiscard]] bool holdsSurface(const scene::Scene& scene, const scene::State& state, const glm::dvec3& centre_ws,
                                double radius_m);

/// Adds a notice for each object, or node of several, that holds all of a light back, as a dome around the scene does,
/// or a bulb around its lamp: nothing else that receives shadow
/// within the light's reach is lit at any of a few hundred points. Around a lamp it also stands in each of a hundred
/// directions; under a sun it does so in most that lead up, and its bounds hold the middles of all that receives. A
/// room does not count, because things in it are lit; nor does a shade with openings, nor an object around both camera
/// and lamp. Searches for a tenth of a second at most.
void noteTakenLight(Shot& shot);

// A ground for models that have none, and the way up of a model.

/// The share of a model, seen from above, with a floor of its own: where the lowest surface that faces up is the lowest
/// surface, or only a thin slab above it. [0, 1]; 0 where there is nothing to see from above. `up` is 1 for y, 2 for z.
[[nodiscard]] double flooredShare(const scene::Scene& scene, const scene::State& state, int up);

/// Does it lack a ground to stand on?
[[nodiscard]] bool isBottomless(const scene::Scene& scene, const scene::State& state);

/// Does it lie on its side, as a model made with z up does? Use it only for a notice: a relief on a wall looks the
/// same.
[[nodiscard]] bool looksFallen(const scene::Scene& scene, const scene::State& state);

/// Turns a file with z up to y up: its nodes become children of a new one.
void standUp(scene::Scene& scene);

/// A disc under `model_ws` that fades into the sky. Its node is the scene's last.
void addGround(scene::Scene& scene, const Aabb& model_ws);

// Refusals and notices.

/// Throws Error when scene, camera or a light that casts is beyond the limits of gnomon/world_range.h: single precision
/// has no room for its shadows, and it is not drawn without them.
void requireInRange(const Shot& shot, const Settings& settings);

/// With filter volumes, or where one of several techniques has it: throws Error, with the names of meshes, where
/// casters are not closed; or with volumes.open=skip says so in a notice.
void requireClosedCasters(Shot& shot, const Settings& settings);
/// With filter smoothies, or where one of several techniques has it: says in a notice which casters have no fins.
void noteFinless(Shot& shot, const Settings& settings);

/// Why the technique gives the light no shadow; the ray tracer takes every light.
[[nodiscard]] std::optional<std::string_view> refusalOf(const host::ShadedLight& light, const Settings& settings);

/// Adds to Shot::notices the facts that people should know before they look at the result.
void noteWhatSurprises(Shot& shot, const Settings& settings);

/// A note that lights waited for their maps to be drawn, and for how long; nothing where none did.
[[nodiscard]] std::optional<std::string> waitNote(const lab::Waits& waits);

} // namespace gnomon::app
