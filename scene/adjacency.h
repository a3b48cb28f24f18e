// SPDX-License-Identifier: Apache-2.0
// The triangles that meet along each edge of a mesh, its open edges, and so whether the mesh has an inside.
#pragma once

#include "scene/model.h"

#include <array>
#include <cstdint>
#include <vector>

namespace gnomon::scene {

/// An edge, from vertex to vertex as the triangle on its left runs along it. Vertices in one place count as one, the
/// first of them, whatever their normals and texture coordinates.
struct MeshEdge {
    std::uint32_t from = 0;
    std::uint32_t to = 0;
    std::uint32_t left = 0;      // index into Adjacency::triangles
    std::uint32_t right = kNone; // the triangle that runs along it the other way; kNone: there is none
};

struct Adjacency {
    std::vector<std::array<std::uint32_t, 3>> triangles; // in the primitive's order, without those of no area
    std::vector<std::uint32_t> first_indices; // by triangle: its first vertex, as the primitive's indices name it
    /// Each triangle is at three of them. Where more than two triangles share an edge, they are taken in pairs, each of
    /// one that runs one way and one that runs the other.
    std::vector<MeshEdge> edges;
    std::uint32_t open_edges = 0; // that have no triangle on their right
};

/// In O(n log n), of any indices and positions: triangles with indices beyond the vertices are left out. Positions that
/// are not numbers are in one place where their bits are the same.
[[nodiscard]] Adjacency adjacencyOf(const Primitive& primitive);

/// How far a mesh is from closed, in edges that no other triangle shares.
struct MeshClosure {
    std::uint32_t open_edges = 0; // over all its primitives together
    bool has_triangles = false;
    std::vector<std::uint32_t> open_edges_of; // each primitive alone

    [[nodiscard]] bool closed() const { return has_triangles && open_edges == 0; }
};
[[nodiscard]] MeshClosure closureOf(const Mesh& mesh);

} // namespace gnomon::scene
