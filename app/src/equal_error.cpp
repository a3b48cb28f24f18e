// SPDX-License-Identifier: Apache-2.0
#include "equal_error.h"

#include "app/shot.h"
#include "technique_json.h"

#include <gnomon/choices.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace gnomon::app {
namespace {

constexpr std::array<std::uint32_t, 19> kMapSizes{16,  23,  32,   45,   64,   91,   128,  181,  256, 362,
                                                  512, 724, 1024, 1448, 2048, 2896, 4096, 5792, 8192};
static_assert(kMapSizes.front() == kEqualErrorMinMap && kMapSizes.back() == kEqualErrorMaxMap);

/// Texels that one pixel reads.
double tapsOf(const Settings& settings)
{
    switch (settings.shadow.pcf.kernel) {
    case PcfKernel::bilinear_2x2:
        return 4.0;
    case PcfKernel::gaussian_3x3:
    case PcfKernel::box_3x3:
    case PcfKernel::projected_3x3:
        return 9.0;
    case PcfKernel::gaussian_5x5:
        return 25.0;
    case PcfKernel::gaussian_7x7:
        return 49.0;
    case PcfKernel::poisson:
    case PcfKernel::vogel:
        break;
    }
    return settings.shadow.pcf.taps;
}

/// The base as plain PCF. A map format that PCF cannot store is dropped.
Settings plainPcf(const Settings& base)
{
    Settings plain = base;
    if (plain.shadow.format && refusal(Filter::pcf, *plain.shadow.format)) {
        plain.shadow.format.reset();
    }
    applySetting(plain, "filter", nameOf(kPlainTechnique.filter));
    applySetting(plain, "partition", nameOf(kPlainTechnique.partition));
    applySetting(plain, "fit", nameOf(kPlainTechnique.fit));
    applySetting(plain, "soften", nameOf(kPlainTechnique.soften));
    applySetting(plain, "motion", nameOf(kPlainTechnique.motion));
    return plain;
}

} // namespace

std::vector<PcfSetting> pcfLadder(const Settings& base, std::uint32_t max_side)
{
    const Settings plain = plainPcf(base);
    const double pixels = static_cast<double>(base.size_px.x) * static_cast<double>(base.size_px.y);
    std::vector<PcfSetting> ladder;
    for (const std::uint32_t map_size : kMapSizes) {
        for (const Setting& kernels : settingTable()) {
            if (kernels.key != "pcf.kernel" || map_size > max_side) {
                continue;
            }
            for (const std::string_view kernel : kernels.choices()) {
                PcfSetting rung{plain};
                applySetting(rung.settings, "map-size", fmt::format("{}", map_size));
                applySetting(rung.settings, "pcf.kernel", kernel);
                if (kernelWidth(rung.settings.shadow.pcf.kernel) < 0) {
                    continue; // kept for what was published: the same work as 3x3, not blended
                }
                completeTechnique(rung.settings);
                rung.work = static_cast<double>(map_size) * map_size + pixels * tapsOf(rung.settings);
                ladder.push_back(std::move(rung));
            }
        }
    }
    std::stable_sort(ladder.begin(), ladder.end(),
                     [](const PcfSetting& a, const PcfSetting& b) { return a.work < b.work; });
    return ladder;
}

bool isPlainPcf(const Settings& settings)
{
    return settings.shadow.technique == kPlainTechnique;
}

std::optional<std::size_t> firstWithin(std::size_t count, double rmse,
                                       const std::function<std::optional<double>(std::size_t)>& rmse_of,
                                       std::uint32_t& tried)
{
    for (std::size_t i = 0; i < count; ++i) {
        ++tried;
        const std::optional<double> found = rmse_of(i);
        if (found && *found <= rmse) {
            return i;
        }
    }
    return std::nullopt;
}

EqualErrorSearch::EqualErrorSearch(const host::SceneOnGpu& scene, const lab::Subject& subject,
                                   const truth::Traced& truth, const Settings& base, const std::function<void()>& step)
    : scene_(scene), subject_(subject), truth_(truth), base_(base), step_(step),
      ladder_(pcfLadder(base, scene.gpu().properties().limits.maxImageDimension2D)), rmse_(ladder_.size())
{
}

std::optional<double> EqualErrorSearch::rmseOf(std::size_t rung)
{
    if (!rmse_[rung]) {
        const lab::Score score =
            lab::scoreTechnique(scene_, subject_, truth_, renderOptions(ladder_[rung].settings), false);
        rmse_[rung] = score.error ? std::optional(score.error->rmse) : std::nullopt;
        step_();
    }
    return *rmse_[rung];
}

EqualError EqualErrorSearch::match(const Settings& technique, const std::optional<double>& rmse)
{
    EqualError result;
    if (isPlainPcf(technique)) {
        result.reason = "it is PCF itself";
        return result;
    }
    if (!rmse) {
        result.reason = "no pixel counts, so there is no error to match";
        return result;
    }
    const auto rung = firstWithin(
        ladder_.size(), *rmse, [&](std::size_t i) { return rmseOf(i); }, result.tried);
    if (!rung) {
        const std::uint32_t largest = std::min(kEqualErrorMaxMap, scene_.gpu().properties().limits.maxImageDimension2D);
        result.reason = fmt::format("no PCF on a map of {} to {} texels errs as little", kEqualErrorMinMap, largest);
        return result;
    }
    const Settings& pcf = ladder_[*rung].settings;
    result.pcf = describeTechnique(pcf);
    result.pcf_rmse = rmseOf(*rung);
    if (*rung == 0 && *result.pcf_rmse < *rmse) {
        result.reason = fmt::format("{}, the cheapest there is, errs less (rmse {:.4f})", result.pcf, *result.pcf_rmse);
        return result;
    }
    if (*rung > 0) {
        result.cheaper = describeTechnique(ladder_[*rung - 1].settings);
        result.cheaper_rmse = rmseOf(*rung - 1);
    }
    time(technique, pcf, result);
    return result;
}

void EqualErrorSearch::time(const Settings& technique, const Settings& pcf, EqualError& result)
{
    const std::vector<lab::Contestant> pair{{describeTechnique(technique), renderOptions(technique)},
                                            {result.pcf, renderOptions(pcf)}};
    const lab::TimingResult timed = lab::timeInTurn(
        scene_, subject_, pair, {.repetitions = base_.repetitions, .warmup = base_.warmup, .reuse_maps = false}, step_);
    const double technique_ms = frameMedian(timed.techniques[0].samples);
    const double pcf_ms = frameMedian(timed.techniques[1].samples);
    const double without_ms = frameMedian(timed.baseline.samples);
    result.technique_ms = technique_ms;
    result.pcf_ms = pcf_ms;
    result.without_ms = without_ms;
    if (!(pcf_ms > 0.0)) {
        result.reason = "the clock measured no time";
        return;
    }
    result.ratio = technique_ms / pcf_ms;
    if (technique_ms > without_ms && pcf_ms > without_ms) {
        result.shadow_ratio = (technique_ms - without_ms) / (pcf_ms - without_ms);
    }
}

} // namespace gnomon::app
