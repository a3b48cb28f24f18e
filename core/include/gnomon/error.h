// SPDX-License-Identifier: Apache-2.0
// The one exception type of our own: a failure of the outside world (unreadable file, no driver, out of memory, lost
// device) or a wrong call that the called header lists. Expected outcomes are values (plan.h: Outcome).
#pragma once

#include <gnomon/export.h>

#include <cstdint>
#include <stdexcept>
#include <string>

namespace gnomon {

/// The kinds of Error that a program may be able to handle by itself.
enum class ErrorKind : std::uint8_t {
    other,
    /// The host or the device has no memory left. Smaller maps or a smaller picture may fit. The library throws
    /// std::bad_alloc instead where its own heap is exhausted.
    out_of_memory,
    /// The Vulkan device is lost, or has not answered for so long that it is taken for lost. Objects that were made
    /// with it can only be destroyed. All can be made again with a new device.
    device_lost,
};

/// what() is one line: what was tried, what was found, and what to do about it where something can be done.
class GNOMON_API Error : public std::runtime_error {
public:
    /// Parts of one sentence each, without a full stop. `todo` may be empty.
    Error(const std::string& tried, const std::string& found, const std::string& todo = {},
          ErrorKind kind = ErrorKind::other);

    /// The kind of error, which says what a program can do by itself.
    [[nodiscard]] ErrorKind kind() const { return kind_; }
    /// The step that was tried.
    [[nodiscard]] const std::string& tried() const { return tried_; }
    /// The finding that made it fail.
    [[nodiscard]] const std::string& found() const { return found_; }
    /// The advice what to do about it; may be empty.
    [[nodiscard]] const std::string& todo() const { return todo_; }

private:
    std::string tried_;
    std::string found_;
    std::string todo_;
    ErrorKind kind_;
};

} // namespace gnomon
