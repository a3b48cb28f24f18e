// SPDX-License-Identifier: Apache-2.0
// `gnomon render`: pictures and masks to files.
#include "app/shot.h"
#include "app/visual.h"
#include "progress.h"
#include "subcommands.h"

#include "host/gpu.h"
#include "image/image_io.h"

#include <gnomon/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>

namespace gnomon::app {
namespace {

namespace fs = std::filesystem;

bool isExr(const fs::path& file)
{
    return file.extension() == ".exr";
}

/// Where the results go; says what is wrong before any work is done.
class Target {
public:
    explicit Target(const Settings& settings) : folder_wanted_(settings.frames.has_value())
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
    ~Target()
    {
        std::error_code ignored;
        if (created_) {
            fs::remove(path_, ignored); // only while it is empty: no frame was written
        }
    }
    Target(const Target&) = delete;
    Target& operator=(const Target&) = delete;

    [[nodiscard]] const fs::path& path() const { return path_; }
    [[nodiscard]] fs::path frame(std::uint32_t index)
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

private:
    bool folder_wanted_;
    bool created_ = false;
    fs::path path_;
};

void writePicture(const fs::path& file, host::Renderer& renderer, const Settings& settings, std::size_t light)
{
    const bool exr = isExr(file);
    const host::Picture picture = renderer.read(
        {.colour = !settings.mask && !exr, .linear = !settings.mask && exr, .masks = settings.mask, .geometry = false});
    if (!settings.mask) {
        exr ? writeExr(file, picture.linear, true) : writePng(file, picture.colour);
    } else if (exr) {
        writeExr(file, picture.masks.at(light));
    } else {
        writePng(file, maskAs16Bit(picture.masks.at(light)));
    }
}

/// What became of the lights, when it is not what one hoped for. Refused ones were named before.
void noteOutcomes(const Shot& shot, const Plan& plan)
{
    for (std::size_t i = 0; i < plan.lights.size(); ++i) {
        const Outcome& outcome = plan.lights[i].outcome;
        if (outcome.kind == OutcomeKind::fallback || outcome.kind == OutcomeKind::degenerate ||
            outcome.kind == OutcomeKind::atlas_full) {
            notice(fmt::format("light {}: {}: {}", shot.lights[i].name, nameOf(outcome.kind), outcome.reason));
        }
    }
}

std::string sentence(const Settings& settings, const Shot& shot, const fs::path& path, double seconds)
{
    const std::string what = settings.frames
                                 ? fmt::format("{} frames", settings.frames->last - settings.frames->first + 1)
                                 : fmt::format("{}x{}", settings.size_px.x, settings.size_px.y);
    return fmt::format("{}: {} of {}, camera {}, {}, in {:.2f} s\n", path.string(), what, settings.scene, shot.camera,
                       describeTechnique(settings), seconds);
}

} // namespace

int runRender(const Settings& settings)
{
    const auto start = std::chrono::steady_clock::now();
    Target target(settings);
    Shot shot = makeShot(settings);
    const std::size_t light = lightIndex(shot, settings);
    const auto gpu = openGpu(settings);
    {
        host::Renderer renderer(*gpu, shot.scene, shot.state, renderOptions(settings));
        const FrameRange range = settings.frames.value_or(FrameRange{});
        Progress progress("drawing", range.last - range.first + 1);
        for (std::uint32_t index = range.first; index <= range.last; ++index) {
            if (index != range.first) {
                moveShot(shot, settings, index);
            }
            renderer.draw(shot.state, shot.eye, shot.lights);
            requireSilence(*gpu);
            if (index == range.first) {
                const Outcome& outcome = renderer.plan().lights[light].outcome;
                if (settings.mask && !outcome.hasMap()) {
                    throw Error("drawing the mask of light " + shot.lights[light].name, std::string(outcome.reason));
                }
                std::for_each(shot.notices.begin(), shot.notices.end(), notice);
                noteOutcomes(shot, renderer.plan());
            }
            writePicture(target.frame(index), renderer, settings, light);
            progress.step();
        }
    }
    requireSilence(*gpu);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    writeStdout(sentence(settings, shot, target.path(), seconds.count()));
    return 0;
}

} // namespace gnomon::app
