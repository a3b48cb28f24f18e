// SPDX-License-Identifier: Apache-2.0
// `gnomon bench`: times of techniques on one frame, interleaved in one process, against the frame without shadows.
#include "app/shot.h"
#include "app/visual.h"
#include "bench_report.h"
#include "progress.h"
#include "subcommands.h"

#include "image/image_io.h"

#include <gnomon/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <memory>

namespace gnomon::app {
namespace {

constexpr std::string_view kAll[] = {"hard",
                                     "pcf+pcf.kernel=2x2",
                                     "pcf+pcf.kernel=3x3",
                                     "pcf+pcf.kernel=5x5",
                                     "pcf+pcf.kernel=7x7",
                                     "pcf+pcf.kernel=poisson",
                                     "pcf+pcf.kernel=vogel"};

/// Whether the options and presets say themselves which technique it is: by what the default list would override.
bool namesOneTechnique(const Settings& settings)
{
    return std::any_of(settings.named.begin(), settings.named.end(),
                       [](const std::string& key) { return key == "filter" || key.starts_with("pcf."); });
}

std::vector<Settings> contestants(const Settings& settings)
{
    if (settings.techniques.empty() && namesOneTechnique(settings)) {
        return {settings};
    }
    std::vector<std::string> texts = settings.techniques;
    if (texts.empty() || texts.front() == "all") {
        texts.assign(std::begin(kAll), std::end(kAll));
    }
    std::vector<Settings> made;
    for (const std::string& text : texts) {
        made.push_back(parseTechnique(settings, text));
        for (std::size_t i = 0; i + 1 < made.size(); ++i) {
            if (describeTechnique(made[i]) == describeTechnique(made.back())) {
                throw UsageError(fmt::format("--techniques: {} and {} are the same technique", texts[i], text));
            }
        }
    }
    return made;
}

std::uint64_t totalBytes(const host::Renderer& renderer)
{
    std::uint64_t total = 0;
    for (const vulkan::MemoryUse& use : renderer.memory()) {
        total += use.bytes;
    }
    return total;
}

/// What one technique needs beyond the frame without shadows, by purpose.
std::vector<std::pair<std::string, std::uint64_t>> addedMemory(const host::Renderer& technique,
                                                               const host::Renderer& baseline)
{
    std::vector<std::pair<std::string, std::uint64_t>> added;
    for (const vulkan::MemoryUse& use : technique.memory()) {
        std::uint64_t before = 0;
        for (const vulkan::MemoryUse& other : baseline.memory()) {
            before += std::string_view(other.purpose) == use.purpose ? other.bytes : 0;
        }
        if (use.bytes > before) {
            added.emplace_back(use.purpose, use.bytes - before);
        }
    }
    return added;
}

TexelDensity densityOf(host::Renderer& renderer, const Shot& shot, const Settings& settings)
{
    const host::Picture picture = renderer.read({.colour = false, .linear = false, .masks = false, .geometry = true});
    const Camera camera = host::cameraOf(shot.eye, settings.size_px.x, settings.size_px.y, shot.state.bounds_ws);
    const std::vector<Light> lights = castersOf(shot);
    return texelDensity(picture, camera, renderer.plan(), lights, 0);
}

/// Draws every renderer once in turn, again and again, so that whatever slows the machine down hits all alike. Every
/// other round goes backwards, so that none always follows the same one.
void drawInTurn(std::vector<std::unique_ptr<host::Renderer>>& renderers, const Shot& shot, const Settings& settings,
                std::vector<std::vector<host::FrameTimes>>& samples, const host::Gpu& gpu, Progress& progress)
{
    samples.assign(renderers.size(), {});
    for (std::uint32_t round = 0; round < settings.warmup + settings.repetitions; ++round) {
        for (std::size_t turn = 0; turn < renderers.size(); ++turn) {
            const std::size_t i = round % 2 == 0 ? turn : renderers.size() - 1 - turn;
            host::FrameTimes times = renderers[i]->draw(shot.state, shot.eye, shot.lights);
            requireSilence(gpu);
            progress.step();
            if (round >= settings.warmup) {
                samples[i].push_back(std::move(times));
            }
        }
    }
}

/// The first renderer draws without shadows, the others one technique each.
std::vector<std::unique_ptr<host::Renderer>> makeRenderers(host::Gpu& gpu, const Shot& shot, const Settings& base,
                                                           const std::vector<Settings>& techniques, bool reuse_maps)
{
    std::vector<std::unique_ptr<host::Renderer>> renderers;
    for (std::size_t i = 0; i <= techniques.size(); ++i) {
        host::RenderOptions options = renderOptions(i == 0 ? base : techniques[i - 1]);
        options.shadows = i != 0;
        options.reuse_maps = reuse_maps;
        renderers.push_back(std::make_unique<host::Renderer>(gpu, shot.scene, shot.state, options));
    }
    return renderers;
}

BenchResult measure(host::Gpu& gpu, const Shot& shot, const Settings& settings, const std::vector<Settings>& techniques)
{
    BenchResult result;
    const std::size_t frames = 2 * (techniques.size() + 1) * (settings.warmup + settings.repetitions);
    Progress progress("timing", frames);
    std::vector<std::vector<host::FrameTimes>> samples;
    {
        auto renderers = makeRenderers(gpu, shot, settings, techniques, false);
        drawInTurn(renderers, shot, settings, samples, gpu, progress);
        result.baseline = samples[0];
        result.baseline_bytes = totalBytes(*renderers[0]);
        for (std::size_t i = 0; i < techniques.size(); ++i) {
            BenchedTechnique benched;
            benched.settings = techniques[i];
            benched.redrawn = samples[i + 1];
            benched.memory = addedMemory(*renderers[i + 1], *renderers[0]);
            benched.counters = countersOf(samples[i + 1].back(), renderers[i + 1]->plan(), true);
            benched.atlas = renderers[i + 1]->plan().atlas;
            benched.density = densityOf(*renderers[i + 1], shot, settings);
            result.techniques.push_back(std::move(benched));
        }
    }
    auto renderers = makeRenderers(gpu, shot, settings, techniques, true);
    drawInTurn(renderers, shot, settings, samples, gpu, progress);
    for (std::size_t i = 0; i < techniques.size(); ++i) {
        result.techniques[i].reused = samples[i + 1];
    }
    result.reused_baseline = samples[0];
    return result;
}

} // namespace

int runBench(const Settings& settings)
{
    if (!settings.json.empty() && settings.json != "-") {
        requireWritable(settings.json);
    }
    const std::vector<Settings> techniques = contestants(settings);
    const Shot shot = makeShot(settings);
    const auto gpu = openGpu(settings);
    for (const std::string& text : shot.notices) {
        notice(text);
    }
    BenchResult result = measure(*gpu, shot, settings, techniques);
    requireSilence(*gpu);
    result.device = gpu->properties().deviceName;
    result.driver = gpu->driver();
    if (settings.json.empty()) {
        writeStdout(benchTable(result, shot, settings));
    } else {
        writeResult(settings.json, benchJson(result, shot, settings).dump(2) + "\n");
    }
    return 0;
}

} // namespace gnomon::app
