// SPDX-License-Identifier: Apache-2.0
#include "geometry.h"

#include <gnomon/error.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace gnomon::host {
namespace {

constexpr std::size_t kChunk = 65536; // vertices packed at once

template <typename T>
T snorm(float value)
{
    constexpr float kMax = static_cast<float>(std::numeric_limits<T>::max());
    return static_cast<T>(std::lround(glm::clamp(value, -1.0F, 1.0F) * kMax));
}

std::uint16_t unorm(float value)
{
    return static_cast<std::uint16_t>(std::lround(glm::clamp(value, 0.0F, 1.0F) * 65535.0F));
}

std::uint32_t baseUvSet(const scene::Scene& scene, const scene::Primitive& primitive)
{
    return primitive.material == scene::kNone ? 0 : scene.materials[primitive.material].base_colour_texture.uv_set;
}

/// `more`: kCreasedVertex and the vertex's piece.
void packDirections(const glm::vec3& normal, std::int16_t more, const glm::vec4* tangent, VertexAttributes& out)
{
    out.normal = {snorm<std::int16_t>(normal.x), snorm<std::int16_t>(normal.y), snorm<std::int16_t>(normal.z), more};
    out.tangent = {};
    if (tangent != nullptr) {
        out.tangent = {snorm<std::int8_t>(tangent->x), snorm<std::int8_t>(tangent->y), snorm<std::int8_t>(tangent->z),
                       snorm<std::int8_t>(tangent->w < 0.0F ? -1.0F : 1.0F)};
    }
}

std::int16_t moreOf(const scene::Primitive& primitive, const scene::Pieces& pieces, std::size_t i)
{
    const int more = (primitive.creased[i] != 0 ? int{kCreasedVertex} : 0) + int{pieces.of_vertex[i]};
    return static_cast<std::int16_t>(more);
}

void packConstant(const scene::Primitive& primitive, std::uint32_t base_set, std::size_t i, VertexAttributes& out)
{
    const std::vector<glm::vec2>& other = base_set == 0 ? primitive.uv1 : primitive.uv0;
    out.uv_other = other.empty() ? glm::vec2{0.0F} : other[i];
    const glm::vec4 c = primitive.colours.empty() ? glm::vec4(1.0F) : primitive.colours[i];
    out.colour = {unorm(c.x), unorm(c.y), unorm(c.z), unorm(c.w)};
}

// smooth_surface.h takes normals for flat below four times this. Transforms may stretch a mesh: one that an uneven
// scale makes lean four times as much has no smooth terminator, unless another mesh is smooth.
constexpr float kLeaning = 0.001F;

// Does a normal of a triangle without a creased vertex lean away from the triangle's own?
bool leans(const scene::Primitive& primitive, const std::uint32_t* v)
{
    const glm::vec3 first = primitive.positions[v[0]];
    const glm::vec3 across = glm::cross(primitive.positions[v[1]] - first, primitive.positions[v[2]] - first);
    const float length = glm::length(across);
    return std::all_of(v, v + 3, [&](std::uint32_t i) { return primitive.creased[i] == 0; }) &&
           std::any_of(v, v + 3, [&](std::uint32_t i) {
               const glm::vec3& normal = primitive.normals[i];
               const float side = glm::dot(across, normal) < 0.0F ? -1.0F : 1.0F;
               return !(glm::length(normal * length - across * side) <= kLeaning * length);
           });
}

bool anyLeans(const scene::Primitive& primitive)
{
    for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
        if (leans(primitive, &primitive.indices[i])) {
            return true;
        }
    }
    return false;
}

} // namespace

Geometry::Geometry(Memory& memory, Uploader& uploader, const scene::Scene& scene, const scene::State& state)
{
    place(scene, state);
    const VkDeviceSize vertices = VkDeviceSize{static_vertices_} + deformed_vertices_;
    constexpr VkBufferUsageFlags kVertex = VK_BUFFER_USAGE_VERTEX_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    // Shadow volumes pull them.
    positions = memory.buffer("scene positions", vertices * sizeof(glm::vec3),
                              kVertex | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, Place::device);
    uvs = memory.buffer("scene texture coordinates", vertices * sizeof(glm::vec2), kVertex, Place::device);
    attributes = memory.buffer("scene attributes", vertices * sizeof(VertexAttributes), kVertex, Place::device);
    indices = memory.buffer("scene indices", VkDeviceSize{index_total_} * 4,
                            VK_BUFFER_USAGE_INDEX_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT, Place::device);
    upload(uploader, scene, state);
}

void Geometry::place(const scene::Scene& scene, const scene::State& state)
{
    for (const scene::Mesh& mesh : scene.meshes) {
        first_primitive_.push_back(static_cast<std::uint32_t>(ranges_.size()));
        ranges_.resize(ranges_.size() + mesh.primitives.size());
    }
    deformed_first_.resize(state.deformed.size());
    std::vector<bool> drawn(ranges_.size(), false);
    for (const scene::Object& object : state.objects) {
        const std::uint32_t which = first_primitive_[object.mesh] + object.primitive;
        drawn[which] = true;
        ranges_[which].used = ranges_[which].used || object.deformed == scene::kNone;
    }
    std::uint64_t vertices = 0;
    std::uint64_t index_total = 0;
    for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
        for (std::size_t p = 0; p < scene.meshes[m].primitives.size(); ++p) {
            const scene::Primitive& primitive = scene.meshes[m].primitives[p];
            const std::size_t which = first_primitive_[m] + p;
            index_counts_.push_back(static_cast<std::uint32_t>(primitive.indices.size()));
            ranges_[which].first_index = static_cast<std::uint32_t>(index_total);
            index_total += drawn[which] ? primitive.indices.size() : 0;
            ranges_[which].first_vertex = static_cast<std::uint32_t>(vertices);
            vertices += ranges_[which].used ? primitive.positions.size() : 0;
        }
    }
    static_vertices_ = static_cast<std::uint32_t>(vertices);
    for (const scene::Object& object : state.objects) {
        if (object.deformed != scene::kNone) {
            deformed_first_[object.deformed] = deformed_vertices_;
            const std::size_t count = scene.meshes[object.mesh].primitives[object.primitive].positions.size();
            deformed_vertices_ += static_cast<std::uint32_t>(count);
            vertices += count;
        }
    }
    if (vertices > 0x7FFFFFFFULL || index_total > 0xFFFFFFFFULL) {
        throw Error("uploading the scene", std::to_string(vertices) + " vertices are more than 31 bits can count");
    }
    index_total_ = static_cast<std::uint32_t>(index_total);
    std::size_t which = 0;
    pieces_.resize(ranges_.size());
    for (const scene::Mesh& mesh : scene.meshes) {
        for (const scene::Primitive& primitive : mesh.primitives) {
            index_counts_[which] = drawn[which] ? index_counts_[which] : 0;
            if (drawn[which]) {
                pieces_[which] = scene::piecesOf(primitive);
                ranges_[which].smooth = anyLeans(primitive);
            }
            ++which;
        }
    }
}

void Geometry::uploadRigid(Uploader& uploader, const scene::Primitive& primitive, const scene::Pieces& pieces,
                           const scene::Scene& scene, std::uint32_t first_vertex) const
{
    const std::uint32_t base_set = baseUvSet(scene, primitive);
    std::vector<VertexAttributes> packed;
    for (std::size_t first = 0; first < primitive.positions.size(); first += kChunk) {
        packed.resize(std::min(kChunk, primitive.positions.size() - first));
        for (std::size_t i = 0; i < packed.size(); ++i) {
            packConstant(primitive, base_set, first + i, packed[i]);
            packDirections(primitive.normals[first + i], moreOf(primitive, pieces, first + i),
                           primitive.tangents.empty() ? nullptr : &primitive.tangents[first + i], packed[i]);
        }
        uploader.toBuffer(attributes, (first_vertex + first) * sizeof(VertexAttributes), packed.data(),
                          packed.size() * sizeof(VertexAttributes));
    }
    uploader.toBuffer(positions, VkDeviceSize{first_vertex} * sizeof(glm::vec3), primitive.positions.data(),
                      primitive.positions.size() * sizeof(glm::vec3));
}

void Geometry::upload(Uploader& uploader, const scene::Scene& scene, const scene::State& state)
{
    const auto upload_uvs = [&](const scene::Primitive& primitive, std::uint32_t first_vertex) {
        const std::vector<glm::vec2>& set = baseUvSet(scene, primitive) == 0 ? primitive.uv0 : primitive.uv1;
        const std::vector<glm::vec2> none(set.empty() ? primitive.positions.size() : 0, glm::vec2{0.0F});
        uploader.toBuffer(uvs, VkDeviceSize{first_vertex} * sizeof(glm::vec2), set.empty() ? none.data() : set.data(),
                          primitive.positions.size() * sizeof(glm::vec2));
    };
    std::size_t which = 0;
    for (const scene::Mesh& mesh : scene.meshes) {
        for (const scene::Primitive& primitive : mesh.primitives) {
            const Range& range = ranges_[which];
            uploader.toBuffer(indices, VkDeviceSize{range.first_index} * 4, primitive.indices.data(),
                              VkDeviceSize{index_counts_[which]} * 4);
            if (range.used) {
                uploadRigid(uploader, primitive, pieces_[which], scene, range.first_vertex);
                upload_uvs(primitive, range.first_vertex);
            }
            ++which;
        }
    }
    for (const scene::Object& object : state.objects) {
        if (object.deformed != scene::kNone) {
            upload_uvs(scene.meshes[object.mesh].primitives[object.primitive],
                       static_vertices_ + deformed_first_[object.deformed]);
        }
    }
}

std::uint16_t Geometry::pieces(const scene::Object& object) const
{
    return static_cast<std::uint16_t>(pieces_[first_primitive_[object.mesh] + object.primitive].count);
}

bool Geometry::isSmooth(const scene::Object& object) const
{
    return object.deformed != scene::kNone || ranges_[first_primitive_[object.mesh] + object.primitive].smooth;
}

vulkan::MeshRange Geometry::range(const scene::Object& object) const
{
    const std::uint32_t which = first_primitive_[object.mesh] + object.primitive;
    const std::uint32_t vertex = object.deformed == scene::kNone ? ranges_[which].first_vertex
                                                                 : static_vertices_ + deformed_first_[object.deformed];
    return {ranges_[which].first_index, index_counts_[which], static_cast<std::int32_t>(vertex)};
}

Buffer Geometry::makeStaging(Memory& memory) const
{
    return memory.buffer("scene deformed vertices",
                         VkDeviceSize{deformed_vertices_} * (sizeof(glm::vec3) + sizeof(VertexAttributes)),
                         VK_BUFFER_USAGE_TRANSFER_SRC_BIT, Place::host);
}

// Positions, then attributes.
void Geometry::writeDeformed(const scene::Scene& scene, const scene::State& state, const Buffer& staging) const
{
    auto* const all_positions = static_cast<glm::vec3*>(staging.mapped);
    auto* const all_attributes = reinterpret_cast<VertexAttributes*>(all_positions + deformed_vertices_);
    for (std::size_t d = 0; d < state.deformed.size(); ++d) {
        const scene::DeformedPrimitive& now = state.deformed[d];
        const scene::Object& object = state.objects[now.object];
        const scene::Primitive& primitive = scene.meshes[object.mesh].primitives[object.primitive];
        const scene::Pieces& pieces = pieces_[first_primitive_[object.mesh] + object.primitive];
        const std::uint32_t base_set = baseUvSet(scene, primitive);
        std::memcpy(all_positions + deformed_first_[d], now.positions.data(), now.positions.size() * sizeof(glm::vec3));
        for (std::size_t i = 0; i < now.positions.size(); ++i) {
            VertexAttributes packed;
            packConstant(primitive, base_set, i, packed);
            packDirections(now.normals[i], moreOf(primitive, pieces, i),
                           now.tangents.empty() ? nullptr : &now.tangents[i], packed);
            all_attributes[deformed_first_[d] + i] = packed;
        }
    }
}

void Geometry::recordDeformed(VkCommandBuffer commands, const Buffer& staging) const
{
    const Access read{VK_PIPELINE_STAGE_2_VERTEX_ATTRIBUTE_INPUT_BIT | VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT,
                      VK_ACCESS_2_VERTEX_ATTRIBUTE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_READ_BIT};
    memoryBarrier(commands, read, kCopyTarget); // frames before this one may still read them
    const VkDeviceSize position_bytes = VkDeviceSize{deformed_vertices_} * sizeof(glm::vec3);
    const VkDeviceSize attribute_bytes = VkDeviceSize{deformed_vertices_} * sizeof(VertexAttributes);
    const VkBufferCopy to_positions{0, VkDeviceSize{static_vertices_} * sizeof(glm::vec3), position_bytes};
    const VkBufferCopy to_attributes{position_bytes, VkDeviceSize{static_vertices_} * sizeof(VertexAttributes),
                                     attribute_bytes};
    vkCmdCopyBuffer(commands, staging.handle, positions.handle, 1, &to_positions);
    vkCmdCopyBuffer(commands, staging.handle, attributes.handle, 1, &to_attributes);
    memoryBarrier(commands, kCopyTarget, read);
}

} // namespace gnomon::host
