// SPDX-License-Identifier: Apache-2.0
// The nodes of a file that its scene shows.
#pragma once

#include "gltf/document.h"

namespace gnomon::scene::gltf {

/// The nodes of the whole file, before a scene is picked. None has two parents, and there is no loop.
struct Tree {
    std::vector<std::vector<std::uint32_t>> children;
    std::vector<std::uint32_t> parents;
};

[[nodiscard]] JsonView nodeView(const Document& document, std::size_t i);
[[nodiscard]] Tree readTree(const Document& document);

/// The parts of the scene to show.
struct ScenePart {
    std::string name;                 // empty: it has none
    std::vector<std::uint32_t> nodes; // parents first
    std::vector<bool> shown;          // by node: named, or below one that is; the others only move these
};

/// The nodes of scene `scene`, else of the first, else all. A node's place follows from the nodes above it, and a
/// skinned mesh's from its joints, so these come along wherever they are. `all`: the file's nodes with their skins.
[[nodiscard]] ScenePart pickScene(const Document& document, const Tree& tree, const std::vector<Node>& all);

} // namespace gnomon::scene::gltf
