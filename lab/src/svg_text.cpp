// SPDX-License-Identifier: Apache-2.0
#include "svg_text.h"

#include <array>
#include <charconv>

namespace gnomon::lab {
namespace {

constexpr char32_t kReplacement = 0xFFFD;
constexpr char32_t kEllipsis = 0x2026;
constexpr char32_t kFirstWide = 0x1100; // Hangul; from here on most scripts are as wide as they are high

bool isXmlCharacter(char32_t c)
{
    return (c >= 0x20 && c < 0x7F) || (c >= 0xA0 && c <= 0xD7FF) || (c >= 0xE000 && c < 0xFFFE) ||
           (c >= 0x10000 && c <= 0x10FFFF);
}

/// Takes one character off the front of `text`, which is not empty. Bytes that are no UTF-8 are taken one by one.
char32_t takeCharacter(std::string_view& text)
{
    struct Form {
        unsigned char mask, lead;
        std::size_t length;
        char32_t least; // smaller values must use fewer bytes
    };
    constexpr std::array<Form, 4> kForms{
        {{0x80, 0x00, 1, 0}, {0xE0, 0xC0, 2, 0x80}, {0xF0, 0xE0, 3, 0x800}, {0xF8, 0xF0, 4, 0x10000}}};
    const auto byte = [&](std::size_t i) {
        return static_cast<unsigned char>(text[i]);
    };
    for (const Form& form : kForms) {
        if ((byte(0) & form.mask) != form.lead || text.size() < form.length) {
            continue;
        }
        char32_t c = byte(0) & static_cast<unsigned char>(~form.mask);
        bool valid = true;
        for (std::size_t i = 1; i < form.length; ++i) {
            valid = valid && (byte(i) & 0xC0U) == 0x80U;
            c = (c << 6U) | (byte(i) & 0x3FU);
        }
        if (valid && c >= form.least) {
            text.remove_prefix(form.length);
            return isXmlCharacter(c) ? c : kReplacement;
        }
    }
    text.remove_prefix(1);
    return kReplacement;
}

std::size_t columnsOf(char32_t c)
{
    return c >= kFirstWide && c != kEllipsis && c != kReplacement ? 2 : 1;
}

void append(std::string& out, char32_t c)
{
    switch (c) {
    case U'&':
        out += "&amp;";
        return;
    case U'<':
        out += "&lt;";
        return;
    case U'>':
        out += "&gt;";
        return;
    case U'"':
        out += "&quot;";
        return;
    case U'\'':
        out += "&#39;";
        return;
    default:
        break;
    }
    const auto tail = [&](unsigned shift) {
        out += static_cast<char>(0x80U | ((c >> shift) & 0x3FU));
    };
    if (c < 0x80) {
        out += static_cast<char>(c);
    } else if (c < 0x800) {
        out += static_cast<char>(0xC0U | (c >> 6U));
        tail(0);
    } else if (c < 0x10000) {
        out += static_cast<char>(0xE0U | (c >> 12U));
        tail(6);
        tail(0);
    } else {
        out += static_cast<char>(0xF0U | (c >> 18U));
        tail(12);
        tail(6);
        tail(0);
    }
}

} // namespace

std::string svgNumber(double value)
{
    constexpr int kDecimals = 2;
    std::array<char, 400> digits{}; // the largest double has 309 before the point
    const char* const end =
        std::to_chars(digits.data(), digits.data() + digits.size(), value, std::chars_format::fixed, kDecimals).ptr;
    std::string text(digits.data(), static_cast<std::size_t>(end - digits.data()));
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') {
        text.pop_back();
    }
    return text == "-0" ? "0" : text;
}

std::string svgText(std::string_view text, std::size_t max_columns)
{
    const bool cut = columnsOf(text) > max_columns;
    std::string out;
    std::size_t columns = cut ? 1 : 0; // the ellipsis
    while (!text.empty()) {
        const char32_t c = takeCharacter(text);
        columns += columnsOf(c);
        if (columns > max_columns) {
            break;
        }
        append(out, c);
    }
    if (cut) {
        append(out, kEllipsis);
    }
    return out;
}

std::size_t columnsOf(std::string_view text)
{
    std::size_t columns = 0;
    while (!text.empty()) {
        columns += columnsOf(takeCharacter(text));
    }
    return columns;
}

} // namespace gnomon::lab
