// SPDX-License-Identifier: Apache-2.0
#include "camera_rays.h"

#include "smooth_surface.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::truth {

CameraRays::CameraRays(const SceneGeometry& geometry, const View& view)
    : geometry_(geometry), view_(view), eye_rel_(view.eye_ws - geometry.originWs())
{
}

CameraRays::Ray CameraRays::parallelThrough(double clip_x, double clip_y) const
{
    const auto pointAt = [&](double depth) {
        const glm::dvec4 end = view_.world_from_clip * glm::dvec4(clip_x, clip_y, depth, 1.0);
        return glm::dvec3(end) / end.w - view_.eye_ws;
    };
    const glm::dvec3 a = pointAt(0.0);
    const glm::dvec3 b = pointAt(1.0);
    const glm::dvec3 along = glm::normalize(b - a);
    const double at_a = glm::dot(a, along);
    const double at_b = glm::dot(b, along);
    const bool from_a = std::abs(at_a) <= std::abs(at_b);
    Ray ray;
    ray.from = a - along * at_a;
    ray.direction = from_a ? along : -along;
    ray.near_m = std::max(from_a ? at_a : -at_b, 0.0);
    ray.far_m = from_a ? at_b : -at_a;
    return ray;
}

CameraRays::Ray CameraRays::through(double clip_x, double clip_y) const
{
    const glm::dmat4& m = view_.world_from_clip;
    if (m[0].w == 0.0 && m[1].w == 0.0 && m[2].w == 0.0) {
        return parallelThrough(clip_x, clip_y);
    }
    // The middle of the depth range is in front of the camera whichever end of it is near, and not at infinity.
    const glm::dvec4 middle = view_.world_from_clip * glm::dvec4(clip_x, clip_y, 0.5, 1.0);
    Ray ray;
    ray.direction = glm::normalize(glm::dvec3(middle) / middle.w - view_.eye_ws);
    const auto distanceAt = [&](double depth) {
        const glm::dvec4 end = view_.world_from_clip * glm::dvec4(clip_x, clip_y, depth, 1.0);
        const double along = glm::dot(glm::dvec3(end) / end.w - view_.eye_ws, ray.direction);
        // A far plane at infinity has w = 0, or by rounding a point very far away on either side.
        return std::isfinite(along) && along > 0.0 ? along : std::numeric_limits<double>::infinity();
    };
    const double a = distanceAt(0.0);
    const double b = distanceAt(1.0);
    ray.near_m = std::min(a, b);
    ray.far_m = std::max(a, b);
    return ray;
}

std::optional<CameraRays::Seen> CameraRays::trace(const glm::dvec2& point_px) const
{
    const Ray ray = through(point_px.x / view_.size_px.x * 2.0 - 1.0, point_px.y / view_.size_px.y * 2.0 - 1.0);
    if (!(glm::dot(ray.direction, ray.direction) > 0.5) || !std::isfinite(ray.near_m)) {
        return {}; // a camera that looks nowhere
    }
    RayContext context;
    context.from_camera = true;
    context.base.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    RTCRayHit query{};
    const glm::dvec3 from_rel = eye_rel_ + ray.from;
    query.ray.org_x = static_cast<float>(from_rel.x);
    query.ray.org_y = static_cast<float>(from_rel.y);
    query.ray.org_z = static_cast<float>(from_rel.z);
    query.ray.dir_x = static_cast<float>(ray.direction.x);
    query.ray.dir_y = static_cast<float>(ray.direction.y);
    query.ray.dir_z = static_cast<float>(ray.direction.z);
    query.ray.tnear = static_cast<float>(ray.near_m);
    query.ray.tfar = static_cast<float>(ray.far_m);
    query.ray.mask = 0xFFFFFFFFU;
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(geometry_.seen(), &context.base, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) {
        return {};
    }
    return surfaceAt(ray, query.hit);
}

std::optional<CameraRays::Seen> CameraRays::surfaceAt(const Ray& ray, const RTCHit& hit) const
{
    Seen seen;
    seen.object = hit.instID[0] != RTC_INVALID_GEOMETRY_ID ? hit.instID[0] : hit.geomID;
    seen.triangle = hit.primID;
    const std::optional<Triangle> triangle = geometry_.triangle(seen.object, seen.triangle);
    if (!triangle) {
        return {};
    }
    // Embree says which triangle; where on it is found again in double precision, because its distance is a float.
    const double facing = glm::dot(triangle->front, ray.direction);
    const double distance_m = glm::dot(triangle->rel[0] - eye_rel_ - ray.from, triangle->front) / facing;
    if (!std::isfinite(distance_m) || distance_m <= 0.0) {
        return {}; // seen exactly edge on
    }
    seen.point = ray.from + ray.direction * distance_m;
    seen.normal = facing < 0.0 ? triangle->front : -triangle->front;
    seen.smooth_normal =
        smoothPoint(*triangle, geometry_.vertexNormals(seen.object, seen.triangle), eye_rel_ + seen.point, seen.normal)
            .normal;
    return seen;
}

} // namespace gnomon::truth
