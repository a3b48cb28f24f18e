// SPDX-License-Identifier: Apache-2.0
// A glTF document while it is being read. Each part (`read…`) needs the ones declared above it.
#pragma once

#include "gltf/accessor.h"
#include "gltf/decode.h"
#include "gltf/glb.h"
#include "gltf/json_view.h"

#include <array>
#include <deque>
#include <set>
#include <vector>

namespace gnomon::scene::gltf {

/// Where an extension may stand. `ignored` extensions without a line in the table may stand anywhere.
enum class Place : std::uint8_t {
    root,
    buffer,
    buffer_view,
    primitive,
    node,
    material,
    texture_info,
    texture,
    channel,
    channel_target,
    other
};

struct Document {
    JsonView root;
    Container container;
    Scene scene; // grows as parts are read

    bool quantization = false;                   // KHR_mesh_quantization is used
    std::deque<std::vector<std::byte>> unpacked; // the unpacked bytes of compressed parts
    std::vector<Buffer> buffers;
    std::vector<BufferView> views;
    std::vector<Accessor> accessors;
    std::vector<bool> images_read;      // as many as scene.images: false where nothing could be decoded
    std::vector<std::uint32_t> cameras; // glTF index -> index into scene.cameras, or kNone
    std::vector<std::uint32_t> lights;
    std::vector<std::uint64_t> vertex_counts; // per mesh, of all its primitives once they have normals
    std::vector<std::uint32_t> joint_limits;  // per mesh: 1 + the largest joint its primitives name
    std::vector<bool> meshes_skinned;         // per mesh: every primitive has joints
    std::vector<std::uint32_t> nodes;         // glTF index -> index into scene.nodes, or kNone when not in the scene

    [[nodiscard]] Context& context() const { return root.context(); }
    [[nodiscard]] const Accessor& accessor(const JsonView& reference) const
    {
        return accessors[reference.index(accessors.size())];
    }
};

/// Asset version, extensions used and required.
void readAsset(Document& document);
void readBuffers(Document& document);
void readAccessors(Document& document);
void readImages(Document& document);
void readTextures(Document& document);
void readMaterials(Document& document);
void readMeshes(Document& document);
void readCameras(Document& document);
void readLights(Document& document);
/// Reads the nodes of the shown scene, parents first; then skins, which name nodes, and joins both.
void readNodes(Document& document);
void readSkins(Document& document);
void readAnimations(Document& document);

/// Fails at `view` where the accessor has a NaN or an infinity; else returns smallest and largest value per component.
std::vector<ComponentRange> requireFinite(const JsonView& view, const Accessor& accessor);
/// Adds a notice where the view of an accessor that is not of vertices has a stride. `what` names its content in the
/// plural.
void noticeStride(const Document& document, const Accessor& accessor, const std::string& what);
/// Refuses a known extension in a place where it has no meaning.
void checkExtensions(const JsonView& object, Place place);
/// Number of entries of a top-level array; 0 when there is none.
[[nodiscard]] std::size_t topLevelCount(const Document& document, const char* key);
/// `extensions`/name of an object.
[[nodiscard]] std::optional<JsonView> extension(const JsonView& object, const char* name);

} // namespace gnomon::scene::gltf
