// SPDX-License-Identifier: Apache-2.0
// A file or folder that is being made has a temporary name until it is whole; what a dying process leaves is removed
// later.
#pragma once

#include <filesystem>

namespace gnomon {

/// ".NAME.N.tmp" beside NAME: an empty file or folder that nobody else uses. A lock (flock) on it says that it is in
/// use and ends with the process, however that ends and on any host. So one without a lock was left by a killed
/// process, and the next process that makes NAME removes it. Where there are no locks, nothing counts as left behind.
class Temporary {
public:
    enum class Kind { file, folder };

    /// Throws Error when none can be had.
    Temporary(const std::filesystem::path& target, Kind kind);
    /// Removes it, unless it was moved. Without the memory to look into a folder, the folder stays until NAME is made
    /// next.
    ~Temporary();
    Temporary(const Temporary&) = delete;
    Temporary& operator=(const Temporary&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    /// The descriptor of the file or folder; this object keeps it.
    [[nodiscard]] int descriptor() const { return descriptor_; }
    /// Renames it and replaces a file that is there. Returns 0, or the errno: then nothing has changed.
    [[nodiscard]] int moveTo(const std::filesystem::path& place);

private:
    /// Makes an object without a file or folder.
    explicit Temporary(Kind kind) : kind_(kind) {}

    Kind kind_;
    std::filesystem::path path_;
    int descriptor_ = -1;
};

/// Removes what killed processes left while they made `target`. For a process that finds `target` already made. Throws
/// std::bad_alloc alone.
void removeLeftBehind(const std::filesystem::path& target, Temporary::Kind kind);

/// Keeps other FolderLocks from a folder while it lives. Waits some seconds at most, so that a forgotten lock does not
/// stop us.
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
