// SPDX-License-Identifier: Apache-2.0
// Widgets that settings are changed by, made from the one table of settings; and where on the screen each one is.
#pragma once

#include "view/viewer.h"

#include <glm/vec2.hpp>

#include <functional>
#include <map>
#include <string>
#include <string_view>

namespace gnomon::app::view {

class Widgets {
public:
    /// Before the first widget of a turn.
    void begin();

    /// A row for a setting: as what it is, with unit, range and what it does where the pointer rests.
    void setting(Viewer& viewer, const Setting& setting);
    /// A setting that takes one of several names, with why one cannot be had and where it comes from.
    void choice(Viewer& viewer, const Setting& setting);
    /// A line of text; true when the person has ended it. `hint` while it is empty.
    bool text(const char* label, std::string& value, const char* hint);
    bool button(const char* label);
    bool checkbox(const char* label, bool& value);
    /// True when it became the one of several with the value `mine`.
    bool radio(const char* label, int& value, int mine);
    bool slider(const char* label, float& value, float least, float most);
    bool header(const char* label, bool open);
    /// Closed at first. While it is open, ImGui::TreePop() ends it.
    bool tree(const char* label);
    /// One of several names; the index that was chosen, or -1.
    int pick(const char* label, const std::string& shown, const std::vector<std::string>& names,
             const std::function<std::string(std::size_t)>& refusal = nullptr,
             const std::function<std::string(std::size_t)>& about = nullptr);

    /// Middle of the widget of this label in the last turn, pixels of the window; whoever tries the window asks for
    /// it. Items of an open list are "LABEL/ITEM". Null where it was not there, or is not to be seen.
    [[nodiscard]] const glm::dvec2* placeOf(std::string_view label) const;
    /// The panel moves so that this one is seen.
    void reveal(std::string label) { revealed_ = std::move(label); }

private:
    void note(const std::string& label);
    void number(Viewer& viewer, const Setting& setting, const std::string& now);
    void textSetting(Viewer& viewer, const Setting& setting, const std::string& now);

    std::map<std::string, glm::dvec2, std::less<>> places_;
    std::string revealed_;
    // What is being typed or dragged, until it is given.
    std::string edited_key_;
    bool edited_was_there_ = false; // in this turn
    std::string edited_text_;
    double edited_number_ = 0.0;
};

/// Explains the last widget when the pointer rests on it.
void explain(std::string_view text);

} // namespace gnomon::app::view
