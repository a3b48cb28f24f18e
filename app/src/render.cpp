// SPDX-License-Identifier: Apache-2.0
// `gnomon render`: pictures and masks to files, with a technique's shadows or with the ray tracer's.
#include "app/shot.h"
#include "app/visual.h"
#include "debug_views.h"
#include "interrupt.h"
#include "progress.h"
#include "render_target.h"
#include "shot_parts.h"
#include "streams.h"
#include "subcommands.h"
#include "truth_masks.h"

#include "files/files.h"
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
    return hasExtension(file, ".exr");
}

void writeMask(const fs::path& file, const ImageF& mask)
{
    isExr(file) ? writeExr(file, mask) : writePng(file, maskAs16Bit(mask));
}

void writePicture(const fs::path& file, host::FrameRenderer& renderer, const Settings& settings, std::size_t light)
{
    const bool exr = isExr(file);
    const host::Picture picture = renderer.read(
        {.colour = !settings.mask && !exr, .linear = !settings.mask && exr, .masks = settings.mask, .geometry = false});
    if (settings.mask) {
        writeMask(file, picture.masks.at(light));
    } else {
        exr ? writeExr(file, picture.linear, true) : writePng(file, picture.colour);
    }
}

/// Notes lights that have smaller maps than they ask for, or whose outcome is a fallback or worse. Refused lights were
/// named before.
void noteOutcomes(const Shot& shot, const Plan& plan)
{
    if (const auto smaller = std::ranges::count_if(plan.lights, [](const LightPlan& l) { return l.halved > 0; })) {
        const LightPlan& least = *std::ranges::max_element(plan.lights, {}, &LightPlan::halved);
        notice(fmt::format("{} of {} lights have smaller maps than they ask for, of 1/{} the side at least: together "
                           "they ask for {} texels and have {}",
                           smaller, plan.lights.size(), 1U << least.halved, plan.pages[0].wanted_texels,
                           plan.pages[0].given_texels));
    }
    for (std::size_t i = 0; i < plan.lights.size(); ++i) {
        const Outcome& outcome = plan.lights[i].outcome;
        if (outcome.kind == OutcomeKind::fallback || outcome.kind == OutcomeKind::degenerate ||
            outcome.kind == OutcomeKind::refused || outcome.kind == OutcomeKind::atlas_full) {
            notice(fmt::format("light {}: {}: {}", shot.lights[i].name, nameOf(outcome.kind), outcome.reason));
        }
    }
}

/// Notes that a motion that joins two positions of a sun has only one in a single picture, where nothing moves the sun.
void notePositions(const Settings& settings, const Plan& plan)
{
    const Motion motion = settings.shadow.technique.motion;
    const bool joins_two =
        motion == Motion::step_band || motion == Motion::step_blend || motion == Motion::step_alternate;
    const bool steps = std::ranges::any_of(plan.lights, [](const LightPlan& light) { return light.steps.stepping; });
    if (!settings.frames && joins_two && steps) {
        notice(fmt::format("motion {} shows two positions of a sun that moves, and in a single frame none does: add "
                           "--path day --frames 0-30",
                           nameOf(motion)));
    }
}

std::string sentence(const Settings& settings, const Shot& shot, const RenderTarget& target, glm::uvec2 size_px,
                     const std::string& how, double seconds)
{
    const std::string size = fmt::format("{}x{}", size_px.x, size_px.y);
    const std::uint32_t frames = settings.frames ? settings.frames->last - settings.frames->first + 1 : 1;
    const std::string what = !settings.frames ? size
                             : target.oneForEach()
                                 ? fmt::format("{} frames", frames)
                                 : fmt::format("{}, last of {} frame{}", size, frames, frames == 1 ? "" : "s");
    return fmt::format("{}: {} of {}, camera {}, {}, in {:.2f} s\n", target.path().string(), what, settings.scene,
                       shot.camera, how, seconds);
}

/// Moves the shot from frame to frame and calls `draw` with the index and whether it is the first.
template <typename Draw>
void forEachFrame(Shot& shot, const Settings& settings, const Draw& draw)
{
    const FrameRange range = settings.frames.value_or(FrameRange{});
    Progress progress("drawing", range.last - range.first + 1);
    bool told = shot.lights_left_out > 0; // by the shot's own notices
    for (std::uint32_t index = range.first; index <= range.last; ++index) {
        if (index != range.first) {
            moveShot(shot, settings, index);
            if (shot.lights_left_out > 0 && !told) {
                told = true;
                notice(fmt::format("frame {}: {}", index, leftOutSentence(shot)));
            }
        }
        requireNotInterrupted();
        draw(index, index == range.first);
        progress.step();
    }
}

/// Returns how it was drawn. A debug view's picture has a size of its own.
std::string drawTechnique(Shot& shot, const Settings& settings, RenderTarget& target, std::size_t light,
                          glm::uvec2& size_px)
{
    const auto gpu = openGpu(settings);
    {
        const host::SceneOnGpu scene(*gpu, shot.scene, shot.state);
        host::FrameRenderer renderer(scene, renderOptions(settings));
        lab::Waits waits;
        forEachFrame(shot, settings, [&](std::uint32_t index, bool first) {
            for (std::uint32_t frame = 1; frame < settings.converge; ++frame) {
                renderer.draw(shot.state, shot.eye, shot.lights);
                requireNotInterrupted();
            }
            renderer.draw(shot.state, shot.eye, shot.lights);
            requireSilence(*gpu);
            if (!first) { // in which all maps are drawn
                waits.take(renderer.plan());
            }
            if (first) {
                const Outcome& outcome = renderer.plan().lights[light].outcome;
                if (settings.mask && !outcome.hasMap()) {
                    throw Error("drawing the mask of light " + shot.lights[light].name, std::string(outcome.reason));
                }
                std::for_each(shot.notices.begin(), shot.notices.end(), notice);
                noteOutcomes(shot, renderer.plan());
                notePositions(settings, renderer.plan());
            }
            const std::optional<fs::path> file = target.frame(index);
            if (!file) {
                return;
            }
            if (settings.debug != "none") {
                const Image8 picture = debugPicture(renderer, shot, settings, light);
                size_px = {picture.width, picture.height};
                writePng(*file, picture);
            } else {
                writePicture(*file, renderer, settings, light);
            }
        });
        if (const std::optional<std::string> note = waitNote(waits)) {
            notice(*note);
        }
    }
    requireSilence(*gpu);
    return describeTechnique(settings);
}

/// The same shading with the ray tracer's masks.
std::string drawTruth(Shot& shot, const Settings& settings, RenderTarget& target)
{
    TruthMasks truth(shot, settings);
    const auto gpu = openGpu(settings);
    {
        host::RenderOptions options = renderOptions(settings);
        options.shadows = false;
        const host::SceneOnGpu scene(*gpu, shot.scene, shot.state);
        host::FrameRenderer renderer(scene, options);
        forEachFrame(shot, settings, [&](std::uint32_t index, bool first) {
            if (first) {
                std::for_each(shot.notices.begin(), shot.notices.end(), notice);
                truth.noteSizes();
            }
            const std::optional<fs::path> file = target.frame(index);
            if (!file) {
                return;
            }
            const std::vector<ImageF> masks = truth.ofAllLights();
            renderer.draw(shot.state, shot.eye, shot.lights, &masks);
            requireSilence(*gpu);
            writePicture(*file, renderer, settings, 0);
        });
    }
    requireSilence(*gpu);
    return truth.summary();
}

/// The ray tracer's mask as it is; nothing is drawn, so no GPU is asked for.
std::string writeTruth(Shot& shot, const Settings& settings, RenderTarget& target, std::size_t light)
{
    noteSizesWithoutEffect(shot, settings, {&shot.lights[light], 1});
    TruthMasks truth(shot, settings);
    forEachFrame(shot, settings, [&](std::uint32_t index, bool first) {
        if (first) {
            std::for_each(shot.notices.begin(), shot.notices.end(), notice);
            truth.noteSize(light);
        }
        if (const std::optional<fs::path> file = target.frame(index)) {
            const ImageF mask = truth.ofLight(light);
            requireNotInterrupted();
            writeMask(*file, mask);
        }
    });
    return truth.summary();
}

} // namespace

int runRender(const Settings& settings)
{
    const auto start = std::chrono::steady_clock::now();
    requireDebugView(settings);
    RenderTarget target(settings);
    Shot shot = makeShot(settings);
    const std::size_t light = lightIndex(shot, settings);
    glm::uvec2 size_px = settings.size_px;
    const std::string how = !settings.truth ? drawTechnique(shot, settings, target, light, size_px)
                            : settings.mask ? writeTruth(shot, settings, target, light)
                                            : drawTruth(shot, settings, target);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    writeStdout(sentence(settings, shot, target, size_px, how, seconds.count()));
    return 0;
}

} // namespace gnomon::app
