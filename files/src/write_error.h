// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace gnomon {

/// Throws the Error of a file that cannot be written, with what can be done where that is known; ClosedPipe for EPIPE.
[[noreturn]] void failWriting(const std::filesystem::path& file, int error);

} // namespace gnomon
