// SPDX-License-Identifier: Apache-2.0
// Vertex attributes of one primitive or morph target.
#pragma once

#include "gltf/document.h"

namespace gnomon::scene::gltf {

/// Fails unless `name` is a semantic of glTF 2.0 or starts with an underscore.
void checkSemantic(const JsonView& attribute, std::string_view name);

/// Reads all attributes of a primitive into `out`; false when there are no positions.
[[nodiscard]] bool readAttributes(Document& document, const JsonView& attributes, Primitive& out);
[[nodiscard]] MorphTarget readMorphTarget(Document& document, const JsonView& target, const JsonView& attributes,
                                          std::size_t vertex_count);

/// Marks the accessor's buffer view; a notice when it is for the other kind, too.
void claimView(Document& document, const Accessor& accessor, ViewUse use);

} // namespace gnomon::scene::gltf
