// SPDX-License-Identifier: Apache-2.0
// The combinations that are refused, as rules with reasons.
#pragma once

#include <gnomon/choices.h>

#include <string>
#include <vector>

namespace gnomon::app {

struct Refused {
    std::string technique; // in words, or as one would write it with | between what is refused alike
    std::string reason;    // a sentence
};
/// Rules of the choices first, then formats that filters cannot use, then options that a format has no room for.
[[nodiscard]] std::vector<Refused> allRefused();
/// The rules that refuse this value beside values of other choices; for a filter, also beside formats and options.
[[nodiscard]] std::vector<Refused> refusedOf(const ChoiceValue& value);

/// The formats in which a filter's maps are stored, the usual one first; of other values and without maps none.
[[nodiscard]] std::vector<std::string_view> formatsOf(const ChoiceValue& value);

} // namespace gnomon::app
