// SPDX-License-Identifier: Apache-2.0
// How a row of the option table reads and writes its member, made from the way to the member alone.
#pragma once

#include <gnomon/option_table.h>

#include <concepts>
#include <cstdint>
#include <limits>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

namespace gnomon {

/// The names of an enum's values, in their order.
template <class Enum>
std::vector<std::string_view> namesOf()
{
    std::vector<std::string_view> names;
    for (std::uint8_t i = 0; nameOf(static_cast<Enum>(i)) != "?"; ++i) {
        names.push_back(nameOf(static_cast<Enum>(i)));
    }
    return names;
}

/// "0.05" for 0.05F: a single-precision member is known by the number that one would write for it.
[[nodiscard]] double asWritten(float value);

template <class T>
OptionValue valueOf(const T& member)
{
    OptionValue value;
    if constexpr (std::same_as<T, bool>) {
        value.flag = member;
    } else if constexpr (std::is_enum_v<T>) {
        value.text = nameOf(member);
    } else if constexpr (std::integral<T>) {
        value.integer = member;
    } else if constexpr (std::same_as<T, float>) {
        value.real = asWritten(member);
    } else {
        value.real = member;
    }
    return value;
}

/// A number that a member cannot hold becomes its largest, which no range has: cut off it might be a legal one.
template <std::integral T>
T fitted(std::int64_t number)
{
    return std::in_range<T>(number) ? static_cast<T>(number) : std::numeric_limits<T>::max();
}

template <class T>
void assign(T& member, const OptionValue& value)
{
    if constexpr (std::same_as<T, bool>) {
        member = value.flag;
    } else if constexpr (std::is_enum_v<T>) {
        const std::vector<std::string_view> names = namesOf<T>();
        for (std::size_t i = 0; i < names.size(); ++i) {
            if (names[i] == value.text) {
                member = static_cast<T>(i);
            }
        }
    } else if constexpr (std::integral<T>) {
        member = fitted<T>(value.integer);
    } else {
        member = static_cast<T>(value.real);
    }
}

template <class T>
OptionValue valueOf(const std::optional<T>& member)
{
    if (member) {
        return valueOf(*member);
    }
    OptionValue none;
    none.none = true;
    return none;
}

template <class T>
void assign(std::optional<T>& member, const OptionValue& value)
{
    if (value.none) {
        member.reset();
    } else {
        assign(member.emplace(), value);
    }
}

/// `path` is a lambda from the options to the member: [](auto& o) -> auto& { return o.map_size; }.
template <auto path>
OptionValue getMember(const ShadowOptions& options)
{
    return valueOf(path(options));
}
template <auto path>
void setMember(ShadowOptions& options, const OptionValue& value)
{
    assign(path(options), value);
}

} // namespace gnomon

/// The two functions of a row for a member that is nothing but a value.
#define GNOMON_MEMBER(PATH)                                                                                            \
    .get = getMember < [](auto& o) -> auto&                                                                            \
    {                                                                                                                  \
        return o.PATH;                                                                                                 \
    }                                                                                                                  \
    >, .set = setMember < [](auto& o) -> auto&                                                                         \
    {                                                                                                                  \
        return o.PATH;                                                                                                 \
    }                                                                                                                  \
    >
