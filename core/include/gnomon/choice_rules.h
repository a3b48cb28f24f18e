// SPDX-License-Identifier: Apache-2.0
// Which combinations of available choices are refused, as data: what `gnomon list` prints.
#pragma once

#include <gnomon/choices.h>
#include <gnomon/export.h>
#include <gnomon/options.h>

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace gnomon {

/// The choices, by their places in kChoiceNames.
enum class Choice : std::uint8_t { light, partition, fit, filter, soften, motion };
/// Their names, as choiceValues() has them.
inline constexpr std::array<std::string_view, 6> kChoiceNames{"light",  "partition", "fit",
                                                              "filter", "soften",    "motion"};

/// A rule that refusal(LightType, Technique) goes by: a value of one choice does not go with some values of another.
struct ChoiceRule {
    Choice choice;                              // the choice whose value it is about
    std::uint8_t value;                         // that value, in the choice's enum
    Choice other;                               // the choice whose values do not go with it
    std::uint32_t named;                        // a bit for each value that the rule names: 1 << value
    bool is_needed;                             // all values but the named ones are refused; else the named ones are
    std::string_view reason;                    // a sentence
    std::optional<Filter> apart = std::nullopt; // the filter that the rule does not hold for

    /// Is it this combination that the rule refuses?
    [[nodiscard]] GNOMON_API bool applies(LightType light, const Technique& technique) const;
    /// Does the rule refuse the value beside values of another choice?
    [[nodiscard]] GNOMON_API bool concerns(const ChoiceValue& row) const;
    /// In words: "partition sdsm with every motion but free".
    [[nodiscard]] GNOMON_API std::string refuses() const;
};
/// Every rule. A combination of available values that none applies to can be had.
[[nodiscard]] GNOMON_API std::span<const ChoiceRule> choiceRules();

/// Why a light of this type cannot have these options, whose technique and depths go by the light, as a sentence that
/// lives as long as the program; nothing when it can. resolve() says what else there is.
[[nodiscard]] GNOMON_API std::optional<std::string_view> refusal(LightType light, const ShadowOptions& options);

} // namespace gnomon
