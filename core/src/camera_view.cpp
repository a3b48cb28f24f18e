// SPDX-License-Identifier: Apache-2.0
#include "camera_view.h"

#include "motion/steps.h"

#include <gnomon/world_range.h>

#include <glm/common.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon {
namespace {

/// Does the matrix say which end of the view has depth 1, and is it not what reversed_z says? Along the view's axis
/// depth is (a t + b) / (c t + d), which grows if a d - b c > 0. Only what is beyond rounding counts.
Outcome checkDirection(const Camera& camera)
{
    constexpr double kRounding = 1e-5; // the matrix may come from floats
    const glm::dmat4 rows = glm::transpose(clipFromWorld(camera));
    const glm::dvec4 eye(camera.eye_ws, 1.0);
    const double length = glm::length(glm::dvec3(rows[3]));
    double growth = 0.0;
    double rounding = 0.0;
    if (length > 0.0) {
        const double a = glm::dot(glm::dvec3(rows[2]), glm::dvec3(rows[3]) / length);
        const double b = glm::dot(rows[2], eye);
        const double d = glm::dot(rows[3], eye);
        const glm::dvec4 magnitude = glm::abs(eye);
        growth = a * d - b * length;
        rounding = kRounding * (std::abs(a) * glm::dot(glm::abs(rows[3]), magnitude) +
                                length * glm::dot(glm::abs(rows[2]), magnitude));
    } else {
        // Nothing but the eye tells an orthographic view's ends apart: it is not beyond the far one.
        const double depth = glm::dot(rows[2], eye) / rows[3].w;
        growth = depth >= 1.0 ? -1.0 : (depth <= 0.0 ? 1.0 : 0.0);
    }
    if (camera.reversed_z && growth > rounding) {
        return {OutcomeKind::degenerate,
                "Camera::reversed_z is set, but the camera's matrix has depth 0 at the near plane"};
    }
    if (!camera.reversed_z && growth < -rounding) {
        return {OutcomeKind::degenerate,
                "Camera::reversed_z is not set, but the camera's matrix has depth 1 at the near plane"};
    }
    return {};
}

Outcome checkCamera(const Camera& camera)
{
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) {
            if (!std::isfinite(camera.clip_from_world[column][row])) {
                return {OutcomeKind::degenerate, "the camera's matrix is not finite"};
            }
        }
    }
    if (!std::isfinite(camera.eye_ws.x) || !std::isfinite(camera.eye_ws.y) || !std::isfinite(camera.eye_ws.z)) {
        return {OutcomeKind::degenerate, "the camera's eye is not finite"};
    }
    if (isTooFar(camera.eye_ws)) {
        return {OutcomeKind::degenerate, "the camera is farther than 1e9 m from the origin"};
    }
    const double determinant = glm::determinant(camera.clip_from_world);
    if (!std::isfinite(determinant) || determinant == 0.0) {
        return {OutcomeKind::degenerate, "the camera's matrix is singular"};
    }
    return checkDirection(camera);
}

/// Half-spaces around the ball of what is near enough to be shadowed.
void addDistancePlanes(const Camera& camera, const CameraView& view, double max_distance_m, std::vector<Plane>& planes)
{
    for (int axis = 0; axis < 3; ++axis) {
        for (const double sign : {1.0, -1.0}) {
            glm::dvec3 normal(0.0);
            normal[axis] = sign;
            planes.push_back({normal, max_distance_m - glm::dot(normal, camera.eye_ws)});
        }
    }
    if (view.perspective) {
        planes.push_back({-view.forward_ws, max_distance_m + glm::dot(view.forward_ws, camera.eye_ws)});
    }
}

/// For a perspective camera w grows along the view axis; for an orthographic one z grows, or falls.
void findAxis(const Camera& camera, CameraView& view)
{
    const glm::dmat4 rows = glm::transpose(clipFromWorld(camera));
    const glm::dvec3 w(rows[3]);
    view.eye_ws = camera.eye_ws;
    view.clip_from_world = clipFromWorld(camera);
    view.perspective = !isOrthographic(camera);
    const glm::dvec3 z = camera.reversed_z ? -glm::dvec3(rows[2]) : glm::dvec3(rows[2]);
    view.forward_ws = glm::normalize(view.perspective ? w : z);
}

constexpr int kMostCutBoxes = 64;
/// Share of the largest coordinate by which boxes are padded: what single precision may round, some eight times.
constexpr double kPad = 1e-6;

} // namespace

void CameraView::measureDepths(const ObjectSet& objects, const std::vector<std::uint32_t>& receivers)
{
    near_m = std::numeric_limits<double>::infinity();
    far_m = -near_m;
    int cut_boxes = 0;
    for (const std::uint32_t object : receivers) {
        const Aabb& box = objects.bounds(object);
        const glm::dvec3 centre = (glm::dvec3(box.min) + glm::dvec3(box.max)) * 0.5;
        const glm::dvec3 half = (glm::dvec3(box.max) - glm::dvec3(box.min)) * 0.5 + pad_m;
        const double depth_m = depthOf(centre);
        const double reach_m = glm::dot(glm::abs(forward_ws), half);
        if (depth_m - reach_m >= near_m && depth_m + reach_m <= far_m) {
            continue;
        }
        // Only a part is seen of a box that reaches out of sight. Clipping takes a microsecond, so not all boxes are
        // clipped.
        if (cut_boxes == kMostCutBoxes) {
            near_m = std::min(near_m, depth_m - reach_m);
            far_m = std::max(far_m, depth_m + reach_m);
            continue;
        }
        ++cut_boxes;
        const glm::vec3 pad(static_cast<float>(pad_m));
        cut_.reset({box.min - pad, box.max + pad});
        cut_.clip(planes);
        for (const glm::dvec3& corner : cut_.points()) {
            near_m = std::min(near_m, depthOf(corner));
            far_m = std::max(far_m, depthOf(corner));
        }
    }
    if (!(near_m <= far_m)) { // boxes that only touch the view
        near_m = far_m = 0.0;
    }
    if (perspective) {
        near_m = std::max(near_m, 0.0);
    }
    far_m = std::max(far_m, near_m);
}

void CameraView::boundDepths(const Camera& camera, double max_distance_m)
{
    const Frustum frustum = frustumFromClip(clipFromWorld(camera));
    const auto depthOfPlane = [&](const Plane& plane) {
        const double along = glm::dot(plane.normal, forward_ws);
        return along == 0.0 ? std::numeric_limits<double>::infinity() : -plane.distance(eye_ws) / along;
    };
    const Plane& first = frustum.planes[camera.reversed_z ? 5 : 4];
    const Plane& last = frustum.planes[camera.reversed_z ? 4 : 5];
    double farthest_m = pad_m;
    for (int i = 0; i < 8; ++i) {
        farthest_m = std::max(farthest_m, glm::distance(glm::dvec3(scene_ws.corner(i)), eye_ws));
    }
    near_m = depthOfPlane(first);
    far_m = std::min(depthOfPlane(last), steppedRatio(farthest_m, farthest_m).high);
    if (max_distance_m > 0.0) {
        far_m = std::min(far_m, max_distance_m);
    }
    far_m = std::max(far_m, near_m + pad_m);
}

void CameraView::look(const Frame& frame, double max_distance_m, std::vector<std::uint32_t>& receivers)
{
    receivers.clear();
    planes.clear();
    scene_ws = frame.objects->bounds();
    outcome = checkCamera(frame.camera);
    if (outcome.kind != OutcomeKind::ok || scene_ws.empty()) {
        return;
    }
    findAxis(frame.camera, *this);
    glm::dvec3 largest = glm::max(glm::abs(glm::dvec3(scene_ws.min)), glm::abs(glm::dvec3(scene_ws.max)));
    if (scene_ws.min == scene_ws.max) { // a point, which may be at the origin: there is no other measure
        largest = glm::max(largest, glm::max(glm::abs(eye_ws), glm::dvec3(kSmallestScene_m)));
    }
    pad_m = kPad * std::max({largest.x, largest.y, largest.z});

    for (const Plane& plane : frustumFromClip(clipFromWorld(frame.camera)).planes) {
        if (plane.normal != glm::dvec3(0.0)) {
            planes.push_back(plane);
        }
    }
    if (max_distance_m > 0.0) {
        addDistancePlanes(frame.camera, *this, max_distance_m, planes);
    }
    frame.objects->query(planes, ObjectSet::Want::receivers, receivers);
    if (max_distance_m > 0.0) {
        std::erase_if(receivers, [&](std::uint32_t object) {
            const Aabb& box = frame.objects->bounds(object);
            const glm::dvec3 nearest = glm::clamp(frame.camera.eye_ws, glm::dvec3(box.min), glm::dvec3(box.max));
            return glm::distance(nearest, frame.camera.eye_ws) > max_distance_m;
        });
    }
}

} // namespace gnomon
