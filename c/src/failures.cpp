// SPDX-License-Identifier: Apache-2.0
#include "failures.h"

#include <gnomon/error.h>

#include <algorithm>
#include <new>

namespace gnomon::c {
namespace {

struct LastError {
    GnomonError shown{GNOMON_OK, 0, "", "", "", ""};
    std::string message;
    std::string tried;
    std::string found;
    std::string todo;

    void note(GnomonStatus status, const Error& error)
    {
        message = error.what();
        tried = error.tried();
        found = error.found();
        todo = error.todo();
        shown = {status, 0, message.c_str(), tried.c_str(), found.c_str(), todo.c_str()};
    }
};

LastError& lastError()
{
    thread_local LastError last;
    return last;
}

GnomonStatus note(const char* tried)
{
    try {
        throw;
    } catch (const WrongCall& wrong) {
        lastError().note(GNOMON_REFUSED, Error(tried, wrong.found, wrong.todo));
        return GNOMON_REFUSED;
    } catch (const Error& error) {
        const bool memory = error.kind() == ErrorKind::out_of_memory;
        lastError().note(memory ? GNOMON_OUT_OF_MEMORY : GNOMON_REFUSED, error);
        return memory ? GNOMON_OUT_OF_MEMORY : GNOMON_REFUSED;
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& other) { // of the standard library: a length that no container can have
        lastError().note(GNOMON_REFUSED, Error(tried, other.what()));
        return GNOMON_REFUSED;
    }
}

} // namespace

GnomonStatus noteFailure(const char* tried) noexcept
{
    try {
        return note(tried);
    } catch (...) { // the message must not ask for memory
        lastError().shown = {GNOMON_OUT_OF_MEMORY,
                             0,
                             "gnomon: the memory is exhausted; free some, or ask for less",
                             tried,
                             "the memory is exhausted",
                             "free some, or ask for less"};
        return GNOMON_OUT_OF_MEMORY;
    }
}

void requireIndex(std::uint64_t index, std::uint64_t count, const char* name)
{
    if (index >= count) {
        throw WrongCall{std::string(name) + " is " + std::to_string(index) + ", and there are " + std::to_string(count),
                        ""};
    }
}

void requireInterface(std::uint32_t header_interface)
{
    if (header_interface == 0 || header_interface > GNOMON_INTERFACE) {
        throw WrongCall{"the program has interface " + std::to_string(header_interface) + ", and the library 1 to " +
                            std::to_string(GNOMON_INTERFACE),
                        "pass GNOMON_INTERFACE, and take a library that is as new as its header"};
    }
}

std::string quoted(std::string_view text)
{
    constexpr std::size_t kLongest = 80;
    std::string shown = "\"" + std::string(text.substr(0, kLongest)) + (text.size() > kLongest ? "..." : "") + "\"";
    std::ranges::replace_if(
        shown, [](char c) { return static_cast<unsigned char>(c) < ' '; }, ' ');
    return shown;
}

} // namespace gnomon::c

extern "C" {

const GnomonError* gnomonLastError(void) noexcept
{
    return &gnomon::c::lastError().shown;
}

const char* gnomonVersion(void) noexcept
{
    return GNOMON_VERSION;
}

} // extern "C"
