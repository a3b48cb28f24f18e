// SPDX-License-Identifier: Apache-2.0
#include "view/background_truth.h"

#include "lab/compare.h"
#include "truth_run.h"

#include <algorithm>
#include <exception>
#include <system_error>
#include <utility>

namespace gnomon::app::view {
namespace {

/// How many rays one after the other: each level has four times as many as the one before, and the last has all.
std::vector<std::uint32_t> levelsOf(const truth::Options& options)
{
    if (options.kind == truth::Kind::hard) {
        return {options.samples};
    }
    constexpr std::uint32_t kMore = 4;
    std::vector<std::uint32_t> levels;
    for (std::uint32_t rays = truth::kSampleSets; rays < options.samples; rays *= kMore) {
        levels.push_back(rays);
    }
    levels.push_back(options.samples);
    return levels;
}

} // namespace

/// All that a trace needs, so that the window may go on with the shot.
struct BackgroundTruth::Work {
    scene::State state;
    host::Eye eye;
    std::vector<host::ShadedLight> lights;
    glm::uvec2 size_px{0};
    truth::Options options;
    std::size_t judged = 0;
};

BackgroundTruth::BackgroundTruth(const scene::Scene& scene) : scene_(scene) {}

BackgroundTruth::~BackgroundTruth()
{
    stop();
}

void BackgroundTruth::stop()
{
    cancel_ = true;
    if (thread_.joinable()) {
        thread_.join();
    }
    cancel_ = false;
    progress_ = 1.0;
    const std::scoped_lock lock(mutex_);
    ready_.reset();
    fault_.clear();
}

void BackgroundTruth::begin(const Shot& shot, const Settings& settings, std::size_t light)
{
    stop();
    Work work{shot.state, shot.eye, shot.lights, settings.size_px, truthOptions(settings), light};
    work.options.threads = std::max(1U, std::thread::hardware_concurrency() / 2); // the window wants to go on, too
    progress_ = 0.0;
    const auto traceAll = [this, all = std::move(work)] {
        try {
            trace(all);
        } catch (const std::exception& error) {
            const std::scoped_lock lock(mutex_);
            fault_ = error.what();
        }
        progress_ = 1.0;
    };
    try {
        thread_ = std::thread(traceAll);
    } catch (const std::system_error& error) { // no thread is to be had
        progress_ = 1.0;
        const std::scoped_lock lock(mutex_);
        fault_ = error.what();
    }
}

void BackgroundTruth::trace(const Work& work)
{
    truth::Options options = work.options;
    options.cancel = &cancel_;
    const truth::Tracer tracer(scene_, work.state, options);
    const lab::Subject first{&scene_, &work.state, work.eye, work.lights, 0};
    const truth::View view = lab::truthView(first, work.size_px);
    std::optional<truth::Surfaces> surfaces = cancel_ ? std::nullopt : tracer.see(view, options);
    const std::vector<std::uint32_t> levels = levelsOf(options);
    for (std::size_t i = 0; i < levels.size() && surfaces && !cancel_; ++i) {
        options.samples = levels[i];
        Level level;
        level.rays = truth::raysPerPixel(options);
        level.is_last = i + 1 == levels.size();
        for (std::uint32_t light = 0; light < work.lights.size(); ++light) {
            if (!work.lights[light].caster.casts_shadow) {
                level.masks.emplace_back(work.size_px.x, work.size_px.y, 1U, 1.0F);
                continue;
            }
            const lab::Subject subject{&scene_, &work.state, work.eye, work.lights, light};
            auto visibility = tracer.trace(*surfaces, view, lab::truthLight(subject), options);
            if (!visibility) {
                return; // cancelled
            }
            level.masks.push_back(visibility->visibility);
            if (light == work.judged) {
                level.judged = truth::Traced{*surfaces, std::move(*visibility)};
            }
        }
        progress_ = static_cast<double>(i + 1) / static_cast<double>(levels.size());
        const std::scoped_lock lock(mutex_);
        ready_ = std::move(level);
    }
}

std::optional<BackgroundTruth::Level> BackgroundTruth::take()
{
    const std::scoped_lock lock(mutex_);
    return std::exchange(ready_, std::nullopt);
}

std::string BackgroundTruth::fault() const
{
    const std::scoped_lock lock(mutex_);
    return fault_;
}

} // namespace gnomon::app::view
