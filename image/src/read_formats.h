// SPDX-License-Identifier: Apache-2.0
// The two decoders behind readImage(). All throw Error with one line that starts with the name given.
#pragma once

#include "image/image.h"

#include <string>
#include <string_view>

namespace gnomon {

[[nodiscard]] bool looksLikePng(std::string_view bytes);
[[nodiscard]] ImageF decodePng(const std::string& name, std::string_view bytes, std::uint32_t max_side);

[[nodiscard]] bool looksLikeExr(std::string_view bytes);
[[nodiscard]] ImageF decodeExr(const std::string& name, std::string_view bytes, std::uint32_t max_side);

} // namespace gnomon
