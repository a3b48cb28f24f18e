// SPDX-License-Identifier: Apache-2.0
// The only place that writes to standard output and standard error.
#pragma once

#include <string_view>

namespace gnomon::app {

/// Puts something that can be neither read nor written in the place of descriptors 0 to 2 where they are closed, so
/// that no file which is opened later becomes what others take for the terminal. To be called before any file is
/// opened.
void holdStandardStreams() noexcept;

/// Throws Error when standard output is closed or full, ClosedPipe (files/files.h) when it is a pipe without a reader,
/// Interrupted when the run is to end while a reader takes nothing.
void writeStdout(std::string_view text);

/// As it is; what cannot be written is lost without a word, for there is nobody to tell. Takes no memory.
void writeStderr(std::string_view text) noexcept;
/// A line on standard error that starts with the program's name; line ends and control characters in `text` become
/// blanks. Otherwise as writeStderr().
void notice(std::string_view text) noexcept;

/// As long as there is one, notice() and writeStdout() say nothing.
class NoNotices {
public:
    NoNotices() noexcept;
    ~NoNotices();
    NoNotices(const NoNotices&) = delete;
    NoNotices& operator=(const NoNotices&) = delete;
};

} // namespace gnomon::app
