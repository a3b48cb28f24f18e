// SPDX-License-Identifier: Apache-2.0
#include "files/temporary.h"

#include "write_error.h"

#include <cerrno>
#include <chrono>
#include <fcntl.h>
#include <new>
#include <string>
#include <sys/file.h>
#include <sys/stat.h>
#include <system_error>
#include <thread>
#include <unistd.h>
#include <utility>

namespace gnomon {
namespace {

namespace fs = std::filesystem;

constexpr int kNames = 100; // as many processes may make one file at a time
constexpr int kGap = 8;     // after this many free names in a row no more are taken

fs::path nameOf(const fs::path& target, int n)
{
    // Cut so that the name does not grow past what a file system takes (255 bytes).
    return target.parent_path() / ("." + target.filename().string().substr(0, 200) + "." + std::to_string(n) + ".tmp");
}

int openExisting(const fs::path& path, Temporary::Kind kind)
{
    const int folder = kind == Temporary::Kind::folder ? O_DIRECTORY : 0;
    return ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOFOLLOW | O_CLOEXEC | folder);
}

/// -1 with errno EEXIST where the name is taken, or another has removed the folder before it was locked.
int create(const fs::path& path, Temporary::Kind kind)
{
    if (kind == Temporary::Kind::file) {
        return ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    }
    if (::mkdir(path.c_str(), 0777) != 0) {
        return -1;
    }
    const int made = openExisting(path, kind);
    if (made < 0 && errno == ENOENT) {
        errno = EEXIST;
    }
    return made;
}

/// Whether `path` still is what the descriptor is open on, of that kind and no other's in its place.
bool isThere(const fs::path& path, Temporary::Kind kind, int descriptor)
{
    struct stat open {};
    struct stat there {};
    return ::fstat(descriptor, &open) == 0 && ::lstat(path.c_str(), &there) == 0 && open.st_ino == there.st_ino &&
           open.st_dev == there.st_dev &&
           (kind == Temporary::Kind::folder ? S_ISDIR(open.st_mode) : S_ISREG(open.st_mode));
}

/// A file goes without memory. A folder for which there is none stays, for the next that makes the same name.
bool removedAll(const fs::path& path, Temporary::Kind kind) noexcept
{
    if (kind == Temporary::Kind::file) {
        return ::unlink(path.c_str()) == 0;
    }
    try {
        std::error_code error;
        fs::remove_all(path, error);
        return !error;
    } catch (const std::bad_alloc&) {
        return false;
    }
}

/// Whether the name was left by a killed process and is now free. Only the holder of the lock may remove or rename.
bool removedStale(const fs::path& path, Temporary::Kind kind)
{
    const int descriptor = openExisting(path, kind);
    if (descriptor < 0) {
        return false;
    }
    const bool removed =
        ::flock(descriptor, LOCK_EX | LOCK_NB) == 0 && isThere(path, kind, descriptor) && removedAll(path, kind);
    ::close(descriptor);
    return removed;
}

/// Another that looks for what was left behind may find a new name before its maker has locked it, and removes it. A
/// file system without locks says something else than that another has it.
bool lockedOurs(const fs::path& path, Temporary::Kind kind, int descriptor)
{
    return (::flock(descriptor, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) && isThere(path, kind, descriptor);
}

/// From the nth name on.
void removeLeftBehindFrom(int n, const fs::path& target, Temporary::Kind kind)
{
    for (int free = 0; n < kNames && free < kGap; ++n) {
        const fs::path path = nameOf(target, n);
        struct stat there {};
        const bool is_free = ::lstat(path.c_str(), &there) != 0 || removedStale(path, kind);
        free = is_free ? free + 1 : 0;
    }
}

} // namespace

void removeLeftBehind(const fs::path& target, Temporary::Kind kind)
{
    removeLeftBehindFrom(0, target, kind);
}

// Once the other constructor is done there is a destructor, which removes what was made when something throws here.
Temporary::Temporary(const fs::path& target, Kind kind) : Temporary(kind)
{
    int n = 0;
    for (; n < kNames && descriptor_ < 0; ++n) {
        fs::path path = nameOf(target, n);
        int made = create(path, kind);
        const int error = made < 0 ? errno : 0;
        if (error == EEXIST && removedStale(path, kind)) {
            made = create(path, kind);
        } else if (error != 0 && error != EEXIST) {
            failWriting(target, error);
        }
        if (made >= 0 && lockedOurs(path, kind, made)) {
            descriptor_ = made;
            path_ = std::move(path);
        } else if (made >= 0) {
            ::close(made);
        }
    }
    if (descriptor_ < 0) {
        failWriting(target, EEXIST);
    }
    removeLeftBehindFrom(n, target, kind);
}

Temporary::~Temporary()
{
    if (!path_.empty()) {
        (void)removedAll(path_, kind_);
    }
    if (descriptor_ >= 0) {
        ::close(descriptor_);
    }
}

int Temporary::moveTo(const fs::path& place)
{
    if (::rename(path_.c_str(), place.c_str()) != 0) {
        return errno;
    }
    path_.clear();
    return 0;
}

FolderLock::FolderLock(const fs::path& folder) : descriptor_(openExisting(folder, Temporary::Kind::folder))
{
    constexpr int kTries = 1000;
    for (int i = 0; i < kTries && ::flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK; ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
}

FolderLock::~FolderLock()
{
    if (descriptor_ >= 0) {
        ::close(descriptor_);
    }
}

} // namespace gnomon
