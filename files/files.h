// SPDX-License-Identifier: Apache-2.0
// Reading and writing of whole files, for files that others wrote and files that others may read meanwhile.
#pragma once

#include <gnomon/error.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace gnomon {

/// The reader of the pipe that is written to has closed it, as `head` does once it has its lines. This needs no
/// message: a program ends silently.
class ClosedPipe : public Error {
public:
    using Error::Error;
};

/// A plain file, open for reading. Pipes, sockets, devices and folders are none: they may have no end, or nothing yet.
class PlainFile {
public:
    /// Never waits, not even for a pipe's writer. Nothing when there is no such file; `why` says why not.
    [[nodiscard]] static std::optional<PlainFile> open(const std::filesystem::path& file, std::string& why);
    PlainFile(PlainFile&& other) noexcept;
    PlainFile& operator=(PlainFile&& other) = delete;
    ~PlainFile();

    /// The file's size when it was opened.
    [[nodiscard]] std::uint64_t bytes() const { return bytes_; }
    /// The next `count` bytes, or as many as there are. Nothing when the system cannot read it: errno says why.
    [[nodiscard]] std::optional<std::size_t> read(void* to, std::size_t count);

private:
    PlainFile(int descriptor, std::uint64_t bytes) : descriptor_(descriptor), bytes_(bytes) {}
    int descriptor_;
    std::uint64_t bytes_;
};

/// Throws Error when it cannot be read, is no plain file or has more than `max_bytes`. The Error names the file's kind
/// by `what`: "reading WHAT FILE"; empty for a kind without a name.
[[nodiscard]] std::string readWholeFile(const std::filesystem::path& file, std::uint64_t max_bytes,
                                        std::string_view what = {});

/// Throws the Error that writeFile() would throw for a directory, a missing folder, a name that is too long or a lack
/// of rights, so that a program can say so before an hour's work. Creates nothing.
void requireWritable(const std::filesystem::path& file);

/// Writes to a temporary name in the same folder, flushes, then renames: either the whole file is there or none of it,
/// even if others write it at the same time. Removes the remains of a killed process's earlier try. Devices and pipes
/// are written to in place, and this waits for a pipe's reader. Throws Error, ClosedPipe where that reader goes, and
/// any exception of callWhileWaiting()'s function.
void writeFile(const std::filesystem::path& file, std::string_view bytes);

/// Sets, for the whole process, a function that is called some times a second while writeFile() waits for a pipe's
/// reader, in the waiting thread. An exception from it ends the writing. Null, the default: only the reader ends the
/// wait.
void callWhileWaiting(void (*look)());

/// Whether the name ends in `extension` (".png"), in capitals or not.
[[nodiscard]] bool hasExtension(const std::filesystem::path& file, std::string_view extension);

} // namespace gnomon
