// SPDX-License-Identifier: Apache-2.0
#include "plot_axis.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <utility>

namespace gnomon::lab {
namespace {

constexpr double kLargest = 1e300;
constexpr double kSmallest = 1e-300;

/// n * 10^exponent, the double nearest to it, so that 3 * 10^-1 is written 0.3.
double decimal(double n, int exponent)
{
    // pow() may be off by a bit on some machine; a parsed number is not.
    const std::string text = "1e" + std::to_string(std::abs(exponent));
    double power = 1.0;
    std::from_chars(text.data(), text.data() + text.size(), power);
    return exponent < 0 ? n / power : n * power;
}

/// "1e-07" to "1e-7", "2e+06" to "2e6".
std::string tidyExponent(const std::string& text)
{
    const std::size_t e = text.find('e');
    return e == std::string::npos ? text : text.substr(0, e + 1) + std::to_string(std::atoi(text.c_str() + e + 1));
}

std::string labelOf(double value, bool scientific, int decimals)
{
    if (value == 0.0) {
        return "0";
    }
    std::array<char, 400> room{};
    char* const end = room.data() + room.size();
    if (!scientific) {
        return {room.data(), std::to_chars(room.data(), end, value, std::chars_format::fixed, decimals).ptr};
    }
    return tidyExponent({room.data(), std::to_chars(room.data(), end, value, std::chars_format::scientific).ptr});
}

/// Of a number that need not be round: whole numbers as they are, others to four digits.
std::string labelOfAny(double value)
{
    constexpr double kLongest = 1e6;
    if (value == std::round(value) && std::abs(value) < kLongest) {
        return labelOf(value, false, 0);
    }
    std::array<char, 64> room{};
    char* const end = room.data() + room.size();
    return tidyExponent({room.data(), std::to_chars(room.data(), end, value, std::chars_format::general, 4).ptr});
}

/// 1, 2 or 5 times a power of ten.
struct Round {
    int digit = 1;
    int exponent = 0;
    [[nodiscard]] double value() const { return decimal(digit, exponent); }
};

Round after(Round round)
{
    switch (round.digit) {
    case 1:
        return {2, round.exponent};
    case 2:
        return {5, round.exponent};
    default:
        return {1, round.exponent + 1};
    }
}

/// The largest that is not above `value` (> 0).
Round roundDown(double value)
{
    // One decade lower than the logarithm says, whose last bit is not to be relied on.
    Round round{1, static_cast<int>(std::floor(std::log10(value))) - 1};
    while (after(round).value() <= value) {
        round = after(round);
    }
    return round;
}

/// The smallest that is not below `value`.
Round roundUp(double value)
{
    const Round below = roundDown(value);
    return below.value() == value ? below : after(below);
}

Axis makeLogarithmic(double low, double high, int wanted)
{
    Round first = roundDown(low);
    Round last = roundUp(high);
    if (first.value() == last.value()) { // a single value that is round itself
        first = roundDown(low * 0.999);
        last = after(last);
    }
    Axis axis;
    axis.low = first.value();
    axis.high = last.value();
    axis.logarithmic = true;
    const int decades = last.exponent - first.exponent;
    const bool label_all = decades * 3 <= wanted + 2;
    const int every = std::max(1, (decades + wanted - 1) / wanted);
    for (Round round = first; round.value() <= axis.high; round = after(round)) {
        const bool labelled = round.digit == 1 ? round.exponent % every == 0 : label_all;
        if (every > 1 && !labelled) {
            continue; // so many decades that lines between them would be a grey area
        }
        const bool scientific = round.exponent < -4 || round.exponent > 5;
        const double value = round.value();
        axis.ticks.push_back({value, labelled ? labelOf(value, scientific, std::max(0, -round.exponent)) : ""});
    }
    return axis;
}

Axis makeLinear(double low, double high, Ends ends, int wanted)
{
    if (ends == Ends::round && low > 0.0 && low <= high - low) {
        low = 0.0;
    }
    if (ends == Ends::round && high < 0.0 && -high <= high - low) {
        high = 0.0;
    }
    const double size = std::max(std::abs(low), std::abs(high));
    if (high - low <= std::max(size * 1e-12, kSmallest)) { // one value, as far as drawing goes
        const double half = size > kSmallest ? size * 0.1 : 1.0;
        low -= half;
        high += half;
    }
    const Round step = roundUp((high - low) / wanted * (1.0 - 1e-9));
    auto first = static_cast<std::int64_t>(std::ceil(low / step.value() - 1e-9));
    auto last = static_cast<std::int64_t>(std::floor(high / step.value() + 1e-9));
    Axis axis;
    const auto at = [&](std::int64_t n) {
        return decimal(static_cast<double>(n * step.digit), step.exponent);
    };
    if (ends == Ends::round) {
        first = static_cast<std::int64_t>(std::floor(low / step.value() + 1e-9));
        last = static_cast<std::int64_t>(std::ceil(high / step.value() - 1e-9));
        low = std::min(low, at(first));
        high = std::max(high, at(last));
    }
    axis.low = low;
    axis.high = high;
    const bool scientific = step.exponent < -5 || std::max(std::abs(low), std::abs(high)) >= 1e6;
    for (std::int64_t n = first; n <= last; ++n) {
        // An end that is round itself may be a last bit off.
        axis.ticks.push_back({std::clamp(at(n), low, high), labelOf(at(n), scientific, std::max(0, -step.exponent))});
    }
    return axis;
}

} // namespace

double Axis::fraction(double value) const
{
    if (logarithmic) {
        return (std::log10(value) - std::log10(low)) / (std::log10(high) - std::log10(low));
    }
    return (value - low) / (high - low);
}

bool isPlottable(double value, bool logarithmic)
{
    return std::isfinite(value) && std::abs(value) <= kLargest && (!logarithmic || value >= kSmallest);
}

Axis makeAxis(const std::vector<double>& values, bool logarithmic, Ends ends, int wanted)
{
    double low = kLargest;
    double high = -kLargest;
    for (const double value : values) {
        if (isPlottable(value, logarithmic)) {
            low = std::min(low, value);
            high = std::max(high, value);
        }
    }
    if (low > high) {
        low = logarithmic ? 1.0 : 0.0;
        high = logarithmic ? 10.0 : 1.0;
    }
    return logarithmic ? makeLogarithmic(low, high, wanted) : makeLinear(low, high, ends, wanted);
}

Axis makeAxisAt(const std::vector<double>& values, double letter)
{
    assert(values.size() >= 2 && isPlottable(values.front(), true) && values.front() < values.back());
    Axis axis;
    axis.low = values.front();
    axis.high = values.back();
    axis.logarithmic = true;
    for (const double value : values) {
        if (axis.ticks.empty() || axis.ticks.back().value < value) {
            axis.ticks.push_back({value, ""});
        }
    }
    struct Span {
        double from;
        double to;
    };
    std::vector<Span> taken;
    const auto label = [&](Tick& tick) {
        constexpr double kGap = 1.5; // letters between two labels
        std::string text = labelOfAny(tick.value);
        const double half = 0.5 * (static_cast<double>(text.size()) + kGap) * letter;
        const Span span{axis.fraction(tick.value) - half, axis.fraction(tick.value) + half};
        const bool free = std::none_of(taken.begin(), taken.end(),
                                       [&](const Span& other) { return span.from < other.to && other.from < span.to; });
        if (free) {
            taken.push_back(span);
            tick.label = std::move(text);
        }
    };
    label(axis.ticks.front());
    label(axis.ticks.back());
    std::for_each(axis.ticks.begin() + 1, axis.ticks.end() - 1, label);
    return axis;
}

} // namespace gnomon::lab
