// SPDX-License-Identifier: Apache-2.0
#include "newer_std.h"

#if defined(_LIBCPP_VERSION) && _LIBCPP_VERSION < 15000

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

// WebAssembly's C library has no locale but C's, so strtod() and snprintf() write a point.

namespace std {
namespace {

double read(const char* text, char** end, double /*type*/)
{
    return strtod(text, end);
}
float read(const char* text, char** end, float /*type*/)
{
    return strtof(text, end);
}

/// The fewest digits that tell the number apart, as d.ddde+xx, or plainly where that is no longer.
template <class T>
to_chars_result write(char* first, char* last, T value)
{
    constexpr int kMostDigits = 17;
    std::array<char, 400> text{};
    if (!isfinite(value)) {
        snprintf(text.data(), text.size(), "%s",
                 isnan(value) ? (signbit(value) ? "-nan" : "nan")
                 : value < 0  ? "-inf"
                              : "inf");
    } else {
        int digits = 0;
        do {
            snprintf(text.data(), text.size(), "%.*e", digits, static_cast<double>(value));
        } while (read(text.data(), nullptr, T{}) != value && ++digits < kMostDigits);
        const int exponent = atoi(string_view(text.data()).substr(string_view(text.data()).find('e') + 1).data());
        std::array<char, 400> plain{};
        snprintf(plain.data(), plain.size(), "%.*f", max(digits - exponent, 0), static_cast<double>(value));
        if (string_view(plain.data()).size() <= string_view(text.data()).size()) {
            text = plain;
        }
    }
    const string_view written(text.data());
    if (static_cast<size_t>(last - first) < written.size()) {
        return {last, errc::value_too_large};
    }
    return {std::copy(written.begin(), written.end(), first), errc{}};
}

/// Decimal numbers alone, without a sign + and without spaces before.
template <class T>
from_chars_result readAll(const char* first, const char* last, T& value)
{
    const string_view given(first, static_cast<size_t>(last - first));
    const size_t sign = given.starts_with('-') ? 1 : 0;
    const string_view begin = given.substr(sign);
    const bool is_word =
        begin.starts_with("inf") || begin.starts_with("nan") || begin.starts_with("INF") || begin.starts_with("NAN");
    const bool is_number = !begin.empty() && (is_word || begin[0] == '.' || (begin[0] >= '0' && begin[0] <= '9'));
    if (!is_number) {
        return {first, errc::invalid_argument};
    }
    // Hexadecimal digits are not read: of "0x1" the 0 is.
    const string text(given.substr(0, min(given.find_first_of("xX"), given.size())));
    char* end = nullptr;
    const T got = read(text.c_str(), &end, T{});
    if (end == text.c_str()) {
        return {first, errc::invalid_argument};
    }
    const char* stop = first + (end - text.c_str());
    if (!is_word && !isfinite(got)) {
        return {stop, errc::result_out_of_range};
    }
    value = got;
    return {stop, errc{}};
}

} // namespace

to_chars_result to_chars(char* first, char* last, double value)
{
    return write(first, last, value);
}
to_chars_result to_chars(char* first, char* last, float value)
{
    return write(first, last, value);
}
from_chars_result from_chars(const char* first, const char* last, double& value)
{
    return readAll(first, last, value);
}
from_chars_result from_chars(const char* first, const char* last, float& value)
{
    return readAll(first, last, value);
}

} // namespace std

#endif
