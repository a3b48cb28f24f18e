// SPDX-License-Identifier: Apache-2.0
#include "scene/json.h"

namespace gnomon::scene {

std::string escapeKey(std::string_view key)
{
    std::string out;
    for (const char c : key) {
        if (c == '~') {
            out += "~0";
        } else if (c == '/') {
            out += "~1";
        } else {
            out += c;
        }
    }
    return out;
}

std::string detail::shortReason(std::string_view text)
{
    const std::size_t start = text.find("] ");
    std::string reason(start == std::string_view::npos ? text : text.substr(start + 2));
    constexpr std::size_t kLongest = 200;
    if (reason.size() > kLongest) {
        reason = reason.substr(0, kLongest) + "...";
    }
    std::replace_if(
        reason.begin(), reason.end(), [](unsigned char c) { return c < 0x20U || c >= 0x7FU; }, '?');
    return reason;
}

} // namespace gnomon::scene
