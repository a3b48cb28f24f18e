// SPDX-License-Identifier: Apache-2.0
// EXT_mesh_gpu_instancing: many copies of a node's mesh.
#pragma once

#include "gltf/document.h"

namespace gnomon::scene::gltf {

/// node_from_instance of every copy; empty when the node does not use the extension.
[[nodiscard]] std::vector<glm::mat4> readInstances(Document& document, const JsonView& node);

} // namespace gnomon::scene::gltf
