// SPDX-License-Identifier: Apache-2.0
#include "truth_masks.h"

#include "streams.h"

#include <gnomon/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace gnomon::app {
namespace {

/// "6144", "22.1 million".
std::string countText(double count)
{
    return count < 1e6 ? fmt::format("{:.0f}", count) : fmt::format("{:.3g} million", count / 1e6);
}

constexpr std::uint32_t kMaxSidePx = 16384; // as the cache of truths and the reader of images have it

} // namespace

TruthMasks::TruthMasks(const Shot& shot, const Settings& settings)
    : shot_(shot), settings_(settings), tracer_(shot, settings), moves_(shot.moves)
{
    if (std::max(settings.size_px.x, settings.size_px.y) > kMaxSidePx) {
        throw Error(fmt::format("tracing {}x{} pixels", settings.size_px.x, settings.size_px.y),
                    fmt::format("a truth has at most {} on a side", kMaxSidePx));
    }
}

ImageF TruthMasks::take(std::size_t light)
{
    if (shot_.moves != moves_) {
        moves_ = shot_.moves;
        tracer_.moved();
    }
    TruthRun run = tracer_.trace(light);
    ++traces_;
    from_cache_ += run.from_cache ? 1 : 0;
    rays_ += run.rays;
    seconds_ += run.seconds;
    const truth::Visibility& visibility = run.traced.visibility;
    for (std::size_t i = 0; i < visibility.standard_error.values.size(); ++i) {
        if (run.traced.surfaces.object_ids.values[i] != 0) {
            const double error = visibility.standard_error.values[i];
            squared_error_ += error * error;
            ++pixels_;
        }
    }
    tracer_.takeBack(std::move(run.traced.surfaces));
    return std::move(run.traced.visibility.visibility);
}

ImageF TruthMasks::ofLight(std::size_t light)
{
    light_name_ = shot_.lights[light].name;
    if (!shot_.lights[light].caster.casts_shadow) {
        throw Error("tracing the mask of light " + light_name_, "it casts no shadow");
    }
    return take(light);
}

std::vector<ImageF> TruthMasks::ofAllLights()
{
    std::vector<ImageF> masks;
    for (std::size_t i = 0; i < shot_.lights.size(); ++i) {
        masks.push_back(
            shot_.lights[i].caster.casts_shadow ? take(i) : ImageF(settings_.size_px.x, settings_.size_px.y, 1, 1.0F));
    }
    return masks;
}

void TruthMasks::noteSizes() const
{
    for (std::size_t i = 0; i < shot_.lights.size(); ++i) {
        noteSize(i);
    }
}

void TruthMasks::noteSize(std::size_t light) const
{
    const host::ShadedLight& source = shot_.lights[light];
    if (settings_.truth == truth::Kind::area && source.caster.casts_shadow && isPointLike(source.caster)) {
        notice(fmt::format("light {} has no size, so that its area truth is the same as hard; {} gives it one",
                           source.name, source.caster.type == LightType::directional ? "--sun-angle" : "--light-size"));
    }
}

std::string TruthMasks::summary() const
{
    const bool area = settings_.truth == truth::Kind::area;
    std::string text = fmt::format("truth {}", area ? "area" : "hard");
    if (!light_name_.empty()) {
        text += " of light " + light_name_;
    }
    const bool over_pixels = settings_.truth_pixels == truth::PixelTruth::area;
    if (area || over_pixels) {
        text += fmt::format(", {} rays per pixel{}, standard error {:.2g}",
                            truth::raysPerPixel(truthOptions(settings_)), over_pixels ? " over its area" : "",
                            pixels_ == 0 ? 0.0 : std::sqrt(squared_error_ / static_cast<double>(pixels_)));
    }
    const auto rays = static_cast<double>(rays_);
    text += fmt::format(", {} rays", countText(rays));
    if (seconds_ > 0.0) {
        text += fmt::format(" at {} a second", countText(rays / seconds_));
    }
    if (from_cache_ == traces_ && traces_ != 0) {
        return text + ", from the cache";
    }
    return from_cache_ == 0 ? text : text + fmt::format(", {} of {} from the cache", from_cache_, traces_);
}

} // namespace gnomon::app
