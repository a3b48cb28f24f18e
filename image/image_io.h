// SPDX-License-Identifier: Apache-2.0
// PNG and EXR files. Either the whole file is written or none of it (files/files.h). All throw Error with one line.
#pragma once

#include "image/image.h"

#include <cstdint>
#include <filesystem>
#include <string>

namespace gnomon {

/// 1 to 4 channels, 8 bit. Values are written as they are (pictures: sRGB-encoded already; tagged sRGB when 3 or 4).
void writePng(const std::filesystem::path& file, const Image8& image);
/// The bytes of the file that writePng() writes, for pictures that are not kept in files.
[[nodiscard]] std::string encodePng(const Image8& image);
/// 16-bit, tagged linear (gAMA 1.0).
void writePng(const std::filesystem::path& file, const Image16& image);
/// Half or full float, lossless (ZIP). 1 channel is named Y; 3 and 4 R, G, B, A.
void writeExr(const std::filesystem::path& file, const ImageF& image, bool half = false);

/// Any PNG (8- or 16-bit, any colour type) as [0, 1] values without colour conversion, or any EXR with Y or RGB(A).
/// Untrusted input: sizes are checked against `max_side` before memory is taken.
[[nodiscard]] ImageF readImage(const std::filesystem::path& file, std::uint32_t max_side = 16384);

} // namespace gnomon
