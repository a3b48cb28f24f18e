// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>

namespace gnomon {

/// Looks at an EXR's headers before OpenEXR does, which believes the sizes in them and takes the memory first. Throws
/// std::runtime_error unless every attribute fits the file, every side is in 1 to `max_side`, no data are deep, and the
/// unpacked size is in proportion to the file.
void checkExrHeaders(std::string_view bytes, std::uint32_t max_side);

} // namespace gnomon
