// SPDX-License-Identifier: Apache-2.0
// Whole files in and out, for everything that reads what it did not write, and writes what others may read meanwhile.
#pragma once

#include <gnomon/error.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace gnomon {

/// Whoever read the pipe that is written to has closed it, as `head` does once it has its lines. Not a failure that
/// anybody has to hear of: a program ends without a word.
class ClosedPipe : public Error {
public:
    using Error::Error;
};

/// A plain file, open for reading. Pipes, sockets, devices and folders are none: they may have no end, or nothing yet.
class PlainFile {
public:
    /// Never waits, for a pipe's writer neither. Nothing when there is no such file; `why` says why not.
    [[nodiscard]] static std::optional<PlainFile> open(const std::filesystem::path& file, std::string& why);
    PlainFile(PlainFile&& other) noexcept;
    PlainFile& operator=(PlainFile&& other) = delete;
    ~PlainFile();

    /// As many as it had when it was opened.
    [[nodiscard]] std::uint64_t bytes() const { return bytes_; }
    /// The next `count` bytes, or as many as there are. Nothing when the system cannot read it: errno says why.
    [[nodiscard]] std::optional<std::size_t> read(void* to, std::size_t count);

private:
    PlainFile(int descriptor, std::uint64_t bytes) : descriptor_(descriptor), bytes_(bytes) {}
    int descriptor_;
    std::uint64_t bytes_;
};

/// Throws Error when it cannot be read, is no plain file or has more than `max_bytes`. `what` is what the Error calls
/// it: "reading WHAT FILE"; empty for a file without a name of its kind.
[[nodiscard]] std::string readWholeFile(const std::filesystem::path& file, std::uint64_t max_bytes,
                                        std::string_view what = {});

/// Throws the Error that writeFile() would throw for a directory, a missing folder, a name that is too long or a lack
/// of rights, so that a program can say so before an hour's work. Creates nothing.
void requireWritable(const std::filesystem::path& file);

/// Writes to a temporary name in the same folder, flushes, then renames: either the whole file is there or none of it,
/// whoever else writes it at the same time. What a killed process left of an earlier try is removed. Devices and pipes
/// are written to in place, and a pipe's reader is waited for. Throws Error, ClosedPipe where that reader goes, and
/// what callWhileWaiting()'s function throws.
void writeFile(const std::filesystem::path& file, std::string_view bytes);

/// For the whole process: called some times a second, in the thread that waits, while writeFile() waits for a pipe's
/// reader. What it throws ends the writing. Null, as in the beginning: the wait has no end but the reader.
void callWhileWaiting(void (*look)());

/// Whether the name ends so (".png"), in capitals or not.
[[nodiscard]] bool hasExtension(const std::filesystem::path& file, std::string_view extension);

} // namespace gnomon
