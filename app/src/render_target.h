// SPDX-License-Identifier: Apache-2.0
// Where the results of `render` go: a file, or a folder with one for each frame.
#pragma once

#include "app/settings.h"

#include <filesystem>
#include <optional>

namespace gnomon::app {

/// Reports errors before any work is done. Removes a folder that it made and that stays empty.
class RenderTarget {
public:
    /// Throws UsageError for a name that cannot be, Error for a place that cannot be written.
    explicit RenderTarget(const Settings& settings);
    ~RenderTarget();
    RenderTarget(const RenderTarget&) = delete;
    RenderTarget& operator=(const RenderTarget&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    [[nodiscard]] bool oneForEach() const { return folder_wanted_; } // frame; else for the last
    /// The file of a frame; makes the folder when it is not there yet. Nothing if the frame is not wanted: only the
    /// last of several frames goes to a single file.
    [[nodiscard]] std::optional<std::filesystem::path> frame(std::uint32_t index);

private:
    bool folder_wanted_ = false;
    bool created_ = false;
    std::uint32_t last_ = 0; // frame
    std::filesystem::path path_;
};

} // namespace gnomon::app
