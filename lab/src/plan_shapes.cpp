// SPDX-License-Identifier: Apache-2.0
#include "plan_shapes.h"

#include <gnomon/plan_views.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>

namespace gnomon::lab {
namespace {

constexpr double kNearest_m = 1e-3; // distance from a light with a place: a nearer point has no image

glm::dvec3 rowOf(const glm::dmat4& m, int row)
{
    return {m[0][row], m[1][row], m[2][row]};
}

/// The part of `v` across `axis`, unit; nothing when hardly any is.
std::optional<glm::dvec3> acrossOf(const glm::dvec3& axis, const glm::dvec3& v)
{
    const glm::dvec3 across = v - axis * glm::dot(axis, v);
    const double length = glm::length(across);
    return length > 1e-3 * glm::length(v) ? std::optional(across / length) : std::nullopt;
}

double cross2(const glm::dvec2& o, const glm::dvec2& a, const glm::dvec2& b)
{
    return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
}

/// Based on: A. M. Andrew, "Another efficient algorithm for convex hulls in two dimensions", 1979.
Polygon hullOf(Polygon points)
{
    std::sort(points.begin(), points.end(),
              [](const glm::dvec2& a, const glm::dvec2& b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
    Polygon hull;
    const auto chain = [&](auto first, auto last) {
        const std::size_t start = hull.size();
        for (auto p = first; p != last; ++p) {
            while (hull.size() >= start + 2 && cross2(hull[hull.size() - 2], hull.back(), *p) <= 0.0) {
                hull.pop_back();
            }
            hull.push_back(*p);
        }
        if (!hull.empty()) {
            hull.pop_back(); // the other chain begins with it
        }
    };
    chain(points.begin(), points.end());
    chain(points.rbegin(), points.rend());
    return hull;
}

/// Appends the corners of what is in front of the light.
void addCorners(const LightPlane& plane, ConvexBody& body, Polygon& points)
{
    if (plane.perspective) {
        body.clip(Plane{plane.forward_ws, -glm::dot(plane.forward_ws, plane.origin_ws) - kNearest_m});
    }
    for (const glm::dvec3& corner : body.points()) {
        if (const auto q = plane.project(corner)) {
            points.push_back(*q);
        }
    }
}

/// The planes around the space that a view serves: the camera's sight, the view's slice, the distance of shadows and
/// the light's cone.
std::vector<Plane> planesOf(const LightPlane& plane, const Frame& frame, const Plan& plan, const View& view)
{
    const Frustum frustum = frustumFromClip(frame.camera.clip_from_world);
    std::vector<Plane> planes(frustum.planes.begin(), frustum.planes.end());
    const glm::dvec3 forward = forwardOf(frame.camera);
    const auto add = [&](const glm::dvec4& row) {
        if (const double length = glm::length(glm::dvec3(row)); length > 1e-9) {
            planes.push_back({glm::dvec3(row) / length, row.w / length});
        }
    };
    const ViewSlice& slice = view.serves.slice;
    if (std::isfinite(slice.begin_m)) {
        add(slice.axis - slice.begin_m * slice.over);
    }
    if (std::isfinite(slice.end_m)) {
        add(slice.end_m * slice.over - slice.axis);
    }
    if (const double end_m = optionsOf(plan, view).fadeEnd_m(); end_m > 0.0) {
        add({-forward, glm::dot(forward, frame.camera.eye_ws) + end_m});
    }
    const Light& light = frame.lights[view.light];
    if (light.type != LightType::directional && light.range_m > 0.0) {
        for (int axis = 0; axis < 3; ++axis) { // the box around its reach
            for (const double sign : {1.0, -1.0}) {
                glm::dvec3 normal(0.0);
                normal[axis] = sign;
                planes.push_back({normal, light.range_m - glm::dot(normal, light.position_ws)});
            }
        }
    }
    if (view.serves.sector.bounded()) {
        for (const glm::dvec4& side :
             {view.serves.sector.x, -view.serves.sector.x, view.serves.sector.y, -view.serves.sector.y}) {
            add(view.serves.sector.w + side);
        }
    }
    constexpr int kSides = 24; // sides of the pyramid that stands for a light's cone
    const double tangent = std::tan(light.outer_half_angle_rad);
    const bool cone = plane.perspective && light.type == LightType::spot && layoutOf(light) == LightType::spot &&
                      glm::dot(plane.forward_ws, glm::normalize(light.direction_ws)) > 0.9999; // not a face of a cube
    for (int i = 0; cone && i < kSides; ++i) {
        const double angle = i * glm::two_pi<double>() / kSides;
        const glm::dvec3 side = plane.x_ws * std::cos(angle) + plane.y_ws * std::sin(angle);
        const glm::dvec3 normal = glm::normalize(side + plane.forward_ws * tangent);
        planes.push_back({normal, -glm::dot(normal, plane.origin_ws)});
    }
    return planes;
}

/// So that the camera looks up in the plane.
void turnUp(LightPlane& plane, const Camera& camera)
{
    const glm::dvec3 camera_up = -rowOf(camera.clip_from_world, 1); // y is down in clip space
    for (const glm::dvec3& up : {forwardOf(camera), camera_up, glm::dvec3(0, 0, -1), glm::dvec3(1, 0, 0)}) {
        if (const auto across = acrossOf(plane.forward_ws, up)) {
            plane.y_ws = *across;
            break;
        }
    }
    plane.x_ws = glm::cross(plane.forward_ws, plane.y_ws);
}

} // namespace

std::optional<glm::dvec2> LightPlane::project(const glm::dvec3& p_ws) const
{
    const glm::dvec3 p = p_ws - origin_ws;
    const glm::dvec2 q(glm::dot(x_ws, p), glm::dot(y_ws, p));
    if (!perspective) {
        return q;
    }
    const double depth = glm::dot(forward_ws, p);
    return depth > 0.5 * kNearest_m ? std::optional(q / depth) : std::nullopt;
}

glm::dvec3 forwardOf(const Camera& camera)
{
    // With a perspective camera w grows along the view; with an orthographic one z grows, or falls.
    const glm::dvec3 w = rowOf(camera.clip_from_world, 3);
    const glm::dvec3 z = rowOf(camera.clip_from_world, 2) * (camera.reversed_z ? -1.0 : 1.0);
    return glm::normalize(glm::length(w) > 0.0 ? w : z);
}

LightPlane lightPlaneOf(const View& view, const Camera& camera)
{
    LightPlane plane;
    plane.perspective = !view.projection.parallel;
    if (view.projection.parallel) {
        // A place of a map is a ray of its light, so x and y are constant along a ray, and depth grows. A sun that
        // steps need not stand where the frame's light does.
        const glm::dvec3 ray =
            glm::cross(rowOf(view.projection.clip_from_world, 0), rowOf(view.projection.clip_from_world, 1));
        plane.forward_ws = glm::normalize(ray);
        if (glm::dot(plane.forward_ws, glm::dvec3(view.projection.metric.metric_ws)) < 0.0) {
            plane.forward_ws = -plane.forward_ws;
        }
    } else {
        plane.origin_ws = view.projection.light_place_ws;
        plane.forward_ws =
            glm::normalize(glm::dvec3(view.projection.metric.metric_ws)); // depth grows along the view's axis
    }
    turnUp(plane, camera);
    return plane;
}

LightPlane planeFromAbove(const glm::dvec3& place_ws, const Camera& camera)
{
    LightPlane plane;
    plane.origin_ws = place_ws;
    turnUp(plane, camera);
    return plane;
}

Polygon pyramidOf(const LightPlane& plane, const MapInPlane& map, double reach_m)
{
    Polygon points;
    const auto add = [&](const glm::dvec3& p_ws) {
        if (const auto q = plane.project(p_ws)) {
            points.push_back(*q);
        }
    };
    add(map.plane.origin_ws);
    for (const glm::dvec2& corner : kCorners) {
        const glm::dvec2 q = planePoint(map.from_plane, corner.x, corner.y);
        const glm::dvec3 ray = map.plane.forward_ws + map.plane.x_ws * q.x + map.plane.y_ws * q.y;
        add(map.plane.origin_ws + ray * reach_m);
    }
    return hullOf(std::move(points));
}

glm::dmat3 mapFromPlane(const LightPlane& plane, const View& view)
{
    const auto column = [&](const glm::dvec3& v, double w) {
        const glm::dvec4 clip = view.projection.clip_from_world * glm::dvec4(v, w);
        return glm::dvec3(clip.x, clip.y, clip.w);
    };
    // At any depth under parallel light, which changes nothing; 1 m from the place of another.
    const glm::dvec3 middle = plane.origin_ws + (plane.perspective ? plane.forward_ws : glm::dvec3(0.0));
    return {column(plane.x_ws, 0.0), column(plane.y_ws, 0.0), column(middle, 1.0)};
}

glm::dvec2 planePoint(const glm::dmat3& map_from_plane, double x, double y)
{
    const glm::dvec3 q = glm::inverse(map_from_plane) * glm::dvec3(x, y, 1.0);
    return glm::dvec2(q) / q.z;
}

Polygon shadowOf(const LightPlane& plane, ConvexBody body)
{
    Polygon points;
    addCorners(plane, body, points);
    return hullOf(std::move(points));
}

Polygon seenFrom(const LightPlane& plane, const Frame& frame, const Plan& plan, const View& view)
{
    const std::vector<Plane> planes = planesOf(plane, frame, plan, view);
    ConvexBody body;
    Polygon points;
    for (const std::uint32_t object : plan.receivers) {
        body.reset(frame.objects->bounds(object));
        body.clip(planes);
        addCorners(plane, body, points);
    }
    return hullOf(std::move(points));
}

Polygon inWindow(std::span<const glm::dvec2> polygon, const glm::dmat3& window_from_plane, double half)
{
    // Based on: I. Sutherland, G. Hodgman, "Reentrant polygon clipping", 1974; before the division by w.
    std::vector<glm::dvec3> points;
    points.reserve(polygon.size() + 4);
    double largest = 0.0;
    for (const glm::dvec2& q : polygon) {
        points.push_back(window_from_plane * glm::dvec3(q, 1.0));
        largest = std::max(largest, std::abs(points.back().z));
    }
    const glm::dvec4 sides[] = {
        {0, 0, 1, -1e-9 * largest}, {1, 0, half, 0}, {-1, 0, half, 0}, {0, 1, half, 0}, {0, -1, half, 0}};
    std::vector<glm::dvec3> kept;
    for (const glm::dvec4& side : sides) {
        kept.clear();
        const auto inside = [&](const glm::dvec3& p) {
            return glm::dot(side, glm::dvec4(p, 1.0));
        };
        for (std::size_t i = 0; i < points.size(); ++i) {
            const glm::dvec3& a = points[i];
            const glm::dvec3& b = points[(i + 1) % points.size()];
            const double da = inside(a);
            const double db = inside(b);
            if (da >= 0.0) {
                kept.push_back(a);
            }
            if ((da < 0.0) != (db < 0.0)) {
                kept.push_back(a + (b - a) * (da / (da - db)));
            }
        }
        points.swap(kept);
    }
    Polygon window;
    for (const glm::dvec3& p : points) {
        if (p.z > 0.0) {
            window.emplace_back(p.x / p.z, p.y / p.z);
        }
    }
    return window;
}

} // namespace gnomon::lab
