// SPDX-License-Identifier: Apache-2.0
#include "options/option_rows.h"

#include "options/option_access.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

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

/// "1 to 8 texels"; large whole numbers have all their digits.
std::string rangeText(const OptionRow& row)
{
    const auto written = [](double value) {
        constexpr double kAllDigits = 1e15;
        return std::abs(value) < kAllDigits && value == std::trunc(value)
                   ? std::to_string(static_cast<std::int64_t>(value))
                   : textOf(value);
    };
    return "in the range " + written(row.min) + " to " + written(row.max) + (row.unit.empty() ? "" : " ") +
           std::string(row.unit);
}

/// The whole text as a number.
template <class T>
std::optional<T> numberIn(std::string_view text)
{
    T value{};
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    return error == std::errc{} && stop == end ? std::optional(value) : std::nullopt;
}

std::optional<bool> flagIn(std::string_view text)
{
    constexpr std::array<std::string_view, 8> kWords{"0", "false", "off", "no", "1", "true", "on", "yes"};
    const auto found = std::ranges::find(kWords, text);
    return found != kWords.end() ? std::optional(found - kWords.begin() >= 4) : std::nullopt;
}

/// The finite numbers between slashes; nothing where there is something else, or are too many.
std::optional<std::vector<double>> numbersIn(const OptionRow& row, std::string_view text)
{
    std::vector<double> numbers;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find('/', begin), text.size());
        const std::optional<double> number = numberIn<double>(text.substr(begin, end - begin));
        if (!number || !std::isfinite(*number) || numbers.size() == row.count) {
            return std::nullopt;
        }
        numbers.push_back(*number);
        begin = end + 1;
    }
    return numbers;
}

std::string countText(const OptionRow& row)
{
    return "1 to " + std::to_string(row.count) + " finite numbers with / between (" + std::string(row.form) + ")";
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

OptionReading readOption(const OptionRow& row, std::string_view text)
{
    OptionValue value;
    const std::string none = row.none_text.empty() ? "" : std::string(row.none_text) + " or ";
    if (!row.none_text.empty() && text == row.none_text) {
        value.none = true;
        return {value, {}};
    }
    std::string expected; // where the text is of another type
    bool read = false;
    const auto take = [&read](const auto& found, auto& member) {
        read = found.has_value();
        member = found ? *found : member;
    };
    switch (row.type) {
    case OptionType::flag:
        take(flagIn(text), value.flag);
        expected = "0 or 1";
        break;
    case OptionType::integer:
        take(numberIn<std::int64_t>(text), value.integer);
        expected = none + "a whole number " + rangeText(row);
        break;
    case OptionType::real:
        take(numberIn<double>(text), value.real);
        read = read && std::isfinite(value.real);
        expected = none + "a finite number " + rangeText(row);
        break;
    case OptionType::numbers:
        take(numbersIn(row, text), value.numbers);
        expected = none + countText(row);
        break;
    case OptionType::choice:
        value.text = text;
        read = isKnown(row, value);
        expected = none + namesText(row);
        break;
    }
    if (read && numberOutside(row, value)) {
        return {std::nullopt, rangeText(row)};
    }
    return read ? OptionReading{value, {}} : OptionReading{std::nullopt, expected};
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
