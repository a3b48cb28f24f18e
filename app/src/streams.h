// SPDX-License-Identifier: Apache-2.0
// The only place that writes to standard output and standard error.
#pragma once

#include <string_view>

namespace gnomon::app {

/// Puts an unreadable and unwritable descriptor in place of each closed one of 0 to 2, so that no file opened later
/// becomes a standard stream. To be called before any file is opened.
void holdStandardStreams() noexcept;

/// Throws Error when standard output is closed or full, ClosedPipe (files/files.h) when it is a pipe without a reader,
/// Interrupted when the run is to end while a reader takes nothing.
void writeStdout(std::string_view text);

/// Writes `text` unchanged. Text that cannot be written is lost silently. Takes no memory.
void writeStderr(std::string_view text) noexcept;
/// A line on standard error that starts with the program's name; line ends and control characters in `text` become
/// blanks. Otherwise it acts as writeStderr().
void notice(std::string_view text) noexcept;

/// While one lives, notice() and writeStdout() write nothing.
class NoNotices {
public:
    NoNotices() noexcept;
    ~NoNotices();
    NoNotices(const NoNotices&) = delete;
    NoNotices& operator=(const NoNotices&) = delete;
};

} // namespace gnomon::app
