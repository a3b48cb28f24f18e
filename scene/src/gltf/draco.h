// SPDX-License-Identifier: Apache-2.0
// Primitives that KHR_draco_mesh_compression has compressed.
#pragma once

#include "gltf/document.h"

namespace gnomon::scene::gltf {

/// Whether the primitive's indices and some of its attributes are compressed.
[[nodiscard]] bool isDraco(const JsonView& primitive);
/// Unpacks them: the accessors that the primitive names have their data then, until another primitive that names them
/// is unpacked. Returns the indices of a triangle list, each below the number of vertices.
[[nodiscard]] std::vector<std::uint32_t> unpackDraco(Document& document, const JsonView& primitive);

} // namespace gnomon::scene::gltf
