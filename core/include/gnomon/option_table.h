// SPDX-License-Identifier: Apache-2.0
// Every member of ShadowOptions as a row: the key that it is known by, its unit, range and one line about it. Parsers,
// presets, help and documents read these rows, and resolve() checks by them; what a member is without a word from
// anybody stands in options.h alone.
#pragma once

#include <gnomon/export.h>
#include <gnomon/options.h>

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon {

/// What a value of a row is.
enum class OptionType : std::uint8_t { flag, integer, real, choice, numbers };

/// A value of any row; the member of the row's type holds.
struct OptionValue {
    bool flag = false;           // type flag
    std::int64_t integer = 0;    // type integer
    double real = 0.0;           // type real
    std::vector<double> numbers; // type numbers: at most OptionRow::count
    std::string text;            // choice: its name
    bool none = false;           // a member that may have no value has none
};

/// All that is known of one member of ShadowOptions.
struct OptionRow {
    std::string_view key;                                 // as presets and --set have it: "pcf.taps"
    OptionType type = OptionType::flag;                   // which member of OptionValue holds
    std::string_view form;                                // how its value is written, for help: "N"
    std::string_view unit;                                // empty: none
    double min = 0.0;                                     // of each number; inclusive
    double max = 0.0;                                     // inclusive, too
    std::uint32_t count = 1;                              // numbers: how many, at most
    std::vector<std::string_view> (*choices)() = nullptr; // choice: what can be said
    std::string_view none_text;                           // how one writes that there is no value; empty: one cannot
    std::string_view doc;                                 // one line
    bool own_option = false;                              // has a command line option of its own
    bool (*used)(const ShadowOptions&) = nullptr;         // null: always has an effect
    std::string_view used_when;                           // the words for it: "filter pcf"
    OptionValue (*get)(const ShadowOptions&) = nullptr;   // never null
    /// Members that cannot hold together with the new value are taken back to their defaults. The value is of the row's
    /// type; one outside of its range is set as it is, and refused by resolve().
    void (*set)(ShadowOptions&, const OptionValue&) = nullptr;
};

/// All rows, in the order in which help shows them.
[[nodiscard]] GNOMON_API std::span<const OptionRow> optionTable();
/// Null for an unknown key.
[[nodiscard]] GNOMON_API const OptionRow* findOption(std::string_view key);
/// As one would write it, in every locale; none_text for none.
[[nodiscard]] GNOMON_API std::string textOf(const OptionRow& row, const OptionValue& value);
/// The first member that is outside of its range, as a sentence; nothing when all are inside.
[[nodiscard]] GNOMON_API std::optional<std::string> firstOutOfRange(const ShadowOptions& options);

} // namespace gnomon
