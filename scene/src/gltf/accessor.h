// SPDX-License-Identifier: Apache-2.0
// Typed, bounds-checked views of binary data: buffers, buffer views and accessors (glTF 2.0, 3.6).
#pragma once

#include "gltf/json_view.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace gnomon::scene::gltf {

/// A buffer with neither a URI nor a chunk is a placeholder: it has a length but no content.
struct Buffer {
    std::vector<std::byte> owned;
    std::span<const std::byte> bytes;
    std::uint64_t length = 0;
    bool has_content = false;
};

enum class ViewUse : std::uint8_t { none, vertices, indices };

struct BufferView {
    std::uint32_t buffer = 0;
    std::uint64_t offset = 0; // within the buffer
    std::uint64_t length = 0;
    std::uint32_t stride = 0;         // 0: not given
    std::span<const std::byte> bytes; // empty without content
    bool has_content = false;
    ViewUse use = ViewUse::none;
};

enum class Component : std::uint16_t { i8 = 5120, u8 = 5121, i16 = 5122, u16 = 5123, u32 = 5125, f32 = 5126 };

[[nodiscard]] std::size_t sizeOf(Component component);

/// Replaces some elements of an accessor.
struct Sparse {
    std::uint32_t count = 0;
    Component index_component = Component::u8;
    std::span<const std::byte> indices; // tightly packed, empty without content
    std::span<const std::byte> values;
};

struct Accessor {
    std::string pointer;
    std::string type; // "SCALAR", "VEC2", ...
    Component component = Component::f32;
    bool normalized = false;
    std::uint32_t count = 0;
    std::uint32_t components = 1;   // per element
    std::uint32_t rows = 1;         // rows of a matrix column; = components for vectors
    std::uint32_t column_bytes = 0; // distance between matrix columns
    std::uint64_t stride = 0;       // bytes between elements
    std::uint32_t view = kNone;
    std::span<const std::byte> bytes; // from the first element on; empty: all zero
    Sparse sparse;

    /// From an element's first byte to behind its last component: the columns of a matrix are padded up to the next
    /// one, and behind the last column of the last element there is nothing to pad.
    [[nodiscard]] std::uint64_t lastBytes() const;
    /// False: there is nothing but zeros, because no data are attached (yet).
    [[nodiscard]] bool hasContent() const { return !bytes.empty() || !sparse.values.empty(); }
};

/// All elements as floats, components in a row; integers are divided by their maximum when `normalized`.
/// Charges the elements to the limit on vertices.
[[nodiscard]] std::vector<float> readFloats(Context& context, const Accessor& accessor);
/// All elements of an integer accessor.
[[nodiscard]] std::vector<std::uint32_t> readIntegers(Context& context, const Accessor& accessor);

struct ComponentRange {
    double low = 0.0;
    double high = 0.0;
    std::uint32_t not_finite = kNone; // first element with a NaN or an infinity
};
/// Smallest and largest value of every component as stored (not normalised). Charges the elements to the checks.
[[nodiscard]] std::vector<ComponentRange> measureComponents(Context& context, const Accessor& accessor);

/// One allowed combination of type, component and normalisation.
struct Format {
    const char* type;
    Component component;
    bool normalized;
};
/// Fails at `where` unless the accessor has one of the formats.
void expectFormat(const JsonView& where, const Accessor& accessor, std::span<const Format> allowed);

} // namespace gnomon::scene::gltf
