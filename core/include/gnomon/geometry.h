// SPDX-License-Identifier: Apache-2.0
// Bounds, planes, frustums and convex bodies. World units are metres; angles are radians.
// A suffix names a vector's space: _ws world, _ls light, _vs view. A matrix `b_from_a` takes a to b.
#pragma once

#include <gnomon/export.h>

#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace gnomon {

// A program that has glm align its types lays out the structs of these headers in another way than the library that it
// is linked with.
static_assert(sizeof(glm::vec3) == 12 && alignof(glm::vec3) == alignof(float) && alignof(glm::vec4) == alignof(float) &&
                  sizeof(glm::dvec3) == 24 && alignof(glm::dvec4) == alignof(double) &&
                  alignof(glm::dmat4) == alignof(double),
              "gnomon needs glm's types packed: leave out GLM_FORCE_DEFAULT_ALIGNED_GENTYPES");

/// Axis-aligned box. Default-constructed it is empty (min > max) and is the identity of `merge`.
struct Aabb {
    glm::vec3 min{std::numeric_limits<float>::infinity()};  // the corner of least x, y and z, metres
    glm::vec3 max{-std::numeric_limits<float>::infinity()}; // the corner of greatest x, y and z, metres

    /// It holds no point. A box with a NaN is empty too.
    [[nodiscard]] bool empty() const { return !(min.x <= max.x && min.y <= max.y && min.z <= max.z); }
    /// Its middle; meaningless for an empty box.
    [[nodiscard]] glm::vec3 centre() const { return (min + max) * 0.5F; }
    /// Full edge lengths; meaningless for an empty box.
    [[nodiscard]] glm::vec3 extent() const { return max - min; }
    /// Do both have a point in common? Boxes that touch do.
    [[nodiscard]] bool overlaps(const Aabb& other) const
    {
        return min.x <= other.max.x && max.x >= other.min.x && min.y <= other.max.y && max.y >= other.min.y &&
               min.z <= other.max.z && max.z >= other.min.z;
    }
    /// Is all of `other` inside, its rim included?
    [[nodiscard]] bool contains(const Aabb& other) const
    {
        return min.x <= other.min.x && max.x >= other.max.x && min.y <= other.min.y && max.y >= other.max.y &&
               min.z <= other.min.z && max.z >= other.max.z;
    }
    /// Corner i in 0..7: bit 0 picks x, bit 1 y, bit 2 z (0 = min, 1 = max).
    [[nodiscard]] glm::vec3 corner(int i) const
    {
        return {(i & 1) != 0 ? max.x : min.x, (i & 2) != 0 ? max.y : min.y, (i & 4) != 0 ? max.z : min.z};
    }
};

/// Smallest box around both; an empty argument changes nothing.
[[nodiscard]] GNOMON_API Aabb merge(const Aabb& a, const Aabb& b);
/// Smallest box around a box and a point.
[[nodiscard]] GNOMON_API Aabb merge(const Aabb& a, const glm::vec3& point);
/// Box around the eight transformed corners, tight for the transformed box (Arvo 1990, "Transforming
/// axis-aligned bounding boxes"); affine transforms only.
[[nodiscard]] GNOMON_API Aabb transform(const glm::mat4& b_from_a, const Aabb& box_a);

/// Half-space dot(normal, p) + d >= 0 is inside. `normal` is unit length, so the value is a distance in metres.
struct Plane {
    glm::dvec3 normal{0.0, 0.0, 1.0}; // unit length, inward
    double d = 0.0;                   // metres from the plane to the origin, along the normal

    /// Metres from the plane, positive inside.
    [[nodiscard]] double distance(const glm::dvec3& p) const { return glm::dot(normal, p) + d; }
};

/// Six inward planes, in the order left, right, bottom, top, near, far.
struct Frustum {
    std::array<Plane, 6> planes; // left, right, bottom, top, near, far
};

/// Planes of a clip volume -w <= x,y <= w, 0 <= z <= w (Gribb & Hartmann 2001, "Fast extraction of viewing
/// frustum planes"). Works for perspective and orthographic matrices; the plane z >= 0 is called near, z <= w far (a
/// reversed-z camera has them the other way round). A plane at infinity gets a zero normal and d = 1: all is inside it.
[[nodiscard]] GNOMON_API Frustum frustumFromClip(const glm::dmat4& clip_from_world);

/// The inward planes of a box along the axes, for ObjectSet::query(). low <= high, metres.
[[nodiscard]] GNOMON_API std::array<Plane, 6> planesAround(const glm::dvec3& low, const glm::dvec3& high);

/// Where a box is against a convex region.
enum class Containment : std::uint8_t { outside, intersects, inside };
/// Conservative: `intersects` may be said of a box just outside an edge, never `outside` of one that is not.
[[nodiscard]] GNOMON_API Containment classify(std::span<const Plane> planes, const Aabb& box);

/// A bounded convex polyhedron, as polygons with outward counter-clockwise winding. Empty when it has no face.
/// Used in double precision, because it is clipped many times and thin slivers decide a fit.
class GNOMON_API ConvexBody {
public:
    ConvexBody() = default;
    /// The body of a box; empty for an empty box.
    [[nodiscard]] static ConvexBody fromAabb(const Aabb& box);
    /// The eight corners of a clip volume taken to world space. A singular matrix, or a volume without end (a far plane
    /// at infinity), gives an empty body: clip a box by frustumFromClip() then.
    [[nodiscard]] static ConvexBody fromClip(const glm::dmat4& clip_from_world);
    /// Convex hull of `points` (at most a few hundred). Fewer than four points, or points all within 1e-9 of the
    /// extent of a plane, give an empty body.
    [[nodiscard]] static ConvexBody hull(std::span<const glm::dvec3> points);

    /// It has no face.
    [[nodiscard]] bool empty() const { return face_sizes_.empty(); }
    /// Becomes `box`, keeping its memory.
    void reset(const Aabb& box);
    /// Keeps the part inside `plane`; what is less than 1e-12 of the coordinates' size thick counts as nothing. A plane
    /// with a zero normal keeps all (d >= 0) or nothing. Returns *this, for chaining. Allocates nothing once warm.
    ConvexBody& clip(const Plane& plane);
    /// Keeps the part inside all of them.
    ConvexBody& clip(std::span<const Plane> planes);
    /// Sweeps the body by `offset`: the convex hull of it and its translate. With the reverse light direction this is
    /// the body from which casters can reach it.
    [[nodiscard]] ConvexBody swept(const glm::dvec3& offset) const;
    /// Inward planes of all faces that are not slivers, each once.
    [[nodiscard]] std::vector<Plane> planes() const;
    /// Writes these planes into `out`, which is cleared first.
    void planes(std::vector<Plane>& out) const;

    /// Vertices of all faces, face after face (a corner appears once per face it is on).
    [[nodiscard]] std::span<const glm::dvec3> points() const { return points_; }
    /// Number of vertices of each face.
    [[nodiscard]] std::span<const std::uint32_t> faceSizes() const { return face_sizes_; }
    /// Is a point inside, or at most `tolerance_m` outside of a face? False for an empty body.
    [[nodiscard]] bool contains(const glm::dvec3& p, double tolerance_m = 0.0) const;
    /// Cubic metres; 0 for an empty body.
    [[nodiscard]] double volume() const;

private:
    void clipFaces();
    void closeCut(const Plane& plane, double tolerance_m);

    std::vector<glm::dvec3> points_;
    std::vector<std::uint32_t> face_sizes_;
    // Scratch of clip(), kept so that repeated clipping allocates nothing.
    std::vector<double> distances_;
    std::vector<glm::dvec3> next_points_;
    std::vector<std::uint32_t> next_sizes_;
    std::vector<glm::dvec4> cut_;
};

} // namespace gnomon
