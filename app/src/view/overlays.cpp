// SPDX-License-Identifier: Apache-2.0
#include "view/overlays.h"

#include "view/camera_moves.h"

#include <fmt/format.h>
#include <glm/matrix.hpp>
#include <imgui.h>

#include <cmath>

namespace gnomon::app::view {
namespace {

// Okabe and Ito's colours, which can be told apart with any of the usual colour deficiencies.
constexpr std::array<ImU32, 7> kColours{
    IM_COL32(230, 159, 0, 255), IM_COL32(86, 180, 233, 255), IM_COL32(0, 158, 115, 255),  IM_COL32(240, 228, 66, 255),
    IM_COL32(0, 114, 178, 255), IM_COL32(213, 94, 0, 255),   IM_COL32(204, 121, 167, 255)};

ImVec2 imgui(const glm::dvec2& at)
{
    return {static_cast<float>(at.x), static_cast<float>(at.y)};
}

/// A line of clip space, cut where it passes behind the eye; nothing where all of it is there.
std::optional<std::pair<glm::dvec2, glm::dvec2>> cut(glm::dvec4 a, glm::dvec4 b)
{
    constexpr double kNearest = 1e-4;
    if (a.w < kNearest && b.w < kNearest) {
        return std::nullopt;
    }
    if (a.w < kNearest || b.w < kNearest) {
        glm::dvec4& behind = a.w < b.w ? a : b;
        const glm::dvec4& before = a.w < b.w ? b : a;
        behind += (before - behind) * ((kNearest - behind.w) / (before.w - behind.w));
    }
    return std::pair(glm::dvec2(a) / a.w * 0.5 + 0.5, glm::dvec2(b) / b.w * 0.5 + 0.5);
}

} // namespace

std::vector<std::pair<glm::dvec2, glm::dvec2>> edgesInPicture(const glm::dmat4& clip_from_world,
                                                              const glm::dmat4& map_from_world)
{
    std::vector<std::pair<glm::dvec2, glm::dvec2>> lines;
    const glm::dmat4 world_from_map = glm::inverse(map_from_world);
    std::array<std::optional<glm::dvec4>, 8> corners;
    for (unsigned i = 0; i < corners.size(); ++i) {
        const glm::dvec4 corner((i & 1U) != 0 ? 1.0 : -1.0, (i & 2U) != 0 ? 1.0 : -1.0, (i & 4U) != 0 ? 1.0 : 0.0, 1.0);
        const glm::dvec4 place = world_from_map * corner;
        constexpr double kInfinity = 1e-12;
        if (std::isfinite(place.x + place.y + place.z) && place.w > kInfinity) {
            corners[i] = clip_from_world * (place / place.w);
        }
    }
    for (unsigned i = 0; i < corners.size(); ++i) {
        for (const unsigned bit : {1U, 2U, 4U}) {
            if ((i & bit) == 0 && corners[i] && corners[i | bit]) {
                if (const auto line = cut(*corners[i], *corners[i | bit])) {
                    lines.push_back(*line);
                }
            }
        }
    }
    return lines;
}

void drawFrusta(Viewer& viewer, const PictureArea& area)
{
    const Plan& plan = viewer.renderer().plan();
    const auto light = static_cast<std::uint32_t>(lightIndex(viewer.shot(), viewer.settings()));
    if (light >= plan.lights.size()) {
        return;
    }
    const glm::dmat4 clip_from_world = viewer.camera().clip_from_world;
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    const glm::dvec2 end = area.least + area.size;
    list.PushClipRect(imgui(area.least), imgui(end));
    for (std::uint32_t i = 0; i < plan.lights[light].view_count; ++i) {
        const View& view = plan.views[plan.lights[light].first_view + i];
        for (const auto& [from, to] : edgesInPicture(clip_from_world, view.projection.clip_from_world)) {
            list.AddLine(imgui(area.least + from * area.size), imgui(area.least + to * area.size),
                         IM_COL32(0, 0, 0, 160), 3.0F);
            list.AddLine(imgui(area.least + from * area.size), imgui(area.least + to * area.size),
                         kColours[i % kColours.size()], 1.5F);
        }
    }
    list.PopClipRect();
}

void drawSquares(const MapInset& inset, const glm::dvec2& at, const glm::dvec2& size)
{
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    const glm::dvec2 end = at + size;
    list.AddRect(imgui(at - 1.0), imgui(end + 1.0), IM_COL32(0, 0, 0, 255), 0.0F, 0, 2.0F);
    std::size_t drawn = 0;
    for (const MapInset::Square& square : inset.squares()) {
        const glm::dvec2 least = at + square.least * size;
        const glm::dvec2 most = least + square.size * size;
        // Drawn in this frame: as bright as its colour; left as it is: thin.
        list.AddRect(imgui(least + 1.0), imgui(most - 1.0), kColours[square.view % kColours.size()], 0.0F, 0,
                     square.is_drawn ? 3.0F : 1.0F);
        drawn += square.is_drawn ? 1 : 0;
    }
    const std::string legend = fmt::format("{} of {} maps drawn", drawn, inset.squares().size());
    const ImVec2 extent = ImGui::CalcTextSize(legend.c_str());
    list.AddRectFilled(imgui({at.x, at.y - static_cast<double>(extent.y) - 6.0}), imgui({end.x, at.y - 1.0}),
                       IM_COL32(0, 0, 0, 170));
    list.AddText(imgui({at.x + 4.0, at.y - static_cast<double>(extent.y) - 4.0}), IM_COL32(230, 230, 230, 255),
                 legend.c_str());
}

} // namespace gnomon::app::view
