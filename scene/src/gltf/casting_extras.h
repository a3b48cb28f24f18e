// SPDX-License-Identifier: Apache-2.0
// `extras` that say who casts and who receives: {"gnomon": {"casts": false}}.
#pragma once

#include "gltf/json_view.h"
#include "scene/casting.h"

namespace gnomon::scene::gltf {

/// A node's extras. Members that are not as docs/scenes.md has them get a notice and say nothing: no scene is lost.
[[nodiscard]] Casting readCasting(const JsonView& node);
/// Of a light, which has `groups` alone.
[[nodiscard]] std::optional<std::uint32_t> readLightGroups(const JsonView& light);

} // namespace gnomon::scene::gltf
