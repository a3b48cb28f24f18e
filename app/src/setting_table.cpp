// SPDX-License-Identifier: Apache-2.0
// The declaration of every option. A new option is one row here.
#include "setting_values.h"

#include <gnomon/choices.h>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <limits>

namespace gnomon::app {
namespace {

using enum SettingType;
using Group = SettingGroup;
using Value = SettingValue;

constexpr double kFar = 1e9; // metres; beyond, single precision has no use for a coordinate

std::vector<std::string_view> choiceNames(std::string_view choice)
{
    std::vector<std::string_view> names;
    for (const ChoiceValue& row : choiceValues()) {
        if (row.choice == choice) {
            names.push_back(row.name);
        }
    }
    return names;
}

template <typename Enum>
std::vector<std::string_view> enumNames(std::uint8_t count)
{
    std::vector<std::string_view> names;
    for (std::uint8_t i = 0; i < count; ++i) {
        names.push_back(nameOf(static_cast<Enum>(i)));
    }
    return names;
}

constexpr std::array<std::string_view, 3> kAntiAliasing{"none", "fxaa", "ssaa4"};

std::vector<std::string_view> antiAliasingNames()
{
    return {kAntiAliasing.begin(), kAntiAliasing.end()};
}

template <typename Enum>
void setChoice(std::string_view choice, Enum& target, const Value& value)
{
    target = static_cast<Enum>(findChoice(choice, value.text)->value);
}

glm::dvec3 vec3(const std::vector<double>& numbers, std::size_t first = 0)
{
    return {numbers[first], numbers[first + 1], numbers[first + 2]};
}

/// A direction's length must be told from rounding noise.
glm::dvec3 direction(std::string_view key, const glm::dvec3& vector)
{
    const double length = glm::length(vector);
    if (!(length > 1e-12)) {
        throw UsageError(fmt::format("--{}: the direction is zero", key));
    }
    return vector / length;
}

void applyAntiAliasing(Settings& s, const Value& v)
{
    for (std::size_t i = 0; i < kAntiAliasing.size(); ++i) {
        if (kAntiAliasing[i] == v.text) {
            s.anti_aliasing = static_cast<host::AntiAliasing>(i);
        }
    }
}

void applySpot(Settings& s, const Value& v)
{
    const SpotLight spot{vec3(v.numbers), vec3(v.numbers, 3), v.numbers[6]};
    (void)direction("spot", spot.target_ws - spot.position_ws);
    if (!(spot.angle_deg >= 0.1 && spot.angle_deg <= 120.0)) {
        throw UsageError(
            fmt::format("--spot: its cone of {} degrees is not in the range 0.1 to 120 degrees", spot.angle_deg));
    }
    s.spot = spot;
}

void applyPoint(Settings& s, const Value& v)
{
    if (!(v.numbers[3] > 0.0)) {
        throw UsageError(fmt::format("--point: its range of {} m is not above 0", v.numbers[3]));
    }
    s.point = PointLight{vec3(v.numbers), v.numbers[3]};
}

/// auto | none | constant=M,slope=S,normal=T,receiver-plane=0|1, whose parts are settings of their own.
void applyBias(Settings& s, const Value& v)
{
    s.filter.bias = BiasOptions{};
    if (v.text == "auto") {
        return;
    }
    s.filter.bias.automatic = false;
    if (v.text == "none") {
        return;
    }
    std::vector<std::string_view> seen;
    for (const std::string_view part : split(v.text, ',')) {
        const std::size_t equals = part.find('=');
        const Setting* setting =
            equals == std::string_view::npos ? nullptr : findSetting(fmt::format("bias.{}", part.substr(0, equals)));
        if (setting == nullptr) {
            throw UsageError(fmt::format(
                "--bias: \"{}\" is not auto, none or constant=M,slope=S,normal=T,receiver-plane=0|1", v.text));
        }
        if (std::find(seen.begin(), seen.end(), setting->key) != seen.end()) {
            throw UsageError(fmt::format("--bias: \"{}\" gives {} twice", v.text, part.substr(0, equals)));
        }
        seen.push_back(setting->key);
        setting->apply(s, parseValue(*setting, part.substr(equals + 1)));
    }
}

void applyTechniques(Settings& s, const Value& v)
{
    for (const std::string_view piece : split(v.text, ',')) {
        if (piece.empty()) {
            throw UsageError(
                fmt::format("--techniques: \"{}\" has a comma with no technique before or after it", v.text));
        }
        if (std::find(s.techniques.begin(), s.techniques.end(), piece) != s.techniques.end()) {
            throw UsageError(fmt::format("--techniques: {} is listed twice", piece));
        }
        s.techniques.emplace_back(piece);
    }
    if (s.techniques.size() > 1 && std::find(s.techniques.begin(), s.techniques.end(), "all") != s.techniques.end()) {
        throw UsageError("--techniques: all stands alone; it times hard and every kernel of pcf");
    }
}

void applyLimit(Settings& s, const Value& v)
{
    struct Limit {
        std::string_view name;
        double max;
        void (*set)(scene::Limits&, std::uint64_t);
    };
    constexpr double k32 = std::numeric_limits<std::uint32_t>::max();
    constexpr double k63 = 9.0e18;
    static constexpr std::array kLimits{
        Limit{"file-bytes", k63,
              [](scene::Limits& l, std::uint64_t n) {
                  l.max_file_bytes = n;
              }},
        Limit{"total-bytes", k63,
              [](scene::Limits& l, std::uint64_t n) {
                  l.max_total_bytes = n;
              }},
        Limit{"image-side", k32,
              [](scene::Limits& l, std::uint64_t n) {
                  l.max_image_side = std::uint32_t(n);
              }},
        Limit{"node-depth", k32,
              [](scene::Limits& l, std::uint64_t n) {
                  l.max_node_depth = std::uint32_t(n);
              }},
        Limit{"count", k32,
              [](scene::Limits& l, std::uint64_t n) {
                  l.max_count = std::uint32_t(n);
              }},
        Limit{"vertices", k63,
              [](scene::Limits& l, std::uint64_t n) {
                  l.max_vertices = n;
              }},
    };
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
        if (!number || *number < 1 || static_cast<double>(*number) > limit.max) {
            throw UsageError(fmt::format("--limit: {} takes a whole number from 1 to {}", name, limit.max));
        }
        limit.set(s.limits, static_cast<std::uint64_t>(*number));
        return;
    }
    throw UsageError(fmt::format("--limit: there is no limit \"{}\"{}; it takes NAME=N with one of {}", name,
                                 suggestion(name, names), listed(names)));
}

bool isPcf(const Settings& s)
{
    return s.plan.technique.filter == Filter::pcf;
}
bool isDisc(const Settings& s)
{
    return isPcf(s) && (s.filter.pcf_kernel == PcfKernel::poisson || s.filter.pcf_kernel == PcfKernel::vogel);
}
bool isGaussian(const Settings& s)
{
    return isPcf(s) && !isDisc(s) && s.filter.pcf_kernel != PcfKernel::bilinear_2x2;
}

void manualBias(Settings& s)
{
    s.filter.bias.automatic = false;
}

const std::vector<Setting>& rows()
{
    static const std::vector<Setting> table{
        // clang-format off
        {.key = "size", .group = Group::picture, .type = size, .form = "WxH", .unit = "pixels", .default_text = "1280x720", .min = 1, .max = 1e6,
         .doc = "width and height of the picture", .apply = [](Settings& s, const Value& v) { s.size_px = {v.numbers[0], v.numbers[1]}; }},
        {.key = "aa", .group = Group::picture, .type = choice, .form = "MODE", .default_text = "none", .choices = antiAliasingNames,
         .doc = "anti-aliasing of the picture: none, fxaa or ssaa4", .subcommands = kRender | kBench, .apply = applyAntiAliasing},
        {.key = "ground", .group = Group::picture, .type = flag, .default_text = "0", .doc = "put a ground plane under the scene",
         .apply = [](Settings& s, const Value& v) { s.ground = v.flag; }},
        {.key = "override-material", .group = Group::picture, .type = choice, .form = "NAME", .default_text = "none",
         .choices = [] { return std::vector<std::string_view>{"none", "diffuse"}; }, .doc = "draw everything in one material: none or diffuse",
         .subcommands = kRender | kBench, .apply = [](Settings& s, const Value& v) { s.material_override = v.text == "none" ? "" : v.text; }},

        {.key = "camera", .group = Group::camera, .type = text, .form = "NAME", .doc = "a camera or view of the scene by its name",
         .apply = [](Settings& s, const Value& v) { s.camera = v.text; }},
        {.key = "eye", .group = Group::camera, .type = numbers, .form = "x,y,z", .unit = "m", .min = -kFar, .max = kFar, .count = 3,
         .doc = "where the camera is", .apply = [](Settings& s, const Value& v) { s.eye_ws = vec3(v.numbers); }},
        {.key = "target", .group = Group::camera, .type = numbers, .form = "x,y,z", .unit = "m", .min = -kFar, .max = kFar, .count = 3,
         .doc = "what it looks at", .apply = [](Settings& s, const Value& v) { s.target_ws = vec3(v.numbers); }},
        {.key = "up", .group = Group::camera, .type = numbers, .form = "x,y,z", .default_text = "0,1,0", .min = -kFar, .max = kFar, .count = 3,
         .doc = "what is up for it", .used = [](const Settings& s) { return s.eye_ws.has_value(); }, .used_when = "--eye",
         .apply = [](Settings& s, const Value& v) { s.up_ws = direction("up", vec3(v.numbers)); }},
        {.key = "fov", .group = Group::camera, .type = real, .form = "DEG", .unit = "degrees", .min = 0.1, .max = 179,
         .doc = "vertical field of view; else the camera's own, or 45", .apply = [](Settings& s, const Value& v) { s.fov_deg = v.real; }},

        {.key = "sun", .group = Group::light, .type = numbers, .form = "x,y,z", .min = -kFar, .max = kFar, .count = 3,
         .doc = "direction the light travels; replaces the scene's lights",
         .apply = [](Settings& s, const Value& v) { s.sun_ws = direction("sun", vec3(v.numbers)); }},
        {.key = "spot", .group = Group::light, .type = numbers, .form = "x,y,z,tx,ty,tz,DEG", .unit = "m, degrees", .min = -kFar, .max = kFar, .count = 7,
         .doc = "spot light: place, target, whole cone; likewise", .apply = applySpot},
        {.key = "point", .group = Group::light, .type = numbers, .form = "x,y,z,RANGE", .unit = "m", .min = -kFar, .max = kFar, .count = 4,
         .doc = "point light: place and reach; likewise", .apply = applyPoint},

        {.key = "filter", .group = Group::technique, .type = choice, .form = "NAME", .default_text = "pcf", .choices = [] { return choiceNames("filter"); },
         .doc = "what a texel stores and how it is tested", .apply = [](Settings& s, const Value& v) { setChoice("filter", s.plan.technique.filter, v); }},
        {.key = "fit", .group = Group::technique, .type = choice, .form = "NAME", .default_text = "uniform", .choices = [] { return choiceNames("fit"); },
         .doc = "how one frustum's projection is shaped", .apply = [](Settings& s, const Value& v) { setChoice("fit", s.plan.technique.fit, v); }},
        {.key = "partition", .group = Group::technique, .type = choice, .form = "NAME", .default_text = "single", .choices = [] { return choiceNames("partition"); },
         .doc = "how a light's receivers are divided among frustums", .apply = [](Settings& s, const Value& v) { setChoice("partition", s.plan.technique.partition, v); }},
        {.key = "soften", .group = Group::technique, .type = choice, .form = "NAME", .default_text = "none", .choices = [] { return choiceNames("soften"); },
         .doc = "what happens to the visibility in screen space", .apply = [](Settings& s, const Value& v) { setChoice("soften", s.plan.technique.soften, v); }},
        {.key = "motion", .group = Group::technique, .type = choice, .form = "NAME", .default_text = "free", .choices = [] { return choiceNames("motion"); },
         .doc = "how the map follows a moving camera or sun", .apply = [](Settings& s, const Value& v) { setChoice("motion", s.plan.technique.motion, v); }},
        {.key = "map-size", .group = Group::technique, .type = integer, .form = "N", .unit = "texels", .default_text = "2048", .min = 16, .max = 16384,
         .doc = "side of one map", .apply = [](Settings& s, const Value& v) { s.plan.map_size = static_cast<std::uint32_t>(v.integer); }},
        {.key = "map-format", .group = Group::technique, .type = choice, .form = "FORMAT", .choices = [] { return enumNames<MapFormat>(9); },
         .doc = "what a texel is stored as; else the filter's own",
         .apply = [](Settings& s, const Value& v) { s.filter.format = *findMapFormat(v.text); s.format_given = true; }},
        {.key = "bias", .group = Group::technique, .type = text, .form = "BIAS", .default_text = "auto",
         .doc = "auto, none or constant=M,slope=S,normal=T,receiver-plane=0|1", .apply = applyBias},
        {.key = "bias.constant", .group = Group::technique, .type = real, .form = "M", .unit = "m", .min = -1e6, .max = 1e6,
         .doc = "towards the light; ends bias=auto", .own_option = false,
         .apply = [](Settings& s, const Value& v) { manualBias(s); s.filter.bias.constant_m = static_cast<float>(v.real); }},
        {.key = "bias.slope", .group = Group::technique, .type = real, .form = "S", .unit = "texel depths", .min = 0, .max = 16,
         .doc = "times the depth that one texel spans; ends bias=auto", .own_option = false,
         .apply = [](Settings& s, const Value& v) { manualBias(s); s.filter.bias.slope = static_cast<float>(v.real); }},
        {.key = "bias.normal", .group = Group::technique, .type = real, .form = "T", .unit = "texels", .min = 0, .max = 16,
         .doc = "receiver moved along its normal; ends bias=auto", .own_option = false,
         .apply = [](Settings& s, const Value& v) { manualBias(s); s.filter.bias.normal_texels = static_cast<float>(v.real); }},
        {.key = "bias.receiver-plane", .group = Group::technique, .type = flag, .form = "0|1",
         .doc = "each tap against the receiver's plane there; ends bias=auto", .own_option = false,
         .apply = [](Settings& s, const Value& v) { manualBias(s); s.filter.bias.receiver_plane = v.flag; }},
        {.key = "pcf.kernel", .group = Group::technique, .type = choice, .form = "NAME", .default_text = "3x3", .choices = [] { return enumNames<PcfKernel>(6); },
         .doc = "2x2 is bilinear; 3x3, 5x5, 7x7 Gaussian; poisson, vogel discs", .own_option = false, .used = isPcf, .used_when = "filter pcf",
         .apply = [](Settings& s, const Value& v) { s.filter.pcf_kernel = *findPcfKernel(v.text); }},
        {.key = "pcf.taps", .group = Group::technique, .type = integer, .form = "N", .unit = "taps", .default_text = "16", .min = 4, .max = 64,
         .doc = "of a disc", .own_option = false, .used = isDisc, .used_when = "pcf.kernel poisson or vogel",
         .apply = [](Settings& s, const Value& v) { s.filter.disc_taps = static_cast<std::uint32_t>(v.integer); }},
        {.key = "pcf.radius", .group = Group::technique, .type = real, .form = "R", .unit = "texels", .default_text = "2.5", .min = 0.5, .max = 16,
         .doc = "of a disc", .own_option = false, .used = isDisc, .used_when = "pcf.kernel poisson or vogel",
         .apply = [](Settings& s, const Value& v) { s.filter.disc_radius_texels = static_cast<float>(v.real); }},
        {.key = "pcf.sigma", .group = Group::technique, .type = real, .form = "S", .unit = "texels", .min = 0.3, .max = 4,
         .doc = "of a Gaussian kernel; else its width / 4", .own_option = false, .used = isGaussian, .used_when = "pcf.kernel 3x3, 5x5 or 7x7",
         .apply = [](Settings& s, const Value& v) { s.filter.gaussian_sigma_texels = static_cast<float>(v.real); }},
        {.key = "max-distance", .group = Group::technique, .type = real, .form = "M", .unit = "m", .default_text = "0", .min = 0, .max = kFar,
         .doc = "receivers farther from the eye get no shadow; 0: no limit", .own_option = false,
         .apply = [](Settings& s, const Value& v) { s.plan.max_distance_m = v.real; }},
        {.key = "border", .group = Group::technique, .type = real, .form = "T", .unit = "texels", .min = 0, .max = 64,
         .doc = "room around the fitted map; else what the kernel needs", .own_option = false,
         .apply = [](Settings& s, const Value& v) { s.plan.border_texels = v.real; s.border_given = true; }},

        {.key = "time", .group = Group::time, .type = real, .form = "SECONDS", .unit = "s", .default_text = "0", .min = -1e6, .max = 1e6,
         .doc = "moment of the scene's animation", .apply = [](Settings& s, const Value& v) { s.time_s = v.real; }},
        {.key = "frames", .group = Group::time, .type = range, .form = "A-B", .min = 0, .max = 999999,
         .doc = "frames A to B; frame N is at --time plus N / fps", .subcommands = kRender | kPlan,
         .apply = [](Settings& s, const Value& v) { s.frames = FrameRange{static_cast<std::uint32_t>(v.numbers[0]), static_cast<std::uint32_t>(v.numbers[1])}; }},
        {.key = "fps", .group = Group::time, .type = real, .form = "N", .unit = "1/s", .default_text = "30", .min = 0.001, .max = 1e4,
         .doc = "frames per second", .subcommands = kRender | kPlan, .used = [](const Settings& s) { return s.frames.has_value(); },
         .used_when = "--frames", .apply = [](Settings& s, const Value& v) { s.fps = v.real; }},
        {.key = "animation", .group = Group::time, .type = text, .form = "NAME", .doc = "which animation of the file plays; else the first",
         .apply = [](Settings& s, const Value& v) { s.animation = v.text; }},

        {.key = "seed", .group = Group::run, .type = integer, .form = "N", .default_text = "1", .min = 0, .max = 9e15,
         .doc = "everything random", .apply = [](Settings& s, const Value& v) { s.seed = static_cast<std::uint64_t>(v.integer); }},
        {.key = "gpu", .group = Group::run, .type = text, .form = "NAME", .doc = "part of a GPU's name, or software; else the first real one",
         .subcommands = kRender | kBench, .apply = [](Settings& s, const Value& v) { s.gpu = v.text; }},
        {.key = "validate", .group = Group::run, .type = flag, .default_text = "0", .doc = "Vulkan validation; a message makes the run fail",
         .subcommands = kRender | kBench, .apply = [](Settings& s, const Value& v) { s.validate = v.flag; }},
        {.key = "limit", .group = Group::run, .type = text, .form = "NAME=N", .doc = "raise a limit of the scene reader, as its message says", .repeatable = true,
         .apply = applyLimit},

        {.key = "out", .group = Group::result, .type = text, .form = "FILE", .doc = "picture (.png, .exr; default gnomon.png), or folder with --frames",
         .subcommands = kRender, .apply = [](Settings& s, const Value& v) { s.output = v.text; }},
        {.key = "mask", .group = Group::result, .type = flag, .default_text = "0", .doc = "write the visibility of one light instead of the picture",
         .subcommands = kRender, .apply = [](Settings& s, const Value& v) { s.mask = v.flag; }},
        {.key = "light", .group = Group::result, .type = text, .form = "NAME", .doc = "whose mask; else the first light's", .subcommands = kRender,
         .used = [](const Settings& s) { return s.mask; }, .used_when = "--mask", .apply = [](Settings& s, const Value& v) { s.light = v.text; }},
        {.key = "techniques", .group = Group::result, .type = text, .form = "LIST", .doc = "what to time: hard,pcf+pcf.kernel=5x5,... or all",
         .subcommands = kBench, .repeatable = true, .separator = ",", .apply = applyTechniques},
        {.key = "repetitions", .group = Group::result, .type = integer, .form = "N", .default_text = "11", .min = 1, .max = 100000,
         .doc = "timed frames of each technique", .subcommands = kBench,
         .apply = [](Settings& s, const Value& v) { s.repetitions = static_cast<std::uint32_t>(v.integer); }},
        {.key = "warmup", .group = Group::result, .type = integer, .form = "N", .default_text = "2", .min = 0, .max = 100000,
         .doc = "frames of each technique before them", .subcommands = kBench,
         .apply = [](Settings& s, const Value& v) { s.warmup = static_cast<std::uint32_t>(v.integer); }},
        {.key = "json", .group = Group::result, .type = text, .form = "[FILE]", .doc = "JSON to FILE (*.json), or to stdout with - or nothing",
         .subcommands = kPlan | kBench | kList, .apply = [](Settings& s, const Value& v) { s.json = v.text; }},
        // clang-format on
    };
    return table;
}

} // namespace

std::span<const Setting> settingTable()
{
    return rows();
}

} // namespace gnomon::app
