// SPDX-License-Identifier: Apache-2.0
// Files and data URIs. A glTF file is not trusted: what it names must lie inside its own folder.
#pragma once

#include "gltf/json_view.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::scene::gltf {

struct Resource {
    std::vector<std::byte> bytes;
    std::string media_type; // the media type of a data URI; else empty
};

/// Fetches what the string `uri` names: a data URI (base64 or percent-encoded), or a relative path below the asset's
/// folder. Other schemes, absolute paths, "..", and symbolic links that lead outside are refused.
[[nodiscard]] Resource fetch(const JsonView& uri);
/// fetch(), but nothing where the path leads to no file.
[[nodiscard]] std::optional<Resource> fetchIfThere(const JsonView& uri);

/// Reads a whole regular file within the limits. `where` is what an error says about the place that named it.
[[nodiscard]] std::vector<std::byte> readFile(Context& context, const std::filesystem::path& file,
                                              std::string_view where);

} // namespace gnomon::scene::gltf
