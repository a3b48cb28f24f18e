// SPDX-License-Identifier: Apache-2.0
// The eye and the lights of a frame, in the scene's terms and in the library's.
#pragma once

#include "scene/state.h"

#include <gnomon/frame.h>

#include <glm/vec3.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace gnomon::host {

/// Where the picture is taken from.
struct Eye {
    glm::dvec3 position_ws{0.0};
    glm::dvec3 target_ws{0.0, 0.0, -1.0};
    glm::dvec3 up_ws{0.0, 1.0, 0.0};
    double fov_y_rad = 0.8; // vertical; (0, pi)
    double height_m = 0.0;  // above 0: orthographic, metres from top to bottom; fov_y_rad has no effect then
    double near_m = 0.0;    // 0: 1/20000 of the bounds' diagonal, or 1/100 of the way to the target; orthographic: 0
    double far_m = 0.0;     // 0: behind everything
};
/// Metres from top to bottom of the picture, at a distance before the eye.
[[nodiscard]] inline double pictureHeight(const Eye& eye, double distance_m)
{
    return eye.height_m > 0.0 ? eye.height_m : 2.0 * distance_m * std::tan(eye.fov_y_rad * 0.5);
}

/// A light as it is shaded and as it casts. Made from the scene's placed lights (lightsOf) or from the command line.
struct ShadedLight {
    std::string name;
    Light caster;                         // gnomon/frame.h
    glm::vec3 colour{1.0F};               // linear, times intensity at full strength: lux (directional) or candela
    glm::vec3 strength{1.0F};             // the present share of that; the exposure is chosen for all of it
    double inner_half_angle_rad = 0.0;    // spot
    glm::vec3 up_ws{0.0F, 0.0F, 1.0F};    // orients the cookie
    std::uint32_t cookie = scene::kNone;  // image of the scene
    scene::Body body = scene::Body::none; // directional: what it stands for in a physical sky
};
/// Sets the light's brightness among others: the luminance of its colour and strength.
void setBrightness(ShadedLight& light);
/// The lights of a state. A light of strength 0 casts no shadow, so that no map is drawn for it.
[[nodiscard]] std::vector<ShadedLight> lightsOf(const scene::Scene& scene, const scene::State& state);

/// Lights of one frame at most.
inline constexpr std::size_t kMaxLights = 128;

/// The lights that light a frame, chosen from more than kMaxLights.
struct LightsInSight {
    std::vector<std::uint32_t> lights; // at most kMaxLights, `first` before the others, which ascend
    std::size_t left_out = 0;          // how many others reach into the view and find no room
};
/// The lights that shine into the view: directional ones, then the others that give the camera's place the most light.
/// `first` is always taken. The same for the same arguments. Preconditions: first < lights.size(); the scene's bounds
/// are not empty.
[[nodiscard]] LightsInSight lightsInSight(std::span<const ShadedLight> lights, const Camera& camera,
                                          const Aabb& scene_bounds_ws, std::uint32_t first);

/// The camera of a frame: reversed z, y down. Plan and truth use it for the same view as the picture.
[[nodiscard]] Camera cameraOf(const Eye& eye, std::uint32_t width, std::uint32_t height, const Aabb& scene_bounds_ws);
/// Fills an ObjectSet with a state's objects (index by index) or updates it. `closed`: closedObjects(), for
/// ObjectFlags::closed of those that it adds; empty: none is. `pieces`: pieceCounts(), for ObjectFlags::pieces; empty:
/// unknown. `joined`: joinedObjects(), for ObjectFlags::joined; empty: none is.
void fillObjectSet(const scene::State& state, ObjectSet& objects, std::span<const std::uint8_t> closed = {},
                   std::span<const std::uint16_t> pieces = {}, std::span<const std::uint8_t> joined = {});
/// By object, 1 where it stands still and shares a vertex with another still object, with normals that differ by less
/// than scene::kCreaseAngle_rad.
[[nodiscard]] std::vector<std::uint8_t> joinedObjects(const scene::Scene& scene, const scene::State& state);
/// For each object of a state, the number of pieces of its primitive (scene::piecesOf()).
[[nodiscard]] std::vector<std::uint16_t> pieceCounts(const scene::Scene& scene, const scene::State& state);

/// By object, 1 where its shadow volume can be counted: it is opaque, nothing cuts it, and its edges are shared by as
/// many triangles one way as the other, by its own or with those of its mesh's other primitives.
[[nodiscard]] std::vector<std::uint8_t> closedObjects(const scene::Scene& scene, const scene::State& state);
/// The casters whose shadow volumes cannot be counted, with reasons.
struct VolumeFaults {
    std::size_t objects = 0;
    std::vector<std::string> sentences; // different ones: "mesh M is open: 12 of its edges have one triangle"
};
[[nodiscard]] VolumeFaults volumeFaults(const scene::Scene& scene, const scene::State& state);
/// The casters that have no fins (filter smoothies), because their shadow's outline is not their mesh's.
[[nodiscard]] VolumeFaults finFaults(const scene::Scene& scene, const scene::State& state);

} // namespace gnomon::host
