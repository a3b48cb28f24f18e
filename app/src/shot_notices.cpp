// SPDX-License-Identifier: Apache-2.0
#include "shot_parts.h"

#include "contestants.h"

#include "scene/hash.h"

#include <gnomon/choice_rules.h>
#include <gnomon/world_range.h>

#include <fmt/format.h>
#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::app {
namespace {

std::vector<Settings> techniquesOf(const Settings& settings)
{
    return hasManyTechniques(settings) ? contestants(settings) : std::vector{settings};
}

/// A mean over frames needs more than one, and pages follow the edges of earlier frames.
void noteFrames(Shot& shot, const Settings& settings)
{
    const bool plans = settings.subcommand == kPlan && settings.shadow.technique.soften != Soften::converge;
    const bool draws = settings.subcommand == kCompare || (settings.subcommand == kRender && !settings.truth);
    if (!(draws || plans) || settings.converge != 1 || settings.frames) {
        return;
    }
    const std::vector<Settings> techniques = techniquesOf(settings);
    const auto learns = std::ranges::find_if(techniques, &Settings::learnsFromFrames);
    if (learns != techniques.end()) {
        shot.notices.push_back(
            fmt::format("{}, and this is {}",
                        learns->shadow.technique.soften == Soften::converge
                            ? "soften converge averages frames"
                            : "partition virtual has pages by what the frames before showed",
                        plans ? "the plan of a first frame" : "one frame; --converge N draws N at rest"));
    }
}

/// Adds notices about the lights, once and not for every frame.
void noteLights(Shot& shot, const Settings& settings)
{
    if (shot.scene.lights.empty() && !settings.placesLights()) {
        shot.notices.push_back("the scene has no light; a sun is put in");
    }
    std::uint32_t refused = 0;
    std::string_view why;
    const std::string* first = nullptr;
    for (const host::ShadedLight& light : shot.lights) {
        if (const auto reason = refusalOf(light, settings)) {
            first = refused == 0 ? &light.name : first;
            why = *reason;
            ++refused;
        }
    }
    if (refused != 0) {
        shot.notices.push_back(refused == 1
                                   ? fmt::format("light {} casts no shadow: {}", *first, why)
                                   : fmt::format("{} lights cast no shadow ({} and others): {}", refused, *first, why));
    }
}

/// Warns when a technique for penumbrae of the light's size is asked for and the light has none. The default takes any
/// light.
void noteSizes(Shot& shot, const Settings& settings)
{
    const std::vector<Settings> techniques = techniquesOf(settings);
    const bool asks = std::ranges::any_of(techniques, [](const Settings& technique) {
        return integratesLight(technique.shadow) && filterOf(technique.shadow) != Filter::raymarch;
    });
    const auto has_size = [](const host::ShadedLight& light) {
        const Light& caster = light.caster;
        return caster.type == LightType::directional ? caster.angular_diameter_rad > 0.0 : caster.radius_m > 0.0;
    };
    if (!asks || settings.truth || shot.lights.empty() || std::ranges::any_of(shot.lights, has_size)) {
        return;
    }
    const bool is_sun = shot.lights.front().caster.type == LightType::directional;
    shot.notices.push_back(fmt::format("no light has a size, so there are no penumbrae; {} gives it one",
                                       is_sun ? "--sun-angle" : "--light-size"));
}

/// A picture of a light that swallows what it is to shine on is right, and not what one had in mind.
void noteExtents(Shot& shot, const Settings& settings)
{
    for (const host::ShadedLight& light : shot.lights) {
        const Light& caster = light.caster;
        if (settings.truth == truth::Kind::area && caster.casts_shadow && caster.type != LightType::directional &&
            holdsSurface(shot.scene, shot.state, caster.position_ws, caster.radius_m)) {
            shot.notices.push_back(
                fmt::format("light {}, a sphere of {} m across, reaches into the scene; what is inside "
                            "it is lit in full and casts nothing in the truth",
                            light.name, 2.0 * caster.radius_m));
        }
    }
}

/// In a wide world single precision has no room for what is small, by kSmallestShare, as of a whole scene. Maps
/// and truth lose the same, so a comparison does not show it.
void noteDistances(Shot& shot)
{
    constexpr float kWide_m = 1e5F; // in less, a step is below 8 mm
    const auto longest = [](const glm::vec3& v) {
        return std::max({v.x, v.y, v.z});
    };
    const Aabb& all = shot.state.bounds_ws;
    const float reach_m = all.empty() ? 0.0F : longest(glm::max(glm::abs(all.min), glm::abs(all.max)));
    const auto lost = std::ranges::count_if(shot.state.objects, [&](const scene::Object& object) {
        return !object.bounds_ws.empty() &&
               longest(object.bounds_ws.extent()) < static_cast<float>(kSmallestShare) * reach_m;
    });
    if (reach_m < kWide_m || lost == 0) {
        return;
    }
    constexpr float kMetresOfKm = 1000.0F;
    shot.notices.push_back(fmt::format(
        "the scene reaches {:.0f} km from the origin, where single precision has steps of {:.3g} m: shadows of {} "
        "of its {} objects may be lost or off by as much, in the truth too; leave out what is far, or bring it nearer",
        reach_m / kMetresOfKm, std::nextafter(reach_m, std::numeric_limits<float>::infinity()) - reach_m, lost,
        shot.state.objects.size()));
}

/// A result's preset makes its run again only on what it was made on.
void noteScene(Shot& shot, const Settings& settings)
{
    if (settings.scene_hash.empty()) {
        return;
    }
    const std::string hash = scene::toString(scene::sceneHash(shot.scene));
    if (hash != settings.scene_hash) {
        shot.notices.push_back(
            fmt::format("{} is not what the preset's result was measured on: its hash is {}, there {}", settings.scene,
                        hash, settings.scene_hash));
    }
}

} // namespace

std::optional<std::string_view> refusalOf(const host::ShadedLight& light, const Settings& settings)
{
    const bool traced_alone = settings.truth && settings.subcommand != kCompare;
    if (traced_alone) {
        return std::nullopt;
    }
    const ShadowOptions& options = settings.shadow;
    const MomentOptions& moments = options.moments;
    if (hasWorldLayers(filterOf(options), moments) && moments.layer_axis == LayerAxis::light &&
        std::ranges::all_of(moments.world_layers, [](const WorldLayer& one) { return one == WorldLayer{}; })) {
        return "lvsm.axis light: layers that are found are layers of height; give those along the light by lvsm.world";
    }
    return refusal(light.caster.type, options);
}

void noteWhatSurprises(Shot& shot, const Settings& settings)
{
    noteLights(shot, settings);
    noteFrames(shot, settings);
    noteSizes(shot, settings);
    noteExtents(shot, settings);
    noteDistances(shot);
    noteTakenLight(shot);
    noteScene(shot, settings);
    if (settings.fov_deg && shot.eye.height_m > 0.0) {
        tellNoEffect(settings, shot.notices,
                     "--fov has no effect on an orthographic camera; --ortho sets how much it sees");
    }
}

std::optional<std::string> waitNote(const lab::Waits& waits)
{
    if (waits.longest_frames == 0) {
        return std::nullopt;
    }
    return fmt::format("lights keep maps that they had until their turn comes: up to {} light{} and {} map{} in a "
                       "frame, for {} frame{} at the longest; frames after the first draw {} texels at most",
                       waits.most_lights, waits.most_lights == 1 ? "" : "s", waits.most_maps,
                       waits.most_maps == 1 ? "" : "s", waits.longest_frames, waits.longest_frames == 1 ? "" : "s",
                       waits.most_texels);
}

} // namespace gnomon::app
