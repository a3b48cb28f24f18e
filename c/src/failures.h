// SPDX-License-Identifier: Apache-2.0
// From exceptions to the statuses and texts of the C interface. Every public function has its body in guarded() or
// guardedPointer().
#pragma once

#include <gnomon/gnomon.h>

#include <cstdint>
#include <string>
#include <string_view>

namespace gnomon::c {

/// A wrong call: the finding and the advice. What was tried is known to the function that was called.
struct WrongCall {
    std::string found;
    std::string todo;
};

/// Notes the exception that is being handled as the thread's last error.
GnomonStatus noteFailure(const char* tried) noexcept;

template <class Body>
GnomonStatus guarded(const char* tried, const Body& body) noexcept
{
    try {
        body();
        return GNOMON_OK;
    } catch (...) {
        return noteFailure(tried);
    }
}

/// For functions that return a pointer: null where the body throws.
template <class Body>
auto guardedPointer(const char* tried, const Body& body) noexcept -> decltype(body())
{
    try {
        return body();
    } catch (...) {
        noteFailure(tried);
        return nullptr;
    }
}

/// The object that a pointer leads to. Throws WrongCall for null.
template <class T>
T& required(T* pointer, const char* name)
{
    if (pointer == nullptr) {
        throw WrongCall{std::string(name) + " is null", ""};
    }
    return *pointer;
}

/// Throws WrongCall where an index is not less than a count. `name`: "light".
void requireIndex(std::uint64_t index, std::uint64_t count, const char* name);
/// Throws WrongCall where a program's interface is not one of the library's.
void requireInterface(std::uint32_t header_interface);
/// A host's text in a message: quoted, in one line, its end left out where it is long.
[[nodiscard]] std::string quoted(std::string_view text);

} // namespace gnomon::c
