// SPDX-License-Identifier: Apache-2.0
// Whole files in and out. What image/image_io.h offers of it is documented there.
#pragma once

#include "image/image_io.h"

#include <cstdint>
#include <string>

namespace gnomon {

/// Throws Error when it cannot be read, is no plain file or has more than `max_bytes`.
[[nodiscard]] std::string readWholeFile(const std::filesystem::path& file, std::uint64_t max_bytes);

} // namespace gnomon
