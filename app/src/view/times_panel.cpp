// SPDX-License-Identifier: Apache-2.0
// What a frame costs, pass by pass, and how evenly frames come.
#include "view/panels.h"

#include "lab/passes.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::app::view {
namespace {

struct PassTime {
    std::string name;
    std::optional<double> ms; // none: not measured on this device
};

/// Passes of one name added up, in the order of their first turn.
std::vector<PassTime> passesOf(const host::FrameTimes& times)
{
    std::vector<PassTime> passes;
    for (const vulkan::PassRecord& record : times.passes) {
        const auto known =
            std::find_if(passes.begin(), passes.end(), [&](const PassTime& one) { return one.name == record.name; });
        if (known != passes.end()) {
            lab::addTime(known->ms, record.milliseconds);
        } else {
            passes.push_back({record.name, record.milliseconds});
        }
    }
    return passes;
}

void timeRows(const host::FrameTimes& times)
{
    const auto row = [](const std::string& name, const std::optional<double>& ms) {
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(name.c_str());
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(ms ? fmt::format("{:.2f}", *ms).c_str() : "not measured");
    };
    row("plan", times.plan_ms);
    row("record", times.record_ms);
    for (const PassTime& pass : passesOf(times)) {
        row(pass.name, pass.ms);
    }
    row("whole frame", times.frame_ms);
}

void table(const char* id, const host::FrameTimes& times)
{
    constexpr ImGuiTableFlags kFlags = ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingStretchProp;
    if (ImGui::BeginTable(id, 2, kFlags)) {
        ImGui::TableSetupColumn("pass", ImGuiTableColumnFlags_WidthStretch, 3.0F);
        ImGui::TableSetupColumn("ms", ImGuiTableColumnFlags_WidthStretch, 1.0F);
        timeRows(times);
        ImGui::EndTable();
    }
}

} // namespace

void timesPanel(Viewer& viewer, PanelState& state)
{
    if (!state.widgets.header("Times", true)) {
        return;
    }
    const Pacing& pacing = viewer.pacing();
    const float most = *std::max_element(pacing.ms.begin(), pacing.ms.end());
    const std::string title = fmt::format("{:.1f} ms", viewer.times().frame_ms);
    constexpr float kHeight = 3.5F; // lines
    ImGui::PlotHistogram("##frames", pacing.ms.data(), static_cast<int>(pacing.ms.size()),
                         static_cast<int>(pacing.next), title.c_str(), 0.0F, std::max(most, 1.0F),
                         {ImGui::GetContentRegionAvail().x, ImGui::GetTextLineHeight() * kHeight});
    explain("Milliseconds of the last frames, the newest at the right");
    table("times", viewer.times());
    if (const host::FrameTimes* const beside = viewer.timesBeside()) {
        ImGui::TextDisabled("beside it");
        table("times beside", *beside);
    }
    ImGui::TextDisabled("%s", viewer.gpu().properties().deviceName);
    ImGui::Spacing();
}

} // namespace gnomon::app::view
