// SPDX-License-Identifier: Apache-2.0
// Every option of the program, declared once. The command line, --set, presets, `gnomon list` and reports all read the
// one table that settingTable() returns.
#pragma once

#include "host/frame_renderer.h"
#include "scene/casting.h"
#include "scene/gltf.h"
#include "truth/visibility.h"

#include <gnomon/option_table.h>
#include <gnomon/planner.h>
#include <gnomon/vulkan/shadow_renderer.h>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::app {

/// Wrong usage: one line on stderr and exit status 2.
class UsageError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

struct SpotLight {
    glm::dvec3 position_ws{0.0};
    glm::dvec3 target_ws{0.0};
    double angle_deg = 45.0; // the whole cone
};
struct PointLight {
    glm::dvec3 position_ws{0.0};
    double range_m = 1.0;
};
/// --set object: how the nodes of a name cast and receive.
struct NamedCasting {
    std::string name;
    scene::Casting casting;
};
/// --set light-groups: the groups of casters that a light makes shadows of.
struct NamedGroups {
    std::string name;
    std::uint32_t groups = kAllGroups;
};
/// Whether a ground is put under the scene; automatic: under a file that has none of its own.
enum class Ground : std::uint8_t { automatic, on, off };
/// The axis that points up in a file.
enum class UpAxis : std::uint8_t { y, z };
struct FrameRange {
    std::uint32_t first = 0;
    std::uint32_t last = 0;
};

/// --sweep key=from:to:steps: a numeric setting takes `steps` values from `from` to `to`, both included.
struct Sweep {
    std::string key;
    double from = 0.0;
    double to = 0.0;
    std::uint32_t steps = 0;  // >= 2
    bool logarithmic = false; // values by equal factors: key=from:to:steps:log
};

/// The settings of one run. Only defaultSettings() makes them and only applySetting() changes them, so `values` is
/// complete.
struct Settings {
    std::uint32_t subcommand = 0; // kRender ...; 0: none, as where no command line was read
    std::string scene = "rts";
    std::vector<std::string> scenes; // compare: all of them, where there are several; `scene` is the first
    std::string scene_hash; // of the scene that a preset's result was measured on; empty: no preset was a result
    // picture
    glm::uvec2 size_px{0};
    std::optional<host::AntiAliasing> anti_aliasing; // nothing: antiAliasingOf() chooses
    host::BloomOptions bloom;
    std::optional<bool> ambient_occlusion;    // nothing: hasOcclusion() chooses
    std::optional<double> occlusion_radius_m; // else found from the scene
    host::ToneCurve tone = host::ToneCurve::neutral;
    bool dither = true;
    host::Reflection reflection = host::Reflection::materials;
    host::SkyModel sky = host::SkyModel::physical;
    double exposure_ev = 0.0;
    host::Shading shading = host::Shading::deferred;
    pack::CompactMaskRule compact_mask;
    std::string material_override; // empty or "diffuse"
    bool stained = false;          // blended surfaces are stained glass
    Ground ground = Ground::automatic;
    UpAxis up_axis = UpAxis::y;
    std::vector<NamedCasting> objects; // in the order in which they are applied
    // camera
    std::string camera;
    std::optional<glm::dvec3> eye_ws;
    std::optional<glm::dvec3> target_ws;
    glm::dvec3 up_ws{0.0, 1.0, 0.0};
    std::optional<double> fov_deg;
    std::optional<double> ortho_m; // height of an orthographic picture
    // lights
    std::optional<glm::dvec3> sun_ws; // unit, the way light travels
    std::optional<SpotLight> spot;
    std::vector<PointLight> points;
    std::optional<double> sun_angle_deg; // of every directional light; else the light's own
    std::optional<double> light_size_m;  // diameter of every spot and point light; else the light's own
    std::optional<double> cone_deg;      // the whole cone of every spot light; else the light's own
    std::optional<double> near_m;        // Light::near_m and range_m of every spot light; else the light's own
    std::optional<double> range_m;
    std::vector<NamedGroups> light_groups;
    // technique
    ShadowOptions shadow;
    std::string format_preset; // the preset that gave the map's format; empty: none did, or it was given again
    // truth
    std::optional<truth::Kind> truth; // render: nothing unless given; compare: area
    std::uint32_t samples = 0;
    truth::PixelTruth truth_pixels = truth::PixelTruth::centre;
    bool no_cache = false;
    // time
    double time_s = 0.0;
    std::optional<FrameRange> frames;
    double fps = 0.0;
    std::string animation;
    std::string path; // a name or a file; empty: none
    double path_speed = 1.0;
    std::uint32_t converge = 1; // frames at rest, of which the last counts
    // run
    std::uint64_t seed = 0;
    std::string gpu;
    std::optional<DeviceRates> rates; // nothing: as the device has them
    bool validate = false;
    bool strict = false; // an option that has no effect is refused
    scene::Limits limits;
    // results
    std::string output;
    bool mask = false;
    std::string debug; // render: what the picture shows instead, see debug_views.h; "none"
    std::string light;
    std::string json;      // empty: not asked for; "-": stdout
    std::string technique; // the text of --technique; its parts are settings like others
    std::vector<std::string> techniques;
    /// "FILE:LINE" of those techniques that --techniques @FILE gave.
    std::map<std::string, std::string, std::less<>> technique_places;
    std::uint32_t repetitions = 0;
    std::uint32_t warmup = 0;
    std::string draw;    // plan: the SVG file that shows a light's maps; empty: none
    std::string report;  // compare, bench: folder for a page; empty: none
    std::string against; // bench: the earlier result that this one is compared with; empty: none
    bool equal_error = false;
    std::optional<Sweep> sweep;
    std::string test_image; // metrics: the two files
    std::string truth_image;
    std::string topic;              // list: what is asked about, empty: an overview; completion: the shell
    std::vector<std::string> typed; // completion: the words of the line that is to be completed, after "--"

    /// The text of every setting that has a value, by key; defaults included.
    std::map<std::string, std::string, std::less<>> values;
    /// Keys that the command line itself gave (not defaults, not presets); false: as a part of --technique.
    std::map<std::string, bool, std::less<>> given;
    /// Keys that the command line or a preset named: not left at their defaults.
    std::set<std::string, std::less<>> named;

    /// Does the run place lights instead of the scene's?
    [[nodiscard]] bool placesLights() const { return sun_ws || spot || !points.empty(); }
    /// A frame is made by those before it.
    [[nodiscard]] bool learnsFromFrames() const
    {
        return shadow.technique.soften == Soften::converge || shadow.technique.partition == Partition::virtual_pages;
    }
};

enum class SettingType : std::uint8_t { flag, integer, real, choice, numbers, size, range, text };
enum class SettingGroup : std::uint8_t { picture, camera, light, technique, truth, time, run, result };

/// A parsed and range-checked value, in the member of the setting's type. A size and a range are two `numbers` each.
using SettingValue = OptionValue;

inline constexpr std::uint32_t kRender = 1;
inline constexpr std::uint32_t kPlan = 2;
inline constexpr std::uint32_t kBench = 4;
inline constexpr std::uint32_t kList = 8;
inline constexpr std::uint32_t kCompare = 16;
inline constexpr std::uint32_t kMetrics = 32;
inline constexpr std::uint32_t kView = 128;
inline constexpr std::uint32_t kCompletion = 256;
inline constexpr std::uint32_t kMan = 512;
inline constexpr std::uint32_t kGpus = 1024;
inline constexpr std::uint32_t kCalibrate = 2048;
inline constexpr std::uint32_t kPictures = kRender | kBench | kView; // all that draw pictures
inline constexpr std::uint32_t kDraw = kPictures | kCompare;         // all that draw
inline constexpr std::uint32_t kFrames = kDraw | kPlan;              // all that take a scene
inline constexpr std::uint32_t kMoving = kFrames & ~kView;           // all that take --frames

/// A value that completion offers for a text.
struct Offer {
    std::string_view value;
    std::string_view doc; // one line; may be empty
};

struct Setting {
    std::string_view key;
    SettingGroup group = SettingGroup::picture;
    SettingType type = SettingType::text;
    std::string_view form;         // how its value is written, for help: "WxH"
    std::string_view unit;         // empty: none
    std::string_view default_text; // empty: no value unless given
    double min = 0.0;              // of each number; inclusive
    double max = 0.0;
    std::uint32_t count = 1;                              // numbers: how many, at most
    std::uint32_t min_count = 0;                          // numbers: at least; 0: exactly `count`
    char between = ',';                                   // numbers: what stands between them
    std::uint32_t multiple_of = 1;                        // integer: only multiples of it
    std::vector<std::string_view> (*choices)() = nullptr; // choice: what is allowed
    std::string_view bare_text;          // choice: what the option stands for that has no value; empty: it needs one
    std::string_view none_text;          // how one writes that there is no value; empty: one cannot
    std::string_view doc;                // one line
    std::uint32_t subcommands = kFrames; // which have it
    bool own_option = true;              // false: only --set, presets and techniques
    bool command_line_only = false;      // decides only what is written or read, not what is done
    char letter = 0;                     // "-o"; 0: none
    bool repeatable = false;             // each use adds to the ones before
    std::string_view separator = " ";    // between the uses of a repeatable one in `values`
    bool (*used)(const Settings&) = nullptr; // null: always has an effect
    std::string_view used_when;              // the sentence for it: "filter pcf"
    std::string_view of_lights;              // the types of light that it is about, blanks between
    /// For completion of a text: values that it may have, names in the scene, and files by their extensions: "png exr".
    /// "/": folders alone.
    std::vector<Offer> (*offers)() = nullptr;
    std::vector<std::string> (*names_in)(const scene::Scene&) = nullptr;
    std::string_view files;
    void (*apply)(Settings&, const SettingValue&) = nullptr;
    const OptionRow* option = nullptr; // a setting of the library's own: then neither `used` nor `apply`
};

[[nodiscard]] std::span<const Setting> settingTable();
[[nodiscard]] const Setting* findSetting(std::string_view key);
/// Has it an effect with these settings?
[[nodiscard]] bool isUsed(const Setting& setting, const Settings& settings);
/// Is the key that of a choice of a technique?
[[nodiscard]] bool isChoice(std::string_view key);
/// Any number that what is compared depends on.
[[nodiscard]] bool canBeSwept(const Setting& setting);
/// How one types it: "--size", "--set pcf.taps".
[[nodiscard]] std::string spelled(const Setting& setting);

/// The anti-aliasing of the picture. --aa auto is fxaa for a picture to look at, none for one that is measured or a
/// mask.
[[nodiscard]] host::AntiAliasing antiAliasingOf(const Settings& settings);
/// Whether the picture has ambient occlusion. A mask and forward shading have none.
[[nodiscard]] bool hasOcclusion(const Settings& settings);

/// All defaults applied.
[[nodiscard]] Settings defaultSettings();
/// Parses, checks and applies one value. Throws UsageError that names the setting, what is wrong and what is allowed.
void applySetting(Settings& settings, const Setting& setting, std::string_view text);
/// Applies one value by its key. The UsageError for an unknown key suggests the nearest one.
void applySetting(Settings& settings, std::string_view key, std::string_view text);
/// Throws UsageError for a key that no setting has, with the nearest.
[[noreturn]] void refuseKey(std::string_view key);
/// Forgets the camera's place that was set the other way, so that the latest holds. `latest` is --camera, --eye or
/// --target; other keys change nothing.
void replaceCamera(Settings& settings, std::string_view latest);
/// For one of lvsm.placement, lvsm.splits and lvsm.world the keys that place layers otherwise; for other keys none.
[[nodiscard]] std::span<const std::string_view> placementPartners(std::string_view key);
/// Called before a key is applied whose partner was given in the same place. Throws UsageError when the key contradicts
/// it: lvsm.splits belongs to layers placed by hand, lvsm.world to layers of the world.
void requireOnePlacement(const Settings& settings, std::string_view key, std::string_view text,
                         std::string_view partner);
/// So that a list given later does not add to a preset's.
void forgetTechniques(Settings& settings);
/// Checks settings against each other. Throws UsageError where they contradict each other or cannot be had together.
void validateSettings(const Settings& settings);
/// A sentence for each given option that has no effect with the others, in the order of the table. makeShot() tells of
/// those that depend on the scene. Throws UsageError for the first one with --strict, and where contestants() does.
/// Precondition: validateSettings() passed.
[[nodiscard]] std::vector<std::string> optionsWithoutEffect(const Settings& settings);
/// Adds the sentence to `told` unless it is there; with --strict throws it as UsageError.
void tellNoEffect(const Settings& settings, std::vector<std::string>& told, std::string sentence);
/// Notes in `values` what follows from other settings (map format, border). Throws UsageError when the library refuses
/// the options.
void completeTechnique(Settings& settings);

/// "pcf+pcf.kernel=5x5+map-size=1024": values of the choices and KEY=VALUE of technique settings joined by +. Applies
/// them to a copy of `base`; parts without effect change nothing. Throws UsageError.
[[nodiscard]] Settings parseTechnique(const Settings& base, std::string_view text);
/// The shortest text that parseTechnique() turns into these settings.
[[nodiscard]] std::string describeTechnique(const Settings& settings);

/// The nearest of `names` to what was typed, as " (did you mean \"x\"?)", or empty when none is near.
[[nodiscard]] std::string suggestion(std::string_view typed, const std::vector<std::string_view>& names);
/// "a, b and c".
[[nodiscard]] std::string listed(const std::vector<std::string_view>& names);

} // namespace gnomon::app
