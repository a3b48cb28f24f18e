// SPDX-License-Identifier: Apache-2.0
#include "scene/adjacency.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <iterator>
#include <numeric>
#include <span>
#include <tuple>

namespace gnomon::scene {
namespace {

/// Equal for equal places, and with an order whatever the numbers are: 0 and -0 are one.
std::array<std::uint32_t, 3> placeOf(const glm::vec3& p)
{
    return {std::bit_cast<std::uint32_t>(p.x + 0.0F), std::bit_cast<std::uint32_t>(p.y + 0.0F),
            std::bit_cast<std::uint32_t>(p.z + 0.0F)};
}

/// For each vertex the first one in its place.
std::vector<std::uint32_t> weld(std::span<const glm::vec3> positions)
{
    std::vector<std::uint32_t> order(positions.size());
    std::iota(order.begin(), order.end(), 0U);
    std::ranges::sort(order, [&](std::uint32_t a, std::uint32_t b) {
        const auto at_a = placeOf(positions[a]);
        const auto at_b = placeOf(positions[b]);
        return at_a != at_b ? at_a < at_b : a < b;
    });
    std::vector<std::uint32_t> first(positions.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        const bool again = i > 0 && placeOf(positions[order[i]]) == placeOf(positions[order[i - 1]]);
        first[order[i]] = again ? first[order[i - 1]] : order[i];
    }
    return first;
}

/// A triangle's way along an edge, whose lesser vertex comes first.
struct HalfEdge {
    std::uint32_t lesser = 0;
    std::uint32_t greater = 0;
    bool backwards = false; // from the greater to the lesser
    std::uint32_t triangle = 0;

    [[nodiscard]] auto key() const { return std::tuple(lesser, greater, backwards, triangle); }
};

void addTriangles(std::span<const std::uint32_t> indices, std::span<const std::uint32_t> welded, Adjacency& out)
{
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        if (std::max({indices[i], indices[i + 1], indices[i + 2]}) >= welded.size()) {
            continue;
        }
        const std::array<std::uint32_t, 3> corners{welded[indices[i]], welded[indices[i + 1]], welded[indices[i + 2]]};
        if (corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0]) {
            out.triangles.push_back(corners);
            out.first_indices.push_back(indices[i]);
        }
    }
}

MeshEdge edgeOf(const HalfEdge& half, std::uint32_t right)
{
    return half.backwards ? MeshEdge{half.greater, half.lesser, half.triangle, right}
                          : MeshEdge{half.lesser, half.greater, half.triangle, right};
}

/// The ways along one edge, those forwards first: in pairs, then what is left.
void addEdges(std::span<const HalfEdge> ways, Adjacency& out)
{
    const auto forwards = static_cast<std::size_t>(std::ranges::count(ways, false, &HalfEdge::backwards));
    const std::size_t pairs = std::min(forwards, ways.size() - forwards);
    for (std::size_t i = 0; i < pairs; ++i) {
        out.edges.push_back(edgeOf(ways[i], ways[forwards + i].triangle));
    }
    for (std::size_t i = pairs; i < forwards; ++i) {
        out.edges.push_back(edgeOf(ways[i], kNone));
    }
    for (std::size_t i = forwards + pairs; i < ways.size(); ++i) {
        out.edges.push_back(edgeOf(ways[i], kNone));
    }
    out.open_edges += static_cast<std::uint32_t>(ways.size() - 2 * pairs);
}

void findEdges(Adjacency& out)
{
    std::vector<HalfEdge> ways;
    ways.reserve(3 * out.triangles.size());
    for (std::uint32_t t = 0; t < out.triangles.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t from = out.triangles[t][k];
            const std::uint32_t to = out.triangles[t][(k + 1) % 3];
            ways.push_back({std::min(from, to), std::max(from, to), from > to, t});
        }
    }
    std::ranges::sort(ways, {}, &HalfEdge::key);
    for (std::size_t begin = 0; begin < ways.size();) {
        std::size_t end = begin;
        while (end < ways.size() && ways[end].lesser == ways[begin].lesser &&
               ways[end].greater == ways[begin].greater) {
            ++end;
        }
        addEdges(std::span(ways).subspan(begin, end - begin), out);
        begin = end;
    }
}

} // namespace

Adjacency adjacencyOf(const Primitive& primitive)
{
    Adjacency found;
    addTriangles(primitive.indices, weld(primitive.positions), found);
    findEdges(found);
    return found;
}

MeshClosure closureOf(const Mesh& mesh)
{
    MeshClosure closure;
    for (const Primitive& primitive : mesh.primitives) {
        const Adjacency alone = adjacencyOf(primitive);
        closure.open_edges_of.push_back(alone.open_edges);
        closure.open_edges += alone.open_edges;
        closure.has_triangles = closure.has_triangles || !alone.triangles.empty();
    }
    if (closure.open_edges == 0 || mesh.primitives.size() < 2) {
        return closure;
    }
    // An open edge of one primitive may be closed by another.
    std::vector<glm::vec3> positions;
    for (const Primitive& primitive : mesh.primitives) {
        std::ranges::transform(primitive.positions, std::back_inserter(positions),
                               [&](const glm::vec3& p) { return p + primitive.origin; });
    }
    const std::vector<std::uint32_t> welded = weld(positions);
    Adjacency all;
    std::size_t first = 0;
    for (const Primitive& primitive : mesh.primitives) {
        addTriangles(primitive.indices, std::span(welded).subspan(first, primitive.positions.size()), all);
        first += primitive.positions.size();
    }
    findEdges(all);
    closure.open_edges = all.open_edges;
    return closure;
}

} // namespace gnomon::scene
