// SPDX-License-Identifier: Apache-2.0
#include "compressed.h"

#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <glm/geometric.hpp>
#include <meshoptimizer.h>

#include <array>
#include <cmath>

namespace gnomon::scene::test {

namespace {

constexpr float kSide = 8.0F;

float heightAt(float x, float z)
{
    return x * x / 16.0F + z / 4.0F;
}

template <typename T>
std::vector<std::byte> bytesOf(const std::vector<T>& values)
{
    std::vector<std::byte> out(values.size() * sizeof(T));
    std::memcpy(out.data(), values.data(), out.size());
    return out;
}

/// Adds views that meshoptimizer has compressed to a file with a fallback buffer.
class MeshoptViews {
public:
    MeshoptViews(FileBuilder& file, const char* extension) : file_(file), extension_(extension) {}

    int addAttributes(const std::vector<std::byte>& elements, std::size_t stride, const char* filter)
    {
        const std::size_t count = elements.size() / stride;
        std::vector<unsigned char> packed(meshopt_encodeVertexBufferBound(count, stride));
        packed.resize(meshopt_encodeVertexBuffer(packed.data(), packed.size(), elements.data(), count, stride));
        return add(packed, count, stride, "ATTRIBUTES", filter);
    }

    int addIndices(const std::vector<std::uint32_t>& indices, std::size_t vertices, const std::string& mode, bool wide)
    {
        std::vector<unsigned char> packed;
        if (mode == "TRIANGLES") {
            packed.resize(meshopt_encodeIndexBufferBound(indices.size(), vertices));
            packed.resize(meshopt_encodeIndexBuffer(packed.data(), packed.size(), indices.data(), indices.size()));
        } else {
            packed.resize(meshopt_encodeIndexSequenceBound(indices.size(), vertices));
            packed.resize(meshopt_encodeIndexSequence(packed.data(), packed.size(), indices.data(), indices.size()));
        }
        return add(packed, indices.size(), wide ? 4 : 2, mode.c_str(), "NONE");
    }

    [[nodiscard]] std::size_t unpackedBytes() const { return unpacked_bytes_; }

private:
    int add(const std::vector<unsigned char>& packed, std::size_t count, std::size_t stride, const char* mode,
            const char* filter)
    {
        const int view = file_.addView(packed);
        json& added = file_.root["bufferViews"].back();
        json compression = {{"buffer", 0},
                            {"byteOffset", added["byteOffset"]},
                            {"byteLength", packed.size()},
                            {"byteStride", stride},
                            {"count", count},
                            {"mode", mode}};
        if (std::string(filter) != "NONE") {
            compression["filter"] = filter;
        }
        added = {{"buffer", 1},
                 {"byteOffset", unpacked_bytes_},
                 {"byteLength", count * stride},
                 {"extensions", {{extension_, compression}}}};
        if (std::string(mode) == "ATTRIBUTES" && std::string(filter) != "QUATERNION" && stride != sizeof(float)) {
            added["byteStride"] = stride;
        }
        unpacked_bytes_ += (count * stride + 3) / 4 * 4;
        return view;
    }

    FileBuilder& file_;
    const char* extension_;
    std::size_t unpacked_bytes_ = 0;
};

int addAccessor(FileBuilder& file, int view, const char* type, int component, std::size_t count,
                bool normalized = false)
{
    return file.addAccessor({{"bufferView", view},
                             {"type", type},
                             {"componentType", component},
                             {"count", count},
                             {"normalized", normalized}});
}

void addTurn(FileBuilder& file, MeshoptViews& views)
{
    const float half = std::sqrt(0.5F);
    const std::vector<float> turns{0, 0, 0, 1, half, 0, 0, half};
    std::vector<std::byte> packed(16);
    meshopt_encodeFilterQuat(packed.data(), 2, 8, 12, turns.data());
    const int times = views.addAttributes(bytesOf(std::vector<float>{0, 1}), 4, "NONE");
    const int rotations = views.addAttributes(packed, 8, "QUATERNION");
    json animation;
    animation["samplers"] = json::array({{{"input", addAccessor(file, times, "SCALAR", 5126, 2)},
                                          {"output", addAccessor(file, rotations, "VEC4", 5122, 2, true)}}});
    animation["channels"] = json::array({{{"sampler", 0}, {"target", {{"node", 0}, {"path", "rotation"}}}}});
    file.root["animations"].push_back(animation);
}

} // namespace

glm::vec3 Hill::normalAt(const glm::vec3& point) const
{
    return glm::normalize(glm::vec3(-point.x / 8.0F, 1.0F, -0.25F));
}

Hill makeHill(std::uint32_t side)
{
    Hill hill;
    for (std::uint32_t z = 0; z < side; ++z) {
        for (std::uint32_t x = 0; x < side; ++x) {
            const glm::vec2 at = std::round(64.0F * kSide / static_cast<float>(side - 1)) / 64.0F * glm::vec2(x, z);
            hill.positions.emplace_back(at.x, std::round(64.0F * heightAt(at.x, at.y)) / 64.0F, at.y);
        }
    }
    for (std::uint32_t z = 0; z + 1 < side; ++z) {
        for (std::uint32_t x = 0; x + 1 < side; ++x) {
            const std::uint32_t a = z * side + x;
            hill.indices.insert(hill.indices.end(), {a, a + side, a + 1, a + 1, a + side, a + side + 1});
        }
    }
    return hill;
}

std::vector<std::byte> encodeDraco(const Hill& hill, bool sequential)
{
    draco::TriangleSoupMeshBuilder builder;
    builder.Start(static_cast<int>(hill.indices.size() / 3));
    const int ids[] = {builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32),
                       builder.AddAttribute(draco::GeometryAttribute::NORMAL, 3, draco::DT_FLOAT32),
                       builder.AddAttribute(draco::GeometryAttribute::TEX_COORD, 2, draco::DT_FLOAT32),
                       builder.AddAttribute(draco::GeometryAttribute::GENERIC, 4, draco::DT_UINT16),
                       builder.AddAttribute(draco::GeometryAttribute::GENERIC, 4, draco::DT_FLOAT32),
                       builder.AddAttribute(draco::GeometryAttribute::COLOR, 4, draco::DT_UINT8, true)};
    struct Corner {
        glm::vec3 position;
        glm::vec3 normal;
        glm::vec2 uv;
        std::array<std::uint16_t, 4> joints;
        glm::vec4 weights;
        std::array<std::uint8_t, 4> colour;
    };
    for (std::size_t face = 0; face < hill.indices.size() / 3; ++face) {
        std::array<Corner, 3> c{};
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::vec3 p = hill.positions[hill.indices[face * 3 + k]];
            c[k] = {p,
                    hill.normalAt(p),
                    glm::vec2(p.x, p.z) / kSide,
                    {0, static_cast<std::uint16_t>(std::lround(p.x)), 0, 0},
                    {0.5F, 0.5F, 0.0F, 0.0F},
                    {255, 255, 255, static_cast<std::uint8_t>(std::lround(p.z / kSide * 255.0F))}};
        }
        const draco::FaceIndex index(static_cast<std::uint32_t>(face));
        const auto set = [&](int id, auto member) {
            builder.SetAttributeValuesForFace(id, index, &(c[0].*member), &(c[1].*member), &(c[2].*member));
        };
        set(ids[0], &Corner::position);
        set(ids[1], &Corner::normal);
        set(ids[2], &Corner::uv);
        set(ids[3], &Corner::joints);
        set(ids[4], &Corner::weights);
        set(ids[5], &Corner::colour);
    }
    draco::Encoder encoder;
    encoder.SetEncodingMethod(sequential ? draco::MESH_SEQUENTIAL_ENCODING : draco::MESH_EDGEBREAKER_ENCODING);
    encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, 14);
    encoder.SetAttributeQuantization(draco::GeometryAttribute::NORMAL, 12);
    encoder.SetAttributeQuantization(draco::GeometryAttribute::TEX_COORD, 12);
    draco::EncoderBuffer buffer;
    EXPECT_TRUE(encoder.EncodeMeshToBuffer(*builder.Finalize(), &buffer).ok());
    return toBytes({buffer.data(), buffer.size()});
}

FileBuilder dracoFile(const Hill& hill, bool sequential)
{
    FileBuilder file;
    const int view = file.addView(encodeDraco(hill, sequential));
    struct Attribute {
        const char* name;
        const char* type;
        int component;
    };
    constexpr Attribute kAttributes[] = {{"POSITION", "VEC3", 5126},   {"NORMAL", "VEC3", 5126},
                                         {"TEXCOORD_0", "VEC2", 5126}, {"JOINTS_0", "VEC4", 5123},
                                         {"WEIGHTS_0", "VEC4", 5126},  {"COLOR_0", "VEC4", 5121}};
    json primitive;
    json& compression = primitive["extensions"]["KHR_draco_mesh_compression"];
    compression["bufferView"] = view;
    int id = 0;
    for (const Attribute& attribute : kAttributes) {
        json accessor = {
            {"type", attribute.type}, {"componentType", attribute.component}, {"count", hill.positions.size()}};
        if (attribute.component == 5121) {
            accessor["normalized"] = true;
        }
        primitive["attributes"][attribute.name] = file.addAccessor(accessor);
        compression["attributes"][attribute.name] = id++;
    }
    file.addMesh(primitive);
    return file;
}

FileBuilder meshoptFile(const Hill& hill, const char* mode, bool wide_indices, const char* extension)
{
    FileBuilder file;
    MeshoptViews views(file, extension);
    const std::size_t count = hill.positions.size();
    std::vector<glm::vec4> normals;
    std::vector<glm::vec2> uvs;
    for (const glm::vec3& p : hill.positions) {
        normals.emplace_back(hill.normalAt(p), 0.0F);
        uvs.push_back(glm::vec2(p.x, p.z) / kSide);
    }
    std::vector<std::byte> octahedral(count * 4);
    meshopt_encodeFilterOct(octahedral.data(), count, 4, 8, &normals[0].x);
    std::vector<std::byte> exponential(count * 8);
    meshopt_encodeFilterExp(exponential.data(), count, 8, 20, &uvs[0].x);
    json primitive;
    primitive["attributes"]["POSITION"] =
        addAccessor(file, views.addAttributes(bytesOf(hill.positions), 12, "NONE"), "VEC3", 5126, count);
    primitive["attributes"]["NORMAL"] =
        addAccessor(file, views.addAttributes(octahedral, 4, "OCTAHEDRAL"), "VEC3", 5120, count, true);
    file.root["bufferViews"].back()["byteStride"] = 4;
    primitive["attributes"]["TEXCOORD_0"] =
        addAccessor(file, views.addAttributes(exponential, 8, "EXPONENTIAL"), "VEC2", 5126, count);
    primitive["indices"] = addAccessor(file, views.addIndices(hill.indices, count, mode, wide_indices), "SCALAR",
                                       wide_indices ? 5125 : 5123, hill.indices.size());
    file.addMesh(primitive);
    addTurn(file, views);
    file.root["extensionsUsed"] = {extension, "KHR_mesh_quantization"};
    json fallback = {{"byteLength", views.unpackedBytes()}};
    fallback["extensions"][extension]["fallback"] = true;
    file.root["buffers"] = json::array(
        {{{"byteLength", file.data.size()}, {"uri", "data:application/octet-stream;base64," + base64(file.data)}},
         fallback});
    return file;
}

} // namespace gnomon::scene::test
