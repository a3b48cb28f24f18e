// SPDX-License-Identifier: Apache-2.0
#include "option_steps.h"

#include <algorithm>
#include <cctype>
#include <sstream>
#include <stdexcept>

namespace gnomon::test {
namespace {

constexpr double kLargestMap = 256.0;  // texels
constexpr double kFarthestEnd = 100.0; // metres

double largestOf(const OptionRow& row)
{
    return row.key == "map-size" ? kLargestMap : row.key == "cascades.ends" ? kFarthestEnd : row.max;
}

OptionValue numbersOf(const OptionRow& row, std::uint32_t count)
{
    OptionValue value;
    for (std::uint32_t i = 1; i <= count; ++i) {
        value.numbers.push_back(row.min + (largestOf(row) - row.min) * i / (count + 1));
    }
    return value;
}

std::vector<OptionValue> valuesOf(const OptionRow& row)
{
    std::vector<OptionValue> values;
    OptionValue value;
    switch (row.type) {
    case OptionType::flag:
        for (const bool flag : {true, false}) {
            value.flag = flag;
            values.push_back(value);
        }
        break;
    case OptionType::choice:
        for (const std::string_view name : row.choices()) {
            value.text = name;
            values.push_back(value);
        }
        break;
    case OptionType::numbers:
        values = {numbersOf(row, 1), numbersOf(row, row.count)};
        break;
    default:
        for (const double share : {0.0, 0.3, 1.0}) {
            value.real = row.min + share * (largestOf(row) - row.min);
            value.integer = static_cast<std::int64_t>(value.real);
            values.push_back(value);
        }
    }
    return values;
}

} // namespace

OptionSteps stepsFrom(const ShadowOptions& base)
{
    OptionSteps steps;
    for (const OptionRow& row : optionTable()) {
        const std::size_t before = steps.list.size();
        for (const OptionValue& value : valuesOf(row)) {
            ShadowOptions options = base;
            row.set(options, value);
            if (!resolve(options)) {
                ++steps.refused;
                continue;
            }
            steps.list.push_back({options, std::string(row.key) + "=" + textOf(row, value)});
        }
        steps.rows += steps.list.size() > before ? 1 : 0;
    }
    return steps;
}

ShadowOptions optionsFrom(std::string_view line)
{
    ShadowOptions options{.technique = kPlainTechnique};
    std::istringstream words{std::string(line)};
    for (std::string word; words >> word;) {
        const std::size_t equals = word.find('=');
        const OptionRow* const row = findOption(std::string_view(word).substr(0, equals));
        if (row == nullptr || equals == std::string::npos) {
            throw std::runtime_error("no option " + word);
        }
        OptionValue value;
        value.text = word.substr(equals + 1);
        value.integer = row->type == OptionType::integer ? std::stoll(value.text) : 0;
        row->set(options, value);
    }
    return resolvedOrThrow(options).asked();
}

std::string nameOfBase(std::string_view line)
{
    std::string name;
    std::istringstream words{std::string(line)};
    for (std::string word; words >> word;) {
        if (word.starts_with("map-size") || word.starts_with("keep-still")) {
            continue;
        }
        name += name.empty() ? "" : "_";
        std::ranges::copy_if(word.substr(word.find('=') + 1), std::back_inserter(name),
                             [](unsigned char c) { return std::isalnum(c) != 0; });
    }
    return name;
}

} // namespace gnomon::test
