// SPDX-License-Identifier: Apache-2.0
// The structs that a host fills in, and the C++ ones that they stand for. A default is what the C++ struct has.
#pragma once

#include "failures.h"

#include <gnomon/frame.h>
#include <gnomon/object_set.h>
#include <gnomon/pack/filter_rule.h>

#include <cstring>
#include <vector>

namespace gnomon::c {

/// The first version of each struct, which programs of interface 1 have. It stays as it is when members are added.
template <class T>
inline constexpr std::uint32_t kFirstSize = sizeof(T);

/// The struct that stands for a C++ one; `size` is set.
[[nodiscard]] GnomonObjectFlags given(const ObjectFlags& flags);
[[nodiscard]] GnomonLight given(const Light& light);
[[nodiscard]] GnomonFrame given(const Frame& frame); // without what it points to
[[nodiscard]] GnomonPageRequests given(const PageRequests& requests);
[[nodiscard]] GnomonPrecision given(const pack::DrawPrecision& precision);
/// The C++ struct that a host's stands for. Each throws WrongCall for numbers that it cannot have.
[[nodiscard]] ObjectFlags taken(const GnomonObjectFlags& flags);
[[nodiscard]] Light taken(const GnomonLight& light);
[[nodiscard]] pack::DrawPrecision taken(const GnomonPrecision& precision);
[[nodiscard]] Aabb taken(const GnomonBounds& bounds);
/// The value of an enum that has `count` values, from 0 on.
[[nodiscard]] std::uint8_t takenEnum(std::uint32_t value, std::uint32_t count, const char* name);

/// Throws WrongCall for a size that no version of a struct has.
void requireSize(std::size_t size, std::size_t first, std::size_t now, const char* name);

/// Reads a struct of any version: members that an older one lacks have their defaults.
template <class T, class Cpp>
T readStruct(const void* from, const char* name, std::size_t first = kFirstSize<T>)
{
    std::uint32_t size = 0;
    std::memcpy(&size, from, sizeof(size));
    requireSize(size, first, sizeof(T), name);
    T own = given(Cpp{});
    std::memcpy(&own, from, size);
    return own;
}

/// Writes the defaults to a struct of the version that has `size` bytes.
template <class T, class Cpp>
GnomonStatus initStruct(T* out, std::size_t size, const char* name) noexcept
{
    return guarded("writing defaults", [&] {
        requireSize(size, kFirstSize<T>, sizeof(T), name);
        T own = given(Cpp{});
        own.size = static_cast<std::uint32_t>(size);
        std::memcpy(&required(out, name), &own, size);
    });
}

/// A host's frame, with memory for what it points to, kept from frame to frame.
class FrameTaker {
public:
    /// Holds until the next call. Throws WrongCall.
    const Frame& take(const GnomonFrame& frame);

private:
    void takeLights(const GnomonFrame& own);
    void takeRequests(const GnomonFrame& own);
    void takeLayers(const GnomonFrame& own);

    Frame frame_;
    std::vector<Light> lights_;
    std::vector<WorldLayer> layers_;
    std::vector<PageRequests> requests_;
    std::vector<std::vector<SeenCell>> cells_;
};

} // namespace gnomon::c
