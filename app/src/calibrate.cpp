// SPDX-License-Identifier: Apache-2.0
// `gnomon calibrate`: how long this device takes for the parts of a frame that the size of maps changes (DeviceRates),
// measured once and kept beside the driver's cache.
#include "app/command_line.h"
#include "app/shot.h"
#include "app/visual.h"
#include "result_json.h"
#include "streams.h"
#include "subcommands.h"

#include "files/files.h"
#include "host/gpu.h"

#include <gnomon/device_rates.h>
#include <gnomon/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gnomon::app {
namespace {

constexpr double kNsOfMs = 1e6;
constexpr std::uint32_t kSmall = 1024; // sides of maps, texels
constexpr std::uint32_t kLarge = 4096;

/// A bench whose passes tell the rates apart.
Settings benchSettings(const Settings& asked)
{
    std::string techniques;
    for (const auto& [filter, side] :
         {std::pair("hard", kSmall), std::pair("hard", kLarge), std::pair("pcf", kSmall), std::pair("pcss", kSmall),
          std::pair("raymarch", kLarge), std::pair("vsm", kSmall)}) {
        techniques += fmt::format("{}filter={}+map-size={}", techniques.empty() ? "" : ",", filter, side);
    }
    std::vector<std::string> words{
        "bench", "rts",         "--camera",     "camp",     "--size",        "640x360", "--set",    "partition=single",
        "--set", "fit=uniform", "--techniques", techniques, "--repetitions", "3",       "--warmup", "1"};
    if (!asked.gpu.empty()) {
        words.insert(words.end(), {"--gpu", asked.gpu});
    }
    return parseCommandLine(words).settings;
}

/// The passes of one technique of the bench.
class Passes {
public:
    Passes(const Json& bench, std::string_view filter, std::uint32_t side)
    {
        for (const Json& result : bench.at("results")) {
            const Json& settings = result.at("settings");
            if (settings.at("filter") == filter && settings.at("map-size") == side) {
                passes_ = &result.at("passes");
            }
        }
    }
    /// 0 of a pass that there is not.
    [[nodiscard]] double ms(std::string_view pass) const
    {
        for (const Json& one : *passes_) {
            if (one.at("name") == pass && one.at("ms").is_number()) {
                return one.at("ms").get<double>();
            }
        }
        return 0.0;
    }

private:
    const Json* passes_ = nullptr;
};

double perUnit_ns(double ms, double units)
{
    return std::max(ms, 0.0) * kNsOfMs / std::max(units, 1.0);
}

DeviceRates ratesOfBench(const Json& bench, glm::uvec2 size_px, std::size_t objects)
{
    const Passes hard(bench, "hard", kSmall);
    const Passes large(bench, "hard", kLarge);
    const Passes rays(bench, "raymarch", kLarge);
    const Passes moments(bench, "vsm", kSmall);
    const double pixels = static_cast<double>(size_px.x) * size_px.y;
    const double small_texels = double{kSmall} * kSmall;
    const double large_texels = double{kLarge} * kLarge;
    const std::string maps = "shadow maps";
    DeviceRates rates;
    rates.source = RateSource::measured;
    rates.rest_ns = perUnit_ns(bench.at("baseline").at("time_ms").at("frame").get<double>(), pixels);
    rates.texel_ns = perUnit_ns(large.ms(maps) - hard.ms(maps), large_texels - small_texels);
    rates.caster_ns = perUnit_ns(hard.ms(maps) - rates.texel_ns * small_texels / kNsOfMs, static_cast<double>(objects));
    rates.block_texel_ns = perUnit_ns(rays.ms(maps) - large.ms(maps), large_texels);
    rates.moment_texel_ns = perUnit_ns(moments.ms(maps) + moments.ms("shadow filter") - hard.ms(maps), small_texels);
    rates.compare_ns = perUnit_ns(Passes(bench, "pcf", kSmall).ms("mask"), pixels);
    rates.search_ns = perUnit_ns(Passes(bench, "pcss", kSmall).ms("mask"), pixels);
    rates.ray_ns = perUnit_ns(rays.ms("mask"), pixels);
    return rates;
}

Json ratesJson(const DeviceRates& rates)
{
    return {{"rest_ns", rates.rest_ns},
            {"caster_ns", rates.caster_ns},
            {"texel_ns", rates.texel_ns},
            {"block_texel_ns", rates.block_texel_ns},
            {"moment_texel_ns", rates.moment_texel_ns},
            {"compare_ns", rates.compare_ns},
            {"search_ns", rates.search_ns},
            {"ray_ns", rates.ray_ns}};
}

std::string ratesText(const DeviceRates& rates)
{
    return fmt::format("  a pixel of a frame without shadows   {:10.3f} ns\n"
                       "  a caster drawn into a map            {:10.3f} ns\n"
                       "  a texel of a map                     {:10.3f} ns\n"
                       "  its blocks, for pcss and raymarch    {:10.3f} ns\n"
                       "  more of a filterable map             {:10.3f} ns\n"
                       "  a pixel of the mask of pcf           {:10.3f} ns\n"
                       "  of pcss                              {:10.3f} ns\n"
                       "  of raymarch                          {:10.3f} ns\n",
                       rates.rest_ns, rates.caster_ns, rates.texel_ns, rates.block_texel_ns, rates.moment_texel_ns,
                       rates.compare_ns, rates.search_ns, rates.ray_ns);
}

} // namespace

int runCalibrate(const Settings& settings)
{
    if (!settings.json.empty() && settings.json != "-") {
        requireWritable(settings.json);
    }
    const Settings bench = benchSettings(settings);
    const Json found = findByTiming(bench);
    const std::string device = found.at("device").get<std::string>() + ", " + found.at("driver").get<std::string>();
    const DeviceRates rates = ratesOfBench(found, bench.size_px, makeShot(bench).state.objects.size());
    if (rates.texel_ns == 0.0 || rates.compare_ns == 0.0) {
        throw Error("measuring the rates of " + device, "it gives no times of passes",
                    "--set rates=gpu or rates=software names a table");
    }
    const std::string file = openGpu(bench)->keepRates(rates).string();
    if (!settings.json.empty()) {
        writeResult(settings.json, jsonText({{"device", device}, {"file", file}, {"rates", ratesJson(rates)}}));
        return 0;
    }
    writeStdout(fmt::format("{}\n{}kept in {}; it goes by the table's again when that file is removed\n", device,
                            ratesText(rates), file));
    return 0;
}

} // namespace gnomon::app
