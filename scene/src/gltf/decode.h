// SPDX-License-Identifier: Apache-2.0
// Decoders of untrusted PNG, JPEG and WebP data. libpng and libjpeg report errors by longjmp, so the code around them
// keeps nothing with a destructor alive across a call.
#pragma once

#include "scene/model.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>

namespace gnomon::scene::gltf {

enum class ImageFormat : std::uint8_t { unknown, png, jpeg, webp, ktx2, avif, dds };

/// The format that the first bytes show.
[[nodiscard]] ImageFormat sniff(std::span<const std::byte> bytes);
/// "image/png" and so on; empty for unknown.
[[nodiscard]] const char* mediaType(ImageFormat format);
/// The format of a media type.
[[nodiscard]] ImageFormat formatNamed(std::string_view media_type);

/// Called with width and height before the pixels are allocated; throws when they are too large.
using SizeCheck = std::function<void(std::uint32_t width, std::uint32_t height)>;

/// Fills width, height and rgba of `image`. Returns what is wrong with the data, or an empty string.
[[nodiscard]] std::string decodePng(std::span<const std::byte> bytes, const SizeCheck& check, Image& image);
[[nodiscard]] std::string decodeJpeg(std::span<const std::byte> bytes, const SizeCheck& check, Image& image);
/// Refuses an animation.
[[nodiscard]] std::string decodeWebp(std::span<const std::byte> bytes, const SizeCheck& check, Image& image);

using Decoder = std::string (*)(std::span<const std::byte> bytes, const SizeCheck& check, Image& image);
/// Null where there is none: for AVIF, KTX2, DDS and unknown formats.
[[nodiscard]] Decoder decoderOf(ImageFormat format);

} // namespace gnomon::scene::gltf
