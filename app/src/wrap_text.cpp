// SPDX-License-Identifier: Apache-2.0
#include "wrap_text.h"

#include <fmt/format.h>

namespace gnomon::app {

std::string wrapped(std::string_view first, std::string_view text, std::size_t hanging)
{
    std::string lines(first);
    std::size_t column = first.size();
    bool starts = true;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find(' '), text.size());
        std::string_view word = text.substr(0, end);
        // A list that is longer than a line, as d16|d32f|r32f.
        const std::size_t room = kColumns - hanging;
        const std::size_t bar = word.size() > room ? word.rfind('|', room - 1) : std::string_view::npos;
        word = word.substr(0, bar == std::string_view::npos ? word.size() : bar + 1);
        const bool is_whole = word.size() == end;
        text.remove_prefix(is_whole ? std::min(end + 1, text.size()) : word.size());
        if (!starts && column + 1 + word.size() > kColumns) {
            lines += fmt::format("\n{:{}}", "", hanging);
            column = hanging;
        } else if (!starts) {
            lines += ' ';
            ++column;
        }
        lines += word;
        column += word.size();
        starts = false;
    }
    return lines + "\n";
}

std::string entryText(std::string_view name, std::string_view text, std::size_t column)
{
    return wrapped(fmt::format("  {:<{}}{}", name, column - 2, name.size() + 2 < column ? "" : "  "), text, column);
}

std::string joined(std::span<const std::string_view> names, std::string_view separator)
{
    std::string text;
    for (const std::string_view name : names) {
        text += text.empty() ? std::string(name) : fmt::format("{}{}", separator, name);
    }
    return text;
}

} // namespace gnomon::app
