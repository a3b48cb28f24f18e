// SPDX-License-Identifier: Apache-2.0
#include "render_target.h"

#include "image/image_io.h"

#include <gnomon/error.h>

#include <fmt/format.h>

namespace gnomon::app {

namespace fs = std::filesystem;

namespace {

bool isPicture(const fs::path& path)
{
    return path.extension() == ".png" || path.extension() == ".exr";
}

} // namespace

RenderTarget::RenderTarget(const Settings& settings)
{
    const bool frames = settings.frames.has_value();
    path_ = !settings.output.empty() ? settings.output : frames ? "gnomon_frames" : "gnomon.png";
    folder_wanted_ = frames && (!isPicture(path_) || fs::is_directory(path_));
    last_ = frames ? settings.frames->last : 0;
    if (!folder_wanted_) {
        if (fs::is_directory(path_)) {
            throw Error("writing " + path_.string(), "it is a directory", "name a file in it");
        }
        if (!isPicture(path_)) {
            throw UsageError(fmt::format("--out: \"{}\" ends neither in .png nor in .exr", path_.string()));
        }
        requireWritable(path_);
        return;
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

std::optional<fs::path> RenderTarget::frame(std::uint32_t index)
{
    if (!folder_wanted_) {
        return index == last_ ? std::optional(path_) : std::nullopt;
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
