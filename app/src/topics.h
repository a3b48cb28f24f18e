// SPDX-License-Identifier: Apache-2.0
// The one table of everything that has a name. `list`, completion and the manual page print its rows, each in its way;
// what they say of a setting stands in the setting's own row (app/settings.h).
#pragma once

#include "app/preset.h"
#include "app/settings.h"

#include "worlds/worlds.h"

#include <gnomon/choices.h>

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::app {

/// A name that `list` takes. At most one of the pointers is set; of a section and a choice none is.
struct Topic {
    std::string_view section; // the section of `list` that has it; empty: it is a section
    std::string_view name;    // not unique: "blur" is a value and a setting
    std::string_view summary; // one line
    std::string_view choice;  // of a choice and its values: the choice's name
    const ChoiceValue* value = nullptr;
    const Setting* setting = nullptr;
    const Preset* preset = nullptr;
    const worlds::World* world = nullptr;
};
/// Sections first; then choices, each with its values after it, settings, presets and worlds.
[[nodiscard]] std::span<const Topic> topics();
[[nodiscard]] bool isListed(std::string_view name);

/// A line about a topic.
struct Fact {
    std::string_view name;
    std::string text; // empty: there is nothing to say
};
/// Makes a world, to name its views and lights. Precondition as for pageOf().
[[nodiscard]] std::vector<Fact> factsOf(const Topic& topic);
/// "docs/techniques/msm.md", in the source tree and where the documents are installed. Precondition: a value, a
/// setting, a preset or a world.
[[nodiscard]] std::string pageOf(const Topic& topic);

/// Settings that mean something with this value and with at most two thirds of its choice's, by themselves or once
/// another setting is other than its default.
[[nodiscard]] std::vector<const Setting*> settingsOf(const ChoiceValue& value);

} // namespace gnomon::app
