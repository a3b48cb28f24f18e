// SPDX-License-Identifier: Apache-2.0
// Where the results of `render` go: a file, or a folder with one for each frame.
#pragma once

#include "app/settings.h"

#include <filesystem>
#include <optional>

namespace gnomon::app {

/// Says what is wrong before any work is done. A folder that it made and that stays empty is removed again.
class RenderTarget {
public:
    /// Throws UsageError for a name that cannot be, Error for a place that cannot be written.
    explicit RenderTarget(const Settings& settings);
    ~RenderTarget();
    RenderTarget(const RenderTarget&) = delete;
    RenderTarget& operator=(const RenderTarget&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    [[nodiscard]] bool oneForEach() const { return folder_wanted_; } // frame; else for the last
    /// The file of a frame; makes the folder when it is not there yet. Nothing if the frame is not wanted, since of
    /// several frames that go to one file only the last one stays.
    [[nodiscard]] std::optional<std::filesystem::path> frame(std::uint32_t index);

private:
    bool folder_wanted_ = false;
    bool created_ = false;
    std::uint32_t last_ = 0; // frame
    std::filesystem::path path_;
};

} // namespace gnomon::app
