// SPDX-License-Identifier: Apache-2.0
// Based on: Khronos Group, "KHR_draco_mesh_compression", 2017, and "Draco Bitstream Specification" 2.2. The library
// allocates what a stream asks for; its two decoders of meshes are derived from here, to charge that before they do.
#include "gltf/draco.h"

#include <draco/compression/mesh/mesh_edgebreaker_decoder.h>
#include <draco/compression/mesh/mesh_sequential_decoder.h>
#include <draco/core/varint_decoding.h>

#include <cstring>
#include <exception>

namespace gnomon::scene::gltf {

namespace {

/// Memory that tables of the library take at most.
constexpr std::uint64_t kBytesOfFace = 64;
constexpr std::uint64_t kBytesOfSeam = 32;     // a face once more, for attributes that part along other edges
constexpr std::uint64_t kBytesOfComponent = 8; // quantised, beside the value itself
constexpr std::uint64_t kBytesOfPoint = 8;     // an attribute's table of values

/// Counts that a stream begins with: `points` of the sequential method, `seams` of the other.
struct Counts {
    std::uint32_t faces = 0;
    std::uint32_t points = 0;
    std::uint8_t seams = 0;
};

bool readCounts(draco::DecoderBuffer ahead, draco::MeshEncoderMethod method, Counts& counts)
{
    if (method == draco::MESH_SEQUENTIAL_ENCODING) {
        return draco::DecodeVarint(&counts.faces, &ahead) && draco::DecodeVarint(&counts.points, &ahead);
    }
    std::uint32_t vertices = 0;
    return draco::DecodeVarint(&vertices, &ahead) && draco::DecodeVarint(&counts.faces, &ahead) &&
           ahead.Decode(&counts.seams) && vertices / 3 <= counts.faces;
}

/// A decoder of the library that asks the context before it allocates. An exception of the context is
/// kept until the library has returned.
template <typename Base, draco::MeshEncoderMethod kMethod>
class Bounded : public Base {
public:
    Bounded(Context& context, std::string pointer) : context_(context), pointer_(std::move(pointer)) {}

    void rethrow() const
    {
        if (thrown_) {
            std::rethrow_exception(thrown_);
        }
    }

protected:
    bool DecodeConnectivity() override
    {
        Counts counts;
        return readCounts(*this->buffer(), kMethod, counts) && charge([&] {
                   context_.chargeVertices(std::uint64_t{counts.faces} * 3 + counts.points, pointer_);
                   context_.chargeBytes(std::uint64_t{counts.faces} * (kBytesOfFace + counts.seams * kBytesOfSeam),
                                        pointer_);
               }) &&
               Base::DecodeConnectivity();
    }

    bool DecodeAllAttributes() override
    {
        return charge([&] {
                   const draco::PointCloud& cloud = *this->point_cloud();
                   for (std::int32_t i = 0; i < cloud.num_attributes(); ++i) {
                       const draco::PointAttribute& attribute = *cloud.attribute(i);
                       const auto components = static_cast<std::uint64_t>(attribute.num_components());
                       const auto stride = static_cast<std::uint64_t>(attribute.byte_stride());
                       context_.chargeBytes(std::uint64_t{cloud.num_points()} *
                                                (stride + components * kBytesOfComponent + kBytesOfPoint),
                                            pointer_);
                   }
               }) &&
               Base::DecodeAllAttributes();
    }

private:
    template <typename Charges>
    bool charge(const Charges& charges)
    {
        try {
            charges();
            return true;
        } catch (...) {
            thrown_ = std::current_exception();
            return false;
        }
    }

    Context& context_;
    std::string pointer_;
    std::exception_ptr thrown_;
};

template <typename Base, draco::MeshEncoderMethod kMethod>
void decodeBy(const JsonView& where, draco::DecoderBuffer& buffer, draco::Mesh& mesh)
{
    Bounded<Base, kMethod> decoder(where.context(), where.pointer());
    const draco::DecoderOptions options;
    const draco::Status status = decoder.Decode(options, &buffer, &mesh);
    decoder.rethrow();
    if (!status.ok()) {
        where.failFound("the Draco data are invalid", status.error_msg_string());
    }
}

void decode(const JsonView& where, std::span<const std::byte> bytes, draco::Mesh& mesh)
{
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    draco::DracoHeader header{};
    draco::DecoderBuffer ahead = buffer;
    if (!draco::PointCloudDecoder::DecodeHeader(&ahead, &header).ok() ||
        header.encoder_type != draco::TRIANGULAR_MESH) {
        where.fail("the data are no Draco mesh");
    }
    if (header.version_major != 2 || header.version_minor != 2) {
        where.failFound("the Draco data must be of version 2.2",
                        std::to_string(header.version_major) + "." + std::to_string(header.version_minor));
    }
    if (header.encoder_method == draco::MESH_SEQUENTIAL_ENCODING) {
        decodeBy<draco::MeshSequentialDecoder, draco::MESH_SEQUENTIAL_ENCODING>(where, buffer, mesh);
    } else if (header.encoder_method == draco::MESH_EDGEBREAKER_ENCODING) {
        decodeBy<draco::MeshEdgebreakerDecoder, draco::MESH_EDGEBREAKER_ENCODING>(where, buffer, mesh);
    } else {
        where.failFound("the Draco data are encoded by an unknown method", std::to_string(header.encoder_method));
    }
}

/// Values of all points as the accessor's component, packed; false where they cannot be had as such.
template <typename T>
bool copyValues(const draco::PointAttribute& attribute, std::uint32_t points, std::span<std::byte> out)
{
    const auto components = static_cast<std::int8_t>(attribute.num_components());
    const std::size_t element_bytes = static_cast<std::size_t>(components) * sizeof(T);
    std::array<T, 16> element{};
    for (std::uint32_t i = 0; i < points; ++i) {
        const draco::AttributeValueIndex value = attribute.mapped_index(draco::PointIndex(i));
        if (value.value() >= attribute.size() || !attribute.ConvertValue<T>(value, components, element.data())) {
            return false;
        }
        std::memcpy(out.data() + i * element_bytes, element.data(), element_bytes);
    }
    return true;
}

bool copyAs(Component component, const draco::PointAttribute& attribute, std::uint32_t points, std::span<std::byte> out)
{
    // Draco loads values of this type as `bool`, whatever their bytes are. No accessor of glTF holds any.
    if (attribute.data_type() == draco::DT_BOOL) {
        return false;
    }
    switch (component) {
    case Component::i8:
        return copyValues<std::int8_t>(attribute, points, out);
    case Component::u8:
        return copyValues<std::uint8_t>(attribute, points, out);
    case Component::i16:
        return copyValues<std::int16_t>(attribute, points, out);
    case Component::u16:
        return copyValues<std::uint16_t>(attribute, points, out);
    case Component::u32:
        return copyValues<std::uint32_t>(attribute, points, out);
    case Component::f32:
        return copyValues<float>(attribute, points, out);
    }
    return false;
}

/// Gives an accessor the values of the attribute whose number `id` says.
void attach(Document& document, const JsonView& id, std::uint32_t index, const draco::Mesh& mesh)
{
    const draco::PointAttribute* attribute =
        mesh.GetAttributeByUniqueId(static_cast<std::uint32_t>(id.uint(0, INT32_MAX)));
    if (attribute == nullptr) {
        id.fail("the Draco data have no such attribute");
    }
    Accessor& accessor = document.accessors[index];
    if (static_cast<std::uint32_t>(attribute->num_components()) != accessor.components) {
        id.failFound("the attribute must have as many components as its accessor, " +
                         std::to_string(accessor.components),
                     std::to_string(attribute->num_components()));
    }
    const std::uint32_t points = mesh.num_points();
    if (accessor.count != points) {
        document.context().notice("the count of " + accessor.pointer +
                                  " differs from that of its Draco data, which counts");
    }
    accessor.count = points;
    accessor.view = kNone;
    accessor.sparse = {};
    accessor.column_bytes = static_cast<std::uint32_t>(accessor.rows * sizeOf(accessor.component));
    accessor.stride = std::uint64_t{accessor.components} * sizeOf(accessor.component);
    document.context().chargeBytes(points * accessor.stride, id.pointer());
    std::vector<std::byte>& values = document.unpacked.emplace_back(static_cast<std::size_t>(points * accessor.stride));
    if (!copyAs(accessor.component, *attribute, points, values)) {
        id.fail("the attribute's values do not fit the component type of its accessor");
    }
    accessor.bytes = values;
    static_cast<void>(requireFinite(document.root.at("accessors").element(index), accessor));
}

} // namespace

bool isDraco(const JsonView& primitive)
{
    return extension(primitive, "KHR_draco_mesh_compression").has_value();
}

std::vector<std::uint32_t> unpackDraco(Document& document, const JsonView& primitive)
{
    const JsonView packed = primitive.at("extensions").at("KHR_draco_mesh_compression");
    const BufferView& data = document.views[packed.at("bufferView").index(document.views.size())];
    if (!data.has_content) {
        packed.fail("the buffer view with the Draco data names no data");
    }
    draco::Mesh mesh;
    decode(packed, data.bytes, mesh);
    if (mesh.num_faces() == 0 || mesh.num_points() == 0) {
        packed.fail("the Draco data hold no triangles");
    }
    const JsonView ids = packed.at("attributes");
    ids.expectObject();
    if (!ids.has("POSITION")) {
        ids.fail("the Draco data must have POSITION, which their indices are of");
    }
    const JsonView attributes = primitive.at("attributes");
    for (const auto& [name, value] : ids.value().items()) {
        if (!attributes.has(name)) {
            ids.at(name).fail("the primitive itself has no such attribute");
        }
        attach(document, ids.at(name), attributes.at(name).index(document.accessors.size()), mesh);
    }
    std::vector<std::uint32_t> indices;
    indices.reserve(mesh.num_faces() * std::size_t{3});
    for (draco::FaceIndex face(0); face < mesh.num_faces(); ++face) {
        for (const draco::PointIndex& point : mesh.face(face)) {
            if (point.value() >= mesh.num_points()) {
                packed.fail("an index of the Draco data is out of range");
            }
            indices.push_back(point.value());
        }
    }
    return indices;
}

} // namespace gnomon::scene::gltf
