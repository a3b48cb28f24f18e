// SPDX-License-Identifier: Apache-2.0
#include "options/option_rows.h"

#include "options/option_access.h"

#include <algorithm>
#include <array>
#include <charconv>

namespace gnomon {
namespace {

/// The fewest digits that tell the number apart, in every locale.
std::string textOf(double value)
{
    std::array<char, 32> room{};
    return {room.data(), std::to_chars(room.data(), room.data() + room.size(), value + 0.0).ptr}; // no minus nothing
}

bool isInside(const OptionRow& row, double number)
{
    return number >= row.min && number <= row.max; // NaN is outside, too
}

/// The number of a value that is outside of its row's range.
std::optional<double> numberOutside(const OptionRow& row, const OptionValue& value)
{
    if (value.none) {
        return std::nullopt;
    }
    if (row.type == OptionType::integer && !isInside(row, static_cast<double>(value.integer))) {
        return static_cast<double>(value.integer);
    }
    if (row.type == OptionType::real && !isInside(row, value.real)) {
        return value.real;
    }
    if (row.type == OptionType::numbers) {
        for (const double number : value.numbers) {
            if (!isInside(row, number)) {
                return number;
            }
        }
    }
    return std::nullopt;
}

bool isKnown(const OptionRow& row, const OptionValue& value)
{
    const std::vector<std::string_view> names = row.choices();
    return value.none || std::ranges::find(names, value.text) != names.end();
}

/// "1 or 4"; "a, b or c".
std::string namesText(const OptionRow& row)
{
    const std::vector<std::string_view> names = row.choices();
    std::string text;
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (i != 0) {
            text += i + 1 == names.size() ? " or " : ", ";
        }
        text += names[i];
    }
    return text;
}

} // namespace

double asWritten(float value)
{
    std::array<char, 32> room{};
    const char* const end = std::to_chars(room.data(), room.data() + room.size(), value).ptr;
    double written = 0.0;
    std::from_chars(room.data(), end, written);
    return written;
}

std::span<const OptionRow> optionTable()
{
    static const std::vector<OptionRow> table = [] {
        std::vector<OptionRow> made;
        addTechniqueRows(made);
        addPlanRows(made);
        addStepRows(made);
        addSoftenRows(made);
        addMomentRows(made);
        return made;
    }();
    return table;
}

const OptionRow* findOption(std::string_view key)
{
    const auto table = optionTable();
    const auto found = std::ranges::find(table, key, &OptionRow::key);
    return found != table.end() ? &*found : nullptr;
}

std::string textOf(const OptionRow& row, const OptionValue& value)
{
    if (value.none) {
        return std::string(row.none_text);
    }
    switch (row.type) {
    case OptionType::flag:
        return value.flag ? "1" : "0";
    case OptionType::integer:
        return std::to_string(value.integer);
    case OptionType::real:
        return textOf(value.real);
    case OptionType::choice:
        return value.text;
    case OptionType::numbers:
        break;
    }
    std::string numbers;
    for (const double number : value.numbers) {
        numbers += (numbers.empty() ? "" : "/") + textOf(number);
    }
    return numbers;
}

std::optional<std::string> firstOutOfRange(const ShadowOptions& options)
{
    for (const OptionRow& row : optionTable()) {
        const OptionValue value = row.get(options);
        if (const auto number = numberOutside(row, value)) {
            return std::string(row.key) + " is " + textOf(*number) + "; it can be " + textOf(row.min) + " to " +
                   textOf(row.max) + (row.unit.empty() ? "" : " ") + std::string(row.unit);
        }
        if (row.type == OptionType::choice && !isKnown(row, value)) {
            return std::string(row.key) + " is " + value.text + "; it can be " + namesText(row);
        }
    }
    return std::nullopt;
}

} // namespace gnomon
