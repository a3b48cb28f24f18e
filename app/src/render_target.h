// SPDX-License-Identifier: Apache-2.0
// Where the results of `render` go: a file, or a folder of frames.
#pragma once

#include "app/settings.h"

#include <filesystem>

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
    /// The file of a frame; makes the folder when it is not there yet.
    [[nodiscard]] std::filesystem::path frame(std::uint32_t index);

private:
    bool folder_wanted_;
    bool created_ = false;
    std::filesystem::path path_;
};

} // namespace gnomon::app
