// SPDX-License-Identifier: Apache-2.0
#include "shot_parts.h"

#include <gnomon/error.h>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>

namespace gnomon::app {
namespace {

constexpr double kDefaultFovDeg = 45.0;

double fovRad(const Settings& settings, double otherwise_rad)
{
    return settings.fov_deg ? glm::radians(*settings.fov_deg) : otherwise_rad;
}

void useView(Shot& shot, const Settings& settings, const scene::NamedView& view)
{
    shot.camera = view.name;
    shot.eye = host::Eye{};
    shot.eye.position_ws = view.eye;
    shot.eye.target_ws = view.target;
    shot.eye.fov_y_rad = fovRad(settings, static_cast<double>(view.fov_y_rad));
}

void usePlaced(Shot& shot, const Settings& settings, const scene::PlacedCamera& placed, const std::string& name)
{
    const scene::Camera& camera = shot.scene.cameras[placed.camera];
    shot.camera = name;
    shot.eye = host::Eye{};
    shot.eye.position_ws = placed.eye_ws;
    shot.eye.target_ws = glm::dvec3(placed.eye_ws) + glm::dvec3(placed.forward_ws);
    shot.eye.up_ws = placed.up_ws;
    shot.has_target = false;
    shot.eye.fov_y_rad = fovRad(settings, static_cast<double>(camera.fov_y_rad));
    shot.eye.height_m = camera.orthographic ? 2.0 * static_cast<double>(camera.half_height_m) : 0.0;
    shot.eye.near_m = static_cast<double>(camera.near_m);
    shot.eye.far_m = static_cast<double>(camera.far_m);
}

/// The node that holds a placed camera: both are in the order of the nodes.
const std::string& nodeNameOf(const Shot& shot, std::size_t placed)
{
    static const std::string none;
    for (const scene::Node& node : shot.state.nodes) {
        if (node.camera != scene::kNone && placed-- == 0) {
            return node.name;
        }
    }
    return none;
}

/// The camera's own name; nameless ones are "camera0" and so on. glTF names the node that holds it as well: --camera
/// takes either.
std::string nameOf(const Shot& shot, std::size_t placed)
{
    const std::string& name = shot.scene.cameras[shot.state.cameras[placed].camera].name;
    return name.empty() ? fmt::format("camera{}", placed) : name;
}

void useNamed(Shot& shot, const Settings& settings)
{
    for (const scene::NamedView& view : shot.scene.views) {
        if (view.name == settings.camera) {
            useView(shot, settings, view);
            return;
        }
    }
    for (std::size_t i = 0; i < shot.state.cameras.size(); ++i) {
        if (nameOf(shot, i) == settings.camera) {
            usePlaced(shot, settings, shot.state.cameras[i], settings.camera);
            return;
        }
    }
    for (std::size_t i = 0; i < shot.state.cameras.size(); ++i) {
        if (nodeNameOf(shot, i) == settings.camera) {
            usePlaced(shot, settings, shot.state.cameras[i], settings.camera);
            return;
        }
    }
    const std::vector<std::string> names = cameraNames(shot);
    const std::vector<std::string_view> known(names.begin(), names.end());
    throw UsageError(fmt::format(
        "--camera: {} has no camera \"{}\"{}; {}", settings.scene, settings.camera, suggestion(settings.camera, known),
        known.empty() ? "it has none, so give --eye and --target" : "it has " + listed(known)));
}

void useFramed(Shot& shot, const Settings& settings)
{
    const double aspect = static_cast<double>(settings.size_px.x) / static_cast<double>(settings.size_px.y);
    shot.camera = "fitted";
    shot.eye = framedEye(shot, fovRad(settings, glm::radians(kDefaultFovDeg)), aspect);
    if (settings.ortho_m) {
        shot.eye = standingBack(shot.eye, shot.state.bounds_ws);
    }
}

/// Where the camera is, as it is without --ortho.
void findEye(Shot& shot, const Settings& settings)
{
    shot.has_target = true;
    if (settings.eye_ws) {
        shot.camera = "given";
        shot.eye = host::Eye{};
        shot.eye.position_ws = *settings.eye_ws;
        shot.eye.target_ws = *settings.target_ws;
        shot.eye.up_ws = settings.up_ws;
        shot.eye.fov_y_rad = fovRad(settings, glm::radians(kDefaultFovDeg));
    } else if (!settings.camera.empty()) {
        useNamed(shot, settings);
    } else if (!shot.scene.views.empty()) {
        useView(shot, settings, shot.scene.views.front());
    } else if (const auto& cameras = shot.state.cameras; !cameras.empty()) {
        const auto perspective = std::ranges::find_if(cameras, [&](const scene::PlacedCamera& placed) {
            return !shot.scene.cameras[placed.camera].orthographic;
        });
        const auto first = perspective != cameras.end() ? perspective : cameras.begin();
        usePlaced(shot, settings, *first, nameOf(shot, static_cast<std::size_t>(first - cameras.begin())));
    } else {
        useFramed(shot, settings);
    }
}

} // namespace

std::vector<std::string> cameraNames(const Shot& shot)
{
    std::vector<std::string> names;
    for (const scene::NamedView& view : shot.scene.views) {
        names.push_back(view.name);
    }
    for (std::size_t i = 0; i < shot.state.cameras.size(); ++i) {
        names.push_back(nameOf(shot, i));
    }
    return names;
}

void placeEye(Shot& shot, const Settings& settings)
{
    findEye(shot, settings);
    shot.eye.height_m = settings.ortho_m.value_or(shot.eye.height_m);
}

} // namespace gnomon::app
