// SPDX-License-Identifier: Apache-2.0
// A shot: the scene, the lights and the camera of a run, made from the file and the settings.
#pragma once

#include "app/scripted_path.h"
#include "app/settings.h"
#include "host/frame_renderer.h"
#include "scene/model.h"
#include "scene/state.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace gnomon::app {

/// Where the eye stands in a scene without a camera, and the sun in a scene without a light. Both come from the scene
/// at rest, so neither changes while it moves.
struct Outlook {
    double azimuth_rad = 0.6; // of the eye, seen from the scene: 0 is +z, and it grows towards +x
    double elevation_rad = 0.4;
    double sun_azimuth_rad = 0.0;
};

struct Shot {
    scene::Scene scene;
    scene::State state;
    std::optional<std::uint32_t> ground; // the node of the ground that was put in
    Outlook outlook;
    std::string camera; // name of the view, or how it was chosen
    host::Eye eye;
    bool has_target = true;                // eye.target_ws is a place of its own, not only a direction
    std::vector<host::ShadedLight> lights; // at most host::kMaxLights
    bool lights_chosen = false;            // from more, for this frame; the one that --light means is the first then
    std::size_t lights_left_out = 0;       // of those chosen from, in sight
    std::optional<ScriptedPath> path;      // --path
    std::uint64_t moves = 0;               // how often it was moved
    std::vector<std::string> notices;      // sentences for people, on stderr
};

/// Loads the scene, applies what the settings change in it and evaluates it at --time (or at the first of --frames).
/// Throws UsageError for a camera that is not there, for lights of the command line that the technique refuses and for
/// a path that cannot be; Error for a path's file.
[[nodiscard]] Shot makeShot(const Settings& settings);
/// Moves everything to a frame of --frames; camera and lights of the scene follow, and then the path.
void moveShot(Shot& shot, const Settings& settings, std::uint32_t frame);
/// Checks a technique before it draws this scene. makeShot() does so for its own; call it for one that is taken later.
/// Throws Error for casters that filter volumes cannot count; adds to Shot::notices.
void askOfTechnique(Shot& shot, const Settings& settings);
/// The distance from the eye to its target, metres. An eye with only a direction has as target the point along it that
/// is nearest to the middle of the scene.
[[nodiscard]] double focusOf(const Shot& shot);
/// The scene's time at a frame, if no path says otherwise.
[[nodiscard]] double timeOf(const Settings& settings, std::uint32_t frame);

/// The light that --light names, by its own name or its node's, else the first. Throws UsageError for one that is not
/// there.
[[nodiscard]] std::size_t lightIndex(const Shot& shot, const Settings& settings);
/// Adds to Shot::notices that --sun-angle, --light-size or a setting of spot lights is given and none of `lights`, some
/// of the shot's, has such a size. Throws UsageError with --strict, and for a setting that is swept: all its values
/// would look alike. makeShot() calls it for all lights of a shot.
void noteSizesWithoutEffect(Shot& shot, const Settings& settings, std::span<const host::ShadedLight> lights);

[[nodiscard]] host::RenderOptions renderOptions(const Settings& settings);
/// The frame that the library plans, over objects filled from the state (host::fillObjectSet).
[[nodiscard]] std::vector<Light> castersOf(const Shot& shot);

/// The box around what is drawn, without a ground that was put in and without surroundings, such as a wide ground or a
/// dome (surroundings.h).
[[nodiscard]] Aabb modelBounds(const Shot& shot);
/// The eye of the shot's outlook, as near as it has all of the model in the picture. Where the first light is a sun,
/// the picture has the shadow on the ground too; a low sun's long shadow only in part.
[[nodiscard]] host::Eye framedEye(const Shot& shot, double fov_y_rad, double aspect);

} // namespace gnomon::app
