// SPDX-License-Identifier: Apache-2.0
// Settings of picture, camera and lights. A new option is one row here.
#include "object_casting.h"
#include "setting_rows.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace gnomon::app {
namespace {

using enum SettingType;
using Group = SettingGroup;
using Value = SettingValue;

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
    using enum host::AntiAliasing;
    s.anti_aliasing = v.text == "auto"   ? std::nullopt
                      : v.text == "none" ? std::optional(none)
                      : v.text == "fxaa" ? std::optional(fxaa)
                                         : std::optional(ssaa4);
}

/// Else it is measured, and is to stay comparable with what was measured before.
bool isLookedAt(const Settings& s)
{
    return (s.subcommand & (kRender | kView)) != 0 && !s.mask;
}

/// Ambient occlusion needs a G-buffer and light of the sky. With the ray tracer's masks shading is always deferred.
bool mayBeOccluded(const Settings& s)
{
    const bool deferred = s.shading == host::Shading::deferred || s.truth.has_value();
    return !s.mask && deferred && s.reflection == host::Reflection::materials;
}

void applySpot(Settings& s, const Value& v)
{
    const SpotLight spot{vec3(v.numbers), vec3(v.numbers, 3), v.numbers[6]};
    (void)direction("spot", spot.target_ws - spot.position_ws);
    if (!(spot.angle_deg >= 0.1 && spot.angle_deg <= 180.0)) {
        throw UsageError(
            fmt::format("--spot: its cone of {} degrees is not in the range 0.1 to 180 degrees", spot.angle_deg));
    }
    s.spot = spot;
}

constexpr std::uint32_t kNumbersOfPoint = 4;
constexpr std::uint32_t kMostPoints = 64; // beside a sun and a spot

void applyPoint(Settings& s, const Value& v)
{
    if (v.numbers.size() % kNumbersOfPoint != 0) {
        throw UsageError(fmt::format("--point: {} numbers are not four for each light", v.numbers.size()));
    }
    s.points.clear();
    for (std::size_t i = 0; i < v.numbers.size(); i += kNumbersOfPoint) {
        const double range_m = v.numbers[i + 3];
        if (!(range_m > 0.0)) {
            throw UsageError(fmt::format("--point: its range of {} m is not above 0", range_m));
        }
        s.points.push_back({vec3(v.numbers, i), range_m});
    }
}

/// The ray tracer's mask is written as it is.
bool drawsAPicture(const Settings& s)
{
    return !(s.mask && s.truth.has_value());
}
bool isPicture(const Settings& s)
{
    return !s.mask;
}
bool isShadedPicture(const Settings& s)
{
    return !s.mask && !s.truth.has_value() && (s.debug.empty() || s.debug == "none");
}

bool glows(const Settings& s)
{
    return isPicture(s) && s.bloom.on;
}
/// A compact mask is for pictures, and for lights that need one channel of one frame (ShadowRendererOptions::compact).
bool mayBeCompact(const Settings& s)
{
    const Technique& technique = s.shadow.technique;
    const bool is_shadowed_picture = !s.mask && !s.truth.has_value() && (s.debug.empty() || s.debug == "none");
    return is_shadowed_picture && technique.soften == Soften::none && s.shadow.translucent == Translucent::grey &&
           (technique.motion == Motion::free || technique.motion == Motion::snap) && hasMaps(s.shadow) &&
           s.shadow.mask_size == MaskSize::full;
}
bool isCompact(const Settings& s)
{
    return mayBeCompact(s) && s.compact_mask.channels > 0;
}
/// Does anybody look at how large a light is?
bool lightHasSize(const Settings& s)
{
    if (s.subcommand == kRender && s.truth) { // no map is drawn
        return s.truth == truth::Kind::area;
    }
    return s.truth == truth::Kind::area || s.shadow.technique.soften == Soften::converge || integratesLight(s.shadow);
}

const std::vector<Setting>& rows()
{
    static const std::vector<Setting> table{
        // clang-format off
        {.key = "size", .group = Group::picture, .type = size, .form = "WxH", .unit = "pixels", .default_text = "1280x720", .min = 1, .max = 1e6,
         .doc = "width and height of the picture", .apply = [](Settings& s, const Value& v) { s.size_px = {v.numbers[0], v.numbers[1]}; }},
        {.key = "aa", .group = Group::picture, .type = choice, .form = "MODE", .default_text = "auto", .choices = [] { return Names{"auto", "none", "fxaa", "ssaa4"}; },
         .doc = "anti-aliasing: none, fxaa, ssaa4; auto: fxaa, none in bench", .subcommands = kPictures, .used = drawsAPicture, .used_when = "something to draw", .apply = applyAntiAliasing},
        {.key = "ambient-occlusion", .group = Group::picture, .type = choice, .form = "MODE", .default_text = "auto", .choices = [] { return Names{"auto", "off", "on"}; },
         .doc = "less of the sky's light where surfaces near by hide it: off or on; auto: on, but off in bench", .subcommands = kPictures, .own_option = false, .used = mayBeOccluded,
         .used_when = "a picture (not --mask), shading deferred and reflection materials", .apply = [](Settings& s, const Value& v) { s.ambient_occlusion = v.text == "auto" ? std::nullopt : std::optional(v.text == "on"); }},
        {.key = "ambient-occlusion.radius", .group = Group::picture, .type = real, .form = "METRES", .unit = "m", .min = 1e-6, .max = 1e6,
         .doc = "how far what hides the sky may be; else found from the sizes of what is in the scene", .subcommands = kPictures, .own_option = false, .used = hasOcclusion,
         .used_when = "ambient occlusion", .apply = [](Settings& s, const Value& v) { s.occlusion_radius_m = v.real; }},
        {.key = "tone", .group = Group::picture, .type = choice, .form = "CURVE", .default_text = "neutral", .choices = [] { return Names{"neutral", "filmic"}; },
         .doc = "from light to what a screen shows: neutral keeps hues, filmic has more contrast and turns bright orange to yellow", .subcommands = kPictures, .own_option = false, .used = isPicture, .used_when = "a picture, not --mask", .apply = [](Settings& s, const Value& v) { s.tone = v.text == "filmic" ? host::ToneCurve::filmic : host::ToneCurve::neutral; }},
        {.key = "dither", .group = Group::picture, .type = flag, .default_text = "1", .doc = "noise of a step of 255 at most, so that gradients have no contours",
         .subcommands = kPictures, .own_option = false, .used = isPicture, .used_when = "a picture, not --mask", .apply = [](Settings& s, const Value& v) { s.dither = v.flag; }},
        {.key = "compact-mask", .group = Group::picture, .type = choice, .form = "CHANNELS", .default_text = "none", .choices = [] { return Names{"none", "4", "8"}; },
         .doc = "channels of the mask for each tile of the picture, 4 or 8, instead of one for each light: none, 4 or 8", .subcommands = kPictures, .own_option = false, .used = mayBeCompact,
         .used_when = "a picture with shadows from maps (not --mask, --debug, --truth), soften=none, motion free or snap, translucent=grey and mask-size=full", .apply = [](Settings& s, const Value& v) { s.compact_mask.channels = v.text == "4" ? 4 : v.text == "8" ? 8 : 0; }},
        {.key = "compact-mask.side", .group = Group::picture, .type = choice, .form = "PIXELS", .unit = "pixels", .default_text = "16", .choices = [] { return Names{"16", "32"}; },
         .doc = "side of such a tile, 16 or 32", .subcommands = kPictures, .own_option = false, .used = isCompact, .used_when = "compact-mask=4 or 8", .apply = [](Settings& s, const Value& v) { s.compact_mask.side_px = v.text == "32" ? 32 : 16; }},
        {.key = "bloom", .group = Group::picture, .type = flag, .default_text = "0", .doc = "let what is very bright glow into its surroundings",
         .subcommands = kPictures, .own_option = false, .used = isPicture, .used_when = "a picture, not --mask", .apply = [](Settings& s, const Value& v) { s.bloom.on = v.flag; }},
        {.key = "bloom.threshold", .group = Group::picture, .type = real, .form = "LIGHT", .default_text = "0.8", .min = 0, .max = 64,
         .doc = "brighter light glows; 1 shows at 92 % of white, a sunlit white wall is 1.35", .subcommands = kPictures, .own_option = false, .used = glows, .used_when = "bloom=1",
         .apply = [](Settings& s, const Value& v) { s.bloom.threshold = static_cast<float>(v.real); }},
        {.key = "bloom.knee", .group = Group::picture, .type = real, .form = "SHARE", .default_text = "0.25", .min = 0, .max = 1,
         .doc = "share of the threshold, both ways, over which glowing sets in", .subcommands = kPictures, .own_option = false, .used = glows, .used_when = "bloom=1",
         .apply = [](Settings& s, const Value& v) { s.bloom.knee = static_cast<float>(v.real); }},
        {.key = "bloom.intensity", .group = Group::picture, .type = real, .form = "SHARE", .default_text = "1", .min = 0, .max = 4,
         .doc = "how much of the light above the threshold is spread", .subcommands = kPictures, .own_option = false, .used = glows, .used_when = "bloom=1",
         .apply = [](Settings& s, const Value& v) { s.bloom.intensity = static_cast<float>(v.real); }},
        {.key = "bloom.radius", .group = Group::picture, .type = real, .form = "TEXELS", .unit = "texels", .default_text = "1", .min = 0.5, .max = 3,
         .doc = "half the reach of the tent that enlarges each level", .subcommands = kPictures, .own_option = false, .used = glows, .used_when = "bloom=1",
         .apply = [](Settings& s, const Value& v) { s.bloom.radius = static_cast<float>(v.real); }},
        {.key = "bloom.levels", .group = Group::picture, .type = integer, .form = "N", .default_text = "6", .min = 1, .max = 8,
         .doc = "halvings; each doubles the glow's reach", .subcommands = kPictures, .own_option = false, .used = glows, .used_when = "bloom=1",
         .apply = [](Settings& s, const Value& v) { s.bloom.levels = static_cast<std::uint32_t>(v.integer); }},
        {.key = "sky", .group = Group::picture, .type = choice, .form = "NAME", .default_text = "physical", .choices = [] { return Names{"physical", "plain"}; },
         .doc = "physical: air, light and exposure by the sun's height, where there is a sun; or plain: a gradient",
         .subcommands = kPictures, .own_option = false, .used = isPicture, .used_when = "a picture, not --mask", .apply = [](Settings& s, const Value& v) { s.sky = v.text == "plain" ? host::SkyModel::plain : host::SkyModel::physical; }},
        {.key = "exposure", .group = Group::picture, .type = real, .form = "STOPS", .unit = "stops", .default_text = "0", .min = -16, .max = 16,
         .doc = "brighter than by the light of the hour; 1 is twice as bright", .subcommands = kPictures, .used = isPicture, .used_when = "a picture, not --mask",
         .apply = [](Settings& s, const Value& v) { s.exposure_ev = v.real; }},
        {.key = "shading", .group = Group::picture, .type = choice, .form = "ORDER", .default_text = "deferred", .choices = [] { return Names{"deferred", "forward"}; },
         .doc = "by a G-buffer and a mask, or forward, by the maps", .subcommands = kPictures, .used = isShadedPicture, .used_when = "a picture (not --mask, --debug, --truth)", .apply = [](Settings& s, const Value& v) { s.shading = v.text == "forward" ? host::Shading::forward : host::Shading::deferred; }},
        {.key = "reflection", .group = Group::picture, .type = choice, .form = "NAME", .default_text = "materials", .choices = [] { return Names{"materials", "phong-2005"}; },
         .doc = "by the scene's materials, or phong-2005: exponent 8, no ambient light, as A. S. Shastry shaded in 2005", .subcommands = kPictures, .own_option = false, .used = isPicture, .used_when = "a picture, not --mask", .apply = [](Settings& s, const Value& v) { s.reflection = v.text == "phong-2005" ? host::Reflection::phong_2005 : host::Reflection::materials; }},
        {.key = "ground", .group = Group::picture, .type = choice, .form = "WHEN", .default_text = "auto", .choices = [] { return Names{"auto", "on", "off"}; }, .bare_text = "on",
         .doc = "put a ground under the scene; auto: under a file without one", .apply = [](Settings& s, const Value& v) { s.ground = v.text == "on" ? Ground::on : v.text == "off" ? Ground::off : Ground::automatic; }},
        {.key = "up-axis", .group = Group::picture, .type = choice, .form = "AXIS", .default_text = "y", .choices = [] { return Names{"y", "z"}; },
         .doc = "which axis of a file is up: y, as glTF has it, or z", .apply = [](Settings& s, const Value& v) { s.up_axis = v.text == "z" ? UpAxis::z : UpAxis::y; }},
        {.key = "blended", .group = Group::picture, .type = choice, .form = "AS", .default_text = "coverage",
         .choices = [] { return Names{"coverage", "stained"}; },
         .doc = "light that blended surfaces take: coverage, or stained",
         .apply = [](Settings& s, const Value& v) { s.stained = v.text == "stained"; }},
        {.key = "object", .group = Group::picture, .type = text, .form = "NAME:KEY=VALUE,...",
         .doc = "NAME:KEY=VALUE,... of an object: casts, receives, moves, bias_m, groups (0+3); with ; between several objects", .own_option = false, .repeatable = true, .separator = ";", .apply = applyObjects},
        {.key = "override-material", .group = Group::picture, .type = choice, .form = "NAME", .default_text = "none",
         .choices = [] { return Names{"none", "diffuse"}; }, .doc = "draw everything in one material: none or diffuse",
         .subcommands = kDraw, .apply = [](Settings& s, const Value& v) { s.material_override = v.text == "none" ? "" : v.text; }},

        {.key = "camera", .group = Group::camera, .type = text, .form = "NAME", .doc = "a camera or view of the scene by its name",
         .names_in = [](const scene::Scene& in) { return namesIn(in.views, in.cameras); }, .apply = [](Settings& s, const Value& v) { s.camera = v.text; }},
        {.key = "eye", .group = Group::camera, .type = numbers, .form = "x,y,z", .unit = "m", .min = -kFarthest, .max = kFarthest, .count = 3,
         .doc = "where the camera is", .apply = [](Settings& s, const Value& v) { s.eye_ws = vec3(v.numbers); }},
        {.key = "target", .group = Group::camera, .type = numbers, .form = "x,y,z", .unit = "m", .min = -kFarthest, .max = kFarthest, .count = 3,
         .doc = "what it looks at", .apply = [](Settings& s, const Value& v) { s.target_ws = vec3(v.numbers); }},
        {.key = "up", .group = Group::camera, .type = numbers, .form = "x,y,z", .default_text = "0,1,0", .min = -kFarthest, .max = kFarthest, .count = 3,
         .doc = "what is up for it", .used = [](const Settings& s) { return s.eye_ws.has_value(); }, .used_when = "--eye",
         .apply = [](Settings& s, const Value& v) { s.up_ws = direction("up", vec3(v.numbers)); }},
        {.key = "fov", .group = Group::camera, .type = real, .form = "DEG", .unit = "degrees", .min = 0.1, .max = 179,
         .doc = "vertical field of view; else the camera's own, or 45", .apply = [](Settings& s, const Value& v) { s.fov_deg = v.real; }},
        {.key = "ortho", .group = Group::camera, .type = real, .form = "HEIGHT", .unit = "m", .min = 1e-6, .max = kFarthest,
         .doc = "orthographic, with so much from top to bottom; else the camera's own", .apply = [](Settings& s, const Value& v) { s.ortho_m = v.real; }},

        {.key = "sun", .group = Group::light, .type = numbers, .form = "x,y,z", .min = -kFarthest, .max = kFarthest, .count = 3,
         .doc = "direction the light travels; replaces the scene's lights",
         .of_lights = "directional", .apply = [](Settings& s, const Value& v) { s.sun_ws = direction("sun", vec3(v.numbers)); }},
        {.key = "spot", .group = Group::light, .type = numbers, .form = "x,y,z,tx,ty,tz,DEG", .unit = "m, degrees", .min = -kFarthest, .max = kFarthest, .count = 7,
         .doc = "spot light: place, target, whole cone; replaces the scene's lights", .of_lights = "spot", .apply = applySpot},
        {.key = "point", .group = Group::light, .type = numbers, .form = "x,y,z,RANGE,...", .unit = "m", .min = -kFarthest, .max = kFarthest, .count = kNumbersOfPoint * kMostPoints, .min_count = kNumbersOfPoint,
         .doc = "place and reach of each point light; replaces the scene's lights", .of_lights = "point", .apply = applyPoint},
        {.key = "sun-angle", .group = Group::light, .type = real, .form = "DEG", .unit = "degrees", .min = 0, .max = 90,
         .doc = "angular diameter of directional lights; else their own, or 0.53", .subcommands = kFrames, .used = lightHasSize, .used_when = "--truth area, filter pcss or raymarch, penumbra light, filter or soften smoothies, or soften converge",
         .of_lights = "directional", .apply = [](Settings& s, const Value& v) { s.sun_angle_deg = v.real; }},
        {.key = "light-size", .group = Group::light, .type = real, .form = "METRES", .unit = "m", .min = 0, .max = 1e6,
         .doc = "diameter of spot and point lights, spheres; else their own, or 0", .subcommands = kFrames, .used = lightHasSize, .used_when = "--truth area, filter pcss or raymarch, penumbra light, filter or soften smoothies, or soften converge",
         .of_lights = "spot point", .apply = [](Settings& s, const Value& v) { s.light_size_m = v.real; }},
        {.key = "spot.cone", .group = Group::light, .type = real, .form = "DEG", .unit = "degrees", .min = 0.1, .max = 180,
         .doc = "the whole cone of spot lights; else their own", .own_option = false, .of_lights = "spot", .apply = [](Settings& s, const Value& v) { s.cone_deg = v.real; }},
        {.key = "spot.near", .group = Group::light, .type = real, .form = "METRES", .unit = "m", .min = 0, .max = 1e6,
         .doc = "nothing nearer to a spot light casts; else its own, or found from what casts", .own_option = false, .of_lights = "spot", .apply = [](Settings& s, const Value& v) { s.near_m = v.real; }},
        {.key = "spot.range", .group = Group::light, .type = real, .form = "METRES", .unit = "m", .min = 0, .max = 1e6,
         .doc = "reach of spot lights; else their own, or as far as the scene goes", .own_option = false, .of_lights = "spot", .apply = [](Settings& s, const Value& v) { s.range_m = v.real; }},
        {.key = "light-groups", .group = Group::light, .type = text, .form = "NAME:GROUP+...",
         .doc = "the groups of casters that a light makes shadows of, 0 to 31; else its own, or all", .own_option = false, .repeatable = true, .separator = ";", .apply = applyLightGroups},
        // clang-format on
    };
    return table;
}

} // namespace

host::AntiAliasing antiAliasingOf(const Settings& settings)
{
    const auto chosen = isLookedAt(settings) ? host::AntiAliasing::fxaa : host::AntiAliasing::none;
    return settings.anti_aliasing.value_or(chosen);
}

bool hasOcclusion(const Settings& settings)
{
    return mayBeOccluded(settings) && settings.ambient_occlusion.value_or(isLookedAt(settings));
}

void addSceneRows(std::vector<Setting>& table)
{
    table.insert(table.end(), rows().begin(), rows().end());
}

} // namespace gnomon::app
