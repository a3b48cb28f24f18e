// SPDX-License-Identifier: Apache-2.0
#include "compare_table.h"

#include "setting_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

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

std::string_view meaningOfColumn(std::string_view column)
{
    struct Meaning {
        std::string_view column;
        std::string_view text;
    };
    static constexpr Meaning kMeanings[] = {
        {"rmse", "root of the mean squared error of the mask, whose values go from 0 to 1; 0 is best"},
        {"mae", "mean absolute error of the mask; 0 is best"},
        {"bias", "mean error: below 0 the shadows are too dark or too large, above 0 too light; 0 is best"},
        {"shimmer", "root of the mean squared change of the error from frame to frame, at the same points; 0 is best"},
        {"pop", "the largest mean change of the error from one frame to the next; 0 is best"},
        {"edge%", "share of the squared error at the rims of shadows: stairs, a penumbra of the wrong width"},
        {"acne%", "share of the squared error on lit surfaces that shadow themselves"},
        {"detached%", "share of the squared error in light between an object and its shadow"},
        {"bleeding%", "share of the squared error in light inside a shadow, far behind what casts it"},
        {"ssim", "structural similarity of the mask to the truth; 1 is best"},
        {"flip", "what an eye sees when mask and truth alternate; 0 is best"},
        {"ratio", "median frame divided by the frame without shadows; 1 costs nothing"},
        {"ms", "median frame in milliseconds, every map drawn anew in every frame"},
        {"MiB", "memory beyond the frame without shadows"},
        {"equal", "median frame divided by that of the cheapest PCF that errs no more; below 1 the better buy"},
        {"truth+-", "standard error of the truth itself"},
        {"pixels", "how many pixels count"}};
    const auto* found = std::find_if(std::begin(kMeanings), std::end(kMeanings),
                                     [&](const Meaning& meaning) { return meaning.column == column; });
    return found == std::end(kMeanings) ? std::string_view() : found->text;
}

std::vector<std::string> meaningsOf(const TextTable& table)
{
    std::vector<std::string> meanings;
    for (const std::string& column : table.columns) {
        meanings.emplace_back(meaningOfColumn(column));
    }
    return meanings;
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
    std::string common;
    for (const std::string& technique : techniques) {
        for (const auto part : split(technique, '+')) {
            if (!part.starts_with("blur.path=")) {
                continue;
            }
            if (!common.empty() && common != part) {
                return {};
            }
            common = part;
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
