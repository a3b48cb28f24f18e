// SPDX-License-Identifier: Apache-2.0
// `extras` that say who casts and who receives: {"gnomon": {"casts": false}}.
#pragma once

#include "gltf/json_view.h"
#include "scene/casting.h"

namespace gnomon::scene::gltf {

/// Of a node. What is not as docs/scenes.md has it gets a notice and says nothing: a scene is not lost by it.
[[nodiscard]] Casting readCasting(const JsonView& node);
/// Of a light, which has `groups` alone.
[[nodiscard]] std::optional<std::uint32_t> readLightGroups(const JsonView& light);

} // namespace gnomon::scene::gltf
