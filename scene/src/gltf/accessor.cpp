// SPDX-License-Identifier: Apache-2.0
// Reading elements. Everything here works on spans that accessor_parse.cpp has checked against the buffers.
#include "gltf/accessor.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <limits>

namespace gnomon::scene::gltf {

namespace {

template <typename T>
double load(const std::byte* at)
{
    T value;
    std::memcpy(&value, at, sizeof value); // elements need not be aligned in memory
    return static_cast<double>(value);
}

double loadComponent(const std::byte* at, Component component)
{
    switch (component) {
    case Component::i8:
        return load<std::int8_t>(at);
    case Component::u8:
        return load<std::uint8_t>(at);
    case Component::i16:
        return load<std::int16_t>(at);
    case Component::u16:
        return load<std::uint16_t>(at);
    case Component::u32:
        return load<std::uint32_t>(at);
    case Component::f32:
        return load<float>(at);
    }
    return 0.0;
}

/// glTF 2.0, 3.11: c / (2^bits - 1) unsigned, max(c / (2^(bits-1) - 1), -1) signed.
double normalise(double value, Component component)
{
    switch (component) {
    case Component::i8:
        return std::max(value / 127.0, -1.0);
    case Component::u8:
        return value / 255.0;
    case Component::i16:
        return std::max(value / 32767.0, -1.0);
    case Component::u16:
        return value / 65535.0;
    default:
        return value;
    }
}

/// Byte offset of a component within its element.
std::size_t componentOffset(const Accessor& accessor, std::uint32_t c)
{
    return c / accessor.rows * accessor.column_bytes + c % accessor.rows * sizeOf(accessor.component);
}

/// Calls `put(index of the component among all, value)` for base and sparse elements.
template <typename Put>
void forEachComponent(const Accessor& accessor, const Put& put)
{
    if (!accessor.bytes.empty()) {
        for (std::size_t i = 0; i < accessor.count; ++i) {
            const std::byte* element = accessor.bytes.data() + i * accessor.stride;
            for (std::uint32_t c = 0; c < accessor.components; ++c) {
                put(i * accessor.components + c,
                    loadComponent(element + componentOffset(accessor, c), accessor.component));
            }
        }
    }
    const Sparse& sparse = accessor.sparse;
    if (sparse.indices.empty() || sparse.values.empty()) {
        return;
    }
    const std::size_t element_bytes = accessor.components / accessor.rows * accessor.column_bytes;
    const std::size_t index_bytes = sizeOf(sparse.index_component);
    for (std::size_t i = 0; i < sparse.count; ++i) {
        const auto target =
            static_cast<std::size_t>(loadComponent(sparse.indices.data() + i * index_bytes, sparse.index_component));
        const std::byte* element = sparse.values.data() + i * element_bytes;
        for (std::uint32_t c = 0; c < accessor.components; ++c) {
            put(target * accessor.components + c,
                loadComponent(element + componentOffset(accessor, c), accessor.component));
        }
    }
}

} // namespace

std::size_t sizeOf(Component component)
{
    switch (component) {
    case Component::i8:
    case Component::u8:
        return 1;
    case Component::i16:
    case Component::u16:
        return 2;
    default:
        return 4;
    }
}

std::uint64_t Accessor::lastBytes() const
{
    return std::uint64_t{components / rows - 1} * column_bytes + rows * sizeOf(component);
}

std::vector<float> readFloats(Context& context, const Accessor& accessor)
{
    context.chargeVertices(accessor.count, accessor.pointer);
    const std::uint64_t total = std::uint64_t{accessor.count} * accessor.components;
    context.chargeBytes(total * sizeof(float), accessor.pointer);
    std::vector<float> out(total, 0.0F);
    const bool normalized = accessor.normalized;
    const Component component = accessor.component;
    forEachComponent(accessor, [&](std::size_t i, double value) {
        out[i] = static_cast<float>(normalized ? normalise(value, component) : value);
    });
    return out;
}

std::vector<std::uint32_t> readIntegers(Context& context, const Accessor& accessor)
{
    assert(accessor.component != Component::f32);
    context.chargeVertices(accessor.count, accessor.pointer);
    const std::uint64_t total = std::uint64_t{accessor.count} * accessor.components;
    context.chargeBytes(total * sizeof(std::uint32_t), accessor.pointer);
    std::vector<std::uint32_t> out(total, 0);
    forEachComponent(accessor, [&](std::size_t i, double value) { out[i] = static_cast<std::uint32_t>(value); });
    return out;
}

std::vector<ComponentRange> measureComponents(Context& context, const Accessor& accessor)
{
    context.chargeChecks(accessor.count, accessor.pointer);
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    std::vector<ComponentRange> ranges(accessor.components, ComponentRange{kInfinity, -kInfinity});
    const auto take = [&](std::size_t i, double value) {
        ComponentRange& range = ranges[i % accessor.components];
        if (!std::isfinite(value)) {
            range.not_finite = std::min(range.not_finite, static_cast<std::uint32_t>(i / accessor.components));
        }
        range.low = std::min(range.low, value);
        range.high = std::max(range.high, value);
    };
    if (accessor.sparse.count == 0) {
        forEachComponent(accessor, take);
        return ranges;
    }
    // Replaced elements must not count, so the replacing has to be done first.
    const std::uint64_t total = std::uint64_t{accessor.count} * accessor.components;
    context.chargeBytes(total * sizeof(double), accessor.pointer);
    std::vector<double> values(total, 0.0);
    forEachComponent(accessor, [&](std::size_t i, double value) { values[i] = value; });
    for (std::size_t i = 0; i < values.size(); ++i) {
        take(i, values[i]);
    }
    return ranges;
}

void expectFormat(const JsonView& where, const Accessor& accessor, std::span<const Format> allowed)
{
    const auto name = [](const char* type, Component component, bool normalized) {
        static constexpr const char* kNames[] = {"BYTE", "UNSIGNED_BYTE", "SHORT", "UNSIGNED_SHORT",
                                                 "?",    "UNSIGNED_INT",  "FLOAT"};
        return std::string(type) + " of " + kNames[static_cast<int>(component) - 5120] +
               (normalized ? " normalized" : "");
    };
    std::string expected;
    for (const Format& format : allowed) {
        if (accessor.type == format.type && accessor.component == format.component &&
            accessor.normalized == format.normalized) {
            return;
        }
        expected += (expected.empty() ? "" : ", ") + name(format.type, format.component, format.normalized);
    }
    where.failFound("the accessor's format must be one of: " + expected,
                    name(accessor.type.c_str(), accessor.component, accessor.normalized));
}

} // namespace gnomon::scene::gltf
