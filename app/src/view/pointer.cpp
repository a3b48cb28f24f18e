// SPDX-License-Identifier: Apache-2.0
#include "view/pointer.h"

#include "view/camera_moves.h"

#include <glm/geometric.hpp>
#include <imgui.h>

#include <algorithm>
#include <array>

namespace gnomon::app::view {
namespace {

/// So many times a fifteenth of a letter's height: a pixel on a common screen, more on a dense one.
float fine(float count)
{
    return count * ImGui::GetFontSize() / 15.0F;
}

double reach() // of a handle
{
    return static_cast<double>(fine(11.0F));
}
constexpr double kPerPixel_rad = 0.0055;

glm::dvec2 pointerAt()
{
    const ImVec2 at = ImGui::GetIO().MousePos;
    return {at.x, at.y};
}

glm::dvec2 moved()
{
    const ImVec2 by = ImGui::GetIO().MouseDelta;
    return {by.x, by.y};
}

bool isDown(char letter)
{
#if IMGUI_VERSION_NUM >= 18700
    return ImGui::IsKeyDown(static_cast<ImGuiKey>(ImGuiKey_A + (letter - 'A')));
#else
    return ImGui::IsKeyDown(letter); // GLFW's own numbers, which are those of letters
#endif
}

bool isInside(const PictureArea& area, const glm::dvec2& at)
{
    const glm::dvec2 in = at - area.least;
    return in.x >= 0.0 && in.y >= 0.0 && in.x < area.size.x && in.y < area.size.y;
}

ImVec2 imgui(const glm::dvec2& at)
{
    return {static_cast<float>(at.x), static_cast<float>(at.y)};
}

} // namespace

void Pointer::placeSun(const Viewer& viewer, const Shown& shown, const PictureArea& area)
{
    sun_at_.reset();
    const host::ShadedLight* const sun = sunOf(viewer.shot());
    if (!shown.sun || sun == nullptr || viewer.settings().debug != "none") { // whose pictures have a size of their own
        return;
    }
    const SunDome dome = domeOf(viewer.aimed());
    const glm::dmat4 clip_from_world = viewer.camera().clip_from_world;
    const auto centre = pointOf(clip_from_world, dome.centre_ws);
    const auto at = pointOf(clip_from_world, dome.centre_ws - glm::normalize(sun->caster.direction_ws) * dome.radius_m);
    if (centre && at) {
        dome_at_ = area.least + *centre * area.size;
        sun_at_ = area.least + *at * area.size;
    }
}

Pointer::Grip Pointer::gripAt(const Viewer& viewer, const Shown& shown, const PictureArea& area) const
{
    const glm::dvec2 at = pointerAt();
    if (sun_at_ && glm::distance(at, *sun_at_) < reach()) {
        return Grip::sun;
    }
    const double divider = area.least.x + static_cast<double>(shown.divider) * area.size.x;
    const bool has_divider = viewer.beside() != Beside::nothing && viewer.held() == Held::split;
    return has_divider && std::abs(at.x - divider) < reach() / 2.0 ? Grip::divider : Grip::camera;
}

void Pointer::moveCamera(Viewer& viewer, const PictureArea& area)
{
    const ImGuiIO& io = ImGui::GetIO();
    const glm::dvec2 by = moved();
    if (by == glm::dvec2(0.0)) {
        return;
    }
    const host::Eye eye = viewer.aimed();
    const glm::dvec2 turn = glm::dvec2(by.x, -by.y) * kPerPixel_rad;
    if (io.MouseDown[2] || (io.MouseDown[0] && io.KeyShift)) {
        viewer.look(panned(eye, by, area.size.y));
    } else if (io.MouseDown[1]) {
        viewer.look(looked(eye, turn));
    } else {
        viewer.look(orbited(eye, turn));
    }
}

void Pointer::drag(Viewer& viewer, Shown& shown, const PictureArea& area)
{
    const glm::dvec2 in = (pointerAt() - area.least) / area.size;
    if (grip_ == Grip::sun && moved() != glm::dvec2(0.0)) {
        const host::Eye eye = viewer.aimed();
        const SightLine line = lineThrough(viewer.camera().clip_from_world, in);
        viewer.change({{"sun", textOf(sunFrom(domeOf(eye), line))}});
    } else if (grip_ == Grip::divider) {
        shown.divider = static_cast<float>(std::clamp(in.x, 0.0, 1.0));
    } else if (grip_ == Grip::camera) {
        moveCamera(viewer, area);
    }
}

void Pointer::fly(Viewer& viewer, double elapsed_s)
{
    glm::dvec3 way(0.0);
    constexpr std::array<std::pair<char, glm::ivec3>, 6> kWays{{{'D', {1, 0, 0}},
                                                                {'A', {-1, 0, 0}},
                                                                {'E', {0, 1, 0}},
                                                                {'Q', {0, -1, 0}},
                                                                {'W', {0, 0, 1}},
                                                                {'S', {0, 0, -1}}}};
    for (const auto& [letter, one] : kWays) {
        way += isDown(letter) ? glm::dvec3(one) : glm::dvec3(0.0);
    }
    if (way == glm::dvec3(0.0)) {
        return;
    }
    // What one looks at is reached in two seconds; with shift in a quarter of that.
    const host::Eye eye = viewer.aimed();
    const double speed = glm::length(eye.target_ws - eye.position_ws) * (ImGui::GetIO().KeyShift ? 2.0 : 0.5);
    viewer.look(flown(eye, glm::normalize(way) * speed * elapsed_s));
}

void Pointer::keys(Viewer& viewer, Shown& shown, std::string_view letters)
{
    if (ImGui::GetIO().WantTextInput) {
        return;
    }
    for (const char letter : letters) {
        if (letter == 'H') {
            shown.panel = !shown.panel;
        } else if (letter == 'P') {
            viewer.play(!viewer.plays());
        } else if (letter == 'T') {
            viewer.holdAgainst(viewer.beside() == Beside::truth ? Beside::nothing : Beside::truth);
        } else if (letter == 'F') {
            viewer.frameAll();
        }
    }
}

void Pointer::drawHandles(const Viewer& viewer, const Shown& shown, const PictureArea& area) const
{
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    constexpr ImU32 kSun = IM_COL32(255, 196, 84, 255);
    constexpr ImU32 kDark = IM_COL32(0, 0, 0, 150);
    constexpr ImU32 kLight = IM_COL32(255, 255, 255, 220);
    if (sun_at_ && isInside(area, *sun_at_)) {
        list.AddLine(imgui(dome_at_), imgui(*sun_at_), kDark, fine(3.0F));
        list.AddLine(imgui(dome_at_), imgui(*sun_at_), kSun, fine(1.5F));
        list.AddCircleFilled(imgui(*sun_at_), fine(8.0F), kDark, 24);
        list.AddCircleFilled(imgui(*sun_at_), fine(6.5F), kSun, 24);
    }
    if (viewer.canvasBeside() != nullptr && viewer.held() == Held::split) {
        const auto x = static_cast<float>(area.least.x + static_cast<double>(shown.divider) * area.size.x);
        const auto top = static_cast<float>(area.least.y);
        const auto bottom = static_cast<float>(area.least.y + area.size.y);
        list.AddLine({x, top}, {x, bottom}, kDark, fine(4.0F));
        list.AddLine({x, top}, {x, bottom}, kLight, fine(2.0F));
        list.AddCircleFilled({x, (top + bottom) / 2.0F}, fine(7.0F), kLight, 24);
    }
}

void Pointer::turn(Viewer& viewer, Shown& shown, const PictureArea& area, std::string_view letters, double elapsed_s)
{
    const ImGuiIO& io = ImGui::GetIO();
    placeSun(viewer, shown, area);
    const bool is_down = io.MouseDown[0] || io.MouseDown[1] || io.MouseDown[2];
    if (!is_down) {
        grip_ = Grip::none;
    } else if (grip_ == Grip::none && !io.WantCaptureMouse && isInside(area, pointerAt()) &&
               (ImGui::IsMouseClicked(0) || ImGui::IsMouseClicked(1) || ImGui::IsMouseClicked(2))) {
        grip_ = gripAt(viewer, shown, area);
    } else {
        drag(viewer, shown, area);
    }
    if (!io.WantCaptureMouse && isInside(area, pointerAt())) {
        if (io.MouseWheel != 0.0F) {
            viewer.look(dollied(viewer.aimed(), static_cast<double>(io.MouseWheel)));
        }
        if (io.MouseWheelH != 0.0F) { // two fingers sideways
            viewer.look(orbited(viewer.aimed(), {static_cast<double>(io.MouseWheelH) * kPerPixel_rad * 10.0, 0.0}));
        }
    }
    if (!io.WantTextInput && !io.KeyCtrl) {
        fly(viewer, elapsed_s);
    }
    keys(viewer, shown, letters);
    shown.hint = shown.hint && grip_ == Grip::none && io.MouseWheel == 0.0F && letters.empty();
    placeSun(viewer, shown, area);
    drawHandles(viewer, shown, area);
}

} // namespace gnomon::app::view
