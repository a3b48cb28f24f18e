// SPDX-License-Identifier: Apache-2.0
#include "render_target.h"

#include "image/image_io.h"

#include <gnomon/error.h>

#include <fmt/format.h>

namespace gnomon::app {

namespace fs = std::filesystem;

RenderTarget::RenderTarget(const Settings& settings) : folder_wanted_(settings.frames.has_value())
{
    path_ = !settings.output.empty() ? settings.output : folder_wanted_ ? "gnomon_frames" : "gnomon.png";
    if (!folder_wanted_) {
        if (fs::is_directory(path_)) {
            throw Error("writing " + path_.string(), "it is a directory", "name a file in it");
        }
        if (path_.extension() != ".png" && path_.extension() != ".exr") {
            throw UsageError(fmt::format("--out: \"{}\" ends neither in .png nor in .exr", path_.string()));
        }
        requireWritable(path_);
        return;
    }
    if (path_.extension() == ".png" || path_.extension() == ".exr") {
        throw UsageError(
            fmt::format("--out: \"{}\" names a picture, but with --frames it is a folder", path_.string()));
    }
    if (fs::exists(path_) && !fs::is_directory(path_)) {
        throw Error("writing frames to " + path_.string(), "it is not a folder");
    }
    if (!fs::exists(path_)) {
        const fs::path parent = fs::absolute(path_).parent_path();
        if (!fs::is_directory(parent)) {
            throw Error("writing frames to " + path_.string(), "there is no folder " + parent.string());
        }
    }
}

RenderTarget::~RenderTarget()
{
    std::error_code ignored;
    if (created_) {
        fs::remove(path_, ignored); // only while it is empty: no frame was written
    }
}

fs::path RenderTarget::frame(std::uint32_t index)
{
    if (!folder_wanted_) {
        return path_;
    }
    if (!fs::exists(path_)) {
        std::error_code error;
        if (!fs::create_directory(path_, error)) {
            throw Error("making folder " + path_.string(), error.message());
        }
        created_ = true;
    }
    return path_ / fmt::format("frame_{:04}.png", index);
}

} // namespace gnomon::app
