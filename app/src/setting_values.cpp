// SPDX-License-Identifier: Apache-2.0
#include "setting_values.h"

#include <gnomon/choice_rules.h>

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>
#include <optional>
#include <set>

namespace gnomon::app {
namespace {

[[noreturn]] void refuse(const Setting& setting, std::string_view text, const std::string& expected)
{
    throw UsageError(fmt::format("{}: \"{}\" is not {}", spelled(setting), text, expected));
}

/// A hint for a technique's value that belongs to another choice than the one it was given to.
std::optional<std::string> elsewhere(const Setting& setting, std::string_view text)
{
    std::set<std::string_view> names;
    for (const ChoiceValue& row : choiceValues()) {
        if (row.name == text && row.choice != "light") {
            names.insert(row.choice);
        }
    }
    if (names.size() != 1 || !isChoice(setting.key)) {
        return std::nullopt; // a value of several choices tells nothing
    }
    return fmt::format(" (--{} has it)", *names.begin());
}

void requireInRange(const Setting& setting, std::string_view text, double value)
{
    if (!(value >= setting.min && value <= setting.max)) {
        refuse(setting, text, "in the range " + rangeText(setting));
    }
}

std::string numbersText(const Setting& setting, std::string_view kind)
{
    const std::string count = setting.min_count == 0 ? fmt::format("{}", setting.count)
                                                     : fmt::format("{} to {}", setting.min_count, setting.count);
    const std::string between = setting.between == ',' ? "commas" : fmt::format("{}", setting.between);
    return fmt::format("{} {}numbers with {} between ({})", count, kind, between, setting.form);
}

double realOf(const Setting& setting, std::string_view whole, std::string_view text)
{
    const auto value = toNumber(text);
    if (!value) {
        refuse(setting, whole, numbersText(setting, "finite "));
    }
    requireInRange(setting, whole, *value);
    return *value;
}

std::vector<double> numbersOf(const Setting& setting, std::string_view text)
{
    const auto pieces = split(text, setting.between);
    if (pieces.size() > setting.count || pieces.size() < (setting.min_count == 0 ? setting.count : setting.min_count)) {
        refuse(setting, text, numbersText(setting, ""));
    }
    std::vector<double> numbers;
    numbers.reserve(pieces.size());
    for (const std::string_view piece : pieces) {
        numbers.push_back(realOf(setting, text, piece));
    }
    return numbers;
}

/// Two whole numbers: WxH or A-B.
std::vector<double> pairOf(const Setting& setting, std::string_view text, char separator)
{
    const auto pieces = split(text, separator);
    std::vector<double> numbers;
    for (const std::string_view piece : pieces) {
        if (const auto value = toInteger(piece)) {
            numbers.push_back(static_cast<double>(*value));
        }
    }
    if (pieces.size() != 2 || numbers.size() != 2) {
        refuse(setting, text, fmt::format("{} in whole numbers", setting.form));
    }
    for (const double number : numbers) {
        requireInRange(setting, text, number);
    }
    return numbers;
}

/// The library reads flags and numbers, and does so for settings of the program, too.
SettingValue readByLibrary(const Setting& setting, OptionType type, std::string_view text)
{
    OptionRow row;
    row.type = type;
    row.form = setting.form;
    row.unit = setting.unit;
    row.min = setting.min;
    row.max = setting.max;
    row.none_text = setting.none_text;
    const OptionReading reading = readOption(setting.option != nullptr ? *setting.option : row, text);
    if (!reading.value) {
        refuse(setting, text, reading.expected);
    }
    return *reading.value;
}

std::size_t editDistance(std::string_view a, std::string_view b)
{
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
            diagonal = row[j];
            row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
        }
    }
    return row.back();
}

} // namespace

bool isChoice(std::string_view key)
{
    return std::ranges::find(kChoiceNames, key) != kChoiceNames.end();
}

std::string rangeText(const Setting& setting)
{
    return fmt::format("{} to {}{}{}", setting.min, setting.max, setting.unit.empty() ? "" : " ", setting.unit);
}

std::optional<double> toNumber(std::string_view text)
{
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) {
        return std::nullopt;
    }
    return value;
}

std::optional<std::int64_t> toInteger(std::string_view text)
{
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) {
        return std::nullopt;
    }
    return value;
}

std::vector<std::string_view> split(std::string_view text, char separator)
{
    std::vector<std::string_view> pieces;
    for (;;) {
        const std::size_t end = text.find(separator);
        pieces.push_back(text.substr(0, end));
        if (end == std::string_view::npos) {
            return pieces;
        }
        text.remove_prefix(end + 1);
    }
}

SettingValue parseValue(const Setting& setting, std::string_view text)
{
    SettingValue value;
    if (!setting.none_text.empty() && text == setting.none_text) {
        value.none = true;
        return value;
    }
    switch (setting.type) {
    case SettingType::flag:
        return readByLibrary(setting, OptionType::flag, text);
    case SettingType::integer:
        return readByLibrary(setting, OptionType::integer, text);
    case SettingType::real:
        return readByLibrary(setting, OptionType::real, text);
    case SettingType::numbers:
        if (setting.option != nullptr) {
            return readByLibrary(setting, OptionType::numbers, text);
        }
        value.numbers = numbersOf(setting, text);
        break;
    case SettingType::size:
        value.numbers = pairOf(setting, text, 'x');
        break;
    case SettingType::range:
        value.numbers = pairOf(setting, text, '-');
        break;
    case SettingType::choice: {
        const auto allowed = setting.choices();
        if (std::find(allowed.begin(), allowed.end(), text) == allowed.end()) {
            throw UsageError(fmt::format("{}: there is no \"{}\"{}; it takes {}", spelled(setting), text,
                                         elsewhere(setting, text).value_or(suggestion(text, allowed)),
                                         listed(allowed)));
        }
        value.text = text;
        break;
    }
    case SettingType::text:
        if (text.empty()) {
            refuse(setting, text, fmt::format("a {}", setting.form));
        }
        value.text = text;
        break;
    }
    return value;
}

std::string textOf(const Setting& setting, const SettingValue& value, std::string_view text)
{
    if (value.none) {
        return std::string(setting.none_text);
    }
    switch (setting.type) {
    case SettingType::flag:
        return value.flag ? "1" : "0";
    case SettingType::integer:
        return fmt::format("{}", value.integer);
    case SettingType::real:
        return fmt::format("{}", value.real + 0.0); // no minus nothing
    case SettingType::numbers: {
        std::string numbers;
        for (const double number : value.numbers) {
            numbers += fmt::format("{}{}", numbers.empty() ? "" : std::string(1, setting.between), number + 0.0);
        }
        return numbers;
    }
    default:
        return std::string(text);
    }
}

std::string suggestion(std::string_view typed, const std::vector<std::string_view>& names)
{
    std::string_view best;
    std::size_t best_distance = std::max<std::size_t>(2, typed.size() / 3) + 1;
    for (const std::string_view name : names) {
        const std::size_t distance = editDistance(typed, name);
        if (distance < best_distance && distance < name.size()) {
            best = name;
            best_distance = distance;
        }
    }
    return best.empty() ? std::string() : fmt::format(" (did you mean \"{}\"?)", best);
}

std::string listed(const std::vector<std::string_view>& names)
{
    std::string text;
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (i != 0) {
            text += i + 1 == names.size() ? " and " : ", ";
        }
        text += names[i];
    }
    return text;
}

} // namespace gnomon::app
