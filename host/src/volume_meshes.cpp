// SPDX-License-Identifier: Apache-2.0
#include "volume_meshes.h"

#include "scene/adjacency.h"

#include <glm/vec4.hpp>
#include <gnomon/shared/shadow_volume.h>

#include <array>
#include <map>

namespace gnomon::host {
namespace {

struct Elements {
    bool caps = true;
    std::vector<glm::uvec4> all; // as VolumeGeometry::elements
    std::vector<std::array<std::uint32_t, 3>> triangles;

    /// Adds one primitive.
    vulkan::VolumeMesh add(const scene::Primitive& primitive)
    {
        const scene::Adjacency adjacency = scene::adjacencyOf(primitive);
        const auto first = static_cast<std::uint32_t>(triangles.size());
        const auto first_element = static_cast<std::uint32_t>(all.size());
        triangles.insert(triangles.end(), adjacency.triangles.begin(), adjacency.triangles.end());
        for (const scene::MeshEdge& edge : adjacency.edges) {
            all.emplace_back(edge.from, edge.to, first + edge.left,
                             edge.right == scene::kNone ? shared::kNoTriangle : first + edge.right);
        }
        for (std::uint32_t t = 0; caps && t < adjacency.triangles.size(); ++t) {
            all.emplace_back(shared::kNoTriangle, 0U, first + t, 0U);
        }
        return {first_element, static_cast<std::uint32_t>(all.size()) - first_element, 0};
    }
};

Buffer upload(Memory& memory, Uploader& uploader, const char* purpose, const void* data, VkDeviceSize bytes)
{
    Buffer buffer = memory.buffer(purpose, bytes, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                                  Place::device);
    uploader.toBuffer(buffer, 0, data, bytes);
    return buffer;
}

} // namespace

VolumeMeshes::VolumeMeshes(SceneData& scene, Use use) : memory_(scene.gpu)
{
    const DrawTable& table = scene.table;
    const std::vector<std::uint8_t>& has = use == Use::fins ? table.outlined : table.closed;
    std::map<DrawTable::Source, vulkan::VolumeMesh> known;
    Elements elements;
    elements.caps = use == Use::volumes;
    for (std::size_t i = 0; i < table.objects.size(); ++i) {
        vulkan::VolumeMesh& mesh = objects_.emplace_back();
        if (has[i] == 0) {
            continue;
        }
        const DrawTable::Source source = table.sources[i];
        auto found = known.find(source);
        if (found == known.end()) {
            const scene::Primitive& primitive = scene.scene.meshes[source.mesh].primitives[source.primitive];
            found = known.emplace(source, elements.add(primitive)).first;
        }
        mesh = found->second;
        mesh.first_vertex = static_cast<std::uint32_t>(table.parts[table.objects[i].first_part].mesh.vertex_offset);
    }
    Uploader uploader(scene.gpu, memory_);
    elements_ =
        upload(memory_, uploader, "volume elements", elements.all.data(), elements.all.size() * sizeof(glm::uvec4));
    triangles_ = upload(memory_, uploader, "volume triangles", elements.triangles.data(),
                        elements.triangles.size() * 3 * sizeof(std::uint32_t));
    uploader.submit();
    uploader.wait();
}

vulkan::VolumeGeometry VolumeMeshes::geometry(const Buffer& positions) const
{
    return {
        {positions.handle, positions.size}, {elements_.handle, elements_.size}, {triangles_.handle, triangles_.size}};
}

} // namespace gnomon::host
