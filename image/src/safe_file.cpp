// SPDX-License-Identifier: Apache-2.0
#include "safe_file.h"

#include <gnomon/error.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <signal.h>
#include <string>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace gnomon {
namespace {

namespace fs = std::filesystem;

std::string reason(int error)
{
    return std::generic_category().message(error);
}

[[noreturn]] void fail(const fs::path& file, int error)
{
    const char* todo = "";
    if (error == ENOSPC || error == EDQUOT) {
        todo = "make room there or write elsewhere";
    } else if (error == EFBIG) {
        todo = "raise the file size limit (ulimit -f)";
    } else if (error == ENOENT) {
        todo = "make the folder first";
    }
    throw Error("writing " + file.string(), reason(error), todo);
}

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

/// Writes everything; 0, or the errno of the call that failed.
int writeAll(int descriptor, std::string_view bytes)
{
    while (!bytes.empty()) {
        const ssize_t count = ::write(descriptor, bytes.data(), bytes.size());
        if (count < 0 && errno == EINTR) {
            continue;
        }
        if (count <= 0) {
            return count < 0 ? errno : EIO;
        }
        bytes.remove_prefix(static_cast<std::size_t>(count));
    }
    return 0;
}

/// Flushes and closes: both can be the call that finds the disk full.
int finish(int descriptor, int error)
{
    // Pipes and terminals cannot be flushed to a disk and say EINVAL or ENOTSUP; that is no failure.
    if (error == 0 && ::fsync(descriptor) != 0 && errno != EINVAL && errno != ENOTSUP && errno != EROFS) {
        error = errno;
    }
    if (::close(descriptor) != 0 && error == 0) {
        error = errno;
    }
    return error;
}

/// A device or pipe has no contents to replace, and renaming over it would remove the device itself.
void writeInPlace(const fs::path& file, std::string_view bytes)
{
    const int descriptor = ::open(file.c_str(), O_WRONLY | O_CLOEXEC);
    if (descriptor < 0) {
        fail(file, errno);
    }
    const int error = finish(descriptor, writeAll(descriptor, bytes));
    if (error != 0) {
        fail(file, error);
    }
}

/// A name of our own in the folder of `file`, opened; the name is told apart by process and a count.
std::pair<int, fs::path> openTemporary(const fs::path& file)
{
    constexpr int kAttempts = 100;
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
        std::array<char, 48> suffix{};
        std::snprintf(suffix.data(), suffix.size(), ".%ld-%d.tmp", static_cast<long>(::getpid()), attempt);
        // Cut so that the name does not grow past what a file system takes (255 bytes).
        fs::path temporary = file.parent_path() / ("." + file.filename().string().substr(0, 200) + suffix.data());
        const int descriptor = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (descriptor >= 0) {
            return {descriptor, std::move(temporary)};
        }
        if (errno != EEXIST) {
            fail(file, errno);
        }
    }
    fail(file, EEXIST);
}

} // namespace

void requireWritable(const fs::path& file)
{
    if (file.empty()) {
        throw Error("writing a file", "its name is empty");
    }
    std::error_code error;
    const fs::file_status status = fs::status(file, error);
    if (fs::is_directory(status)) {
        throw Error("writing " + file.string(), "it is a directory", "name a file in it");
    }
    if (fs::exists(status)) {
        if (::access(file.c_str(), W_OK) != 0) {
            fail(file, errno);
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
        fail(file, errno);
    }
}

void writeFile(const fs::path& named, std::string_view bytes)
{
    requireWritable(named);
    std::error_code ignored;
    // A symbolic link stays one: what it points to is replaced.
    const fs::path file = fs::is_symlink(named, ignored) ? fs::weakly_canonical(named, ignored) : named;
    const fs::file_status status = fs::status(file, ignored);
    if (fs::exists(status) && !fs::is_regular_file(status)) {
        writeInPlace(file, bytes);
        return;
    }
    const SignalsHeld signals;
    auto [descriptor, temporary] = openTemporary(file);
    int error = writeAll(descriptor, bytes);
    if (struct stat old{}; error == 0 && ::stat(file.c_str(), &old) == 0 && ::fchmod(descriptor, old.st_mode) != 0) {
        error = errno;
    }
    error = finish(descriptor, error);
    if (error == 0 && ::rename(temporary.c_str(), file.c_str()) != 0) {
        error = errno;
    }
    if (error != 0) {
        ::unlink(temporary.c_str());
        fail(file, error);
    }
}

std::string readWholeFile(const fs::path& file, std::uint64_t max_bytes)
{
    const auto refuse = [&](const std::string& why) {
        throw Error("reading " + file.string(), why);
    };
    const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) {
        refuse(reason(errno));
    }
    struct Closer {
        int descriptor;
        ~Closer() { ::close(descriptor); }
    } const closer{descriptor};
    struct stat info {};
    if (::fstat(descriptor, &info) != 0) {
        refuse(reason(errno));
    }
    if (!S_ISREG(info.st_mode)) {
        refuse(S_ISDIR(info.st_mode) ? "it is a directory" : "it is not a plain file");
    }
    if (static_cast<std::uint64_t>(info.st_size) > max_bytes) {
        refuse("it has " + std::to_string(info.st_size) + " bytes, more than the limit of " +
               std::to_string(max_bytes));
    }
    std::string bytes(static_cast<std::size_t>(info.st_size), '\0');
    std::size_t filled = 0;
    while (filled < bytes.size()) {
        const ssize_t count = ::read(descriptor, bytes.data() + filled, bytes.size() - filled);
        if (count < 0 && errno == EINTR) {
            continue;
        }
        if (count < 0) {
            refuse(reason(errno));
        }
        if (count == 0) {
            break;
        }
        filled += static_cast<std::size_t>(count);
    }
    bytes.resize(filled);
    return bytes;
}

} // namespace gnomon
