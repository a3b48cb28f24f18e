// SPDX-License-Identifier: Apache-2.0
// The text of `list NAME`.
#pragma once

#include "app/preset.h"
#include "app/settings.h"

#include "worlds/worlds.h"

#include <gnomon/choices.h>

#include <string>
#include <vector>

namespace gnomon::app {

/// Settings that mean something with this value and with at most two thirds of its choice's, by themselves or once
/// another setting is other than its default.
[[nodiscard]] std::vector<const Setting*> settingsOf(const ChoiceValue& value);

// Text of at most 100 columns, each.

/// A choice with its values. Precondition: there is such a choice.
[[nodiscard]] std::string choiceText(std::string_view choice);
[[nodiscard]] std::string valueText(const ChoiceValue& value);
[[nodiscard]] std::string settingText(const Setting& setting);
[[nodiscard]] std::string presetText(const Preset& preset);
/// Makes the world, to name its views and lights.
[[nodiscard]] std::string worldText(const worlds::World& world);

/// A setting in a line or two, as lists of them have it.
[[nodiscard]] std::string settingLine(const Setting& setting);
/// Every rule, each with what it refuses.
[[nodiscard]] std::string rulesText();

} // namespace gnomon::app
