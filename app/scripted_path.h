// SPDX-License-Identifier: Apache-2.0
// Cameras and suns that move by themselves: --path. Their places are a pure function of the frame and of their start.
#pragma once

#include "app/keyframes.h"
#include "app/settings.h"
#include "host/view.h"
#include "scene/model.h"
#include "scene/state.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::app {

enum class PathKind : std::uint8_t { pan, orbit, dolly, zoom, day, keys };

// How fast named paths go at path.speed 1, each per second. At 1280x720 and 30 frames per second things at the target's
// distance move by one to three pixels from one frame to the next, nearer things by more.
inline constexpr double kPanHeights = 0.125; // heights of the picture at the target's distance, to the right
inline constexpr double kOrbitDeg = 12.0;    // degrees about the camera's up, against the clock seen from above
inline constexpr double kDollyShare = 0.1;   // of the distance to the target; the target goes along
inline constexpr double kZoomRate = 0.1;     // by which the tangent of half the field of view shrinks: exp(-0.1 s)
inline constexpr double kSunDeg = 3.0;       // degrees, a day in two minutes

struct PathSpot {
    host::Eye eye;
    glm::dvec3 sun_ws{0.0};
};

/// A path that knows where it starts.
struct ScriptedPath {
    PathKind kind = PathKind::pan;
    Keyframes keys;                     // of a file
    host::Eye start;                    // the camera at the first frame
    double focus_m = 1.0;               // from there to the target
    glm::dvec3 right_ws{1.0, 0.0, 0.0}; // of the start's picture
    std::size_t sun = 0;                // which of the shot's lights it moves, if it moves the sun
    glm::dvec3 sun_ws{0.0, -1.0, 0.0};  // the way sunlight travels at the first frame; unit
    bool scene_moves_sun = false;       // day: the scene's own lights take their course as its time goes on

    [[nodiscard]] bool movesCamera() const;
    [[nodiscard]] bool movesSun() const;
};

[[nodiscard]] std::span<const std::string_view> pathNames();

/// Camera and sun `s` seconds from the first frame; one that the path does not move stays at its start. Continuous.
[[nodiscard]] PathSpot pathAt(const ScriptedPath& path, double s);

/// The sun of a scene that does not move it: frame 0 is noon. It goes to the side at constant speed on the great circle
/// that has `noon_ws` as its highest point, as on a day of equinox: it is level after 90 degrees, under the ground
/// until 270, and back after 360. Both are the way light travels, unit.
[[nodiscard]] glm::dvec3 sunAt(const glm::dvec3& noon_ws, double angle_rad);

/// Seconds along the path from the first of --frames to `frame`, times path.speed.
[[nodiscard]] double pathSeconds(const Settings& settings, std::uint32_t frame);

/// Throws UsageError for settings that contradict --path, and for --frames that need one.
void validatePath(const Settings& settings);
/// Reads --path's file, or takes the named path. Nothing without --path. Throws UsageError for an unknown name and for
/// keys that another option contradicts; Error for a wrong file.
[[nodiscard]] std::optional<ScriptedPath> openPath(const Settings& settings);
/// Throws UsageError when at one of --frames the camera has no direction, no way up, or no place.
void requireCameras(const ScriptedPath& path, const Settings& settings);

/// Whether any light that the scene brings changes its direction or place over --frames.
[[nodiscard]] bool lightsMove(const scene::Scene& scene, const scene::State& state, const Settings& settings);

} // namespace gnomon::app
