// SPDX-License-Identifier: Apache-2.0
#include "technique_json.h"

#include "contestants.h"
#include "lab/passes.h"
#include "lab/score/traffic.h"

#include <gnomon/pack/filter_rule.h>
#include <gnomon/plan_views.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace gnomon::app {
namespace {

/// A stage of lab::StageTimes by its name in results.
struct Stage {
    std::string_view name;
    std::optional<double> lab::StageTimes::*member;
};
constexpr std::array kStages{Stage{"plan", &lab::StageTimes::plan}, Stage{"maps", &lab::StageTimes::maps},
                             Stage{"filter", &lab::StageTimes::filter}, Stage{"mask", &lab::StageTimes::mask},
                             Stage{"frame", &lab::StageTimes::frame}};

using Record = vulkan::PassRecord;
/// A count of each pass by its name in results.
struct PassCount {
    std::string_view name;
    std::uint64_t (*of)(const Record&);
    bool by_device; // nothing where PassRecord::has_statistics is false
};
constexpr std::array kPassCounts{
    PassCount{"vertex_invocations", [](const Record& r) { return r.vertex_invocations; }, true},
    PassCount{"primitives", [](const Record& r) { return r.primitives; }, true},
    PassCount{"fragment_invocations", [](const Record& r) { return r.fragment_invocations; }, true},
    PassCount{"compute_invocations", [](const Record& r) { return r.compute_invocations; }, true},
    PassCount{"draws", [](const Record& r) { return std::uint64_t{r.draws}; }, false}};

/// Milliseconds, and their ratios: a tenth of a microsecond is all that a clock gives; more digits would only look
/// exact.
double rounded(double value)
{
    return std::round(value * 1e4) / 1e4;
}

/// Milliseconds; zeros without samples, nothing where the device does not measure it.
std::optional<lab::Spread> spreadOfStage(const std::vector<host::FrameTimes>& samples, const Stage& stage)
{
    std::vector<std::optional<double>> values;
    values.reserve(samples.size());
    for (const host::FrameTimes& sample : samples) {
        values.push_back(lab::stagesOf(sample).*stage.member);
    }
    return lab::spreadOfMeasured(values);
}

} // namespace

std::vector<std::string> notMeasured(const std::vector<host::FrameTimes>& samples)
{
    std::vector<std::string> missing;
    const auto lacks = [&](auto&& is_there) {
        return std::ranges::any_of(samples, [&](const host::FrameTimes& frame) {
            return std::ranges::any_of(frame.passes, [&](const Record& pass) { return !is_there(pass); });
        });
    };
    if (lacks([](const Record& pass) { return pass.milliseconds.has_value(); })) {
        missing.emplace_back("times of passes are not measured on this device: its queue has no timestamps");
    }
    if (lacks([](const Record& pass) { return pass.has_statistics; })) {
        missing.emplace_back("invocations are not measured on this device: it has no pipelineStatisticsQuery");
    }
    return missing;
}

Json numberJson(double value)
{
    return std::isfinite(value) ? Json(value + 0.0) : Json(nullptr); // minus nothing is nothing
}

Json numberJson(const std::optional<double>& value)
{
    return value ? numberJson(*value) : Json(nullptr);
}

Json vectorJson(const glm::dvec3& vector)
{
    return Json::array({numberJson(vector.x), numberJson(vector.y), numberJson(vector.z)});
}

double frameMedian(const std::vector<host::FrameTimes>& samples)
{
    return spreadOfStage(samples, kStages.back()).value_or(lab::Spread()).median;
}

void addTimes(Json& json, const std::string& prefix, const std::vector<host::FrameTimes>& samples)
{
    for (const Stage& stage : kStages) {
        const std::optional<lab::Spread> spread = spreadOfStage(samples, stage);
        json[prefix + "time_ms"][std::string(stage.name)] = spread ? Json(rounded(spread->median)) : Json(nullptr);
        json[prefix + "iqr_ms"][std::string(stage.name)] =
            spread && samples.size() > 1 ? Json(rounded(spread->iqr)) : Json(nullptr);
    }
}

void addMemory(Json& json, const MemoryByPurpose& memory)
{
    std::uint64_t total = 0;
    Json by_purpose = Json::object();
    for (const auto& [purpose, bytes] : memory) {
        total += bytes;
        by_purpose[purpose] = bytes;
    }
    json["memory_bytes"] = total;
    json["memory_by_purpose_bytes"] = std::move(by_purpose);
}

Json mapJson(const MapPages& atlas, const ShadowOptions& options)
{
    const std::uint32_t image_layers = imageLayersPerMap(filterOf(options), options.moments);
    const std::uint32_t levels = pack::mipLevels(resolvedOrThrow(options), atlas.width, atlas.height);
    std::uint64_t stored = 0; // texels of one layer
    for (std::uint32_t level = 0; level < levels; ++level) {
        stored += std::uint64_t{std::max(atlas.width >> level, 1U)} * std::max(atlas.height >> level, 1U);
    }
    const bool is_empty = atlas.width == 0 || atlas.height == 0;
    return {{"texels", std::uint64_t{atlas.width} * atlas.height * atlas.layers},
            {"bytes", is_empty ? 0 : stored * atlas.layers * image_layers * texelBytes(formatOf(options))},
            {"format", nameOf(formatOf(options))},
            {"image_layers", atlas.layers * image_layers},
            {"mip_levels", levels}};
}

Json cascadePassJson(const lab::Timed& timed)
{
    if (!timed.samples.empty() && timed.samples.back().reuse.together > 0) {
        return nameOf(CascadePass::layered);
    }
    for (std::uint32_t i = 0; i < timed.plan.views.size(); ++i) {
        if (viewsTogether(timed.plan, i, true) > 1) {
            return nameOf(CascadePass::each);
        }
    }
    return nullptr;
}

Json passesJson(const lab::Timed& timed)
{
    const double frame_ms = frameMedian(timed.samples);
    Json passes = Json::array();
    for (const lab::PassWork& pass : lab::passesOf(timed.samples, timed.least)) {
        Json json{{"name", pass.name}, {"ms", pass.ms ? Json(rounded(pass.ms->median)) : Json(nullptr)}};
        json["iqr_ms"] = pass.ms && timed.samples.size() > 1 ? Json(rounded(pass.ms->iqr)) : Json(nullptr);
        json["share"] = pass.ms && frame_ms > 0.0 ? Json(rounded(pass.ms->median / frame_ms)) : Json(nullptr);
        for (const PassCount& count : kPassCounts) {
            json[std::string(count.name)] =
                count.by_device && !pass.sum.has_statistics ? Json(nullptr) : Json(count.of(pass.sum));
        }
        json["texels"] = pass.least ? Json(pass.least->texels) : Json(nullptr);
        json["bytes_minimum"] = pass.least ? Json(pass.least->bytes) : Json(nullptr);
        passes.push_back(std::move(json));
    }
    return passes;
}

Json frameRatioJson(const lab::Timed& technique)
{
    const double ratio = lab::frameRatio(technique);
    return ratio > 0.0 ? numberJson(rounded(ratio)) : Json(nullptr);
}

Json fitEfficiencyJson(const lab::TexelDensity& density, double fit_efficiency)
{
    return density.counted == 0 ? Json(nullptr) : numberJson(fit_efficiency);
}

Json sharedUnitsJson()
{
    return {{"frame_ratio", "median frame / median frame without shadows"},
            {"texel_density", "shadow texels per screen pixel along the worse axis"},
            {"texel_density.facing", "the same, if surfaces faced eye and light; share of pixels with 1 to 4"},
            {"fit_efficiency", "texels read / texels rendered"},
            {"eye.near_m", "metres; 0: a 20000th of the scene's diagonal, or a 100th of the way to the target"},
            {"eye.far_m", "metres; 0: behind everything"},
            {"map.texels", "places in all maps: texels of the finest level, however many image layers each takes"},
            {"map.bytes", "bytes of the maps' image: all image layers and mip levels"},
            {"cascade_pass", "how cascades were drawn when the times were taken: each, layered; null: there are none"},
            {"counters.filter_bytes", "bytes that the blur reads and writes"},
            {"pixels", "pixels"}};
}

Json countersJson(const lab::Counters& counters)
{
    const vulkan::FilterCost& filter = counters.filter;
    const double least = static_cast<double>(filter.bytes_minimum);
    const double ratio = least > 0.0 ? static_cast<double>(filter.bytes_moved) / least : 0.0;
    const auto counted = [&](std::uint64_t count) {
        return counters.has_statistics ? Json(count) : Json(nullptr);
    };
    return {{"texels_rendered", counters.texels_rendered},
            {"texels_filtered", filter.texels},
            {"filter_taps", filter.taps},
            {"filter_bytes", filter.bytes_moved},
            {"filter_bytes_minimum", filter.bytes_minimum},
            {"filter_bytes_ratio", ratio > 0.0 ? numberJson(rounded(ratio)) : Json(nullptr)},
            {"blur_path", filter.texels > 0 ? Json(nameOf(filter.path)) : Json(nullptr)},
            {"vertex_invocations", counted(counters.vertex_invocations)},
            {"primitives", counted(counters.primitives)},
            {"fragment_invocations", counted(counters.fragment_invocations)},
            {"compute_invocations", counted(counters.compute_invocations)},
            {"draws", counters.draws},
            {"passes", counters.passes},
            {"bytes_minimum", counters.bytes_minimum}};
}

std::vector<ReuseCounter> reuseCounters(const std::vector<host::FrameTimes>& samples)
{
    using Reuse = vulkan::MapReuse;
    std::vector<ReuseCounter> counters;
    const auto add = [&](std::string_view name, std::string_view title, auto Reuse::*member) {
        double sum = 0.0;
        for (const host::FrameTimes& sample : samples) {
            sum += static_cast<double>(sample.reuse.*member);
        }
        counters.push_back({name, title, samples.empty() ? 0.0 : sum / static_cast<double>(samples.size())});
    };
    add("maps_drawn", "drawn", &Reuse::drawn);
    add("maps_restored", "restored", &Reuse::restored);
    add("maps_held", "untouched", &Reuse::held);
    add("kept_maps_drawn", "kept drawn", &Reuse::kept_drawn);
    add("texels_restored", "restored texels", &Reuse::restored_texels);
    add("casters_at_once", "casters", &Reuse::casters_at_once);
    add("still_casters", "still", &Reuse::still_casters);
    add("moving_casters", "moving", &Reuse::moving_casters);
    return counters;
}

Json reuseJson(const std::vector<host::FrameTimes>& samples)
{
    Json json = Json::object();
    for (const ReuseCounter& counter : reuseCounters(samples)) {
        json[std::string(counter.name)] = numberJson(counter.mean);
    }
    return json;
}

Json errorJson(const std::optional<lab::ErrorNumbers>& error, const std::optional<lab::ClassErrors>& classes,
               const Json& more)
{
    Json json{{"rmse", memberJson(error, &lab::ErrorNumbers::rmse)},
              {"mae", memberJson(error, &lab::ErrorNumbers::mae)},
              {"bias", memberJson(error, &lab::ErrorNumbers::bias)},
              {"p99", memberJson(error, &lab::ErrorNumbers::p99)}};
    json.update(more);
    json.update({{"edge", memberJson(classes, &lab::ClassErrors::edge)},
                 {"acne", memberJson(classes, &lab::ClassErrors::acne)},
                 {"detached", memberJson(classes, &lab::ClassErrors::detached)},
                 {"bleeding", memberJson(classes, &lab::ClassErrors::bleeding)},
                 {"terminator", memberJson(classes, &lab::ClassErrors::terminator)}});
    return json;
}

Json densityJson(const lab::TexelDensity& density)
{
    const auto percentile = [&](double value) {
        return density.counted == 0 ? Json(nullptr) : numberJson(value);
    };
    return {{"p01", percentile(density.p01)},
            {"p50", percentile(density.p50)},
            {"p99", percentile(density.p99)},
            {"facing",
             {{"p01", percentile(density.facing.p01)},
              {"p50", percentile(density.facing.p50)},
              {"p99", percentile(density.facing.p99)},
              {"one_to_four", percentile(density.facing.one_to_four)}}},
            {"pixels", {{"counted", density.counted}, {"left_out", density.left_out}}}};
}

Json repeatJson(const Settings& settings, std::uint32_t subcommand)
{
    Json json = settingsJson(settings, subcommand);
    if (!settings.shadow.format) {
        json.erase("map-format");
    }
    if (!settings.shadow.border_texels) {
        json.erase("border");
    }
    json.erase("techniques");
    return json;
}

Json runJson(const Settings& settings, std::string_view scene_hash, std::uint32_t subcommand)
{
    Json json{{"scene", settings.scene}, {"scene_hash", scene_hash}};
    json.update(repeatJson(settings, subcommand));
    std::string techniques;
    for (const std::string& technique : techniqueList(settings)) {
        techniques += (techniques.empty() ? "" : ",") + technique;
    }
    json["techniques"] = techniques;
    return json;
}

Json pathJson(const Settings& settings)
{
    return {{"name", settings.path},
            {"frames", {{"first", settings.frames->first}, {"last", settings.frames->last}}},
            {"fps", numberJson(settings.fps)},
            {"speed", numberJson(settings.path_speed)}};
}

Json eyeJson(const host::Eye& eye)
{
    Json json{{"position_ws", vectorJson(eye.position_ws)},
              {"target_ws", vectorJson(eye.target_ws)},
              {"up_ws", vectorJson(eye.up_ws)},
              {"fov_y_rad", numberJson(eye.fov_y_rad)}};
    if (eye.height_m > 0.0) {
        json["height_m"] = numberJson(eye.height_m);
    }
    json["near_m"] = numberJson(eye.near_m);
    json["far_m"] = numberJson(eye.far_m);
    return json;
}

Json lightJson(const host::ShadedLight& light)
{
    const Light& caster = light.caster;
    Json json{{"name", light.name}, {"type", nameOf(caster.type)}};
    const bool placed = caster.type != LightType::directional;
    if (placed) {
        json["position_ws"] = vectorJson(caster.position_ws);
    }
    if (caster.type != LightType::point) {
        json["direction_ws"] = vectorJson(caster.direction_ws);
    }
    if (caster.type == LightType::spot) {
        json["outer_half_angle_rad"] = numberJson(caster.outer_half_angle_rad);
    }
    if (placed) {
        json["range_m"] = numberJson(caster.range_m);
        json["near_m"] = numberJson(caster.near_m);
        json["radius_m"] = numberJson(caster.radius_m);
    } else {
        json["angular_diameter_rad"] = numberJson(caster.angular_diameter_rad);
    }
    json["casts_shadow"] = caster.casts_shadow;
    json["groups"] = caster.groups;
    return json;
}

} // namespace gnomon::app
