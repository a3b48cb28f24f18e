// SPDX-License-Identifier: Apache-2.0
// Based on: G. Fowler, L. C. Noll, K.-P. Vo, the FNV hash, 1991; over 64-bit words, because a scene has megabytes.
#include "scene_hash.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace gnomon::app {
namespace {

class Hash {
public:
    template <typename T>
    void add(const std::vector<T>& values)
    {
        static_assert(std::is_trivially_copyable_v<T>);
        addWord(values.size());
        addBytes(reinterpret_cast<const unsigned char*>(values.data()), values.size() * sizeof(T));
    }
    template <typename T>
    void addValue(const T& value)
    {
        static_assert(std::is_trivially_copyable_v<T>);
        addBytes(reinterpret_cast<const unsigned char*>(&value), sizeof(T));
    }
    [[nodiscard]] std::uint64_t value() const { return value_; }

private:
    void addWord(std::uint64_t word)
    {
        value_ = (value_ ^ word) * 0x100000001B3ULL;
        value_ ^= value_ >> 32U; // a word's high bytes would otherwise never reach the low ones
    }
    void addBytes(const unsigned char* bytes, std::size_t count)
    {
        for (std::size_t i = 0; i < count; i += sizeof(std::uint64_t)) {
            std::uint64_t word = 0;
            std::memcpy(&word, bytes + i, std::min(sizeof(word), count - i));
            addWord(word);
        }
    }
    std::uint64_t value_ = 0xCBF29CE484222325ULL;
};

void addNode(Hash& hash, const scene::Node& node)
{
    hash.addValue(node.parent);
    hash.addValue(node.use_matrix ? node.matrix : node.transform.matrix());
    hash.addValue(node.mesh);
    hash.addValue(node.skin);
    hash.add(node.instances);
    hash.addValue(static_cast<std::uint64_t>(node.casts) * 2 + static_cast<std::uint64_t>(node.receives));
}

void addMesh(Hash& hash, const scene::Mesh& mesh)
{
    for (const scene::Primitive& primitive : mesh.primitives) {
        hash.add(primitive.positions);
        hash.add(primitive.normals);
        hash.add(primitive.uv0);
        hash.add(primitive.indices);
        hash.addValue(primitive.material);
    }
}

} // namespace

std::string sceneHash(const scene::Scene& scene)
{
    Hash hash;
    for (const scene::Mesh& mesh : scene.meshes) {
        addMesh(hash, mesh);
    }
    for (const scene::Node& node : scene.nodes) {
        addNode(hash, node);
    }
    for (const scene::Image& image : scene.images) {
        hash.add(image.rgba);
    }
    for (const scene::Material& material : scene.materials) {
        hash.addValue(material.base_colour);
        hash.addValue(material.alpha_cutoff);
    }
    for (const scene::Light& light : scene.lights) {
        hash.addValue(light.colour);
        hash.addValue(light.intensity);
    }
    return fmt::format("{:016x}", hash.value());
}

} // namespace gnomon::app
