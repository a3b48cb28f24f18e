// SPDX-License-Identifier: Apache-2.0
// Which combinations of available choices are refused, as data: what `gnomon list` prints.
#pragma once

#include <gnomon/choices.h>

#include <span>
#include <string_view>

namespace gnomon {

/// A rule that refusal(LightType, Technique) goes by.
struct ChoiceRule {
    bool (*applies)(LightType light, const Technique& technique);
    std::string_view refuses; // in words: "partition sdsm with every motion but free"
    std::string_view reason;  // a sentence
};
/// Every rule. A combination of available values that none applies to can be had.
[[nodiscard]] std::span<const ChoiceRule> choiceRules();

} // namespace gnomon
