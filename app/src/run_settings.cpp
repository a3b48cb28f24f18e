// SPDX-License-Identifier: Apache-2.0
// Truth, time, the run itself and its results. A new option is one row here.
#include "app/scripted_path.h"
#include "debug_views.h"
#include "setting_rows.h"
#include "setting_values.h"

#include "files/files.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace gnomon::app {
namespace {

using enum SettingType;
using Group = SettingGroup;
using Value = SettingValue;

void applyTechniques(Settings& s, const Value& v)
{
    for (std::string_view piece : split(v.text, ',')) {
        piece.remove_prefix(std::min(piece.find_first_not_of(' '), piece.size()));
        piece = piece.substr(0, piece.find_last_not_of(' ') + 1);
        if (piece.empty()) {
            throw UsageError(
                fmt::format("--techniques: \"{}\" has a comma with no technique before or after it", v.text));
        }
        if (piece.front() == '@') { // the command line's to read, see applyTechniqueFile()
            throw UsageError(fmt::format("--techniques: {} stands alone, and on the command line only", piece));
        }
        if (std::find(s.techniques.begin(), s.techniques.end(), piece) != s.techniques.end()) {
            throw UsageError(fmt::format("--techniques: {} is listed twice", piece));
        }
        s.techniques.emplace_back(piece);
    }
    if (s.techniques.size() > 1 && std::find(s.techniques.begin(), s.techniques.end(), "all") != s.techniques.end()) {
        throw UsageError("--techniques: all stands alone; it is every filter and every kernel of pcf");
    }
}

struct Limit {
    std::string_view name;
    std::int64_t max;
    void (*set)(scene::Limits&, std::uint64_t);
};

template <auto member>
constexpr Limit limitOf(std::string_view name)
{
    using Number = std::remove_reference_t<decltype(std::declval<scene::Limits&>().*member)>;
    constexpr std::uint64_t kMost = 9'000'000'000'000'000'000;
    return {name, static_cast<std::int64_t>(std::min<std::uint64_t>(std::numeric_limits<Number>::max(), kMost)),
            [](scene::Limits& limits, std::uint64_t number) {
                limits.*member = static_cast<Number>(number);
            }};
}

void applyLimit(Settings& s, const Value& v)
{
    using Limits = scene::Limits;
    static constexpr std::array kLimits{
        limitOf<&Limits::max_file_bytes>("file-bytes"), limitOf<&Limits::max_total_bytes>("total-bytes"),
        limitOf<&Limits::max_image_side>("image-side"), limitOf<&Limits::max_node_depth>("node-depth"),
        limitOf<&Limits::max_count>("count"),           limitOf<&Limits::max_vertices>("vertices"),
        limitOf<&Limits::max_growth>("growth")};
    const std::size_t equals = v.text.find('=');
    const std::string_view name = std::string_view(v.text).substr(0, equals);
    std::vector<std::string_view> names;
    for (const Limit& limit : kLimits) {
        names.push_back(limit.name);
        if (limit.name != name) {
            continue;
        }
        const auto number =
            equals == std::string::npos ? std::nullopt : toInteger(std::string_view(v.text).substr(equals + 1));
        if (!number || *number < 1 || *number > limit.max) {
            throw UsageError(fmt::format("--limit: {} takes a whole number from 1 to {}", name, limit.max));
        }
        limit.set(s.limits, static_cast<std::uint64_t>(*number));
        return;
    }
    throw UsageError(fmt::format("--limit: there is no limit \"{}\"{}; it takes NAME=N with one of {}", name,
                                 suggestion(name, names), listed(names)));
}

bool hasTruth(const Settings& s)
{
    return s.truth.has_value();
}
bool isArea(const Settings& s)
{
    return s.truth == truth::Kind::area;
}
/// The ray tracer's mask is written unchanged, and a plan needs no drawing except for layers that follow drawn depths.
bool draws(const Settings& s)
{
    if (s.subcommand == kPlan) {
        return s.shadow.technique.filter == Filter::lvsm && followsDepths(s.shadow.moments.placement);
    }
    return !(s.mask && s.truth.has_value());
}
Names rateKinds()
{
    return {"auto", nameOf(RateSource::gpu), nameOf(RateSource::software)};
}
void applyRates(Settings& s, const Value& v)
{
    s.rates.reset();
    for (const RateSource source : {RateSource::gpu, RateSource::software}) {
        if (v.text == nameOf(source)) {
            s.rates = ratesOf(source);
        }
    }
}
bool sizesByTime(const Settings& s)
{
    return !s.shadow.map_size && !s.shadow.max_texels && hasMaps(s.shadow);
}
bool judgesALight(const Settings& s)
{
    return s.mask || (s.debug != "none" && s.debug != "light-count") || s.subcommand == kCompare || !s.draw.empty();
}

bool changesAtRest(const Settings& s)
{
    return s.learnsFromFrames() && !s.frames;
}

void applySamples(Settings& s, const Value& v)
{
    if (v.integer % truth::kSampleSets != 0) {
        throw UsageError(
            fmt::format("--samples: {} is not a multiple of {}: the rays of a pixel come in {} sets, whose "
                        "spread tells the standard error",
                        v.integer, truth::kSampleSets, truth::kSampleSets));
    }
    s.samples = static_cast<std::uint32_t>(v.integer);
}

[[noreturn]] void refuseSweep(std::string_view text, const std::string& why)
{
    throw UsageError(fmt::format("--sweep: \"{}\": {}", text, why));
}

const Setting& sweptSetting(std::string_view text, std::string_view key)
{
    std::vector<std::string_view> keys;
    for (const Setting& setting : settingTable()) {
        if (!canBeSwept(setting)) {
            continue;
        }
        if (setting.key == key) {
            return setting;
        }
        keys.push_back(setting.key);
    }
    refuseSweep(text, fmt::format("{} is no number that errors depend on{}; those are {}", key, suggestion(key, keys),
                                  listed(keys)));
}

double sweepEnd(std::string_view text, const Setting& setting, std::string_view end, bool logarithmic)
{
    const auto number = toNumber(end);
    if (!number || !(*number >= setting.min && *number <= setting.max)) {
        refuseSweep(
            text, fmt::format("\"{}\" is not in the range {} to {} of {}", end, setting.min, setting.max, setting.key));
    }
    if (setting.type == integer && std::fmod(*number, setting.multiple_of) != 0.0) {
        const std::string kind =
            setting.multiple_of == 1 ? "whole numbers" : fmt::format("multiples of {}", setting.multiple_of);
        refuseSweep(text, fmt::format("{} takes {}, of which \"{}\" is none", setting.key, kind, end));
    }
    if (logarithmic && !(*number > 0.0)) {
        refuseSweep(text, fmt::format("values by equal factors are above 0, which \"{}\" is not", end));
    }
    return *number;
}

void applyDraw(Settings& s, const Value& v)
{
    if (!hasExtension(v.text, ".svg")) {
        throw UsageError(fmt::format("--draw: \"{}\" does not end in .svg, which is what it is written as", v.text));
    }
    s.draw = v.text;
}

/// KEY=FROM:TO:STEPS[:log]
void applySweep(Settings& s, const Value& v)
{
    const std::size_t equals = v.text.find('=');
    const auto parts = split(equals == std::string::npos ? "" : std::string_view(v.text).substr(equals + 1), ':');
    if (parts.size() < 3 || parts.size() > 4 || (parts.size() == 4 && parts[3] != "log")) {
        refuseSweep(v.text, "it is not KEY=FROM:TO:STEPS or KEY=FROM:TO:STEPS:log");
    }
    const Setting& setting = sweptSetting(v.text, v.text.substr(0, equals));
    const bool logarithmic = parts.size() == 4;
    const double from = sweepEnd(v.text, setting, parts[0], logarithmic);
    const double to = sweepEnd(v.text, setting, parts[1], logarithmic);
    constexpr std::int64_t kMaxSteps = 1000;
    const auto steps = toInteger(parts[2]);
    if (!steps || *steps < 2 || *steps > kMaxSteps) {
        refuseSweep(v.text,
                    fmt::format("\"{}\" steps are not a whole number in the range 2 to {}", parts[2], kMaxSteps));
    }
    if (from == to) {
        refuseSweep(v.text, "it begins and ends at the same value");
    }
    const double most = std::abs(to - from) / setting.multiple_of + 1.0;
    if (setting.type == integer && static_cast<double>(*steps) > most) {
        refuseSweep(v.text, fmt::format("{} has only {} values from {} to {}", setting.key, most, from, to));
    }
    s.sweep = Sweep{std::string(setting.key), from, to, static_cast<std::uint32_t>(*steps), logarithmic};
}

std::vector<Offer> offeredPaths()
{
    std::vector<Offer> offers;
    for (const std::string_view name : pathNames()) {
        offers.push_back({name, ""});
    }
    return offers;
}

const std::vector<Setting>& rows()
{
    static const std::vector<Setting> table{
        // clang-format off
        {.key = "truth", .group = Group::truth, .type = choice, .form = "KIND", .choices = [] { return Names{"hard", "area"}; },
         .doc = "rays to the light's centre (hard) or over all of it (area)", .subcommands = kRender | kCompare | kView,
         .apply = [](Settings& s, const Value& v) { s.truth = v.text == "hard" ? truth::Kind::hard : truth::Kind::area; }},
        {.key = "samples", .group = Group::truth, .type = integer, .form = "N", .unit = "rays", .default_text = "256", .min = 4, .max = 65536, .multiple_of = truth::kSampleSets,
         .doc = "per pixel and light, a multiple of 4", .subcommands = kRender | kCompare | kView, .used = isArea, .used_when = "--truth area", .apply = applySamples},
        {.key = "truth-pixels", .group = Group::truth, .type = choice, .form = "PART", .default_text = "centre",
         .choices = [] { return Names{"centre", "area"}; },
         .doc = "at each pixel's centre, or the mean over its area", .subcommands = kRender | kCompare, .used = hasTruth, .used_when = "--truth",
         .apply = [](Settings& s, const Value& v) { s.truth_pixels = v.text == "area" ? truth::PixelTruth::area : truth::PixelTruth::centre; }},
        {.key = "no-cache", .group = Group::truth, .type = flag, .default_text = "0", .doc = "trace anew; neither read nor write the cache of truths",
         .subcommands = kRender | kCompare, .used = hasTruth, .used_when = "--truth", .apply = [](Settings& s, const Value& v) { s.no_cache = v.flag; }},

        {.key = "time", .group = Group::time, .type = real, .form = "SECONDS", .unit = "s", .default_text = "0", .min = -1e6, .max = 1e6,
         .doc = "moment of the scene's animation", .apply = [](Settings& s, const Value& v) { s.time_s = v.real; }},
        {.key = "frames", .group = Group::time, .type = range, .form = "A-B", .min = 0, .max = 999999,
         .doc = "frames A to B; frame N is at --time plus N / fps", .subcommands = kMoving,
         .apply = [](Settings& s, const Value& v) { s.frames = FrameRange{static_cast<std::uint32_t>(v.numbers[0]), static_cast<std::uint32_t>(v.numbers[1])}; }},
        {.key = "fps", .group = Group::time, .type = real, .form = "N", .unit = "1/s", .default_text = "30", .min = 0.001, .max = 1e4,
         .doc = "frames per second", .subcommands = kMoving, .used = [](const Settings& s) { return s.frames.has_value(); },
         .used_when = "--frames", .apply = [](Settings& s, const Value& v) { s.fps = v.real; }},
        {.key = "path", .group = Group::time, .type = text, .form = "NAME|FILE", .doc = "pan, orbit, dolly, zoom, day or keys: what moves over --frames", .subcommands = kMoving,
         .offers = offeredPaths, .files = "json", .apply = [](Settings& s, const Value& v) { s.path = v.text; }},
        {.key = "path.speed", .group = Group::time, .type = real, .form = "FACTOR", .default_text = "1", .min = 0.001, .max = 1000,
         .doc = "how many seconds of the path pass in one", .subcommands = kMoving, .own_option = false, .used = [](const Settings& s) { return !s.path.empty(); }, .used_when = "--path",
         .apply = [](Settings& s, const Value& v) { s.path_speed = v.real; }},
        {.key = "converge", .group = Group::time, .type = integer, .form = "N", .unit = "frames", .default_text = "1", .min = 1, .max = 65536,
         .doc = "draw this many at rest; the last counts", .subcommands = kRender | kCompare, .used = changesAtRest,
         .used_when = "soften converge or partition virtual, and without --frames", .apply = [](Settings& s, const Value& v) { s.converge = static_cast<std::uint32_t>(v.integer); }},
        {.key = "animation", .group = Group::time, .type = text, .form = "NAME", .doc = "which animation of the file plays; else the first",
         .names_in = [](const scene::Scene& in) { return namesIn(in.animations); }, .apply = [](Settings& s, const Value& v) { s.animation = v.text; }},

        {.key = "seed", .group = Group::run, .type = integer, .form = "N", .default_text = "1", .min = 0, .max = 9e15,
         .doc = "everything random", .apply = [](Settings& s, const Value& v) { s.seed = static_cast<std::uint64_t>(v.integer); }},
        {.key = "gpu", .group = Group::run, .type = text, .form = "NAME", .doc = "part of a GPU's name, or software; else the first real one",
         .subcommands = kFrames | kCalibrate, .used = draws, .used_when = "something to draw", .offers = [] { return std::vector<Offer>{{"software", "the software rasteriser"}}; }, .apply = [](Settings& s, const Value& v) { s.gpu = v.text; }},
        {.key = "rates", .group = Group::run, .type = choice, .form = "KIND", .default_text = "auto", .choices = rateKinds, .doc = "how fast the device is, to auto: as calibrate found it, or the table's: gpu or software",
         .own_option = false, .used = sizesByTime, .used_when = "map-size and texels auto, but filter volumes", .apply = applyRates},
        {.key = "validate", .group = Group::run, .type = flag, .default_text = "0", .doc = "Vulkan validation; a message makes the run fail",
         .used = draws, .used_when = "something to draw", .apply = [](Settings& s, const Value& v) { s.validate = v.flag; }},
        {.key = "strict", .group = Group::run, .type = flag, .default_text = "0", .doc = "refuse options without effect, which are told else",
         .command_line_only = true, .apply = [](Settings& s, const Value& v) { s.strict = v.flag; }},
        {.key = "limit", .group = Group::run, .type = text, .form = "NAME=N", .doc = "raise a limit of the scene reader, as its message says", .repeatable = true,
         .apply = applyLimit},

        {.key = "out", .group = Group::result, .type = text, .form = "FILE", .doc = "picture (.png, .exr; gnomon.png), last of --frames; folder for all",
         .subcommands = kRender, .command_line_only = true, .letter = 'o', .files = "png exr", .apply = [](Settings& s, const Value& v) { s.output = v.text; }},
        {.key = "mask", .group = Group::result, .type = flag, .default_text = "0", .doc = "write the visibility of one light instead of the picture",
         .subcommands = kRender, .apply = [](Settings& s, const Value& v) { s.mask = v.flag; }},
        {.key = "debug", .group = Group::result, .type = choice, .form = "VIEW", .default_text = "none", .choices = debugViewNames,
         .doc = "density faded layers light-count map octree rays steps views", .subcommands = kRender | kView, .apply = [](Settings& s, const Value& v) { s.debug = v.text; }},
        {.key = "light", .group = Group::result, .type = text, .form = "NAME", .doc = "the light that is looked at; else the first", .subcommands = kRender | kPlan | kCompare | kView,
         .used = judgesALight, .used_when = "--mask, a --debug of one light or --draw, or in compare", .names_in = [](const scene::Scene& in) { return namesIn(in.lights); }, .apply = [](Settings& s, const Value& v) { s.light = v.text; }},
        {.key = "draw", .group = Group::result, .type = text, .form = "FILE", .doc = "a picture of the light's maps instead of the JSON (.svg)",
         .subcommands = kPlan, .command_line_only = true, .files = "svg", .apply = applyDraw},
        {.key = "techniques", .group = Group::result, .type = text, .form = "LIST|@FILE", .doc = "which ones: hard,pcf+pcf.kernel=5x5,... or all; @FILE: a line each",
         .subcommands = kBench | kCompare, .repeatable = true, .separator = ",", .offers = [] { return std::vector<Offer>{{"all", "every filter, and pcf with every kernel"}}; }, .apply = applyTechniques},
        {.key = "repetitions", .group = Group::result, .type = integer, .form = "N", .default_text = "11", .min = 1, .max = 100000,
         .doc = "timed frames of each technique", .subcommands = kBench | kCompare,
         .apply = [](Settings& s, const Value& v) { s.repetitions = static_cast<std::uint32_t>(v.integer); }},
        {.key = "warmup", .group = Group::result, .type = integer, .form = "N", .default_text = "2", .min = 0, .max = 100000,
         .doc = "frames of each technique before them", .subcommands = kBench | kCompare,
         .apply = [](Settings& s, const Value& v) { s.warmup = static_cast<std::uint32_t>(v.integer); }},
        {.key = "report", .group = Group::result, .type = text, .form = "DIR", .doc = "folder for a page with pictures and the table",
         .subcommands = kBench | kCompare, .command_line_only = true, .files = "/", .apply = [](Settings& s, const Value& v) { s.report = v.text; }},
        {.key = "against", .group = Group::result, .type = text, .form = "FILE", .doc = "what has grown since an earlier --json; status 1 if counters have",
         .subcommands = kBench, .command_line_only = true, .files = "json", .apply = [](Settings& s, const Value& v) { s.against = v.text; }},
        {.key = "equal-error", .group = Group::result, .type = flag, .default_text = "0", .doc = "time the cheapest pcf that is as near to the truth, too",
         .subcommands = kCompare, .apply = [](Settings& s, const Value& v) { s.equal_error = v.flag; }},
        {.key = "sweep", .group = Group::result, .type = text, .form = "KEY=FROM:TO:STEPS[:log]", .doc = "the error of each technique over values of any number",
         .subcommands = kCompare, .apply = applySweep},
        {.key = "json", .group = Group::result, .type = text, .form = "[FILE]", .doc = "JSON to FILE (*.json), or to stdout with - or nothing",
         .subcommands = kPlan | kBench | kList | kCompare | kMetrics | kGpus | kCalibrate, .command_line_only = true, .files = "json", .apply = [](Settings& s, const Value& v) { s.json = v.text; }},
        // clang-format on
    };
    return table;
}

} // namespace

bool canBeSwept(const Setting& setting)
{
    return (setting.type == integer || setting.type == real) && setting.group != Group::result &&
           (setting.subcommands & kCompare) != 0;
}

void addRunRows(std::vector<Setting>& table)
{
    table.insert(table.end(), rows().begin(), rows().end());
}

} // namespace gnomon::app
