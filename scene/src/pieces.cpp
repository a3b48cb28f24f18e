// SPDX-License-Identifier: Apache-2.0
#include "scene/pieces.h"

#include "scene/adjacency.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace gnomon::scene {
namespace {

/// Sets of vertices that grow together.
class Joined {
public:
    explicit Joined(std::size_t count) : parents_(count) { std::iota(parents_.begin(), parents_.end(), 0U); }

    [[nodiscard]] std::uint32_t rootOf(std::uint32_t i)
    {
        while (parents_[i] != i) {
            parents_[i] = parents_[parents_[i]];
            i = parents_[i];
        }
        return i;
    }
    void join(std::uint32_t a, std::uint32_t b)
    {
        const std::uint32_t root_a = rootOf(a);
        const std::uint32_t root_b = rootOf(b);
        parents_[std::max(root_a, root_b)] = std::min(root_a, root_b);
    }

private:
    std::vector<std::uint32_t> parents_;
};

glm::dvec3 acrossOf(const Primitive& primitive, const std::array<std::uint32_t, 3>& corners)
{
    const glm::dvec3 first(primitive.positions[corners[0]]);
    return glm::cross(glm::dvec3(primitive.positions[corners[1]]) - first,
                      glm::dvec3(primitive.positions[corners[2]]) - first);
}

bool meetFlat(const glm::dvec3& a, const glm::dvec3& b)
{
    return glm::dot(a, b) >= std::cos(kCreaseAngle_rad) * glm::length(a) * glm::length(b);
}

bool isWhole(const Primitive& primitive, std::size_t first)
{
    const std::uint32_t* const v = &primitive.indices[first];
    return std::max({v[0], v[1], v[2]}) < primitive.positions.size();
}

} // namespace

Pieces piecesOf(const Primitive& primitive)
{
    Joined joined(primitive.positions.size());
    for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
        if (isWhole(primitive, i)) {
            joined.join(primitive.indices[i], primitive.indices[i + 1]);
            joined.join(primitive.indices[i], primitive.indices[i + 2]);
        }
    }
    // Vertices in one place are one to it, so which of them is a triangle's own is looked up by the triangle.
    const Adjacency adjacency = adjacencyOf(primitive);
    for (const MeshEdge& edge : adjacency.edges) {
        if (edge.right != kNone && meetFlat(acrossOf(primitive, adjacency.triangles[edge.left]),
                                            acrossOf(primitive, adjacency.triangles[edge.right]))) {
            joined.join(adjacency.first_indices[edge.left], adjacency.first_indices[edge.right]);
        }
    }
    Pieces pieces;
    pieces.of_vertex.assign(primitive.positions.size(), 0);
    std::vector<std::uint32_t> numbers(primitive.positions.size(), kNone); // by root
    std::uint32_t count = 0;
    for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
        if (!isWhole(primitive, i)) {
            continue;
        }
        const std::uint32_t root = joined.rootOf(primitive.indices[i]);
        if (numbers[root] == kNone) {
            numbers[root] = count++;
        }
        for (std::size_t k = 0; k < 3; ++k) {
            pieces.of_vertex[primitive.indices[i + k]] = static_cast<std::uint16_t>(numbers[root] % kMostPieces);
        }
    }
    pieces.count = std::clamp(count, 1U, kMostPieces);
    return pieces;
}

} // namespace gnomon::scene
