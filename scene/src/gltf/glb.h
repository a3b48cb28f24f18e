// SPDX-License-Identifier: Apache-2.0
// The binary container of glTF 2.0 (specification, chapter 4).
#pragma once

#include "gltf/context.h"

#include <cstddef>
#include <span>

namespace gnomon::scene::gltf {

struct Container {
    std::span<const std::byte> json;
    std::span<const std::byte> binary;
    bool is_glb = false;
    bool has_binary = false; // an empty binary chunk is still one
};

/// Splits a file into its parts; anything that does not start with the magic "glTF" is taken for JSON.
[[nodiscard]] Container openContainer(Context& context, std::span<const std::byte> file);

} // namespace gnomon::scene::gltf
