// SPDX-License-Identifier: Apache-2.0
#include "app/preset.h"

#include "technique_text.h"

#include "scene/json.h"

#include "files/files.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>

namespace gnomon::app {
namespace {

using Json = nlohmann::ordered_json;

// Presets of what others published stay as they were held against it: the older tone curve, and neither dither nor
// anti-aliasing nor ambient occlusion.
constexpr std::array kPresets{
    Preset{"demo", "a sundial late in the day, at its best: what `make demo` draws", R"({
  "scene": "sundial", "camera": "face", "time": 545, "size": "1280x720", "aa": "fxaa", "quality": "best", "map-size": 4096
})"},
    Preset{"fast", "the least work that still looks right", R"({
  "quality": "fast", "pcf.kernel": "2x2", "map-size": 1024, "bias": "auto"
})"},
    Preset{"plain", "one uniform map and 3x3 PCF: what everybody has, and techniques are held against", R"({
  "partition": "single", "fit": "uniform", "filter": "pcf", "map-size": 2048, "ambient-occlusion": "off"
})"},
    // All of the article: a floating-point map, one constant bias for the scene, nine comparisons with offsets that a
    // projective fetch divides by w, a Gaussian over the screen by its own taps, and its shading. Its depth before the
    // division, z (f / (f - n)) - n f / (f - n), is metres along the axis times 1.001.
    Preset{"shastry-2005", "A. S. Shastry, Soft-Edged Shadows, 2005: 3x3 PCF, then a blur on the screen", R"({
  "scene": "spotlit", "camera": "stage", "spot.cone": 30, "spot.near": 1, "spot.range": 1024,
  "reflection": "phong-2005", "aa": "none", "ambient-occlusion": "off", "tone": "filmic", "dither": false,
  "partition": "single", "fit": "uniform", "filter": "pcf",
  "pcf.kernel": "3x3-projected", "map-size": 1024, "map-format": "r32f", "bias": "constant=0.1",
  "soften": "blur", "soften.kernel": "gaussian", "soften.edges": "plain", "soften.taps": "published"
})"},
    // A layer around the ground and one for what stands and floats above it, four samples, a Gaussian of 1.25 texels,
    // unsigned normalised moments; the figures for variance and contrast are the paper's shader's. It lightens
    // what is displayed by 0.65, for XNA 4 knew no linear light, of which that is 0.65^2.2 = 0.39. The ends of the
    // layers, which it does not give, are this world's, and the warp is the step that it names as the next: a map that
    // adapts to the view. `--fit scene` is its own, made once.
    Preset{"rts-2011", "A. Marinescu, soft shadows of a real-time strategy game, 2011: two layers of variance", R"({
  "scene": "rts", "camera": "camp", "partition": "single", "fit": "lispsm-simple", "filter": "lvsm",
  "map-size": 1024, "map-format": "rgba16", "lvsm.world": [7, 13, 12, 40], "msaa": 4, "blur": "gaussian", "blur.sigma": 1.25,
  "map-sampling": "bilinear", "min-variance": 0.01, "bleeding.power": 1.3, "lighten": 0.39, "lighten.as": "add",
  "sky": "plain", "bloom": true, "bloom.threshold": 0.3, "aa": "none", "ambient-occlusion": "off", "tone": "filmic", "dither": false
})"},
    // The whole screen blended between two positions of the sun, whose depths share the bytes of a colour texel. The
    // world's clock is the document's: one minute a second.
    Preset{"icefall-2010", "P. Fortier, shadows of a moving sun, 2010: two positions blended, two maps a texel", R"({
  "scene": "sundial", "camera": "meadow", "size": "1280x720", "partition": "single", "fit": "uniform",
  "filter": "pcf", "pcf.kernel": "3x3", "map-size": 1024, "map-format": "rgba8",
  "motion": "step-blend", "step.by": "time", "step.interval": 2, "step.fade": "smooth",
  "sky": "plain",
  "aa": "none", "ambient-occlusion": "off", "tone": "filmic", "dither": false
})"},
    // The article ends with exponential maps after those of variance leaked; of its settings it names depth that is
    // linear, a blur, mip levels and full floats. The exponent, the kernel and the size are chosen.
    Preset{"esm-2008", "T. Annen et al. 2008, as Kite & Lightning use it: one exponential, blurred, with mip levels",
           R"({
  "scene": "spotlit", "camera": "stage", "size": "1920x1080", "partition": "single", "fit": "uniform",
  "filter": "esm", "map-size": 1024, "map-format": "r32f", "esm.exponent": 80, "depth-metric": "linear",
  "msaa": 4, "blur": "gaussian", "blur.sigma": 1.25, "map-sampling": "trilinear",
  "aa": "none", "ambient-occlusion": "off", "tone": "filmic", "dither": false
})"},
    // Frustums as the receivers ask for them, that pan by whole texels and fade over where they have to change. Their
    // densities lie between one and four times what is needed, and 2 is the middle. The talk's simplified warp follows
    // the viewer, so that its texels cannot be held: with `--motion free --fit lispsm-simple` it is there. The four
    // nearest texels of a depth map stand for the ids that the talk turns to after that (filter depth-id).
    Preset{"startopia-2006", "T. Forsyth, Extremely Practical Shadows, 2006: many frustums a lamp, held still", R"({
  "scene": "ring", "camera": "deck", "partition": "multi", "multi.texels-per-pixel": 2, "multi.most-times": 4,
  "motion": "snap", "fit": "uniform",
  "filter": "pcf", "pcf.kernel": "2x2", "map-format": "d32f", "bias": "auto",
  "aa": "none", "ambient-occlusion": "off", "tone": "filmic", "dither": false
})"},
};

/// A JSON value as it would be typed; `between` the elements of a list.
std::string typed(const Json& value, char between = ',')
{
    if (value.is_string()) {
        return value.get<std::string>();
    }
    if (value.is_boolean()) {
        return value.get<bool>() ? "1" : "0";
    }
    if (value.is_number_float()) { // 4.0 is 4, so that a technique has one name
        std::array<char, 32> room{};
        return {room.data(), std::to_chars(room.data(), room.data() + room.size(), value.get<double>()).ptr};
    }
    if (value.is_array()) {
        std::string text;
        for (const auto& element : value) {
            text += (text.empty() ? "" : std::string(1, between)) + typed(element);
        }
        return text;
    }
    return value.dump();
}

/// Whether a value may be given so, as a string or as JSON has it; what it says is for applySetting() to check.
bool isTyped(SettingType type, const Json& value)
{
    if (value.is_string()) {
        return true;
    }
    switch (type) {
    case SettingType::flag:
        return value.is_boolean() || value.is_number();
    case SettingType::integer:
    case SettingType::real:
    case SettingType::choice: // some are numbers
        return value.is_number();
    case SettingType::numbers:
        return value.is_number() ||
               (value.is_array() && !value.empty() &&
                std::all_of(value.begin(), value.end(), [](const auto& x) { return x.is_number(); }));
    case SettingType::size:
    case SettingType::range:
    case SettingType::text:
        break;
    }
    return false;
}

void requireType(const Setting& setting, const Json& value)
{
    constexpr std::string_view kTakes[] = {"true or false",     "a number",         "a number", "a string or a number",
                                           "numbers in a list", "a string \"WxH\"", "a string", "a string"};
    if (value.is_string() && value.get_ref<const std::string&>().find('\0') != std::string::npos) {
        throw UsageError(fmt::format("{} takes no string with a NUL in it", setting.key));
    }
    const bool list = setting.repeatable && value.is_array();
    const bool typed =
        list ? std::all_of(value.begin(), value.end(), [&](const auto& x) { return isTyped(setting.type, x); })
             : isTyped(setting.type, value);
    if (!typed) {
        throw UsageError(fmt::format("{} takes {}{}, not {}", setting.key,
                                     kTakes[static_cast<std::size_t>(setting.type)],
                                     setting.repeatable ? " or a list of them" : "", value.type_name()));
    }
}

void applyEntry(Settings& settings, const std::string& key, const Json& value, std::uint32_t subcommand)
{
    if (key == "scene" || key == "scene_hash") {
        if (!value.is_string()) {
            throw UsageError(fmt::format("{} takes a string, not {}", key, value.type_name()));
        }
        (key == "scene" ? settings.scene : settings.scene_hash) = value.get<std::string>();
        return;
    }
    const Setting* setting = findSetting(key);
    constexpr std::size_t kLongestKey = 80; // far beyond any that there is
    if (setting == nullptr && (key.size() > kLongestKey || key.find('\0') != std::string::npos)) {
        throw UsageError(fmt::format("a key of {} bytes is no setting", key.size()));
    }
    if (setting != nullptr) {
        requireType(*setting, value);
    }
    if (setting != nullptr && setting->command_line_only) { // a preset's user would not see what it overwrites or reads
        throw UsageError(fmt::format("{} {} of this run alone; give it on the command line", key,
                                     setting->type == SettingType::flag ? "is" : "names a file"));
    }
    if (setting != nullptr && (setting->subcommands & subcommand) == 0) {
        return;
    }
    settings.named.insert(key);
    if (key == "techniques" || key == "technique") {
        forgetTechniques(settings);
    }
    if (setting != nullptr && setting->repeatable && value.is_array()) {
        for (const auto& element : value) {
            applySetting(settings, *setting, typed(element));
        }
        return;
    }
    applySetting(settings, key, typed(value, setting == nullptr ? ',' : setting->between));
}

class PresetOwner final : public scene::JsonOwner {
public:
    explicit PresetOwner(const std::string& name) : name_(name) {}
    [[noreturn]] void fail(const std::string& pointer, const std::string& what, const std::string& found,
                           const std::string& todo) const override
    {
        throw UsageError(fmt::format("--preset: {} is not a JSON object of settings: {}{}{}{}{}{}{}", name_, what,
                                     pointer.empty() ? "" : " at ", pointer, found.empty() ? "" : ": ", found,
                                     todo.empty() ? "" : "; ", todo));
    }

private:
    const std::string& name_;
};

/// One key of the preset, with what the others have to do with it.
void applyKey(Settings& settings, const std::string& name, const Json& json, const std::string& key,
              std::uint32_t subcommand)
{
    try {
        for (const std::string_view other : placementPartners(key)) {
            if (key != "lvsm.placement" && json.contains(other)) {
                const auto& said = json[std::string(other)];
                requireOnePlacement(settings, other, said.is_string() ? typed(said) : "", key);
            }
        }
        applyEntry(settings, key, json.at(key), subcommand);
        if (key == "map-format") {
            settings.format_preset = name;
        }
    } catch (const UsageError& error) {
        throw UsageError(fmt::format("preset {}: {}", name, error.what()));
    }
}

/// Its other keys have been applied, and none may say otherwise.
void requireTechniqueOf(const Settings& settings, const std::string& name, const Json& json)
{
    try {
        if (json.contains("techniques") && !settings.techniques.empty()) {
            throw UsageError("technique and techniques both say what is held against what");
        }
        requireTechnique(settings, json["technique"].get<std::string>());
    } catch (const UsageError& error) {
        throw UsageError(fmt::format("preset {}: {}", name, error.what()));
    }
}

void applyJson(Settings& settings, const std::string& name, std::string_view text, std::uint32_t subcommand)
{
    // Ordered, because bias ends what bias.constant said before it.
    PresetOwner owner(name);
    const auto tree = scene::readJson<Json>(text, owner);
    const Json& file = tree.root();
    const bool is_result = file.is_object() && file.contains("settings");
    const auto& json = is_result ? file["settings"] : file;
    if (!json.is_object()) {
        throw UsageError(fmt::format("--preset: {} is not a JSON object of settings", name));
    }
    if (json.contains("scene")) {
        settings.scene_hash.clear(); // it was the hash of an earlier preset's scene
    }
    // An earlier preset's camera gives way; a preset that has both is wrong by itself.
    if (json.contains("camera") != (json.contains("eye") || json.contains("target"))) {
        replaceCamera(settings, json.contains("camera") ? "camera" : "eye");
    }
    // First, so that what other keys say otherwise is seen.
    const std::string technique = "technique";
    if (json.contains(technique)) {
        applyKey(settings, name, json, technique, subcommand);
    }
    for (const auto& [key, value] : json.items()) {
        if (key != technique) {
            applyKey(settings, name, json, key, subcommand);
        }
    }
    if (json.contains(technique) && (subcommand & kFrames) != 0) {
        requireTechniqueOf(settings, name, json);
    }
}

std::string readPreset(const std::filesystem::path& file)
{
    constexpr std::uint64_t kMaxBytes = 1U << 24U; // a result holds every number of every technique
    return readWholeFile(file, kMaxBytes, "preset");
}

} // namespace

void applyPresetText(Settings& settings, const std::string& name, std::string_view text, std::uint32_t subcommand)
{
    applyJson(settings, name, text, subcommand);
}

std::span<const Preset> presets()
{
    return kPresets;
}

void applyPreset(Settings& settings, std::string_view name_or_file, std::uint32_t subcommand)
{
    std::vector<std::string_view> names;
    for (const Preset& preset : kPresets) {
        names.push_back(preset.name);
        if (preset.name == name_or_file) {
            applyJson(settings, std::string(name_or_file), preset.json, subcommand);
            return;
        }
    }
    const std::filesystem::path file(name_or_file);
    std::error_code ignored;
    if (!std::filesystem::exists(file, ignored)) {
        throw UsageError(fmt::format("--preset: \"{}\" is no file and no preset{}; presets are {}", name_or_file,
                                     suggestion(name_or_file, names), listed(names)));
    }
    applyJson(settings, file.string(), readPreset(file), subcommand);
}

} // namespace gnomon::app
