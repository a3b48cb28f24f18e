// SPDX-License-Identifier: Apache-2.0
// The combinations that are refused, as rules with reasons.
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
/// The rules that refuse this value beside values of other choices; for a filter, also beside formats and options.
[[nodiscard]] std::vector<Refused> refusedOf(const ChoiceValue& value);

/// The formats in which maps of these filters are stored.
struct StoredAs {
    std::vector<std::string_view> filters; // that store the same
    std::span<const MapFormat> formats;    // the usual one first; none: they have no maps
};
[[nodiscard]] std::vector<StoredAs> storageOfFilters();

} // namespace gnomon::app
