// SPDX-License-Identifier: Apache-2.0
// Compiled alone: it has shaders' headers in double precision.
// Shadow volumes against rays: the faces that a stencil buffer would count behind a point, made by the arithmetic of
// volume.vert, say of a point whether the mesh is between it and the light, wherever the eye is.
#define GNOMON_REAL double
#include "gnomon/shared/shadow_volume.h"
#include "scene/adjacency.h"

#include <glm/matrix.hpp>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <optional>
#include <random>
#include <span>
#include <vector>

namespace gnomon {
namespace {

using Triangle = std::array<glm::dvec3, 3>;
using Corners = std::array<glm::dvec4, 3>; // homogeneous

struct Placed {
    scene::Adjacency adjacency;
    std::vector<glm::dvec3> vertices; // as they are placed
    double mirrored = 1.0;

    [[nodiscard]] Triangle triangle(std::size_t i) const
    {
        const auto& corners = adjacency.triangles[i];
        return {vertices[corners[0]], vertices[corners[1]], vertices[corners[2]]};
    }
};

/// As volume.vert has them.
std::vector<Corners> volumeOf(const Placed& mesh, const glm::dvec4& place)
{
    std::vector<bool> casts;
    for (std::size_t i = 0; i < mesh.adjacency.triangles.size(); ++i) {
        const Triangle t = mesh.triangle(i);
        casts.push_back(shared::volumeCasts(t[0], t[1], t[2], place, mesh.mirrored));
    }
    std::vector<Corners> out;
    const auto add = [&](auto&& corner) {
        const auto at = [&](int number) {
            return corner(shared::volumeCorner(number, mesh.mirrored));
        };
        out.push_back({at(0), at(1), at(2)});
        out.push_back({at(3), at(4), at(5)});
    };
    for (std::size_t i = 0; i < casts.size(); ++i) {
        const Triangle t = mesh.triangle(i);
        add([&](int k) { return shared::volumeCap(k, t[0], t[1], t[2], casts[i], place); });
    }
    for (const scene::MeshEdge& edge : mesh.adjacency.edges) {
        const bool right = edge.right != scene::kNone && casts[edge.right];
        add([&](int k) {
            return shared::volumeWall(k, mesh.vertices[edge.from], mesh.vertices[edge.to], casts[edge.left], right,
                                      place);
        });
    }
    return out;
}

constexpr double kUnsure = 1e-9;

/// The face's addition to the count of a point on the ray from the eye: it counts beyond the point, and at infinity.
/// Nothing where rounding could decide either way.
std::optional<int> countOf(const Corners& face, const glm::dvec3& p, const glm::dvec3& along)
{
    const glm::dmat4 at_p(face[0], face[1], face[2], glm::dvec4(p, 1.0));
    const double side = glm::determinant(at_p); // above 0: the face turns away from the point
    const bool at_infinity = face[0].w == 0.0 && face[1].w == 0.0 && face[2].w == 0.0;
    if (at_infinity) {
        const glm::dmat3 m{glm::dvec3(face[0]), glm::dvec3(face[1]), glm::dvec3(face[2])};
        if (std::abs(glm::determinant(m)) < 1e-14) {
            return 0; // under parallel light all are one point
        }
        const glm::dvec3 share = glm::inverse(m) * along;
        const double least = std::min({share.x, share.y, share.z});
        if (std::abs(least) < kUnsure) {
            return std::nullopt;
        }
        return least < 0.0 ? 0 : side > 0.0 ? 1 : -1;
    }
    const glm::dmat4 m(face[0], face[1], face[2], glm::dvec4(-along, 0.0));
    if (std::abs(glm::determinant(m)) < 1e-14) {
        return 0; // no area
    }
    const glm::dvec4 share = glm::inverse(m) * glm::dvec4(p, 1.0);
    const double least = std::min({share.x, share.y, share.z, share.w});
    if (std::abs(least) < kUnsure) {
        return std::nullopt;
    }
    return least < 0.0 ? 0 : side > 0.0 ? 1 : -1;
}

/// The stencil's count at p, seen from the eye.
std::optional<int> stencilAt(std::span<const Corners> volume, const glm::dvec3& eye, const glm::dvec3& p)
{
    int count = 0;
    for (const Corners& face : volume) {
        const auto one = countOf(face, p, glm::normalize(p - eye));
        if (!one) {
            return std::nullopt;
        }
        count += *one;
    }
    return count;
}

/// Along the ray from p: 1 for a triangle that it enters the mesh by, -1 for one that it leaves it by, 0 for one that
/// it passes. `most`: how far, in lengths of `along`.
std::optional<int> crossing(const Placed& mesh, std::size_t i, const glm::dvec3& p, const glm::dvec3& along,
                            double most)
{
    const Triangle t = mesh.triangle(i);
    const glm::dvec3 n = glm::cross(t[1] - t[0], t[2] - t[0]) * mesh.mirrored;
    const glm::dmat3 m(t[1] - t[0], t[2] - t[0], -along);
    if (std::abs(glm::determinant(m)) < 1e-14) {
        return 0;
    }
    const glm::dvec3 at = glm::inverse(m) * (p - t[0]);
    const double least = std::min({at.x, at.y, 1.0 - at.x - at.y, at.z, most - at.z});
    if (std::abs(least) < kUnsure) {
        return std::nullopt;
    }
    return least < 0.0 ? 0 : glm::dot(n, along) < 0.0 ? 1 : -1;
}

struct Rays {
    bool inside = false; // of the mesh, so that nobody sees the point
    int left = 0;        // how often the way from the light to the point leaves the mesh
    int met = 0;         // how many triangles are on it
};
std::optional<Rays> castRays(const Placed& mesh, const glm::dvec3& p, const glm::dvec4& place)
{
    const glm::dvec3 toward = glm::dvec3(place) - p * place.w;
    Rays rays;
    int winding = 0;
    for (std::size_t i = 0; i < mesh.adjacency.triangles.size(); ++i) {
        const auto along = crossing(mesh, i, p, toward, place.w == 0.0 ? 1e9 : 1.0);
        const auto aside = crossing(mesh, i, p, glm::dvec3(0.31, 0.83, -0.46), 1e9);
        if (!along || !aside) {
            return std::nullopt;
        }
        rays.left += *along == 1 ? 1 : 0; // enters it on the way back to the light
        rays.met += *along != 0 ? 1 : 0;
        winding += *aside;
    }
    rays.inside = winding != 0;
    return rays;
}

class Random {
public:
    explicit Random(unsigned seed) : engine_(seed) {}
    double in(double low, double high) { return low + (high - low) * (static_cast<double>(engine_()) / 4294967296.0); }
    glm::dvec3 vector(double size) { return {in(-size, size), in(-size, size), in(-size, size)}; }
    bool chance(double share) { return in(0.0, 1.0) < share; }

private:
    std::mt19937 engine_;
};

/// A sphere of eight triangles or thirty-two, its corners drawn in and out at random: closed and not convex. Triangles
/// share vertices or not.
scene::Primitive randomBody(Random& random)
{
    std::vector<std::array<glm::vec3, 3>> faces;
    for (int octant = 0; octant < 8; ++octant) {
        const glm::vec3 s((octant & 1) != 0 ? 1.0F : -1.0F, (octant & 2) != 0 ? 1.0F : -1.0F,
                          (octant & 4) != 0 ? 1.0F : -1.0F);
        const bool odd = s.x * s.y * s.z < 0.0F;
        const glm::vec3 x(s.x, 0, 0);
        const glm::vec3 y(0, s.y, 0);
        const glm::vec3 z(0, 0, s.z);
        faces.push_back({x, odd ? z : y, odd ? y : z});
    }
    if (random.chance(0.7)) {
        std::vector<std::array<glm::vec3, 3>> finer;
        for (const auto& [a, b, c] : faces) {
            const glm::vec3 ab = glm::normalize(a + b);
            const glm::vec3 bc = glm::normalize(b + c);
            const glm::vec3 ca = glm::normalize(c + a);
            finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
        }
        faces = finer;
    }
    scene::Primitive body;
    for (const auto& face : faces) {
        for (const glm::vec3& corner : face) {
            body.indices.push_back(static_cast<std::uint32_t>(body.positions.size()));
            body.positions.push_back(corner);
        }
    }
    // The same length for all corners in one place.
    const glm::dvec3 wave = random.vector(9.0);
    for (glm::vec3& p : body.positions) {
        p *= static_cast<float>(0.65 + 0.35 * std::sin(glm::dot(wave, glm::dvec3(p)) + wave.x));
    }
    return body;
}

Placed place(const scene::Primitive& body, const glm::dmat3& m, const glm::dvec3& by)
{
    Placed placed{scene::adjacencyOf(body), {}, glm::determinant(m) < 0.0 ? -1.0 : 1.0};
    for (const glm::vec3& p : body.positions) {
        placed.vertices.push_back(m * glm::dvec3(p) + by);
    }
    return placed;
}

TEST(ShadowVolume, CountsWhatRaysHit)
{
    constexpr int kCases = 10000;
    Random random(7);
    int shadowed = 0;
    int shut_in = 0;
    int unsure = 0;
    for (int i = 0; i < kCases;) {
        const glm::dmat3 m(random.vector(1.0), random.vector(1.0), random.vector(1.0));
        if (std::abs(glm::determinant(m)) < 0.05) {
            continue;
        }
        ++i;
        const Placed mesh = place(randomBody(random), m, random.vector(0.5));
        ASSERT_EQ(mesh.adjacency.open_edges, 0U);
        const bool parallel = random.chance(0.4);
        const glm::dvec4 light = parallel ? glm::dvec4(glm::normalize(random.vector(1.0)), 0.0)
                                          : glm::dvec4(random.vector(random.chance(0.2) ? 0.3 : 3.0), 1.0);
        const std::vector<Corners> volume = volumeOf(mesh, light);
        const glm::dvec3 eye = random.vector(2.0); // in the mesh and in its volume, too
        for (int point = 0; point < 3; ++point) {
            const glm::dvec3 p = random.vector(3.0);
            const auto rays = castRays(mesh, p, light);
            const auto count = stencilAt(volume, eye, p);
            if (!rays || !count) {
                ++unsure;
                continue;
            }
            if (rays->inside) {
                continue;
            }
            ASSERT_EQ(*count, rays->left) << "mesh " << i;
            ASSERT_EQ(*count != 0, rays->met != 0) << "mesh " << i;
            shadowed += *count != 0 ? 1 : 0;
            shut_in += rays->met == 1 ? 1 : 0;
        }
    }
    EXPECT_GT(shadowed, 1500);
    EXPECT_GT(shut_in, 50) << "lamps inside of meshes";
    EXPECT_LT(unsure, 30);
}

/// A cube about the origin, of sides 2.
Placed cubeAt(const glm::dvec3& by)
{
    scene::Primitive cube;
    for (int corner = 0; corner < 8; ++corner) {
        cube.positions.emplace_back((corner & 1) != 0 ? 1 : -1, (corner & 2) != 0 ? 1 : -1, (corner & 4) != 0 ? 1 : -1);
    }
    cube.indices = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                    2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
    return place(cube, glm::dmat3(1.0), by);
}

TEST(ShadowVolume, OfACubeIsRightFromInsideAndOutside)
{
    const Placed cube = cubeAt({0.1, 5.0, 0.2});
    for (const glm::dvec4& light : {glm::dvec4(0.05, 1.0, 0.02, 0.0), glm::dvec4(0.3, 20.0, 0.4, 1.0)}) {
        const std::vector<Corners> volume = volumeOf(cube, light);
        const glm::dvec3 beneath(0.2, 0.0, 0.3);
        const glm::dvec3 beside(3.7, 0.0, 0.3);
        // Beside the volume, inside of it, before the cube, above it, and so near that a near plane would cut the
        // volume.
        for (const glm::dvec3& eye : {glm::dvec3(8.0, 3.0, 7.0), glm::dvec3(0.31, 2.0, 0.17), glm::dvec3(0.4, 5.1, 9.0),
                                      glm::dvec3(0.13, 30.0, 0.21), glm::dvec3(1.16, 1.0, 0.9)}) {
            EXPECT_EQ(stencilAt(volume, eye, beneath), 1);
            EXPECT_EQ(stencilAt(volume, eye, beside), 0);
        }
    }
}

TEST(ShadowVolume, OfAnOpenMeshIsWrong)
{
    Placed cube = cubeAt({0.1, 5.0, 0.2});
    cube.adjacency.triangles.resize(10); // without its side at x = 1
    scene::Primitive open;
    for (const glm::dvec3& p : cube.vertices) {
        open.positions.emplace_back(p);
    }
    for (const auto& corners : cube.adjacency.triangles) {
        open.indices.insert(open.indices.end(), corners.begin(), corners.end());
    }
    cube.adjacency = scene::adjacencyOf(open);
    EXPECT_EQ(cube.adjacency.open_edges, 4U);
    const glm::dvec4 light(glm::normalize(glm::dvec3(-1.0, 0.3, 0.0)), 0.0); // through the side that is gone
    const std::vector<Corners> volume = volumeOf(cube, light);
    const glm::dvec3 p = glm::dvec3(0.1, 5.2, 0.27) - glm::dvec3(light) * 5.0;
    ASSERT_NE(castRays(cube, p, light)->met, 0);
    EXPECT_EQ(stencilAt(volume, {3.0, 9.0, 7.0}, p), 0) << "rays hit its other side";
}

} // namespace
} // namespace gnomon
