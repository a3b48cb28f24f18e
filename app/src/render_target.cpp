// SPDX-License-Identifier: Apache-2.0
#include "render_target.h"

#include "files/files.h"

#include <gnomon/error.h>

#include <fmt/format.h>

#include <system_error>

namespace gnomon::app {

namespace fs = std::filesystem;

namespace {

/// Throws Error where that cannot be told: a name that is too long, a folder that may not be looked into.
fs::file_type typeOf(const fs::path& path)
{
    std::error_code error;
    const fs::file_type type = fs::status(path, error).type();
    if (type == fs::file_type::none) {
        throw Error("writing " + path.string(), error.message());
    }
    return type;
}

bool isPicture(const fs::path& path)
{
    return hasExtension(path, ".png") || hasExtension(path, ".exr");
}

} // namespace

RenderTarget::RenderTarget(const Settings& settings)
{
    const bool frames = settings.frames.has_value();
    path_ = !settings.output.empty() ? settings.output : frames ? "gnomon_frames" : "gnomon.png";
    folder_wanted_ = frames && (!isPicture(path_) || typeOf(path_) == fs::file_type::directory);
    last_ = frames ? settings.frames->last : 0;
    if (!folder_wanted_) {
        if (typeOf(path_) == fs::file_type::directory) {
            throw Error("writing " + path_.string(), "it is a directory", "name a file in it");
        }
        if (!isPicture(path_)) {
            throw UsageError(fmt::format("--out: \"{}\" ends neither in .png nor in .exr", path_.string()));
        }
        requireWritable(path_);
        return;
    }
    const fs::file_type type = typeOf(path_);
    if (type == fs::file_type::not_found) {
        const fs::path parent = fs::absolute(path_).parent_path();
        if (typeOf(parent) != fs::file_type::directory) {
            throw Error("writing frames to " + path_.string(), "there is no folder " + parent.string());
        }
        requireWritable(path_);
    } else if (type != fs::file_type::directory) {
        throw Error("writing frames to " + path_.string(), "it is not a folder");
    } else {
        requireWritable(path_ / ".gnomon-frame"); // any name there
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
    std::error_code error;
    created_ = fs::create_directory(path_, error) || created_; // another process may have made it
    if (error) {
        throw Error("making folder " + path_.string(), error.message());
    }
    return path_ / fmt::format("frame_{:04}.png", index);
}

} // namespace gnomon::app
