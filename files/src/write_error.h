// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace gnomon {

/// Throws the Error of a file that cannot be written, with advice where there is some; ClosedPipe for EPIPE.
[[noreturn]] void failWriting(const std::filesystem::path& file, int error);

} // namespace gnomon
