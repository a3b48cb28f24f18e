// SPDX-License-Identifier: Apache-2.0
#include "view/panels.h"

#include "app/preset.h"
#include "shot_parts.h"
#include "worlds/worlds.h"

#include <gnomon/choices.h>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace gnomon::app::view {
namespace {

constexpr std::array<std::string_view, 5> kChoices{"filter", "partition", "fit", "soften", "motion"};

/// All settings of a group that have an effect now, but for those that `leaves_out` names.
template <typename LeavesOut>
void rowsOf(Viewer& viewer, Widgets& widgets, SettingGroup group, LeavesOut&& leaves_out)
{
    for (const Setting& setting : settingTable()) {
        if (setting.group == group && (setting.subcommands & kRender) != 0 && !setting.command_line_only &&
            !leaves_out(setting) && isUsed(setting, viewer.settings())) {
            widgets.setting(viewer, setting);
        }
    }
}

/// From which side the sun shines, clockwise from north (-z), and how high it stands.
struct SunAngles {
    float azimuth_deg = 0.0F;
    float height_deg = 45.0F;
};
SunAngles anglesOf(const glm::dvec3& direction_ws)
{
    const glm::dvec3 towards = -glm::normalize(direction_ws);
    const double azimuth = std::fmod(glm::degrees(std::atan2(towards.x, -towards.z)) + 360.0, 360.0);
    return {static_cast<float>(azimuth), static_cast<float>(glm::degrees(std::asin(std::clamp(towards.y, -1.0, 1.0))))};
}
glm::dvec3 directionOf(const SunAngles& angles)
{
    const double azimuth = glm::radians(static_cast<double>(angles.azimuth_deg));
    const double height = glm::radians(static_cast<double>(angles.height_deg));
    return -glm::dvec3(std::cos(height) * std::sin(azimuth), std::sin(height), -std::cos(height) * std::cos(azimuth));
}

/// Is there a light that the setting of this key shapes? Those that place lights need none.
bool hasLightFor(const Shot& shot, std::string_view key)
{
    const auto has = [&shot](auto&& is_one) {
        return std::any_of(shot.lights.begin(), shot.lights.end(),
                           [&](const host::ShadedLight& light) { return is_one(light.caster.type); });
    };
    if (key.starts_with("spot.")) {
        return has([](LightType type) { return type == LightType::spot; });
    }
    if (key == "sun-angle") {
        return has([](LightType type) { return type == LightType::directional; });
    }
    return key != "light-size" || has([](LightType type) { return type != LightType::directional; });
}

std::vector<std::string> namesOfLights(const Shot& shot)
{
    std::vector<std::string> names;
    for (const host::ShadedLight& light : shot.lights) {
        names.push_back(light.name);
    }
    return names;
}

} // namespace

float panelWidth()
{
    constexpr float kLetters = 26.0F;
    return ImGui::GetFontSize() * kLetters;
}

void techniquePanel(Viewer& viewer, PanelState& state)
{
    Widgets& widgets = state.widgets;
    if (!widgets.header("Technique", true)) {
        return;
    }
    for (const std::string_view key : kChoices) {
        widgets.choice(viewer, *findSetting(key));
    }
    if (widgets.tree("Options that count here")) {
        rowsOf(viewer, widgets, SettingGroup::technique, [](const Setting& setting) { return isChoice(setting.key); });
        ImGui::TreePop();
    }
    ImGui::Spacing();
}

void comparePanel(Viewer& viewer, PanelState& state)
{
    Widgets& widgets = state.widgets;
    if (!widgets.header("Hold against", true)) {
        return;
    }
    int beside = static_cast<int>(viewer.beside());
    constexpr std::array<const char*, 3> kBeside{"nothing", "a technique", "the truth"};
    for (std::size_t i = 0; i < kBeside.size(); ++i) {
        if (i > 0) {
            ImGui::SameLine();
        }
        if (widgets.radio(kBeside[i], beside, static_cast<int>(i))) {
            viewer.holdAgainst(static_cast<Beside>(i));
        }
    }
    if (viewer.beside() == Beside::technique) {
        if (widgets.text("technique", state.typed.technique_beside, "pcf+cascades+map-size=1024")) {
            viewer.setTechniqueBeside(state.typed.technique_beside);
        }
        explain("Values of the choices and KEY=VALUE, joined by +, as --technique takes them");
    } else if (viewer.beside() == Beside::truth) {
        int kind = static_cast<int>(viewer.truthKind());
        if (widgets.radio("hard", kind, static_cast<int>(truth::Kind::hard))) {
            viewer.setTruthKind(truth::Kind::hard);
        }
        ImGui::SameLine();
        if (widgets.radio("area", kind, static_cast<int>(truth::Kind::area))) {
            viewer.setTruthKind(truth::Kind::area);
        }
        if (viewer.truthRays() == 0) {
            ImGui::TextDisabled("traced once the picture rests");
        } else {
            ImGui::TextUnformatted(
                fmt::format("{} rays per pixel{}", viewer.truthRays(), viewer.isTruthDone() ? "" : " ...").c_str());
        }
        if (viewer.rmse()) {
            ImGui::TextUnformatted(fmt::format("rmse {:.4f}", *viewer.rmse()).c_str());
        }
    }
    if (viewer.beside() != Beside::nothing) {
        bool difference = viewer.held() == Held::difference;
        if (widgets.checkbox("difference", difference)) {
            viewer.setHeld(difference ? Held::difference : Held::split);
        }
        explain("How far both pictures are from each other, four times enlarged");
    }
    ImGui::Spacing();
}

void scenePanel(Viewer& viewer, PanelState& state)
{
    Widgets& widgets = state.widgets;
    if (!widgets.header("Scene and camera", true)) {
        return;
    }
    std::vector<std::string> worlds;
    for (const worlds::World& world : worlds::all()) {
        worlds.emplace_back(world.name);
    }
    const int world = widgets.pick("world", viewer.settings().scene, worlds, nullptr,
                                   [](std::size_t i) { return std::string(worlds::all()[i].summary); });
    if (world >= 0) {
        viewer.open(worlds[static_cast<std::size_t>(world)]);
    }
    if (widgets.text("file", state.typed.scene, "scene.glb, or drop it here") && !state.typed.scene.empty()) {
        viewer.open(state.typed.scene);
    }
    const std::vector<std::string> cameras = cameraNames(viewer.shot());
    const int camera = widgets.pick("camera", viewer.shot().camera, cameras);
    if (camera >= 0) {
        viewer.change({{"fov", ""},
                       {"ortho", ""},
                       {"eye", ""},
                       {"target", ""},
                       {"up", ""},
                       {"camera", cameras[static_cast<std::size_t>(camera)]}});
    }
    if (widgets.button("Frame all")) {
        viewer.frameAll();
    }
    ImGui::SameLine();
    bool plays = viewer.plays();
    if (widgets.checkbox("play", plays)) {
        viewer.play(plays);
    }
    explain("Lets the scene's time pass");
    widgets.setting(viewer, *findSetting("time"));
    if (widgets.tree("More of the scene")) {
        std::vector<std::string> animations;
        for (const scene::Animation& animation : viewer.shot().scene.animations) {
            animations.push_back(animation.name);
        }
        const std::string& playing = viewer.settings().animation;
        const int animation =
            animations.empty() ? -1
                               : widgets.pick("animation", playing.empty() ? animations.front() : playing, animations);
        if (animation >= 0) {
            viewer.change({{"animation", animations[static_cast<std::size_t>(animation)]}});
        }
        for (const std::string_view key : {"fov", "ortho", "ground", "up-axis", "override-material"}) {
            widgets.setting(viewer, *findSetting(key));
        }
        ImGui::TreePop();
    }
    ImGui::Spacing();
}

void lightPanel(Viewer& viewer, PanelState& state)
{
    Widgets& widgets = state.widgets;
    if (!widgets.header("Light", true)) {
        return;
    }
    const std::vector<std::string> lights = namesOfLights(viewer.shot());
    const Settings& settings = viewer.settings();
    const std::string judged = settings.light.empty() ? lights.front() : settings.light;
    const int light = widgets.pick("light", judged, lights, nullptr, [](std::size_t) {
        return std::string("The light that debug views and the error are of");
    });
    if (light >= 0) {
        viewer.change({{"light", lights[static_cast<std::size_t>(light)]}});
    }
    const host::ShadedLight* const sun = sunOf(viewer.shot());
    SunAngles angles = anglesOf(sun != nullptr ? sun->caster.direction_ws : glm::dvec3(0.65, -0.75, -0.12));
    const bool turned = widgets.slider("sun from (degrees)", angles.azimuth_deg, 0.0F, 360.0F);
    explain("From which side it shines: 0 from -z, 90 from +x. Moving it replaces the scene's lights with one sun");
    const bool raised = widgets.slider("sun's height (degrees)", angles.height_deg, 1.0F, 90.0F);
    if (turned || raised) {
        viewer.change({{"sun", textOf(directionOf(angles))}});
    }
    bool moves = viewer.movesSun();
    if (widgets.checkbox("the sun moves", moves)) {
        viewer.moveSun(moves);
    }
    explain("A day in two minutes, as by --path day; where it stands is its noon");
    if (settings.placesLights()) {
        if (widgets.button("The scene's own lights")) {
            viewer.change({{"sun", ""}, {"spot", ""}, {"point", ""}});
        }
    }
    widgets.checkbox("handle of the sun in the picture", state.shown.sun);
    if (widgets.tree("More of lights")) {
        rowsOf(viewer, widgets, SettingGroup::light, [&](const Setting& setting) {
            return setting.key == "sun" || !hasLightFor(viewer.shot(), setting.key);
        });
        ImGui::TreePop();
    }
    ImGui::Spacing();
}

void picturePanel(Viewer& viewer, PanelState& state)
{
    Widgets& widgets = state.widgets;
    if (!widgets.header("Picture and debug views", false)) {
        return;
    }
    widgets.setting(viewer, *findSetting("debug"));
    widgets.checkbox("frusta of the light's maps", state.shown.frusta);
    explain("The box that each map shows. They follow the camera: from where it stands they are around the picture");
    widgets.checkbox("maps in a corner", state.shown.maps);
    explain("The pages that hold maps, six at most; near is dark. What has a thick frame was drawn in the last frame, "
            "what has a thin one was left as it is");
    widgets.checkbox("half size", state.shown.half_size);
    explain(
        "Draws one pixel for each 2 x 2 of the window: quicker on a slow device. It is on at first where the processor "
        "draws and no --size was given");
    rowsOf(viewer, widgets, SettingGroup::picture, [](const Setting& setting) {
        return setting.key == "size" || setting.key == "ground" || setting.key == "up-axis" ||
               setting.key == "override-material";
    });
    ImGui::Spacing();
}

void filesPanel(Viewer& viewer, PanelState& state)
{
    Widgets& widgets = state.widgets;
    if (!widgets.header("Presets and files", true)) {
        return;
    }
    std::vector<std::string> names;
    for (const Preset& preset : presets()) {
        names.emplace_back(preset.name);
    }
    const int preset =
        widgets.pick("preset", "", names, nullptr, [](std::size_t i) { return std::string(presets()[i].summary); });
    if (preset >= 0) {
        viewer.loadPreset(names[static_cast<std::size_t>(preset)]);
    }
    (void)widgets.text("preset file", state.typed.preset_file, "preset.json");
    if (widgets.button("Load") && !state.typed.preset_file.empty()) {
        viewer.loadPreset(state.typed.preset_file);
    }
    ImGui::SameLine();
    if (widgets.button("Save") && !state.typed.preset_file.empty()) {
        viewer.savePreset(state.typed.preset_file);
    }
    (void)widgets.text("picture file", state.typed.screenshot, "gnomon.png");
    if (widgets.button("Screenshot") && !state.typed.screenshot.empty()) {
        viewer.saveScreenshot(state.typed.screenshot);
    }
    ImGui::SameLine();
    if (widgets.button("Copy as command")) {
        state.to_clipboard(viewer.command());
        viewer.say({"copied: " + viewer.command(), false});
    }
    explain("The command that draws this picture, to the last bit");
    ImGui::Spacing();
}

} // namespace gnomon::app::view
