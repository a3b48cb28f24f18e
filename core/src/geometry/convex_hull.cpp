// SPDX-License-Identifier: Apache-2.0
// Convex hull of a few hundred points, grown point by point: a point outside replaces the faces that it sees by a fan
// over their horizon.
// Based on: F. Preparata, M. Shamos, "Computational Geometry: An Introduction", 1985, section 3.4.
#include <gnomon/geometry.h>

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>

namespace gnomon {
namespace {

struct Triangle {
    std::array<std::uint32_t, 3> corners;
    glm::dvec3 normal; // outward, unit length
    double d = 0.0;

    [[nodiscard]] double above(const glm::dvec3& p) const { return glm::dot(normal, p) + d; }
};

using Edge = std::pair<std::uint32_t, std::uint32_t>;

Triangle makeTriangle(std::span<const glm::dvec3> points, std::uint32_t a, std::uint32_t b, std::uint32_t c)
{
    Triangle triangle{{a, b, c}, glm::dvec3(0.0), 0.0};
    const glm::dvec3 normal = glm::cross(points[b] - points[a], points[c] - points[a]);
    const double length = glm::length(normal);
    if (length > 0.0) {
        triangle.normal = normal / length;
    }
    triangle.d = -glm::dot(triangle.normal, points[a]);
    return triangle;
}

/// The point for which `measure` is largest, and that value.
template <class Measure>
std::pair<std::uint32_t, double> farthest(std::span<const glm::dvec3> points, Measure measure)
{
    std::pair<std::uint32_t, double> best{0, -1.0};
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        if (const double value = measure(points[i]); value > best.second) {
            best = {i, value};
        }
    }
    return best;
}

/// Four points that span space; none when all lie within `flat` of a plane.
bool firstTetrahedron(std::span<const glm::dvec3> points, double flat, std::vector<Triangle>& faces)
{
    const std::uint32_t a = 0;
    const auto [b, length] = farthest(points, [&](const glm::dvec3& p) { return glm::distance(p, points[a]); });
    if (length <= flat) {
        return false;
    }
    const glm::dvec3 axis = glm::normalize(points[b] - points[a]);
    const auto [c, width] =
        farthest(points, [&](const glm::dvec3& p) { return glm::length(glm::cross(axis, p - points[a])); });
    if (width <= flat) {
        return false;
    }
    Triangle base = makeTriangle(points, a, b, c);
    const auto [d, height] = farthest(points, [&](const glm::dvec3& p) { return std::abs(base.above(p)); });
    if (height <= flat) {
        return false;
    }
    std::array<std::uint32_t, 4> corner{a, b, c, d};
    if (base.above(points[d]) > 0.0) {
        std::swap(corner[1], corner[2]);
    }
    faces.push_back(makeTriangle(points, corner[0], corner[1], corner[2]));
    faces.push_back(makeTriangle(points, corner[0], corner[3], corner[1]));
    faces.push_back(makeTriangle(points, corner[1], corner[3], corner[2]));
    faces.push_back(makeTriangle(points, corner[2], corner[3], corner[0]));
    return true;
}

void addPoint(std::span<const glm::dvec3> points, std::uint32_t point, double tolerance, std::vector<Triangle>& faces)
{
    std::vector<Edge> edges;
    std::size_t kept = 0;
    for (const Triangle& face : faces) {
        if (face.above(points[point]) <= tolerance) {
            faces[kept++] = face;
            continue;
        }
        for (std::size_t i = 0; i < 3; ++i) {
            edges.emplace_back(face.corners[i], face.corners[(i + 1) % 3]);
        }
    }
    faces.resize(kept);
    // The horizon: edges of seen faces whose other side is not seen.
    for (const Edge& edge : edges) {
        if (std::find(edges.begin(), edges.end(), Edge(edge.second, edge.first)) == edges.end()) {
            faces.push_back(makeTriangle(points, edge.first, edge.second, point));
        }
    }
}

} // namespace

ConvexBody ConvexBody::hull(std::span<const glm::dvec3> points)
{
    if (points.size() < 4) {
        return {};
    }
    // Sorted, so that the result depends on the set of points alone, and equal ones go.
    std::vector<glm::dvec3> unique(points.begin(), points.end());
    const auto key = [](const glm::dvec3& p) {
        return std::array{p.x, p.y, p.z};
    };
    std::sort(unique.begin(), unique.end(), [&](const glm::dvec3& a, const glm::dvec3& b) { return key(a) < key(b); });
    unique.erase(std::unique(unique.begin(), unique.end()), unique.end());
    glm::dvec3 low = unique[0];
    glm::dvec3 high = unique[0];
    for (const glm::dvec3& p : unique) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    const double extent = glm::length(high - low);
    std::vector<Triangle> faces;
    if (!std::isfinite(extent) || !firstTetrahedron(unique, 1e-9 * extent, faces)) {
        return {};
    }
    for (std::uint32_t i = 0; i < unique.size(); ++i) {
        addPoint(unique, i, 1e-11 * extent, faces);
    }

    ConvexBody body;
    for (const Triangle& face : faces) {
        for (const std::uint32_t corner : face.corners) {
            body.points_.push_back(unique[corner]);
        }
        body.face_sizes_.push_back(3);
    }
    return body;
}

} // namespace gnomon
