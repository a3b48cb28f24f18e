// SPDX-License-Identifier: Apache-2.0
// What does not go together, as rules with reasons.
#pragma once

#include <gnomon/choices.h>

#include <span>
#include <string>
#include <vector>

namespace gnomon::app {

struct Refused {
    std::string technique; // in words, or as one would write it with | between what is refused alike
    std::string reason;    // a sentence
};
/// Rules of the choices first, then formats that filters cannot use, then options that a format has no room for.
[[nodiscard]] std::vector<Refused> allRefused();
/// The rules that this value is refused by beside values of other choices; of a filter, formats and options too.
[[nodiscard]] std::vector<Refused> refusedOf(const ChoiceValue& value);

/// What maps of these filters are stored as.
struct StoredAs {
    std::vector<std::string_view> filters; // that store the same
    std::span<const MapFormat> formats;    // the usual one first; none: they have no maps
};
[[nodiscard]] std::vector<StoredAs> storageOfFilters();

} // namespace gnomon::app
