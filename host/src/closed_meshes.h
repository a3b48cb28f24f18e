// SPDX-License-Identifier: Apache-2.0
// Which meshes have an inside, so that leaving out the triangles that face a light leaves no hole in their shadow, and
// that their shadow volumes can be counted.
#pragma once

#include "scene/adjacency.h"
#include "scene/model.h"
#include "scene/state.h"

#include <cstdint>
#include <string>
#include <vector>

namespace gnomon::host {

/// Are all edges of the mesh, over all its primitives, shared by as many triangles one way as the other? Vertices in
/// one place count as one, whatever their normals and texture coordinates. False without triangles.
[[nodiscard]] bool isClosed(const scene::Mesh& mesh);
/// isClosed() of each mesh of the scene.
[[nodiscard]] std::vector<bool> closedMeshes(const scene::Scene& scene);
[[nodiscard]] std::vector<scene::MeshClosure> closures(const scene::Scene& scene);
/// As closedObjects() in host/view.h.
[[nodiscard]] std::vector<std::uint8_t> closedObjects(const scene::Scene& scene, const scene::State& state,
                                                      const std::vector<scene::MeshClosure>& closures);
/// By object, 1 where its shadow has its mesh's outline: it is opaque and nothing cuts it.
[[nodiscard]] std::vector<std::uint8_t> outlinedObjects(const scene::Scene& scene, const scene::State& state);

} // namespace gnomon::host
