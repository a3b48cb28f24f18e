// SPDX-License-Identifier: Apache-2.0
#include "compare_table.h"

#include "setting_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace gnomon::app {

std::string cell(const std::optional<double>& value, int decimals)
{
    return value && std::isfinite(*value) ? fmt::format("{:.{}f}", *value, decimals) : std::string(kNoNumber);
}

std::vector<std::string> errorColumns()
{
    return {"rmse", "mae", "bias", "edge%", "acne%", "detached%", "bleeding%"};
}

void addErrorCells(std::vector<std::string>& row, const std::optional<lab::ErrorNumbers>& error,
                   const lab::ClassErrors& classes)
{
    const auto number = [&](double lab::ErrorNumbers::*member) {
        return error ? std::optional((*error).*member) : std::nullopt;
    };
    row.push_back(cell(number(&lab::ErrorNumbers::rmse), 4));
    row.push_back(cell(number(&lab::ErrorNumbers::mae), 4));
    std::string bias =
        error && std::isfinite(error->bias) ? fmt::format("{:+.4f}", error->bias) : std::string(kNoNumber);
    row.push_back(bias == "-0.0000" || bias == "+0.0000" ? "0.0000" : bias);
    const double squared = error ? error->rmse * error->rmse : 0.0;
    for (const double part : {classes.edge, classes.acne, classes.detached, classes.bleeding}) {
        row.push_back(cell(squared > 0.0 ? std::optional(100.0 * part / squared) : std::nullopt, 1));
    }
}

std::string tableText(const TextTable& table)
{
    std::vector<std::size_t> widths;
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
        widths.push_back(table.columns[i].size());
        for (const auto& row : table.rows) {
            widths.back() = std::max(widths.back(), row[i].size());
        }
    }
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
