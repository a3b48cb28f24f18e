// SPDX-License-Identifier: Apache-2.0
#include "files/files.h"
#include "files/temporary.h"
#include "write_error.h"

#include <gnomon/error.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <string>
#include <sys/stat.h>
#include <system_error>
#include <thread>
#include <unistd.h>

namespace gnomon {
namespace {

namespace fs = std::filesystem;

/// Ctrl-C waits until the file is whole or gone, so that no temporary file is left behind.
class SignalsHeld {
public:
    SignalsHeld()
    {
        sigset_t held;
        sigemptyset(&held);
        for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
            sigaddset(&held, signal);
        }
        pthread_sigmask(SIG_BLOCK, &held, &before_);
    }
    ~SignalsHeld() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
    SignalsHeld(const SignalsHeld&) = delete;
    SignalsHeld& operator=(const SignalsHeld&) = delete;

private:
    sigset_t before_{};
};

std::atomic<void (*)()> while_waiting{nullptr};
constexpr int kLookEvery_ms = 50;

void lookUp()
{
    if (auto* const look = while_waiting.load()) {
        look();
    }
}

/// Until a descriptor that does not block can be written to.
void waitForReader(int descriptor)
{
    for (pollfd ready{descriptor, POLLOUT, 0}; ::poll(&ready, 1, kLookEvery_ms) <= 0;) {
        lookUp();
    }
}

/// Writes everything; 0, or the errno of the call that failed.
int writeAll(int descriptor, std::string_view bytes)
{
    while (!bytes.empty()) {
        const ssize_t count = ::write(descriptor, bytes.data(), bytes.size());
        if (count < 0 && errno == EINTR) {
            continue;
        }
        if (count < 0 && errno == EAGAIN) {
            waitForReader(descriptor);
            continue;
        }
        if (count <= 0) {
            return count < 0 ? errno : EIO;
        }
        bytes.remove_prefix(static_cast<std::size_t>(count));
    }
    return 0;
}

/// Writes and flushes: that can be the call that finds the disk full. 0, or the errno of what failed.
int writeAndFlush(int descriptor, std::string_view bytes)
{
    const int error = writeAll(descriptor, bytes);
    // Pipes and terminals cannot be flushed to a disk and say EINVAL or ENOTSUP; that is no failure.
    const bool refused = error == 0 && ::fsync(descriptor) != 0;
    return refused && errno != EINVAL && errno != ENOTSUP && errno != EROFS ? errno : error;
}

/// Closing can find it full, too.
int closeAfter(int descriptor, int error)
{
    return ::close(descriptor) != 0 && error == 0 ? errno : error;
}

/// Never blocks, so that waiting can be ended. A pipe that nobody reads says ENXIO; so do others, for good.
int openInPlace(const fs::path& file)
{
    for (;;) {
        const int descriptor = ::open(file.c_str(), O_WRONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
        const int error = descriptor < 0 ? errno : 0;
        std::error_code ignored;
        const bool unread = error == ENXIO && fs::is_fifo(file, ignored);
        if (!unread || fs::canonical(file, ignored).empty()) { // a pipe without a name gets no other reader
            errno = unread ? EPIPE : error;
            return descriptor;
        }
        lookUp();
        std::this_thread::sleep_for(std::chrono::milliseconds(kLookEvery_ms));
    }
}

/// A device or pipe has no contents to replace, and renaming over it would remove the device itself.
void writeInPlace(const fs::path& file, std::string_view bytes)
{
    const int descriptor = openInPlace(file);
    if (descriptor < 0) {
        failWriting(file, errno);
    }
    int error = 0;
    try {
        error = writeAndFlush(descriptor, bytes);
    } catch (...) {
        ::close(descriptor);
        throw;
    }
    error = closeAfter(descriptor, error);
    if (error != 0) {
        failWriting(file, error);
    }
}

} // namespace

void callWhileWaiting(void (*look)())
{
    while_waiting = look;
}

void failWriting(const fs::path& file, int error)
{
    const std::string tried = "writing " + file.string();
    const std::string found = std::generic_category().message(error);
    if (error == EPIPE) {
        throw ClosedPipe(tried, found);
    }
    const char* todo = "";
    if (error == ENOSPC || error == EDQUOT) {
        todo = "make room there or write elsewhere";
    } else if (error == EFBIG) {
        todo = "raise the file size limit (ulimit -f)";
    } else if (error == ENOENT) {
        todo = "make the folder first";
    } else if (error == ENAMETOOLONG) {
        todo = "give it a shorter name";
    }
    throw Error(tried, found, todo);
}

void requireWritable(const fs::path& file)
{
    if (file.empty()) {
        throw Error("writing a file", "its name is empty");
    }
    std::error_code error;
    const fs::file_status status = fs::status(file, error);
    if (status.type() == fs::file_type::none) { // neither there nor missing
        failWriting(file, error.value());
    }
    if (fs::is_directory(status)) {
        throw Error("writing " + file.string(), "it is a directory", "name a file in it");
    }
    if (fs::exists(status)) {
        if (::access(file.c_str(), W_OK) != 0) {
            failWriting(file, errno);
        }
        return;
    }
    if (!file.has_filename()) {
        throw Error("writing " + file.string(), "it names no file");
    }
    const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
    const fs::file_status folder_status = fs::status(folder, error);
    if (!fs::exists(folder_status)) {
        throw Error("writing " + file.string(), "there is no folder " + folder.string(), "make it first");
    }
    if (!fs::is_directory(folder_status)) {
        throw Error("writing " + file.string(), folder.string() + " is not a folder");
    }
    if (::access(folder.c_str(), W_OK | X_OK) != 0) {
        failWriting(file, errno);
    }
}

void writeFile(const fs::path& named, std::string_view bytes)
{
    requireWritable(named);
    std::error_code ignored;
    const fs::file_status status = fs::status(named, ignored);
    if (fs::exists(status) && !fs::is_regular_file(status)) {
        writeInPlace(named, bytes); // by this name: /dev/stdout leads to a pipe that has no other
        return;
    }
    // A symbolic link stays one: what it points to is replaced.
    const fs::path file = fs::is_symlink(named, ignored) ? fs::weakly_canonical(named, ignored) : named;
    const SignalsHeld signals;
    Temporary temporary(file, Temporary::Kind::file);
    int error = writeAndFlush(temporary.descriptor(), bytes);
    // A copy, because the lock lasts until the last one is closed.
    if (error == 0) {
        const int copy = ::fcntl(temporary.descriptor(), F_DUPFD_CLOEXEC, 0);
        error = copy < 0 ? errno : closeAfter(copy, 0);
    }
    if (struct stat old{};
        error == 0 && ::stat(file.c_str(), &old) == 0 && ::fchmod(temporary.descriptor(), old.st_mode) != 0) {
        error = errno;
    }
    if (error == 0) {
        error = temporary.moveTo(file);
    }
    if (error != 0) {
        failWriting(file, error);
    }
}

} // namespace gnomon
