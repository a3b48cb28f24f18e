// SPDX-License-Identifier: Apache-2.0
#include "mesh_maker.h"

#include "rng.h"

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace gnomon::worlds {

namespace {

float linearFromSrgb(std::uint32_t byte)
{
    const float v = static_cast<float>(byte & 0xFFU) / 255.0F;
    return v <= 0.04045F ? v / 12.92F : std::pow((v + 0.055F) / 1.055F, 2.4F);
}

/// Texture coordinates on the coordinate plane that `normal` is nearest to; v grows downwards, as images do.
glm::vec2 planarUv(const glm::vec3& p, const glm::vec3& normal)
{
    const glm::vec3 n = glm::abs(normal);
    if (n.y >= n.x && n.y >= n.z) {
        return {p.x, p.z};
    }
    return n.x >= n.z ? glm::vec2(normal.x > 0.0F ? -p.z : p.z, -p.y) : glm::vec2(normal.z > 0.0F ? p.x : -p.x, -p.y);
}

struct Ball {
    std::vector<glm::vec3> points;
    std::vector<std::array<std::uint32_t, 3>> faces;
};

Ball icosahedron()
{
    const float t = (1.0F + std::sqrt(5.0F)) / 2.0F;
    Ball ball;
    ball.points = {{-1, t, 0},  {1, t, 0},  {-1, -t, 0}, {1, -t, 0}, {0, -1, t},  {0, 1, t},
                   {0, -1, -t}, {0, 1, -t}, {t, 0, -1},  {t, 0, 1},  {-t, 0, -1}, {-t, 0, 1}};
    for (glm::vec3& p : ball.points) {
        p = glm::normalize(p);
    }
    ball.faces = {{{0, 11, 5}},  {{0, 5, 1}},  {{0, 1, 7}},  {{0, 7, 10}}, {{0, 10, 11}}, {{1, 5, 9}}, {{5, 11, 4}},
                  {{11, 10, 2}}, {{10, 7, 6}}, {{7, 1, 8}},  {{3, 9, 4}},  {{3, 4, 2}},   {{3, 2, 6}}, {{3, 6, 8}},
                  {{3, 8, 9}},   {{4, 9, 5}},  {{2, 4, 11}}, {{6, 2, 10}}, {{8, 6, 7}},   {{9, 8, 1}}};
    return ball;
}

std::uint32_t midpoint(Ball& ball, std::vector<std::pair<std::uint64_t, std::uint32_t>>& known, std::uint32_t a,
                       std::uint32_t b)
{
    const std::uint64_t key = (static_cast<std::uint64_t>(std::min(a, b)) << 32U) | std::max(a, b);
    for (const auto& [edge, index] : known) {
        if (edge == key) {
            return index;
        }
    }
    ball.points.push_back(glm::normalize(ball.points[a] + ball.points[b]));
    known.emplace_back(key, static_cast<std::uint32_t>(ball.points.size() - 1));
    return known.back().second;
}

Ball makeBall(int subdivisions)
{
    Ball ball = icosahedron();
    for (int i = 0; i < subdivisions; ++i) {
        std::vector<std::pair<std::uint64_t, std::uint32_t>> known;
        std::vector<std::array<std::uint32_t, 3>> faces;
        for (const std::array<std::uint32_t, 3>& f : ball.faces) {
            const std::uint32_t ab = midpoint(ball, known, f[0], f[1]);
            const std::uint32_t bc = midpoint(ball, known, f[1], f[2]);
            const std::uint32_t ca = midpoint(ball, known, f[2], f[0]);
            faces.insert(faces.end(), {{{f[0], ab, ca}}, {{f[1], bc, ab}}, {{f[2], ca, bc}}, {{ab, bc, ca}}});
        }
        ball.faces = std::move(faces);
    }
    return ball;
}

} // namespace

glm::vec4 rgb(std::uint32_t srgb)
{
    return {linearFromSrgb(srgb >> 16U), linearFromSrgb(srgb >> 8U), linearFromSrgb(srgb), 1.0F};
}

glm::mat4 at(const glm::vec3& position)
{
    return glm::translate(glm::mat4(1.0F), position);
}
glm::mat4 turnedX(float radians)
{
    return glm::rotate(glm::mat4(1.0F), radians, {1.0F, 0.0F, 0.0F});
}
glm::mat4 turnedY(float radians)
{
    return glm::rotate(glm::mat4(1.0F), radians, {0.0F, 1.0F, 0.0F});
}
glm::mat4 turnedZ(float radians)
{
    return glm::rotate(glm::mat4(1.0F), radians, {0.0F, 0.0F, 1.0F});
}
glm::mat4 scaled(const glm::vec3& factors)
{
    return glm::scale(glm::mat4(1.0F), factors);
}

std::uint32_t Part::vertex(const glm::vec3& position, const glm::vec3& normal, const glm::vec2& uv)
{
    primitive_.positions.push_back(position);
    primitive_.normals.push_back(normal);
    primitive_.uv0.push_back(uv);
    primitive_.colours.push_back(colour);
    return static_cast<std::uint32_t>(primitive_.positions.size() - 1);
}

void Part::triangle(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c)
{
    const std::array<glm::vec3, 3> p{glm::vec3(frame * glm::vec4(a, 1.0F)), glm::vec3(frame * glm::vec4(b, 1.0F)),
                                     glm::vec3(frame * glm::vec4(c, 1.0F))};
    const glm::vec3 cross = glm::cross(p[1] - p[0], p[2] - p[0]);
    const float area2 = glm::length(cross);
    if (area2 < 1e-9F) {
        return;
    }
    for (const glm::vec3& v : p) {
        const glm::vec3 n = cross / area2;
        primitive_.indices.push_back(vertex(v, n, planarUv(v, n) * uv_per_metre));
    }
}

void Part::quad(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec3& d)
{
    const std::array<glm::vec3, 4> p{glm::vec3(frame * glm::vec4(a, 1.0F)), glm::vec3(frame * glm::vec4(b, 1.0F)),
                                     glm::vec3(frame * glm::vec4(c, 1.0F)), glm::vec3(frame * glm::vec4(d, 1.0F))};
    const glm::vec3 cross = glm::cross(p[2] - p[0], p[3] - p[1]);
    const float area2 = glm::length(cross);
    if (area2 < 1e-9F) {
        return;
    }
    const glm::vec3 n = cross / area2;
    std::uint32_t first = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        const std::uint32_t index = vertex(p[i], n, planarUv(p[i], n) * uv_per_metre);
        first = i == 0 ? index : first;
    }
    for (const std::uint32_t corner : {0U, 1U, 2U, 0U, 2U, 3U}) {
        primitive_.indices.push_back(first + corner);
    }
}

void Part::card(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec3& d, const glm::vec3& normal)
{
    const glm::vec3 n = glm::normalize(glm::mat3(frame) * normal);
    const std::array<glm::vec3, 4> p{a, b, c, d};
    const std::array<glm::vec2, 4> uv{glm::vec2(0, 1), glm::vec2(1, 1), glm::vec2(1, 0), glm::vec2(0, 0)};
    const auto first = static_cast<std::uint32_t>(primitive_.positions.size());
    for (std::size_t i = 0; i < 4; ++i) {
        vertex(glm::vec3(frame * glm::vec4(p[i], 1.0F)), n, uv[i]);
    }
    for (const std::uint32_t corner : {0U, 1U, 2U, 0U, 2U, 3U}) {
        primitive_.indices.push_back(first + corner);
    }
}

void Part::box(const glm::vec3& min, const glm::vec3& max, float taper, bool bottom)
{
    const glm::vec3 centre = (min + max) * 0.5F;
    const glm::vec3 half = (max - min) * 0.5F;
    const float tx = half.x * taper;
    const float tz = half.z * taper;
    const std::array<glm::vec3, 8> v{glm::vec3(min.x, min.y, min.z),
                                     {max.x, min.y, min.z},
                                     {max.x, min.y, max.z},
                                     {min.x, min.y, max.z},
                                     {centre.x - tx, max.y, centre.z - tz},
                                     {centre.x + tx, max.y, centre.z - tz},
                                     {centre.x + tx, max.y, centre.z + tz},
                                     {centre.x - tx, max.y, centre.z + tz}};
    quad(v[3], v[2], v[6], v[7]);
    quad(v[1], v[0], v[4], v[5]);
    quad(v[2], v[1], v[5], v[6]);
    quad(v[0], v[3], v[7], v[4]);
    quad(v[7], v[6], v[5], v[4]);
    if (bottom) {
        quad(v[0], v[1], v[2], v[3]);
    }
}

void Part::gable(float width, float height, float length)
{
    const float w = width * 0.5F;
    const float l = length * 0.5F;
    const float t = 0.18F; // a slab, so that eaves are seen from below
    quad({w, 0, l}, {w, 0, -l}, {0, height, -l}, {0, height, l});
    quad({-w, 0, -l}, {-w, 0, l}, {0, height, l}, {0, height, -l});
    quad({w, -t, -l}, {w, -t, l}, {0, height - t, l}, {0, height - t, -l});
    quad({-w, -t, l}, {-w, -t, -l}, {0, height - t, -l}, {0, height - t, l});
    for (const float z : {l, -l}) {
        const float s = z > 0.0F ? 1.0F : -1.0F;
        quad({s * w, 0, z}, {0, height, z}, {0, height - t, z}, {s * w, -t, z});
        quad({0, height, z}, {-s * w, 0, z}, {-s * w, -t, z}, {0, height - t, z});
    }
    quad({w, -t, l}, {w, -t, -l}, {w, 0, -l}, {w, 0, l});
    quad({-w, -t, -l}, {-w, -t, l}, {-w, 0, l}, {-w, 0, -l});
}

void Part::latheSegment(std::span<const glm::vec2> profile, std::size_t row, int sides, bool smooth_profile,
                        bool faceted)
{
    const auto slope = [&](std::size_t segment) {
        const glm::vec2 d = profile[segment + 1] - profile[segment];
        const float length = glm::length(d);
        return length > 0.0F ? glm::vec2(d.y, -d.x) / length : glm::vec2(1.0F, 0.0F);
    };
    const auto normalAt = [&](std::size_t point) { // radial and vertical part
        if (!smooth_profile) {
            return slope(row);
        }
        const glm::vec2 before = slope(point == 0 ? 0 : point - 1);
        const glm::vec2 after = slope(point + 1 < profile.size() ? point : point - 1);
        return glm::normalize(before + after + glm::vec2(1e-6F, 0.0F));
    };
    const glm::mat3 turn(frame);
    const float around_m = kTau * std::max(profile[row].x, profile[row + 1].x) * uv_per_metre;
    const auto corner = [&](std::size_t point, int side, float normal_side) {
        const float a = kTau * static_cast<float>(side) / static_cast<float>(sides);
        const float na = kTau * normal_side / static_cast<float>(sides);
        const glm::vec2 n = normalAt(point);
        const glm::vec3 p(profile[point].x * std::sin(a), profile[point].y, profile[point].x * std::cos(a));
        const glm::vec2 uv(around_m * static_cast<float>(side) / static_cast<float>(sides),
                           -profile[point].y * uv_per_metre);
        return vertex(glm::vec3(frame * glm::vec4(p, 1.0F)),
                      glm::normalize(turn * glm::vec3(n.x * std::sin(na), n.y, n.x * std::cos(na))), uv);
    };
    for (int side = 0; side < sides; ++side) {
        const auto s = static_cast<float>(side);
        const std::uint32_t a = corner(row, side, faceted ? s + 0.5F : s);
        const std::uint32_t b = corner(row, side + 1, faceted ? s + 0.5F : s + 1.0F);
        const std::uint32_t c = corner(row + 1, side + 1, faceted ? s + 0.5F : s + 1.0F);
        const std::uint32_t d = corner(row + 1, side, faceted ? s + 0.5F : s);
        if (profile[row].x > 0.0F) {
            primitive_.indices.insert(primitive_.indices.end(), {a, b, c});
        }
        if (profile[row + 1].x > 0.0F) {
            primitive_.indices.insert(primitive_.indices.end(), {a, c, d});
        }
    }
}

void Part::lathe(std::span<const glm::vec2> profile, int sides, bool smooth_profile, bool faceted)
{
    for (std::size_t row = 0; row + 1 < profile.size(); ++row) {
        latheSegment(profile, row, sides, smooth_profile, faceted);
    }
}

void Part::lathe(std::initializer_list<glm::vec2> profile, int sides, bool smooth_profile, bool faceted)
{
    lathe(std::span<const glm::vec2>(profile.begin(), profile.size()), sides, smooth_profile, faceted);
}

void Part::beam(const glm::vec3& a, const glm::vec3& b, float thickness, bool ends)
{
    const glm::vec3 along = b - a;
    const float length = glm::length(along);
    const glm::vec3 y = along / length;
    const glm::vec3 helper = std::abs(y.y) < 0.9F ? glm::vec3(0, 1, 0) : glm::vec3(0, 0, 1);
    const glm::vec3 x = glm::normalize(glm::cross(helper, y));
    const glm::vec3 z = glm::cross(x, y);
    const glm::mat4 before = frame;
    frame = frame * glm::mat4(glm::vec4(x, 0), glm::vec4(y, 0), glm::vec4(z, 0), glm::vec4(a, 1));
    const float h = thickness * 0.5F;
    if (ends) {
        box({-h, 0, -h}, {h, length, h}, 1.0F, true);
    } else {
        lathe({{h * 1.414F, 0.0F}, {h * 1.414F, length}}, 4, false, true);
    }
    frame = before;
}

void Part::tube(std::span<const glm::vec3> path, std::span<const float> radii, int sides, bool ring)
{
    const std::size_t n = path.size();
    const std::size_t rows = ring ? n + 1 : n;
    glm::vec3 right(0.0F);
    for (std::size_t row = 0; row < rows; ++row) {
        const std::size_t i = row % n;
        const glm::vec3& before = path[i == 0 ? (ring ? n - 1 : 0) : i - 1];
        const glm::vec3& after = path[i + 1 == n ? (ring ? 0 : i) : i + 1];
        const glm::vec3 along = glm::normalize(after - before);
        if (row == 0) {
            right =
                glm::normalize(glm::cross(std::abs(along.y) < 0.9F ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0), along));
        }
        right = glm::normalize(right - along * glm::dot(right, along)); // carried along, so that it does not twist
        const glm::vec3 up = glm::cross(along, right);
        for (int side = 0; side <= sides; ++side) {
            const float a = kTau * static_cast<float>(side) / static_cast<float>(sides);
            const glm::vec3 out = right * std::cos(a) + up * std::sin(a);
            vertex(glm::vec3(frame * glm::vec4(path[i] + out * radii[i], 1.0F)), glm::normalize(glm::mat3(frame) * out),
                   {static_cast<float>(row) * 0.25F, static_cast<float>(side) / static_cast<float>(sides)});
        }
    }
    const auto columns = static_cast<std::uint32_t>(sides + 1);
    const auto first = static_cast<std::uint32_t>(primitive_.positions.size() - rows * columns);
    for (std::uint32_t row = 0; row + 1 < rows; ++row) {
        for (std::uint32_t side = 0; side + 1 < columns; ++side) {
            const std::uint32_t a = first + row * columns + side;
            const std::uint32_t b = a + columns;
            primitive_.indices.insert(primitive_.indices.end(), {a, a + 1, b + 1, a, b + 1, b});
        }
    }
}

void Part::ball(float radius, int subdivisions, float roughness, std::uint32_t seed)
{
    Ball shape = makeBall(subdivisions);
    if (roughness > 0.0F) {
        for (std::size_t i = 0; i < shape.points.size(); ++i) {
            const float push = hashUnit(static_cast<std::int32_t>(i), 7, seed) * 2.0F - 1.0F;
            shape.points[i] *= radius * (1.0F + roughness * push);
        }
        for (const std::array<std::uint32_t, 3>& f : shape.faces) {
            triangle(shape.points[f[0]], shape.points[f[1]], shape.points[f[2]]);
        }
        return;
    }
    const auto first = static_cast<std::uint32_t>(primitive_.positions.size());
    const glm::mat3 turn(frame);
    for (const glm::vec3& p : shape.points) {
        const glm::vec2 uv(std::atan2(p.x, p.z) / kTau * 2.0F, -p.y * 0.5F);
        vertex(glm::vec3(frame * glm::vec4(p * radius, 1.0F)), glm::normalize(turn * p), uv);
    }
    for (const std::array<std::uint32_t, 3>& f : shape.faces) {
        primitive_.indices.insert(primitive_.indices.end(), {first + f[0], first + f[1], first + f[2]});
    }
}

Primitive Part::take(std::uint32_t material)
{
    primitive_.material = material;
    return std::move(primitive_);
}

Part& MeshMaker::with(std::uint32_t material)
{
    for (std::size_t i = 0; i < materials_.size(); ++i) {
        if (materials_[i] == material) {
            return parts_[i];
        }
    }
    materials_.push_back(material);
    parts_.emplace_back().frame = frame_;
    return parts_.back();
}

void MeshMaker::setFrame(const glm::mat4& frame)
{
    frame_ = frame;
    for (Part& part : parts_) {
        part.frame = frame;
    }
}

Mesh MeshMaker::take(const std::string& name)
{
    Mesh mesh;
    mesh.name = name;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
        if (parts_[i].triangles() > 0) {
            mesh.primitives.push_back(parts_[i].take(materials_[i]));
        }
    }
    return mesh;
}

void leafCard(Part& part, const glm::vec3& centre, const glm::vec3& facing, float half, float roll,
              const glm::vec3& normal)
{
    const glm::vec3 helper = std::abs(facing.y) < 0.9F ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
    const glm::vec3 right = glm::normalize(glm::cross(helper, facing));
    const glm::vec3 up = glm::cross(facing, right);
    const glm::vec3 u = (right * std::cos(roll) + up * std::sin(roll)) * half;
    const glm::vec3 v = (up * std::cos(roll) - right * std::sin(roll)) * half;
    part.card(centre - u - v, centre + u - v, centre + u + v, centre - u + v, normal);
}

} // namespace gnomon::worlds
