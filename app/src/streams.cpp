// SPDX-License-Identifier: Apache-2.0
#include "streams.h"

#include "interrupt.h"

#include "files/files.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <fcntl.h>
#include <poll.h>
#include <string>
#include <system_error>
#include <unistd.h>

namespace gnomon::app {
namespace {

std::atomic<int> silences = 0; // how many NoNotices there are

/// Waits until a pipe or terminal takes bytes. False when the run is to end and it still takes none.
bool waitFor(int descriptor) noexcept
{
    constexpr int kLookEvery_ms = 50;
    for (;;) {
        pollfd ready{descriptor, POLLOUT, 0};
        const int found = ::poll(&ready, 1, kLookEvery_ms);
        if (found > 0 || (found < 0 && errno != EINTR)) {
            return true;
        }
        if (interruptFlag()) {
            return false;
        }
    }
}

/// Writes everything; 0, the errno of the call that failed, or EINTR when the run is to end first.
int writeTo(int descriptor, std::string_view bytes) noexcept
{
    while (!bytes.empty()) {
        if (!waitFor(descriptor)) {
            return EINTR;
        }
        // A pipe that takes bytes takes PIPE_BUF of them without blocking.
        const ssize_t count = ::write(descriptor, bytes.data(), std::min<std::size_t>(bytes.size(), PIPE_BUF));
        if (count < 0 && errno != EINTR && errno != EAGAIN) { // EAGAIN: somebody else has set it not to block
            return errno;
        }
        if (count == 0) {
            return EIO;
        }
        if (count > 0) {
            bytes.remove_prefix(static_cast<std::size_t>(count));
        }
    }
    return 0;
}

} // namespace

void holdStandardStreams() noexcept
{
    for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        if (::fcntl(descriptor, F_GETFD) < 0 && errno == EBADF) {
            // open() gives the lowest number that is free, which is this one. The wrong way round on purpose: a read or
            // write there must fail.
            (void)::open("/dev/null", descriptor == STDIN_FILENO ? O_WRONLY : O_RDONLY);
        }
    }
}

void writeStdout(std::string_view text)
{
    if (silences != 0) {
        return;
    }
    if (const int error = writeTo(STDOUT_FILENO, text); error != 0) {
        if (error == EINTR) {
            throw Interrupted();
        }
        const std::string tried = "writing to standard output";
        const std::string found = std::generic_category().message(error);
        if (error == EPIPE) {
            throw ClosedPipe(tried, found);
        }
        throw Error(tried, found);
    }
}

void writeStderr(std::string_view text) noexcept
{
    (void)writeTo(STDERR_FILENO, text);
}

NoNotices::NoNotices() noexcept
{
    ++silences;
}

NoNotices::~NoNotices()
{
    --silences;
}

void notice(std::string_view text) noexcept
{
    if (silences != 0) {
        return;
    }
    std::array<char, 4096> line{}; // a line in one piece, so that those of several processes do not mix
    std::size_t length = 0;
    const auto add = [&](std::string_view more) {
        for (const char c : more) {
            line[length++] = c;
            if (length == line.size()) {
                writeStderr({line.data(), length});
                length = 0;
            }
        }
    };
    add("gnomon: ");
    for (const char c : text) {
        const auto code = static_cast<unsigned char>(c);
        add(code < 0x20 || code == 0x7F ? std::string_view(" ") : std::string_view(&c, 1));
    }
    add("\n");
    writeStderr({line.data(), length});
}

} // namespace gnomon::app
