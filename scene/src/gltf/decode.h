// SPDX-License-Identifier: Apache-2.0
// Decoders of untrusted PNG and JPEG data. The C libraries report errors by longjmp, so the code around them keeps
// nothing with a destructor alive across a call.
#pragma once

#include "scene/model.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>

namespace gnomon::scene::gltf {

enum class ImageFormat : std::uint8_t { unknown, png, jpeg, webp, ktx2, avif, dds };

/// What the first bytes say.
[[nodiscard]] ImageFormat sniff(std::span<const std::byte> bytes);
/// "image/png" and so on; empty for unknown.
[[nodiscard]] const char* mediaType(ImageFormat format);

/// Called with width and height before the pixels are allocated; throws when they are too large.
using SizeCheck = std::function<void(std::uint32_t width, std::uint32_t height)>;

/// Fills width, height and rgba of `image`. Returns what is wrong with the data, or an empty string.
[[nodiscard]] std::string decodePng(std::span<const std::byte> bytes, const SizeCheck& check, Image& image);
[[nodiscard]] std::string decodeJpeg(std::span<const std::byte> bytes, const SizeCheck& check, Image& image);

} // namespace gnomon::scene::gltf
