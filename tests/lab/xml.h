// SPDX-License-Identifier: Apache-2.0
// Checks that an SVG is well-formed, and reads its content.
#pragma once

#include <algorithm>
#include <cstddef>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::lab {

/// Checks what is inside a tag: name, then attributes in double quotes, each once.
inline std::string whyTagIsBad(std::string_view tag)
{
    std::set<std::string> seen;
    std::size_t at = tag.find_first_of(" /");
    while (at < tag.size() && tag[at] == ' ') {
        const std::size_t equals = tag.find("=\"", at);
        const std::size_t end = equals == std::string_view::npos ? equals : tag.find('"', equals + 2);
        if (end == std::string_view::npos) {
            return "attribute without value in " + std::string(tag);
        }
        if (!seen.emplace(tag.substr(at + 1, equals - at - 1)).second) {
            return "attribute twice in " + std::string(tag);
        }
        at = end + 1;
    }
    return at >= tag.size() || tag.substr(at) == "/" ? "" : "stray text in " + std::string(tag);
}

inline std::string whyTextIsBad(std::string_view text)
{
    for (std::size_t at = text.find('&'); at != std::string_view::npos; at = text.find('&', at + 1)) {
        bool known = false;
        for (const std::string_view entity : {"&amp;", "&lt;", "&gt;", "&quot;", "&#39;"}) {
            known = known || text.substr(at).starts_with(entity);
        }
        if (!known) {
            return "unknown entity in " + std::string(text);
        }
    }
    return "";
}

/// Empty when every tag is closed in order and every & begins an entity; else the fault.
inline std::string whyNotWellFormed(std::string_view xml)
{
    std::vector<std::string> open;
    while (!xml.empty()) {
        const std::size_t less = std::min(xml.find('<'), xml.size());
        std::string why = whyTextIsBad(xml.substr(0, less));
        if (less == xml.size()) {
            return !why.empty() ? why : open.empty() ? "" : open.back() + " is not closed";
        }
        const std::size_t greater = xml.find('>', less);
        if (greater == std::string_view::npos) {
            return "a tag has no end";
        }
        const std::string_view tag = xml.substr(less + 1, greater - less - 1);
        xml.remove_prefix(greater + 1);
        if (why.empty() && tag.starts_with('/')) {
            if (open.empty() || open.back() != tag.substr(1)) {
                return std::string(tag) + " closes what is not open";
            }
            open.pop_back();
            continue;
        }
        why += whyTagIsBad(tag) + whyTextIsBad(tag) + (tag.find('<') == std::string_view::npos ? "" : "< in a tag");
        if (!why.empty()) {
            return why;
        }
        if (!tag.ends_with('/')) {
            open.emplace_back(tag.substr(0, tag.find(' ')));
        }
    }
    return open.empty() ? "" : open.back() + " is not closed";
}

inline std::size_t count(std::string_view text, std::string_view what)
{
    std::size_t found = 0;
    for (std::size_t at = text.find(what); at != std::string_view::npos; at = text.find(what, at + 1)) {
        ++found;
    }
    return found;
}

} // namespace gnomon::lab
