// SPDX-License-Identifier: Apache-2.0
// Buffer views that EXT_meshopt_compression, or KHR_meshopt_compression, has compressed.
#pragma once

#include "gltf/document.h"

namespace gnomon::scene::gltf {

/// The extension of a buffer or of a buffer view.
[[nodiscard]] std::optional<JsonView> meshoptOf(const JsonView& object);
/// Whether a buffer is a place for its views' unpacked data. Its own content is for readers without the extension.
[[nodiscard]] bool isMeshoptFallback(const JsonView& buffer);
/// The content of the buffer view of `packed`, its extension; kept by the document. `length`: the view's own.
/// Empty where the buffer has no content.
[[nodiscard]] std::span<const std::byte> unpackMeshopt(Document& document, const JsonView& packed,
                                                       std::uint64_t length);

} // namespace gnomon::scene::gltf
