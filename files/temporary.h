// SPDX-License-Identifier: Apache-2.0
// What is being made has a name of its own until it is whole, and takes that name along when its process dies.
#pragma once

#include <filesystem>

namespace gnomon {

/// ".NAME.N.tmp" beside NAME: an empty file or folder that nobody else uses. A lock (flock) on it says that it is in
/// use and ends with the process, however that ends and on whichever host; so what lies there without one was left by a
/// killed process and is removed by whoever makes the same NAME next. Where there are no locks, nothing is taken for
/// left behind.
class Temporary {
public:
    enum class Kind { file, folder };

    /// Throws Error when none can be had.
    Temporary(const std::filesystem::path& target, Kind kind);
    /// Removes it, unless it was moved. A folder that there is no memory to look into stays for whoever makes the next.
    ~Temporary();
    Temporary(const Temporary&) = delete;
    Temporary& operator=(const Temporary&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    /// Of the file or folder; it stays ours.
    [[nodiscard]] int descriptor() const { return descriptor_; }
    /// Renames it, in the place of a file that is there. 0, or the errno: then it still is what it was.
    [[nodiscard]] int moveTo(const std::filesystem::path& place);

private:
    /// Of nothing yet.
    explicit Temporary(Kind kind) : kind_(kind) {}

    Kind kind_;
    std::filesystem::path path_;
    int descriptor_ = -1;
};

/// What killed processes left while they made `target`. For who found that another has made it, and makes none. Throws
/// std::bad_alloc alone.
void removeLeftBehind(const std::filesystem::path& target, Temporary::Kind kind);

/// Keeps others that ask likewise from a folder's contents while it lives. Waits some seconds at most: a lock that
/// somebody forgot is not to stop us.
class FolderLock {
public:
    explicit FolderLock(const std::filesystem::path& folder);
    ~FolderLock();
    FolderLock(const FolderLock&) = delete;
    FolderLock& operator=(const FolderLock&) = delete;

private:
    int descriptor_;
};

} // namespace gnomon
