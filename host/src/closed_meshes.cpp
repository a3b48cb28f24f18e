// SPDX-License-Identifier: Apache-2.0
#include "closed_meshes.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <tuple>
#include <utility>

namespace gnomon::host {
namespace {

auto placeOf(const glm::vec3& p)
{
    return std::tuple(p.x, p.y, p.z);
}

/// A number for each vertex of the mesh, primitive after primitive: the same for those in one place.
std::vector<std::uint32_t> weld(const std::vector<glm::vec3>& positions)
{
    std::vector<std::uint32_t> order(positions.size());
    std::iota(order.begin(), order.end(), 0U);
    std::ranges::sort(order, {}, [&](std::uint32_t i) { return placeOf(positions[i]); });
    std::vector<std::uint32_t> numbers(positions.size());
    std::uint32_t number = 0;
    for (std::size_t i = 0; i < order.size(); ++i) {
        if (i > 0 && positions[order[i]] != positions[order[i - 1]]) {
            ++number;
        }
        numbers[order[i]] = number;
    }
    return numbers;
}

/// An edge, its lesser vertex first, and which way a triangle runs along it.
using Edge = std::tuple<std::uint32_t, std::uint32_t, bool>;

void addEdges(const std::vector<std::uint32_t>& indices, std::span<const std::uint32_t> numbers,
              std::vector<Edge>& edges)
{
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        const std::array<std::uint32_t, 3> corners{numbers[indices[i]], numbers[indices[i + 1]],
                                                   numbers[indices[i + 2]]};
        if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) {
            continue; // it has no area
        }
        for (std::size_t k = 0; k < 3; ++k) {
            const auto [lesser, greater] = std::minmax(corners[k], corners[(k + 1) % 3]);
            edges.emplace_back(lesser, greater, corners[k] == lesser);
        }
    }
}

} // namespace

bool isClosed(const scene::Mesh& mesh)
{
    std::vector<glm::vec3> positions;
    for (const scene::Primitive& primitive : mesh.primitives) {
        positions.insert(positions.end(), primitive.positions.begin(), primitive.positions.end());
    }
    const std::vector<std::uint32_t> numbers = weld(positions);
    std::vector<Edge> edges;
    std::size_t first = 0;
    for (const scene::Primitive& primitive : mesh.primitives) {
        addEdges(primitive.indices, std::span(numbers).subspan(first, primitive.positions.size()), edges);
        first += primitive.positions.size();
    }
    std::ranges::sort(edges);
    for (std::size_t i = 0; i < edges.size();) {
        const auto [lesser, greater, ignored] = edges[i];
        std::ptrdiff_t balance = 0;
        for (; i < edges.size() && std::get<0>(edges[i]) == lesser && std::get<1>(edges[i]) == greater; ++i) {
            balance += std::get<2>(edges[i]) ? 1 : -1;
        }
        if (balance != 0) {
            return false;
        }
    }
    return !edges.empty();
}

std::vector<bool> closedMeshes(const scene::Scene& scene)
{
    std::vector<bool> closed;
    for (const scene::Mesh& mesh : scene.meshes) {
        closed.push_back(isClosed(mesh));
    }
    return closed;
}

} // namespace gnomon::host
