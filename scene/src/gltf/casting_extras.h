// SPDX-License-Identifier: Apache-2.0
// `extras` that say whether a node casts and receives: {"gnomon": {"casts": false}}.
#pragma once

#include "gltf/json_view.h"
#include "scene/casting.h"

namespace gnomon::scene::gltf {

/// A node's extras. Members that are not as docs/scenes.md has them get a notice and have no effect, and the scene
/// still loads.
[[nodiscard]] Casting readCasting(const JsonView& node);
/// A light's extras, which have `groups` alone.
[[nodiscard]] std::optional<std::uint32_t> readLightGroups(const JsonView& light);

} // namespace gnomon::scene::gltf
