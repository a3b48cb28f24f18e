// SPDX-License-Identifier: Apache-2.0
// Every member of ShadowOptions as a row: the key that it is known by, its unit, range and one line about it. Parsers,
// presets, help and documents read these rows, and resolve() checks by them; what a member is without a word from
// anybody stands in options.h alone.
#pragma once

#include <gnomon/export.h>
#include <gnomon/options.h>

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon {

/// The type of a row's value.
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

/// The description of one member of ShadowOptions.
struct OptionRow {
    std::string_view key;                                 // its name in presets and --set: "pcf.taps"
    OptionType type = OptionType::flag;                   // which member of OptionValue holds
    std::string_view form;                                // how its value is written, for help: "N"
    std::string_view unit;                                // empty: none
    double min = 0.0;                                     // least value of each number; inclusive
    double max = 0.0;                                     // largest value of each number; inclusive
    std::uint32_t count = 1;                              // numbers: how many, at most
    std::vector<std::string_view> (*choices)() = nullptr; // choice: the names to choose from
    std::string_view none_text;                           // how one writes that there is no value; empty: one cannot
    std::string_view doc;                                 // one line
    bool own_option = false;                              // has a command line option of its own
    bool (*used)(const ShadowOptions&) = nullptr;         // null: always has an effect
    std::string_view used_when;                           // when it is used, in words: "filter pcf"
    OptionValue (*get)(const ShadowOptions&) = nullptr;   // never null
    /// Members that cannot hold together with the new value are taken back to their defaults. The value is of the row's
    /// type; one outside of its range is set as it is, and refused by resolve().
    void (*set)(ShadowOptions&, const OptionValue&) = nullptr;
};

/// All rows, in the order in which help shows them.
[[nodiscard]] GNOMON_API std::span<const OptionRow> optionTable();
/// The row of a key; null for an unknown key.
[[nodiscard]] GNOMON_API const OptionRow* findOption(std::string_view key);
/// The value as one would write it, the same in every locale; none_text where there is no value.
[[nodiscard]] GNOMON_API std::string textOf(const OptionRow& row, const OptionValue& value);
/// The value that a text stands for, or what the row takes instead.
struct OptionReading {
    std::optional<OptionValue> value; // nothing where the text is none of the row's values
    std::string expected;             // then: "a whole number in the range 4 to 64"
};
/// Reads a value that was written as textOf() writes it, the same in every locale. Flags may be 1, true, on, yes, 0,
/// false, off and no. A number outside of the row's range is none of its values.
[[nodiscard]] GNOMON_API OptionReading readOption(const OptionRow& row, std::string_view text);
/// The first member that is outside of its range, as a sentence; nothing when all are inside.
[[nodiscard]] GNOMON_API std::optional<std::string> firstOutOfRange(const ShadowOptions& options);

} // namespace gnomon
