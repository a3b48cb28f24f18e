// SPDX-License-Identifier: Apache-2.0
// The one exception type of our own: a failure of the outside world (unreadable file, no driver, out of memory, lost
// device) or a wrong call that the called header lists. Expected outcomes are values (plan.h: Outcome).
#pragma once

#include <gnomon/export.h>

#include <cstdint>
#include <stdexcept>
#include <string>

namespace gnomon {

/// What a program can do about an Error, where it can do something by itself.
enum class ErrorKind : std::uint8_t {
    other,
    /// Of the host or of the device. Smaller maps or a smaller picture may do. Where the library's own heap is
    /// exhausted, std::bad_alloc comes out instead.
    out_of_memory,
    /// The Vulkan device is lost, or has not answered for so long that it is taken for lost. Nothing that was made with
    /// it can be used any more, only destroyed. All can be made again with a new device.
    device_lost,
};

/// what() is one line: what was tried, what was found, what to do about it (where there is something to do).
class GNOMON_API Error : public std::runtime_error {
public:
    /// Parts of one sentence each, without a full stop. `todo` may be empty.
    Error(const std::string& tried, const std::string& found, const std::string& todo = {},
          ErrorKind kind = ErrorKind::other);

    /// What a program can do about it by itself.
    [[nodiscard]] ErrorKind kind() const { return kind_; }
    /// What was tried.
    [[nodiscard]] const std::string& tried() const { return tried_; }
    /// What was found instead.
    [[nodiscard]] const std::string& found() const { return found_; }
    /// What to do about it; may be empty.
    [[nodiscard]] const std::string& todo() const { return todo_; }

private:
    std::string tried_;
    std::string found_;
    std::string todo_;
    ErrorKind kind_;
};

} // namespace gnomon
