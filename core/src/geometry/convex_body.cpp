// SPDX-License-Identifier: Apache-2.0
// Clipping of convex bodies by planes.
// Based on: I. Sutherland, G. Hodgman, "Reentrant polygon clipping", 1974, face by face, and a new face over the cut.
#include <gnomon/geometry.h>

#include <glm/common.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>

namespace gnomon {
namespace {

// Corners of a box (bit 0 x, bit 1 y, bit 2 z) in outward counter-clockwise order: -x, +x, -y, +y, -z, +z.
constexpr int kBoxFaces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};

/// Newell's normal: its length is twice the polygon's area.
glm::dvec3 newellNormal(std::span<const glm::dvec3> polygon)
{
    glm::dvec3 normal(0.0);
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
        normal += glm::cross(polygon[i] - polygon[0], polygon[i + 1] - polygon[0]);
    }
    return normal;
}

double largestCoordinate(std::span<const glm::dvec3> points)
{
    double largest = 0.0;
    for (const glm::dvec3& p : points) {
        largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    }
    return largest;
}

} // namespace

void ConvexBody::reset(const Aabb& box)
{
    points_.clear();
    face_sizes_.clear();
    if (box.empty()) {
        return;
    }
    for (const auto& face : kBoxFaces) {
        for (const int corner : face) {
            points_.emplace_back(box.corner(corner));
        }
        face_sizes_.push_back(4);
    }
}

ConvexBody ConvexBody::fromAabb(const Aabb& box)
{
    ConvexBody body;
    body.reset(box);
    return body;
}

ConvexBody ConvexBody::fromClip(const glm::dmat4& clip_from_world)
{
    const double determinant = glm::determinant(clip_from_world);
    if (!std::isfinite(determinant) || determinant == 0.0) {
        return {};
    }
    const glm::dmat4 world_from_clip = glm::inverse(clip_from_world);
    std::array<glm::dvec3, 8> corners;
    int positive = 0;
    for (int i = 0; i < 8; ++i) {
        const glm::dvec4 h = world_from_clip * glm::dvec4((i & 1) != 0 ? 1.0 : -1.0, (i & 2) != 0 ? 1.0 : -1.0,
                                                          (i & 4) != 0 ? 1.0 : 0.0, 1.0);
        // A corner at infinity comes out with w = 0, or with what rounding left of it.
        if (!(std::abs(h.w) > 1e-13 * glm::length(glm::dvec3(h)))) {
            return {};
        }
        positive += h.w > 0.0 ? 1 : 0;
        corners[static_cast<std::size_t>(i)] = glm::dvec3(h) / h.w;
        if (!std::isfinite(glm::dot(corners[static_cast<std::size_t>(i)], glm::dvec3(1.0)))) {
            return {};
        }
    }
    if (positive != 0 && positive != 8) {
        return {};
    }
    ConvexBody body;
    for (const auto& face : kBoxFaces) {
        for (const int corner : face) {
            body.points_.push_back(corners[static_cast<std::size_t>(corner)]);
        }
        body.face_sizes_.push_back(4);
    }
    // Projections mirror (y down, z reversed, or both); the winding follows.
    if (body.volume() < 0.0) {
        for (std::size_t face = 0; face < 6; ++face) {
            std::reverse(body.points_.begin() + static_cast<std::ptrdiff_t>(4 * face),
                         body.points_.begin() + static_cast<std::ptrdiff_t>(4 * face + 4));
        }
    }
    return body;
}

ConvexBody& ConvexBody::clip(const Plane& plane)
{
    if (empty()) {
        return *this;
    }
    const double tolerance_m = 1e-12 * std::max(largestCoordinate(points_), std::abs(plane.d));
    distances_.clear();
    bool any_inside = false;
    bool any_outside = false;
    for (const glm::dvec3& p : points_) {
        double distance = plane.distance(p);
        if (std::abs(distance) <= tolerance_m) {
            distance = 0.0;
        }
        any_inside |= distance > 0.0;
        any_outside |= distance < 0.0;
        distances_.push_back(distance);
    }
    if (!any_outside) {
        return *this;
    }
    next_points_.clear();
    next_sizes_.clear();
    cut_.clear();
    if (any_inside) {
        clipFaces();
        closeCut(plane, tolerance_m);
    }
    points_.swap(next_points_);
    face_sizes_.swap(next_sizes_);
    return *this;
}

ConvexBody& ConvexBody::clip(std::span<const Plane> planes)
{
    for (const Plane& plane : planes) {
        clip(plane);
    }
    return *this;
}

void ConvexBody::clipFaces()
{
    std::size_t first = 0;
    for (const std::uint32_t size : face_sizes_) {
        const std::size_t start = next_points_.size();
        bool off_plane = false;
        for (std::size_t i = 0; i < size; ++i) {
            const std::size_t a = first + i;
            const std::size_t b = first + (i + 1) % size;
            const double da = distances_[a];
            const double db = distances_[b];
            if (da >= 0.0) {
                next_points_.push_back(points_[a]);
                off_plane |= da > 0.0;
                if (da == 0.0) {
                    cut_.emplace_back(points_[a], 0.0);
                }
            }
            if ((da > 0.0 && db < 0.0) || (da < 0.0 && db > 0.0)) {
                // Always from the inner end, so that both faces of an edge get the same bits.
                const std::size_t in = da > 0.0 ? a : b;
                const std::size_t out = da > 0.0 ? b : a;
                const double t = distances_[in] / (distances_[in] - distances_[out]);
                const glm::dvec3 p = points_[in] + (points_[out] - points_[in]) * t;
                next_points_.push_back(p);
                cut_.emplace_back(p, 0.0);
            }
        }
        first += size;
        const std::size_t kept = next_points_.size() - start;
        if (kept >= 3 && off_plane) {
            next_sizes_.push_back(static_cast<std::uint32_t>(kept));
        } else {
            next_points_.resize(start);
        }
    }
}

void ConvexBody::closeCut(const Plane& plane, double tolerance_m)
{
    // Every corner of the cut was met once per face it is on.
    std::size_t count = 0;
    glm::dvec3 centre(0.0);
    for (const glm::dvec4& candidate : cut_) {
        bool known = false;
        for (std::size_t i = 0; i < count && !known; ++i) {
            const glm::dvec3 apart = glm::abs(glm::dvec3(cut_[i]) - glm::dvec3(candidate));
            known = std::max({apart.x, apart.y, apart.z}) <= tolerance_m;
        }
        if (!known) {
            cut_[count++] = candidate;
            centre += glm::dvec3(candidate);
        }
    }
    cut_.resize(count);
    if (count < 3) {
        return;
    }
    centre /= static_cast<double>(count);
    // cross(u, v) = -normal: angles grow counter-clockwise for one who looks at the cut from outside.
    const glm::dvec3 n = plane.normal;
    const glm::dvec3 helper = std::abs(n.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 u = glm::normalize(glm::cross(n, helper));
    const glm::dvec3 v = glm::cross(u, n);
    for (glm::dvec4& p : cut_) {
        p.w = std::atan2(glm::dot(glm::dvec3(p) - centre, v), glm::dot(glm::dvec3(p) - centre, u));
    }
    std::sort(cut_.begin(), cut_.end(), [](const glm::dvec4& a, const glm::dvec4& b) { return a.w < b.w; });
    for (const glm::dvec4& p : cut_) {
        next_points_.emplace_back(p);
    }
    next_sizes_.push_back(static_cast<std::uint32_t>(count));
}

ConvexBody ConvexBody::swept(const glm::dvec3& offset) const
{
    std::vector<glm::dvec3> points(points_);
    for (const glm::dvec3& p : points_) {
        points.push_back(p + offset);
    }
    return hull(points);
}

void ConvexBody::planes(std::vector<Plane>& out) const
{
    out.clear();
    const double size = largestCoordinate(points_);
    std::size_t first = 0;
    for (const std::uint32_t count : face_sizes_) {
        const std::span face(points_.data() + first, count);
        first += count;
        const glm::dvec3 outward = newellNormal(face);
        const double length = glm::length(outward);
        // The direction of a sliver is rounding; leaving it out only makes the region larger.
        if (!(length > 1e-18 * size * size)) {
            continue;
        }
        const glm::dvec3 normal = -outward / length;
        // The supporting plane, so that every corner is inside whatever rounding did to the normal.
        double d = -glm::dot(normal, face[0]);
        for (const glm::dvec3& p : points_) {
            d = std::max(d, -glm::dot(normal, p));
        }
        const bool known = std::any_of(out.begin(), out.end(), [&](const Plane& plane) {
            return glm::dot(plane.normal, normal) > 1.0 - 1e-14 && std::abs(plane.d - d) <= 1e-12 * size;
        });
        if (!known) {
            out.push_back({normal, d});
        }
    }
}

std::vector<Plane> ConvexBody::planes() const
{
    std::vector<Plane> out;
    planes(out);
    return out;
}

bool ConvexBody::contains(const glm::dvec3& p, double tolerance_m) const
{
    if (empty()) {
        return false;
    }
    const std::vector<Plane> sides = planes();
    return std::all_of(sides.begin(), sides.end(),
                       [&](const Plane& plane) { return plane.distance(p) >= -tolerance_m; });
}

double ConvexBody::volume() const
{
    if (empty()) {
        return 0.0;
    }
    // Signed tetrahedra over one corner: exact for convex bodies, and small bodies far from the origin keep their
    // digits.
    const glm::dvec3 apex = points_[0];
    double six_volumes = 0.0;
    std::size_t first = 0;
    for (const std::uint32_t count : face_sizes_) {
        const std::span face(points_.data() + first, count);
        first += count;
        six_volumes += glm::dot(newellNormal(face), face[0] - apex);
    }
    return six_volumes / 6.0;
}

} // namespace gnomon
