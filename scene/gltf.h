// SPDX-License-Identifier: Apache-2.0
// Scenes from glTF 2.0 files.
#pragma once

#include "scene/model.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

namespace gnomon::scene {

/// The limits of an untrusted file. A file beyond one is refused by an Error that names the limit, the value found and
/// the flag that raises it.
struct Limits {
    std::uint64_t max_file_bytes = 1ULL << 30;  // --limit file-bytes=N: any one file or data URI
    std::uint64_t max_total_bytes = 4ULL << 30; // --limit total-bytes=N: everything read and decoded
    std::uint32_t max_image_side = 16384;       // --limit image-side=N: texels
    std::uint32_t max_node_depth = 256;         // --limit node-depth=N
    std::uint32_t max_count = 1U << 20;         // --limit count=N: nodes, meshes, accessors, instances of a node …
    std::uint64_t max_vertices = 1ULL << 27;    // --limit vertices=N: vertices and indices in all
    /// --limit growth=N: bytes decoded for each byte read, beyond kFreeBytes. No image and no mesh comes near unless
    /// all its values are equal; a one-line file that asks for a gigabyte does.
    std::uint64_t max_growth = 2048;
    static constexpr std::uint64_t kFreeBytes = 256ULL << 20;
};

/// Reads a .gltf or .glb file. Throws Error with one line that says what is wrong and where (a JSON pointer).
[[nodiscard]] Scene readGltf(const std::filesystem::path& file, const Limits& limits = {});

/// Reads a file from memory (fuzzing, embedding). External URIs are read from `folder`, and refused when it is empty.
[[nodiscard]] Scene readGltf(std::span<const std::byte> bytes, const std::filesystem::path& folder,
                             const Limits& limits = {});

} // namespace gnomon::scene
