// SPDX-License-Identifier: Apache-2.0
#include "app/scripted_path.h"

#include "app/shot.h"
#include "setting_rows.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace gnomon::app {
namespace {

constexpr std::array<std::string_view, 5> kNames{"pan", "orbit", "dolly", "zoom", "day"}; // as PathKind
constexpr double kNarrowestFov_deg = 0.1;                                                 // as --fov
constexpr double kWidestFov_deg = 179.0;

/// About a unit axis, counter-clockwise seen from its tip (Rodrigues' formula).
glm::dvec3 rotate(const glm::dvec3& v, const glm::dvec3& axis, double angle_rad)
{
    const double c = std::cos(angle_rad);
    return v * c + glm::cross(axis, v) * std::sin(angle_rad) + axis * (glm::dot(axis, v) * (1.0 - c));
}

void shift(host::Eye& eye, const glm::dvec3& by)
{
    eye.position_ws += by;
    eye.target_ws += by;
}

/// Never wider than the start or the options' limit, whichever is wider, and never narrower than the narrower of both.
double zoomedFov(double start_rad, double s)
{
    const double fov = 2.0 * std::atan(std::tan(start_rad / 2.0) * std::exp(-kZoomRate * s));
    return std::clamp(fov, std::min(start_rad, glm::radians(kNarrowestFov_deg)),
                      std::max(start_rad, glm::radians(kWidestFov_deg)));
}

host::Eye eyeAt(const ScriptedPath& path, double s)
{
    host::Eye eye = path.start;
    const glm::dvec3 forward = glm::normalize(eye.target_ws - eye.position_ws);
    switch (path.kind) {
    case PathKind::pan:
        shift(eye, path.right_ws * (s * kPanHeights * host::pictureHeight(eye, path.focus_m)));
        break;
    case PathKind::orbit: {
        const glm::dvec3 centre = eye.position_ws + forward * path.focus_m;
        const glm::dvec3 axis = glm::normalize(eye.up_ws);
        eye.position_ws = centre - rotate(forward, axis, glm::radians(kOrbitDeg) * s) * path.focus_m;
        eye.target_ws = centre;
        break;
    }
    case PathKind::dolly:
        shift(eye, forward * (s * kDollyShare * path.focus_m));
        break;
    case PathKind::zoom:
        eye.fov_y_rad = zoomedFov(eye.fov_y_rad, s);
        eye.height_m *= std::exp(-kZoomRate * s);
        break;
    case PathKind::day:
        break;
    case PathKind::keys:
        eye.position_ws = path.keys.eye_ws.empty() ? eye.position_ws : path.keys.eye_ws.at(s);
        eye.target_ws = path.keys.target_ws.empty() ? eye.target_ws : path.keys.target_ws.at(s);
        eye.fov_y_rad = path.keys.fov_deg.empty() ? eye.fov_y_rad : glm::radians(path.keys.fov_deg.at(s).x);
        break;
    }
    return eye;
}

glm::dvec3 sunOf(const ScriptedPath& path, double s)
{
    if (path.kind == PathKind::day && !path.scene_moves_sun) {
        return sunAt(path.sun_ws, glm::radians(kSunDeg) * s);
    }
    return path.keys.sun_ws.empty() ? path.sun_ws : glm::normalize(path.keys.sun_ws.at(s));
}

/// Options that say where something is whose place the file's keys say.
void requireNoRival(const Settings& settings, const KeyTrack& track, std::string_view what,
                    const std::vector<std::string_view>& options)
{
    for (const std::string_view option : options) {
        if (!track.empty() && settings.given.contains(option)) {
            throw UsageError(fmt::format("--{} and the keys of {} both say {}; give one", option, settings.path, what));
        }
    }
}

ScriptedPath openFile(const Settings& settings)
{
    std::error_code ignored;
    if (!std::filesystem::exists(settings.path, ignored)) {
        const std::vector<std::string_view> names(kNames.begin(), kNames.end());
        throw UsageError(fmt::format("--path: \"{}\" is no file and no path{}; paths are {}", settings.path,
                                     suggestion(settings.path, names), listed(names)));
    }
    ScriptedPath path;
    path.kind = PathKind::keys;
    path.keys = readKeyframes(settings.path);
    requireNoRival(settings, path.keys.eye_ws, "where the camera is", {"eye"});
    requireNoRival(settings, path.keys.target_ws, "where the camera looks", {"target"});
    if (!path.keys.target_ws.empty()) {
        requireNoRival(settings, path.keys.eye_ws, "where the camera is", {"camera"});
    }
    requireNoRival(settings, path.keys.fov_deg, "how wide the camera looks", {"fov", "ortho"});
    requireNoRival(settings, path.keys.sun_ws, "where the sun is", {"sun", "spot", "point"});
    requireNoRival(settings, path.keys.time_s, "what time it is", {"time"});
    return path;
}

} // namespace

bool ScriptedPath::movesCamera() const
{
    return kind == PathKind::keys ? !(keys.eye_ws.empty() && keys.target_ws.empty() && keys.fov_deg.empty())
                                  : kind != PathKind::day;
}

bool ScriptedPath::movesSun() const
{
    return kind == PathKind::keys ? !keys.sun_ws.empty() : kind == PathKind::day && !scene_moves_sun;
}

std::span<const std::string_view> pathNames()
{
    return kNames;
}

PathSpot pathAt(const ScriptedPath& path, double s)
{
    return {eyeAt(path, s), sunOf(path, s)};
}

glm::dvec3 sunAt(const glm::dvec3& noon_ws, double angle_rad)
{
    const glm::dvec3 up(0.0, 1.0, 0.0);
    glm::dvec3 side = glm::cross(noon_ws, up);
    const double length = glm::length(side);
    side = length > 1e-9 ? side / length : glm::dvec3(1.0, 0.0, 0.0); // from straight above, or below
    return glm::normalize(noon_ws * std::cos(angle_rad) + side * std::sin(angle_rad));
}

double pathSeconds(const Settings& settings, std::uint32_t frame)
{
    const std::uint32_t first = settings.frames ? settings.frames->first : 0;
    return settings.path_speed * (static_cast<double>(frame) - static_cast<double>(first)) / settings.fps;
}

void validatePath(const Settings& settings)
{
    const bool measures = settings.subcommand == kCompare || settings.subcommand == kBench;
    if (settings.path.empty()) {
        if (measures && settings.frames) {
            throw UsageError("--frames needs --path, which says what moves from frame to frame");
        }
        return;
    }
    if (!settings.frames) {
        throw UsageError("--path needs --frames A-B");
    }
    if (settings.sweep) {
        throw UsageError("--path and --sweep both say what changes from frame to frame; give one");
    }
    if (settings.equal_error) {
        throw UsageError("--equal-error is of a single frame, not of a --path");
    }
}

std::optional<ScriptedPath> openPath(const Settings& settings)
{
    if (settings.path.empty()) {
        return std::nullopt;
    }
    const auto* name = std::find(kNames.begin(), kNames.end(), settings.path);
    if (name == kNames.end()) {
        return openFile(settings);
    }
    ScriptedPath path;
    path.kind = static_cast<PathKind>(name - kNames.begin());
    return path;
}

void requireCameras(const ScriptedPath& path, const Settings& settings)
{
    if (!path.movesCamera() && !path.movesSun()) {
        return;
    }
    const bool is_file = path.kind == PathKind::keys;
    for (std::uint32_t frame = settings.frames->first; frame <= settings.frames->last; ++frame) {
        const PathSpot spot = pathAt(path, pathSeconds(settings, frame));
        const glm::dvec3 look = spot.eye.target_ws - spot.eye.position_ws;
        const double distance = glm::length(look);
        const auto refuse = [&](std::string_view why) {
            throw UsageError(fmt::format("--path {}: at frame {} {}", settings.path, frame, why));
        };
        for (int i = 0; i < 3; ++i) {
            if (!(std::abs(spot.eye.position_ws[i]) <= kFarthest && std::abs(spot.eye.target_ws[i]) <= kFarthest)) {
                refuse(fmt::format("the camera is farther away than {} m", kFarthest));
            }
        }
        // As --eye and --target are held to.
        if (is_file && path.movesCamera() && !(distance > 1e-7 * (1e-3 + glm::length(spot.eye.position_ws)))) {
            refuse("eye and target are the same point");
        }
        if (is_file && path.movesCamera() &&
            glm::length(glm::cross(look / distance, glm::normalize(spot.eye.up_ws))) < 1e-6) {
            refuse("the camera looks along its own up");
        }
        if (!(glm::length(spot.sun_ws) > 0.5)) { // not a number where two directions cancel out
            refuse("the sun's direction is zero");
        }
    }
}

bool lightsMove(const scene::Scene& scene, const scene::State& state, const Settings& settings)
{
    constexpr std::uint32_t kLooks = 16;
    scene::State moved = state;
    const std::uint32_t first = settings.frames->first;
    const std::uint32_t count = settings.frames->last - first;
    for (std::uint32_t look = 1; look <= kLooks; ++look) {
        const double share = static_cast<double>(look) / kLooks;
        const double frames = std::max(1.0, std::round(share * static_cast<double>(count)));
        const double time_s = timeOf(settings, first) + settings.path_speed * frames / settings.fps;
        scene::advance(scene, time_s, moved, settings.animation);
        for (std::size_t i = 0; i < state.lights.size(); ++i) {
            if (moved.lights[i].direction_ws != state.lights[i].direction_ws ||
                moved.lights[i].position_ws != state.lights[i].position_ws) {
                return true;
            }
        }
    }
    return false;
}

} // namespace gnomon::app
