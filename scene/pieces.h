// SPDX-License-Identifier: Apache-2.0
// The faces of a mesh that ids may tell apart (IdOptions::of): pieces of connected triangles without a crease.
#pragma once

#include "scene/model.h"

#include <cstdint>
#include <vector>

namespace gnomon::scene {

inline constexpr std::uint32_t kMostPieces = 4096; // as gnomon/object_set.h has it

struct Pieces {
    /// The piece of each vertex, from 0 on in the order of the primitive's triangles, and from 0 again after
    /// kMostPieces. Triangles that share a vertex are of one piece, so a triangle's vertices have the same.
    std::vector<std::uint16_t> of_vertex;
    std::uint32_t count = 1; // 1 .. kMostPieces
};

/// Triangles are of one piece where they share a vertex, or an edge (adjacencyOf()) at which their planes meet by no
/// more than kCreaseAngle_rad. So a surface that is shaded as one is one piece, and so is one that bends little. Pieces
/// are of the rest pose, so a mesh keeps them however it deforms. O(n log n), for any indices and positions.
[[nodiscard]] Pieces piecesOf(const Primitive& primitive);

} // namespace gnomon::scene
