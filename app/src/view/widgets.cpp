// SPDX-License-Identifier: Apache-2.0
#include "view/widgets.h"

#include "setting_values.h"

#include <gnomon/choices.h>

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cmath>

namespace gnomon::app::view {
namespace {

/// What a setting is and takes, for the pointer that rests on it.
std::string aboutOf(const Setting& setting)
{
    std::string about = fmt::format("{}\n{}", spelled(setting), setting.doc);
    if (setting.min < setting.max) {
        about += fmt::format("\n{} to {}{}{}", setting.min, setting.max, setting.unit.empty() ? "" : " ", setting.unit);
    }
    if (!setting.default_text.empty()) {
        about += fmt::format("\ndefault {}", setting.default_text);
    }
    return about;
}

/// A slider is of use where its steps can be told from each other.
bool fitsASlider(const Setting& setting)
{
    constexpr double kWidest = 1000.0;
    return setting.none_text.empty() && setting.max - setting.min <= kWidest;
}

std::string labelOf(const Setting& setting)
{
    return setting.unit.empty() ? std::string(setting.key) : fmt::format("{} ({})", setting.key, setting.unit);
}

} // namespace

void explain(std::string_view text)
{
    if (!ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) {
        return;
    }
    ImGui::BeginTooltip();
    constexpr float kWidth = 26.0F; // letters, roughly
    ImGui::PushTextWrapPos(ImGui::GetFontSize() * kWidth);
    ImGui::TextUnformatted(text.data(), text.data() + text.size());
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

void Widgets::begin()
{
    places_.clear();
    if (!edited_was_there_) { // hidden while it was dragged: nobody will let go of it
        edited_key_.clear();
    }
    edited_was_there_ = false;
}

void Widgets::note(const std::string& label)
{
    edited_was_there_ = edited_was_there_ || label == edited_key_;
    if (revealed_ == label) {
        ImGui::SetScrollHereY(0.5F);
        revealed_.clear();
    }
    if (ImGui::IsItemVisible()) {
        const ImVec2 least = ImGui::GetItemRectMin();
        const ImVec2 most = ImGui::GetItemRectMax();
        const ImVec2 origin = ImGui::GetMainViewport()->Pos;
        places_[label] = {(least.x + most.x) / 2.0F - origin.x, (least.y + most.y) / 2.0F - origin.y};
    }
}

const glm::dvec2* Widgets::placeOf(std::string_view label) const
{
    const auto place = places_.find(label);
    return place != places_.end() ? &place->second : nullptr;
}

bool Widgets::text(const char* label, std::string& value, const char* hint)
{
    const bool entered = ImGui::InputTextWithHint(label, hint, &value, ImGuiInputTextFlags_EnterReturnsTrue);
    const bool left = ImGui::IsItemDeactivatedAfterEdit();
    note(label);
    return entered || left;
}

bool Widgets::button(const char* label)
{
    const bool pressed = ImGui::Button(label);
    note(label);
    return pressed;
}

bool Widgets::checkbox(const char* label, bool& value)
{
    const bool changed = ImGui::Checkbox(label, &value);
    note(label);
    return changed;
}

bool Widgets::radio(const char* label, int& value, int mine)
{
    const bool chosen = ImGui::RadioButton(label, &value, mine);
    note(label);
    return chosen;
}

bool Widgets::slider(const char* label, float& value, float least, float most)
{
    const bool changed = ImGui::SliderFloat(label, &value, least, most, "%.1f");
    note(label);
    return changed;
}

bool Widgets::header(const char* label, bool open)
{
    const bool is_open = ImGui::CollapsingHeader(label, open ? ImGuiTreeNodeFlags_DefaultOpen : 0);
    note(label);
    return is_open;
}

bool Widgets::tree(const char* label)
{
    const bool is_open = ImGui::TreeNode(label);
    note(label);
    return is_open;
}

int Widgets::pick(const char* label, const std::string& shown, const std::vector<std::string>& names,
                  const std::function<std::string(std::size_t)>& refusal,
                  const std::function<std::string(std::size_t)>& about)
{
    int picked = -1;
    const bool is_open = ImGui::BeginCombo(label, shown.c_str(), ImGuiComboFlags_HeightLarge);
    if (!is_open) {
        note(label);
        return picked;
    }
    for (std::size_t i = 0; i < names.size(); ++i) {
        const std::string why = refusal ? refusal(i) : "";
        ImGui::BeginDisabled(!why.empty());
        if (ImGui::Selectable(names[i].c_str(), names[i] == shown)) {
            picked = static_cast<int>(i);
        }
        note(fmt::format("{}/{}", label, names[i]));
        ImGui::EndDisabled();
        if (!why.empty()) {
            explain("Not with the rest: " + why);
        } else if (about) {
            explain(about(i));
        }
    }
    ImGui::EndCombo();
    return picked;
}

void Widgets::choice(Viewer& viewer, const Setting& setting)
{
    const std::string key(setting.key);
    std::vector<std::string> names;
    for (const std::string_view name : setting.choices()) {
        names.emplace_back(name);
    }
    const Settings& settings = viewer.settings();
    const auto now = settings.values.find(key);
    const int picked = pick(
        key.c_str(), now != settings.values.end() ? now->second : std::string(), names,
        [&](std::size_t i) {
            return edited(settings, {{setting.key, names[i]}}).refusal;
        },
        [&](std::size_t i) {
            const ChoiceValue* const row = findChoice(setting.key, names[i]);
            return row != nullptr ? fmt::format("{}\n{}", row->summary, row->source) : aboutOf(setting);
        });
    explain(aboutOf(setting));
    if (picked >= 0) {
        viewer.change({{setting.key, names[static_cast<std::size_t>(picked)]}});
    }
}

void Widgets::number(Viewer& viewer, const Setting& setting, const std::string& now)
{
    const std::string label = labelOf(setting);
    const bool is_edited = edited_key_ == setting.key;
    double value = is_edited ? edited_number_ : toNumber(now).value_or(0.0);
    const bool whole = setting.type == SettingType::integer;
    const ImGuiSliderFlags flags = setting.min >= 0.0 && setting.max > 100.0 * std::max(setting.min, 1e-3) && !whole
                                       ? ImGuiSliderFlags_Logarithmic
                                       : 0;
    if (ImGui::SliderScalar(label.c_str(), ImGuiDataType_Double, &value, &setting.min, &setting.max,
                            whole ? "%.0f" : "%.4g", flags)) {
        edited_key_ = setting.key;
        edited_number_ = value;
    }
    const bool ends = edited_key_ == setting.key && ImGui::IsItemDeactivated();
    note(std::string(setting.key));
    explain(aboutOf(setting));
    // Light and time follow the hand; a technique is made anew when the hand rests.
    const bool follows = setting.group == SettingGroup::light || setting.group == SettingGroup::time ||
                         setting.group == SettingGroup::camera;
    if (edited_key_ == setting.key && (ends || follows)) {
        const double rounded =
            whole ? std::round(edited_number_ / setting.multiple_of) * setting.multiple_of : edited_number_;
        const std::string text = whole ? fmt::format("{:.0f}", rounded) : fmt::format("{:.4g}", rounded);
        if (text != now) {
            viewer.change({{setting.key, text}});
        }
    }
    if (ends) {
        edited_key_.clear();
    }
}

void Widgets::textSetting(Viewer& viewer, const Setting& setting, const std::string& now)
{
    const std::string label = labelOf(setting);
    const bool is_edited = edited_key_ == setting.key;
    std::string value = is_edited ? edited_text_ : now;
    const std::string hint =
        setting.default_text.empty() ? std::string(setting.form) : std::string(setting.default_text);
    const bool entered =
        ImGui::InputTextWithHint(label.c_str(), hint.c_str(), &value, ImGuiInputTextFlags_EnterReturnsTrue);
    const bool ended = entered || ImGui::IsItemDeactivated();
    const bool active = ImGui::IsItemActive();
    note(std::string(setting.key));
    explain(aboutOf(setting));
    if (active) {
        edited_key_ = setting.key;
        edited_text_ = value;
    }
    if (ended && is_edited) {
        edited_key_.clear();
        if (value != now) {
            viewer.change({{setting.key, value}});
        }
    }
}

void Widgets::setting(Viewer& viewer, const Setting& setting)
{
    const auto value = viewer.settings().values.find(setting.key);
    const std::string now = value != viewer.settings().values.end() ? value->second : std::string();
    const std::string key(setting.key);
    ImGui::PushID(key.c_str());
    switch (setting.type) {
    case SettingType::flag: {
        bool on = now == "1";
        const bool changed = ImGui::Checkbox(key.c_str(), &on);
        note(key);
        explain(aboutOf(setting));
        if (changed) {
            viewer.change({{setting.key, on ? "1" : "0"}});
        }
        break;
    }
    case SettingType::choice:
        choice(viewer, setting);
        break;
    case SettingType::integer:
    case SettingType::real:
        fitsASlider(setting) && !now.empty() ? number(viewer, setting, now) : textSetting(viewer, setting, now);
        break;
    case SettingType::numbers:
    case SettingType::size:
    case SettingType::range:
    case SettingType::text:
        textSetting(viewer, setting, now);
        break;
    }
    ImGui::PopID();
}

} // namespace gnomon::app::view
