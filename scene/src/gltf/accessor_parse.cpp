// SPDX-License-Identifier: Apache-2.0
// Checks accessors against the buffers they name, and their content against what they declare.
#include "gltf/document.h"

#include <cmath>
#include <cstring>

namespace gnomon::scene::gltf {

namespace {

struct TypeShape {
    const char* name;
    std::uint32_t columns;
    std::uint32_t rows;
};
constexpr TypeShape kTypes[] = {{"SCALAR", 1, 1}, {"VEC2", 1, 2}, {"VEC3", 1, 3}, {"VEC4", 1, 4},
                                {"MAT2", 2, 2},   {"MAT3", 3, 3}, {"MAT4", 4, 4}};

Component readComponent(const JsonView& view)
{
    const std::uint64_t value = view.uint();
    if (value < 5120 || value > 5126 || value == 5124) {
        view.fail("the component type must be one of 5120, 5121, 5122, 5123, 5125, 5126");
    }
    return static_cast<Component>(value);
}

void readShape(const JsonView& view, Accessor& accessor)
{
    const JsonView type = view.at("type");
    accessor.type = type.string();
    for (const TypeShape& shape : kTypes) {
        if (accessor.type == shape.name) {
            accessor.rows = shape.rows;
            accessor.components = shape.columns * shape.rows;
            const auto bytes = static_cast<std::uint32_t>(shape.rows * sizeOf(accessor.component));
            // Columns of a matrix start on 4-byte boundaries (glTF 2.0, 3.6.2.4).
            accessor.column_bytes = shape.columns > 1 ? (bytes + 3) / 4 * 4 : bytes;
            return;
        }
    }
    type.fail("the accessor type must be one of SCALAR, VEC2, VEC3, VEC4, MAT2, MAT3, MAT4");
}

/// The uses that primitives make of accessors, by accessor and view. Mistakes are told when the primitives are read.
struct Uses {
    std::vector<bool> vertices;
    std::vector<bool> indices;
    std::vector<bool> vertex_views;
};

/// An empty value where there is no such member.
const nlohmann::json& memberOf(const nlohmann::json& object, const char* key)
{
    static const nlohmann::json kNothing;
    return object.is_object() && object.contains(key) ? object[key] : kNothing;
}

void mark(std::vector<bool>& used, const nlohmann::json& index)
{
    if (index.is_number_unsigned() && index.get<std::uint64_t>() < used.size()) {
        used[index.get<std::size_t>()] = true;
    }
}

Uses findUses(const Document& document)
{
    const nlohmann::json& root = document.root.value();
    const nlohmann::json& accessors = memberOf(root, "accessors");
    Uses uses{std::vector<bool>(accessors.size()), std::vector<bool>(accessors.size()),
              std::vector<bool>(document.views.size())};
    for (const nlohmann::json& mesh : memberOf(root, "meshes")) {
        for (const nlohmann::json& primitive : memberOf(mesh, "primitives")) {
            for (const nlohmann::json& attribute : memberOf(primitive, "attributes")) {
                mark(uses.vertices, attribute);
            }
            for (const nlohmann::json& target : memberOf(primitive, "targets")) {
                for (const nlohmann::json& attribute : target) {
                    mark(uses.vertices, attribute);
                }
            }
            mark(uses.indices, memberOf(primitive, "indices"));
        }
    }
    for (std::size_t i = 0; i < accessors.size(); ++i) {
        if (uses.vertices[i]) {
            mark(uses.vertex_views, memberOf(accessors[i], "bufferView"));
        }
    }
    return uses;
}

/// Whether elements lie one after the other although their view has a stride. A stride is for vertices (glTF 2.0,
/// 3.6.2.1). With other data in one view it is not theirs where it leads out of the view, and of indices never: no API
/// takes indices with a stride.
bool ignoresStride(const Uses& uses, std::size_t index, const Accessor& accessor, bool fits)
{
    return !uses.vertices[index] && (!fits || (uses.indices[index] && uses.vertex_views[accessor.view]));
}

/// Where the data of an accessor lie within its view.
void attachData(const Document& document, const JsonView& view, const Uses& uses, Accessor& accessor)
{
    const std::optional<JsonView> offset_view = view.find("byteOffset");
    const std::uint64_t offset = offset_view ? offset_view->uint() : 0;
    const JsonView where = offset_view.value_or(view);
    const std::uint64_t component_bytes = sizeOf(accessor.component);
    const bool matrix = accessor.components > accessor.rows;
    if (offset % component_bytes != 0) {
        where.fail("the offset must be a multiple of the component's " + std::to_string(component_bytes) + " bytes");
    }
    if (matrix && offset % 4 != 0) {
        where.fail("the offset of a matrix accessor must be a multiple of 4");
    }
    const std::uint64_t element_bytes = std::uint64_t{accessor.components / accessor.rows} * accessor.column_bytes;
    accessor.stride = element_bytes;
    accessor.view = view.index("bufferView", document.views.size());
    if (accessor.view == kNone) {
        if (offset_view) {
            where.fail("byteOffset needs a bufferView");
        }
        return;
    }
    const BufferView& data = document.views[accessor.view];
    if ((data.offset + offset) % component_bytes != 0) {
        view.failFound("the offsets of buffer view and accessor must add up to a multiple of the component's " +
                           std::to_string(component_bytes) + " bytes",
                       std::to_string(data.offset) + " + " + std::to_string(offset));
    }
    if (data.stride != 0) {
        if (data.stride < element_bytes) {
            view.failFound("the buffer view's byteStride is smaller than an element of " +
                               std::to_string(element_bytes) + " bytes",
                           std::to_string(data.stride));
        }
        accessor.stride = data.stride;
    }
    // count < 2^32 and stride <= 252, so the product cannot wrap; the offset is at most 2^53.
    const auto spanOf = [&] {
        return (accessor.count - 1ULL) * accessor.stride + accessor.lastBytes();
    };
    const bool fits = offset <= data.length && spanOf() <= data.length - offset;
    if (ignoresStride(uses, document.accessors.size(), accessor, fits)) {
        accessor.stride = element_bytes;
    }
    const std::uint64_t span = spanOf();
    if (offset > data.length || span > data.length - offset) {
        where.failFound("the accessor does not fit its buffer view of " + std::to_string(data.length) + " bytes",
                        "offset " + std::to_string(offset) + ", length " + std::to_string(span));
    }
    if (data.has_content) {
        accessor.bytes = data.bytes.subspan(offset, span);
    }
}

/// Tightly packed data of `bytes` bytes in the view that `object` names.
std::span<const std::byte> packedData(const Document& document, const JsonView& object, std::uint64_t bytes,
                                      std::uint64_t alignment)
{
    const BufferView& data = document.views[object.at("bufferView").index(document.views.size())];
    const std::uint64_t offset = object.uint("byteOffset", 0);
    if (data.stride != 0 || data.use != ViewUse::none) {
        object.context().notice("sparse data lie in a buffer view with target or byteStride, as at " +
                                object.pointer() + "; they are taken as packed");
    }
    if ((data.offset + offset) % alignment != 0) {
        object.failFound("the data must start at a multiple of " + std::to_string(alignment) + " bytes",
                         std::to_string(data.offset + offset));
    }
    if (offset > data.length || bytes > data.length - offset) {
        object.failFound("the data do not fit their buffer view of " + std::to_string(data.length) + " bytes",
                         "offset " + std::to_string(offset) + ", length " + std::to_string(bytes));
    }
    return data.has_content ? data.bytes.subspan(offset, bytes) : std::span<const std::byte>{};
}

std::uint32_t sparseIndex(const Sparse& sparse, std::size_t i)
{
    std::uint32_t value = 0; // little endian, as every machine that this runs on
    const std::size_t bytes = sizeOf(sparse.index_component);
    std::memcpy(&value, sparse.indices.data() + i * bytes, bytes);
    return value;
}

void attachSparse(const Document& document, const JsonView& view, Accessor& accessor)
{
    Sparse& sparse = accessor.sparse;
    const JsonView count = view.at("count");
    sparse.count = static_cast<std::uint32_t>(count.uint(1, UINT32_MAX));
    if (sparse.count > accessor.count) {
        count.fail("a sparse count must not be larger than the accessor's count " + std::to_string(accessor.count));
    }
    const JsonView indices = view.at("indices");
    const JsonView component = indices.at("componentType");
    sparse.index_component = readComponent(component);
    if (sparse.index_component != Component::u8 && sparse.index_component != Component::u16 &&
        sparse.index_component != Component::u32) {
        component.fail("sparse indices must be 5121, 5123 or 5125");
    }
    const std::uint64_t index_bytes = sizeOf(sparse.index_component);
    const std::uint64_t element_bytes = std::uint64_t{accessor.components / accessor.rows} * accessor.column_bytes;
    sparse.indices = packedData(document, indices, sparse.count * index_bytes, index_bytes);
    sparse.values =
        packedData(document, view.at("values"), (sparse.count - 1ULL) * element_bytes + accessor.lastBytes(),
                   sizeOf(accessor.component));
    if (sparse.indices.empty()) {
        sparse.values = {};
        return;
    }
    document.context().chargeChecks(sparse.count, view.pointer());
    for (std::size_t i = 0; i < sparse.count; ++i) {
        const std::uint32_t index = sparseIndex(sparse, i);
        if (index >= accessor.count) {
            indices.failFound("a sparse index is out of range: the accessor has " + std::to_string(accessor.count) +
                                  " elements",
                              std::to_string(index));
        }
        if (i > 0 && index <= sparseIndex(sparse, i - 1)) {
            indices.failFound("sparse indices must increase",
                              std::to_string(sparseIndex(sparse, i - 1)) + ", then " + std::to_string(index));
        }
    }
}

/// Declared bounds serve readers that do not read the data; exporters round them. The data count.
void checkBounds(const JsonView& view, const Accessor& accessor)
{
    const std::vector<ComponentRange> ranges =
        accessor.hasContent() ? requireFinite(view, accessor) : std::vector<ComponentRange>{};
    bool differ = false;
    for (const char* key : {"min", "max"}) {
        const std::optional<JsonView> bound = view.find(key);
        if (bound && bound->size() != accessor.components) {
            bound->fail("one number per component is needed, " + std::to_string(accessor.components));
        }
        for (std::uint32_t c = 0; bound && c < accessor.components; ++c) {
            const float declared = bound->element(c).number();
            if (!ranges.empty()) { // compared as floats, for JSON has more digits than the data
                const double found = key[1] == 'i' ? ranges[c].low : ranges[c].high;
                differ = differ || static_cast<float>(found) != declared;
            }
        }
    }
    if (differ) {
        view.context().notice("declared bounds of " + view.pointer() + " differ from its data, which count");
    }
}

Accessor readAccessor(const Document& document, const JsonView& view, const Uses& uses)
{
    checkExtensions(view, Place::other);
    Accessor accessor;
    accessor.pointer = view.pointer();
    accessor.component = readComponent(view.at("componentType"));
    accessor.count = static_cast<std::uint32_t>(view.at("count").uint(1, UINT32_MAX));
    readShape(view, accessor);
    accessor.normalized = view.boolean("normalized", false);
    if (accessor.normalized && (accessor.component == Component::f32 || accessor.component == Component::u32)) {
        view.at("normalized").fail("only BYTE and SHORT components can be normalized");
    }
    attachData(document, view, uses, accessor);
    if (const std::optional<JsonView> sparse = view.find("sparse")) {
        attachSparse(document, *sparse, accessor);
    }
    checkBounds(view, accessor);
    return accessor;
}

} // namespace

std::vector<ComponentRange> requireFinite(const JsonView& view, const Accessor& accessor)
{
    std::vector<ComponentRange> ranges = measureComponents(view.context(), accessor);
    for (const ComponentRange& range : ranges) {
        if (range.not_finite != kNone) {
            view.failFound("the accessor's data must be finite",
                           "NaN or infinity in element " + std::to_string(range.not_finite));
        }
    }
    return ranges;
}

void readAccessors(Document& document)
{
    const std::size_t count = topLevelCount(document, "accessors");
    document.accessors.reserve(count);
    const Uses uses = findUses(document);
    for (std::size_t i = 0; i < count; ++i) {
        document.accessors.push_back(readAccessor(document, document.root.at("accessors").element(i), uses));
    }
}

} // namespace gnomon::scene::gltf
