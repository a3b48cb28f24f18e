// SPDX-License-Identifier: Apache-2.0
#include "app/shot.h"

#include "object_casting.h"
#include "shot_parts.h"

#include "scene/range.h"
#include "worlds/worlds.h"

#include <gnomon/error.h>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>

namespace gnomon::app {
namespace {

// As bright as the suns of the built-in worlds; a spot or point light shines as brightly at its aim.
constexpr float kSunLux = 3.2F;
constexpr double kAimLux = 6.0;
const glm::vec3 kWarmWhite{1.0F, 0.95F, 0.87F};
constexpr double kInnerShare = 0.8; // the share of a spot's cone that is fully lit

/// Any vector that is perpendicular to `axis`, the same one every time.
glm::dvec3 perpendicular(const glm::dvec3& axis)
{
    const glm::dvec3 other = std::abs(axis.y) < 0.9 ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(0.0, 0.0, 1.0);
    return glm::normalize(other - axis * glm::dot(axis, other));
}

host::ShadedLight sunLight(const glm::dvec3& direction_ws)
{
    host::ShadedLight light;
    light.name = "sun";
    light.caster.type = LightType::directional;
    light.caster.direction_ws = direction_ws;
    light.colour = kWarmWhite * kSunLux;
    light.body = scene::Body::sun;
    light.up_ws = perpendicular(direction_ws);
    setBrightness(light);
    return light;
}

host::ShadedLight spotLight(const SpotLight& spot)
{
    const glm::dvec3 aim = spot.target_ws - spot.position_ws;
    const double distance = glm::length(aim);
    host::ShadedLight light;
    light.name = "spot";
    light.caster.type = LightType::spot;
    light.caster.position_ws = spot.position_ws;
    light.caster.direction_ws = aim / distance;
    light.caster.outer_half_angle_rad = glm::radians(spot.angle_deg) / 2.0;
    light.inner_half_angle_rad = light.caster.outer_half_angle_rad * kInnerShare;
    light.colour = kWarmWhite * static_cast<float>(kAimLux * distance * distance);
    light.up_ws = perpendicular(light.caster.direction_ws);
    setBrightness(light);
    return light;
}

host::ShadedLight pointLight(const PointLight& point)
{
    host::ShadedLight light;
    light.name = "point";
    light.caster.type = LightType::point;
    light.caster.position_ws = point.position_ws;
    light.caster.range_m = point.range_m;
    constexpr double kBrightAt = 0.3; // share of the reach: half way to the dark, by eye
    const double bright_m = point.range_m * kBrightAt;
    light.colour = kWarmWhite * static_cast<float>(kAimLux * bright_m * bright_m);
    setBrightness(light);
    return light;
}

/// Lights of the command line; empty when it names none.
std::vector<host::ShadedLight> givenLights(const Settings& settings)
{
    std::vector<host::ShadedLight> lights;
    if (settings.sun_ws) {
        lights.push_back(sunLight(*settings.sun_ws));
    }
    if (settings.spot) {
        lights.push_back(spotLight(*settings.spot));
    }
    for (const PointLight& point : settings.points) {
        lights.push_back(pointLight(point));
    }
    for (const host::ShadedLight& light : lights) {
        if (const auto reason = refusalOf(light, settings)) {
            throw UsageError(fmt::format("--{}: {}", light.name, *reason));
        }
    }
    for (std::size_t i = 0; settings.points.size() > 1 && i < settings.points.size(); ++i) {
        lights[lights.size() - settings.points.size() + i].name = fmt::format("point {}", i);
    }
    for (std::size_t i = 0; i < lights.size(); ++i) {
        lights[i].caster.key = static_cast<std::uint32_t>(i);
    }
    return lights;
}

void shapeSpot(host::ShadedLight& light, const Settings& settings)
{
    Light& caster = light.caster;
    if (settings.cone_deg) {
        const double outer_rad = glm::radians(*settings.cone_deg) / 2.0;
        light.inner_half_angle_rad *= outer_rad / caster.outer_half_angle_rad;
        caster.outer_half_angle_rad = outer_rad;
    }
    caster.near_m = settings.near_m.value_or(caster.near_m);
    caster.range_m = settings.range_m.value_or(caster.range_m);
}

void placeLights(Shot& shot, const Settings& settings)
{
    shot.lights = givenLights(settings);
    if (shot.lights.empty()) {
        shot.lights = host::lightsOf(shot.scene, shot.state);
        for (std::size_t i = 0; i < shot.lights.size(); ++i) {
            if (shot.lights[i].name.empty()) {
                shot.lights[i].name = fmt::format("light{}", i);
            }
        }
    }
    if (shot.lights.empty()) {
        shot.lights.push_back(sunLight(sunOf(shot.outlook)));
    }
    for (host::ShadedLight& light : shot.lights) {
        if (light.caster.type == LightType::directional) {
            light.caster.angular_diameter_rad =
                settings.sun_angle_deg ? glm::radians(*settings.sun_angle_deg) : light.caster.angular_diameter_rad;
        } else if (settings.light_size_m) {
            light.caster.radius_m = *settings.light_size_m / 2.0;
        }
        if (light.caster.type == LightType::spot) {
            shapeSpot(light, settings);
        }
    }
    groupAsTold(shot, settings);
}

void overrideMaterials(scene::Scene& scene)
{
    scene::Material diffuse;
    diffuse.name = "diffuse";
    diffuse.base_colour = {0.7F, 0.7F, 0.7F, 1.0F};
    diffuse.metallic = 0.0F;
    diffuse.double_sided = true;
    scene.materials.assign(1, diffuse);
    for (scene::Mesh& mesh : scene.meshes) {
        for (scene::Primitive& primitive : mesh.primitives) {
            primitive.material = 0;
        }
    }
}

} // namespace

double timeOf(const Settings& settings, std::uint32_t frame)
{
    return settings.frames ? settings.time_s + static_cast<double>(frame) / settings.fps : settings.time_s;
}

namespace {

/// A path may say what time it is.
double momentOf(const Shot& shot, const Settings& settings, std::uint32_t frame)
{
    const double s = pathSeconds(settings, frame);
    if (shot.path && !shot.path->keys.time_s.empty()) {
        return shot.path->keys.time_s.at(s).x;
    }
    if (shot.path && shot.path->scene_moves_sun) {
        return timeOf(settings, settings.frames->first) + s;
    }
    return timeOf(settings, frame);
}

} // namespace

double focusOf(const Shot& shot)
{
    constexpr double kNearest = 0.01; // share of the scene's diagonal
    const glm::dvec3 look = shot.eye.target_ws - shot.eye.position_ws;
    if (shot.has_target) {
        return glm::length(look);
    }
    const Aabb model = modelBounds(shot);
    const glm::dvec3 to_middle = glm::dvec3(model.centre()) - shot.eye.position_ws;
    return std::max(glm::dot(to_middle, glm::normalize(look)), kNearest * glm::length(glm::dvec3(model.extent())));
}

namespace {

/// The shot is at the first frame.
void startPath(Shot& shot, const Settings& settings)
{
    ScriptedPath& path = *shot.path;
    path.start = shot.eye;
    path.focus_m = focusOf(shot);
    const Camera camera = host::cameraOf(shot.eye, 1, 1, shot.state.bounds_ws);
    const glm::dmat4& m = camera.clip_from_world;
    path.right_ws = glm::normalize(glm::dvec3(m[0][0], m[1][0], m[2][0]));
    const glm::dvec3 forward = glm::normalize(shot.eye.target_ws - shot.eye.position_ws);
    if (glm::length(glm::cross(forward, glm::normalize(shot.eye.up_ws))) < 1e-6) {
        path.start.up_ws = glm::cross(path.right_ws, forward); // the picture's: turning about the line of sight is none
    }
    const bool from_scene = !settings.placesLights() && !shot.scene.lights.empty();
    path.scene_moves_sun = path.kind == PathKind::day && from_scene && lightsMove(shot.scene, shot.state, settings);
    if (path.movesSun()) {
        const auto sun = std::find_if(shot.lights.begin(), shot.lights.end(), [](const host::ShadedLight& light) {
            return light.caster.type == LightType::directional;
        });
        if (sun == shot.lights.end()) {
            throw UsageError(fmt::format("--path {} moves the sun, but there is no directional light", settings.path));
        }
        path.sun = static_cast<std::size_t>(sun - shot.lights.begin());
        path.sun_ws = sun->caster.direction_ws;
    }
    requireCameras(path, settings);
}

/// Camera and sun as the path has them at a frame.
void followPath(Shot& shot, const Settings& settings, std::uint32_t frame)
{
    const PathSpot spot = pathAt(*shot.path, pathSeconds(settings, frame));
    if (shot.path->movesCamera()) {
        shot.eye = spot.eye;
    }
    if (shot.path->movesSun()) {
        host::ShadedLight& sun = shot.lights[shot.path->sun];
        sun.caster.direction_ws = spot.sun_ws;
        sun.body = scene::Body::sun; // a light of a file is none, and would be no sun where it sets
        sun.up_ws = perpendicular(spot.sun_ws);
    }
}

void requireAnimation(const scene::Scene& scene, const std::string& name)
{
    std::vector<std::string_view> names;
    for (const scene::Animation& animation : scene.animations) {
        names.push_back(animation.name);
    }
    if (!name.empty() && std::find(names.begin(), names.end(), name) == names.end()) {
        throw UsageError(fmt::format("--animation: there is no \"{}\"{}; {}", name, suggestion(name, names),
                                     names.empty() ? "the scene has none" : "it has " + listed(names)));
    }
}

} // namespace

namespace {

bool isFile(const Settings& settings)
{
    return worlds::find(settings.scene) == nullptr;
}

void turnFile(Shot& shot, const Settings& settings)
{
    if (settings.up_axis == UpAxis::y) {
        return;
    }
    if (isFile(settings)) {
        standUp(shot.scene);
    } else {
        tellNoEffect(settings, shot.notices, "--up-axis has an effect on files only; built-in worlds have y up");
    }
}

void stainMaterials(Shot& shot, const Settings& settings)
{
    bool any = false;
    for (scene::Material& material : shot.scene.materials) {
        material.stained = settings.stained && material.alpha_mode == scene::AlphaMode::blend;
        any = any || material.stained;
    }
    if (settings.stained && !any) {
        tellNoEffect(settings, shot.notices, "--blended has an effect on blended surfaces only; the scene has none");
    }
}

/// Chooses outlook and ground by the scene at rest, whatever the time and the animation. True: a ground was put in, and
/// the state is to be made anew.
bool furnish(Shot& shot, const Settings& settings)
{
    const bool at_rest = shot.state.time_s == 0.0 && settings.animation.empty();
    const scene::State other = at_rest ? scene::State() : scene::evaluate(shot.scene, 0.0);
    const scene::State& rest = at_rest ? shot.state : other;
    shot.outlook = outlookOn(shot.scene, rest);
    const bool is_file = isFile(settings);
    if (is_file && settings.up_axis == UpAxis::y && looksFallen(shot.scene, rest)) {
        shot.notices.push_back("the model seems to stand on its side, as if z were up; --up-axis z turns it");
    }
    const bool wanted = settings.ground == Ground::on ||
                        (settings.ground == Ground::automatic && is_file && isBottomless(shot.scene, rest));
    if (wanted) {
        shot.ground = static_cast<std::uint32_t>(shot.scene.nodes.size());
        addGround(shot.scene, rest.bounds_ws);
    }
    return wanted;
}

} // namespace

Shot makeShot(const Settings& settings)
{
    Shot shot;
    shot.path = openPath(settings);
    shot.scene = worlds::load(settings.scene, settings.seed, settings.limits);
    shot.notices = shot.scene.notices;
    turnFile(shot, settings);
    if (settings.material_override == "diffuse") {
        overrideMaterials(shot.scene);
    }
    stainMaterials(shot, settings);
    castAsTold(shot.scene, settings);
    requireAnimation(shot.scene, settings.animation);
    const std::uint32_t first = settings.frames ? settings.frames->first : 0;
    const double time_s = momentOf(shot, settings, first);
    shot.state = scene::evaluate(shot.scene, time_s, settings.animation);
    if (shot.state.objects.empty() || shot.state.bounds_ws.empty()) {
        throw Error("drawing " + settings.scene, "the scene has nothing to draw");
    }
    scene::requireInRange(shot.state, "drawing " + settings.scene); // before anything is measured by it
    if (furnish(shot, settings)) {
        shot.state = scene::evaluate(shot.scene, time_s, settings.animation);
    }
    placeLights(shot, settings);
    placeEye(shot, settings); // after the lights: it makes room for shadows
    if (shot.path) {
        startPath(shot, settings);
        followPath(shot, settings, first);
    }
    requireInRange(shot, settings);
    noteSizesWithoutEffect(shot, settings, shot.lights);
    chooseLights(shot, settings);
    if (shot.lights_left_out > 0) {
        shot.notices.push_back(leftOutSentence(shot));
    }
    noteWhatSurprises(shot, settings);
    askOfTechnique(shot, settings);
    return shot;
}

void askOfTechnique(Shot& shot, const Settings& settings)
{
    requireClosedCasters(shot, settings);
    noteFinless(shot, settings);
}

void moveShot(Shot& shot, const Settings& settings, std::uint32_t frame)
{
    ++shot.moves;
    scene::advance(shot.scene, momentOf(shot, settings, frame), shot.state, settings.animation);
    const bool stays_fitted = shot.camera == "fitted" && !settings.eye_ws && settings.camera.empty();
    if (!stays_fitted) { // it would breathe with the scene
        placeEye(shot, settings);
    }
    placeLights(shot, settings);
    if (shot.path) {
        followPath(shot, settings, frame);
    }
    requireInRange(shot, settings);
    chooseLights(shot, settings);
}

host::RenderOptions renderOptions(const Settings& settings)
{
    host::RenderOptions options;
    options.width = settings.size_px.x;
    options.height = settings.size_px.y;
    options.shadow = settings.shadow;
    const FilterTraits* const traits = filterTraits(filterOf(settings.shadow));
    if (traits != nullptr && traits->filterable) { // made one by one, whatever others in a list do
        options.shadow.cascades.pass = CascadePass::automatic;
    }
    options.average_pixels =
        settings.shadow.technique.soften == Soften::converge && settings.truth_pixels == truth::PixelTruth::area;
    options.anti_aliasing = antiAliasingOf(settings);
    options.bloom = settings.bloom;
    options.ambient_occlusion = {hasOcclusion(settings), static_cast<float>(settings.occlusion_radius_m.value_or(0.0))};
    options.tone = settings.tone;
    options.dither = settings.dither;
    options.reflection = settings.reflection;
    options.sky = settings.sky;
    options.exposure_ev = settings.exposure_ev;
    options.shading = settings.shading;
    if (isUsed(*findSetting("compact-mask"), settings)) { // beside others it changes nothing, as people are told
        options.compact_mask = settings.compact_mask;
    }
    options.shows_rays = settings.debug == "rays";
    return options;
}

std::vector<Light> castersOf(const Shot& shot)
{
    std::vector<Light> lights;
    lights.reserve(shot.lights.size());
    for (const host::ShadedLight& light : shot.lights) {
        lights.push_back(light.caster);
    }
    return lights;
}

} // namespace gnomon::app
