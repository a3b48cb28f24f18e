// SPDX-License-Identifier: Apache-2.0
// Which combinations of available choices are refused, as data: what `gnomon list` prints.
#pragma once

#include <gnomon/choices.h>
#include <gnomon/export.h>
#include <gnomon/options.h>

#include <span>
#include <string_view>

namespace gnomon {

/// A rule that refusal(LightType, Technique) goes by.
struct ChoiceRule {
    bool (*applies)(LightType light, const Technique& technique); // is it this combination that the rule refuses?
    std::string_view refuses; // in words: "partition sdsm with every motion but free"
    std::string_view reason;  // a sentence
};
/// Every rule. A combination of available values that none applies to can be had.
[[nodiscard]] GNOMON_API std::span<const ChoiceRule> choiceRules();

/// Why a light of this type cannot have these options, whose technique and depths go by the light, as a sentence that
/// lives as long as the program; nothing when it can. resolve() says what else there is.
[[nodiscard]] GNOMON_API std::optional<std::string_view> refusal(LightType light, const ShadowOptions& options);

} // namespace gnomon
