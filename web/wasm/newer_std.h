// SPDX-License-Identifier: Apache-2.0
// C++20 that the standard library of Debian's Emscripten (libc++ 13) lacks: algorithms of std::ranges, and numbers as
// text (newer_std.cpp). The build for WebAssembly includes it before each source. A newer library has all of it, and
// then this is empty.
#pragma once

#include <version>

#if defined(_LIBCPP_VERSION) && _LIBCPP_VERSION < 15000

#include <algorithm>
#include <bit>
#include <charconv>
#include <functional>
#include <iterator>
#include <ranges>
#include <utility>

// NOLINTBEGIN(cert-dcl58-cpp): it stands in for the library.

namespace std {

template <class To, class From>
constexpr To bit_cast(const From& from) noexcept
{
    return __builtin_bit_cast(To, from);
}

to_chars_result to_chars(char* first, char* last, double value);
to_chars_result to_chars(char* first, char* last, float value);
from_chars_result from_chars(const char* first, const char* last, double& value);
from_chars_result from_chars(const char* first, const char* last, float& value);

namespace ranges {

/// A comparison of what two projections make of its arguments.
template <class Compare, class First, class Second>
constexpr auto gnomonProjected(Compare& compare, First& first, Second& second)
{
    return [&](auto&& a, auto&& b) {
        return std::invoke(compare, std::invoke(first, static_cast<decltype(a)>(a)),
                           std::invoke(second, static_cast<decltype(b)>(b)));
    };
}
/// A predicate of what a projection makes of its argument.
template <class Predicate, class Projection>
constexpr auto gnomonProjected(Predicate& predicate, Projection& projection)
{
    return [&](auto&& a) {
        return std::invoke(predicate, std::invoke(projection, static_cast<decltype(a)>(a)));
    };
}

#define GNOMON_OF_PREDICATE(NAME)                                                                                      \
    template <class Range, class Predicate, class Projection = identity>                                               \
    constexpr auto NAME(Range&& range, Predicate predicate, Projection projection = {})                                \
    {                                                                                                                  \
        return std::NAME(ranges::begin(range), ranges::end(range), gnomonProjected(predicate, projection));            \
    }
GNOMON_OF_PREDICATE(all_of)
GNOMON_OF_PREDICATE(any_of)
GNOMON_OF_PREDICATE(none_of)
GNOMON_OF_PREDICATE(find_if)
GNOMON_OF_PREDICATE(count_if)
#undef GNOMON_OF_PREDICATE

#define GNOMON_OF_ORDER(NAME)                                                                                          \
    template <class Range, class Compare = less, class Projection = identity>                                          \
    constexpr auto NAME(Range&& range, Compare compare = {}, Projection projection = {})                               \
    {                                                                                                                  \
        return std::NAME(ranges::begin(range), ranges::end(range), gnomonProjected(compare, projection, projection));  \
    }
GNOMON_OF_ORDER(sort)
GNOMON_OF_ORDER(push_heap)
GNOMON_OF_ORDER(pop_heap)
GNOMON_OF_ORDER(min_element)
GNOMON_OF_ORDER(max_element)
#undef GNOMON_OF_ORDER

template <class Range, class Value, class Projection = identity>
constexpr auto find(Range&& range, const Value& value, Projection projection = {})
{
    return std::find_if(ranges::begin(range), ranges::end(range),
                        [&](auto&& one) { return std::invoke(projection, static_cast<decltype(one)>(one)) == value; });
}

template <class Range, class Value, class Compare = less, class Projection = identity>
constexpr auto lower_bound(Range&& range, const Value& value, Compare compare = {}, Projection projection = {})
{
    identity same;
    return std::lower_bound(ranges::begin(range), ranges::end(range), value,
                            gnomonProjected(compare, projection, same));
}

template <class Range, class Value, class Compare = less, class Projection = identity>
constexpr auto upper_bound(Range&& range, const Value& value, Compare compare = {}, Projection projection = {})
{
    identity same;
    return std::upper_bound(ranges::begin(range), ranges::end(range), value,
                            gnomonProjected(compare, same, projection));
}

template <class Range, class Value, class Compare = less>
constexpr bool binary_search(Range&& range, const Value& value, Compare compare = {})
{
    return std::binary_search(ranges::begin(range), ranges::end(range), value, compare);
}

template <class First, class Second, class Equal = equal_to, class FirstProjection = identity,
          class SecondProjection = identity>
constexpr bool equal(First&& first, Second&& second, Equal equal = {}, FirstProjection first_projection = {},
                     SecondProjection second_projection = {})
{
    return std::equal(ranges::begin(first), ranges::end(first), ranges::begin(second), ranges::end(second),
                      gnomonProjected(equal, first_projection, second_projection));
}

template <class Range, class Out>
constexpr auto copy(Range&& range, Out out)
{
    return std::copy(ranges::begin(range), ranges::end(range), std::move(out));
}

template <class Range, class Out, class Predicate, class Projection = identity>
constexpr auto copy_if(Range&& range, Out out, Predicate predicate, Projection projection = {})
{
    return std::copy_if(ranges::begin(range), ranges::end(range), std::move(out),
                        gnomonProjected(predicate, projection));
}

template <class Range, class Out, class Function>
constexpr auto transform(Range&& range, Out out, Function function)
{
    return std::transform(ranges::begin(range), ranges::end(range), std::move(out),
                          [&](auto&& one) { return std::invoke(function, static_cast<decltype(one)>(one)); });
}

template <class Range, class Function>
constexpr void for_each(Range&& range, Function&& function)
{
    std::for_each(ranges::begin(range), ranges::end(range), [&](auto&& one) { std::invoke(function, one); });
}

template <class Range, class Value>
constexpr void fill(Range&& range, const Value& value)
{
    std::fill(ranges::begin(range), ranges::end(range), value);
}

template <class Range, class Predicate, class Value>
constexpr void replace_if(Range&& range, Predicate predicate, const Value& value)
{
    std::replace_if(ranges::begin(range), ranges::end(range), predicate, value);
}

template <class First, class Second, class Out>
constexpr auto set_union(First&& first, Second&& second, Out out)
{
    return std::set_union(ranges::begin(first), ranges::end(first), ranges::begin(second), ranges::end(second),
                          std::move(out));
}

} // namespace ranges
} // namespace std

// NOLINTEND(cert-dcl58-cpp)

#endif
