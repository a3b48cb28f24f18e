// SPDX-License-Identifier: Apache-2.0
#include "compare_table.h"

#include "setting_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace gnomon::app {
namespace {

std::vector<std::size_t> widthsOf(const TextTable& table)
{
    std::vector<std::size_t> widths;
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
        widths.push_back(table.columns[i].size());
        for (const auto& row : table.rows) {
            widths.back() = std::max(widths.back(), row[i].size());
        }
    }
    return widths;
}

} // namespace

std::string cell(const std::optional<double>& value, int decimals)
{
    return value && std::isfinite(*value) ? fmt::format("{:.{}f}", *value, decimals) : std::string(kNoNumber);
}

std::string tableText(const TextTable& table)
{
    const std::vector<std::size_t> widths = widthsOf(table);
    const auto line = [&](const std::vector<std::string>& cells) {
        std::string text = fmt::format("{:<{}}", cells.front(), widths.front());
        for (std::size_t i = 1; i < cells.size(); ++i) {
            text += fmt::format("  {:>{}}", cells[i], widths[i]);
        }
        return text + "\n";
    };
    std::string text = line(table.columns);
    for (const auto& row : table.rows) {
        text += line(row);
    }
    return text;
}

std::string fittedTableText(const TextTable& table)
{
    std::size_t width = 0;
    for (const std::size_t column : widthsOf(table)) {
        width += column + (width == 0 ? 0 : 2);
    }
    if (width <= kTableWidth) {
        return tableText(table);
    }
    TextTable numbered = table;
    std::vector<std::string> names;
    for (std::vector<std::string>& row : numbered.rows) {
        auto name = std::find(names.begin(), names.end(), row.front());
        if (name == names.end()) {
            name = names.insert(names.end(), row.front());
        }
        row.front() = fmt::format("{}", name - names.begin() + 1);
    }
    std::string text = tableText(numbered) + "\n";
    for (std::size_t i = 0; i < names.size(); ++i) {
        text += fmt::format("{:>3}  {}\n", i + 1, names[i]);
    }
    return text;
}

std::vector<std::string> techniqueNames(const Json& rows)
{
    std::vector<std::string> names;
    for (const Json& row : rows) {
        names.push_back(textAt(row, "/technique"));
    }
    return names;
}

std::vector<std::string> shortNames(std::vector<std::string> techniques)
{
    const std::string common = commonParts(techniques) + "+" + commonBlurPath(techniques);
    for (std::string& name : techniques) {
        name = withoutParts(name, common);
    }
    return techniques;
}

std::string commonParts(const std::vector<std::string>& techniques)
{
    if (techniques.size() < 2) {
        return {};
    }
    std::string common;
    const auto parts = split(techniques.front(), '+');
    for (std::size_t i = 1; i < parts.size(); ++i) {
        const bool everywhere = std::all_of(techniques.begin(), techniques.end(), [&](const std::string& technique) {
            const auto others = split(technique, '+');
            return std::find(others.begin() + 1, others.end(), parts[i]) != others.end();
        });
        if (everywhere) {
            common += fmt::format("{}{}", common.empty() ? "" : "+", parts[i]);
        }
    }
    return common;
}

std::string commonBlurPath(const std::vector<std::string>& techniques)
{
    std::set<std::string_view> paths;
    for (const std::string& technique : techniques) {
        for (const std::string_view part : split(technique, '+')) {
            if (part.starts_with("blur.path=")) {
                paths.insert(part);
            }
        }
    }
    return paths.size() == 1 ? std::string(*paths.begin()) : std::string();
}

std::string withoutParts(std::string_view technique, std::string_view parts)
{
    const auto gone = split(parts, '+');
    const auto all = split(technique, '+');
    std::string text(all.front());
    for (std::size_t i = 1; i < all.size(); ++i) {
        if (std::find(gone.begin(), gone.end(), all[i]) == gone.end()) {
            text += fmt::format("+{}", all[i]);
        }
    }
    return text;
}

} // namespace gnomon::app
