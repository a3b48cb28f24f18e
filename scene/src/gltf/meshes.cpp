// SPDX-License-Identifier: Apache-2.0
#include "gltf/attributes.h"
#include "gltf/draco.h"

#include <algorithm>
#include <array>

namespace gnomon::scene::gltf {

namespace {

enum Mode : std::uint64_t { kPoints = 0, kTriangles = 4, kTriangleStrip = 5, kTriangleFan = 6 };

constexpr Format kIndexFormats[] = {
    {"SCALAR", Component::u8, false}, {"SCALAR", Component::u16, false}, {"SCALAR", Component::u32, false}};

std::uint32_t restartValue(Component component)
{
    return component == Component::u8 ? 0xFFU : component == Component::u16 ? 0xFFFFU : 0xFFFFFFFFU;
}

/// The primitive's indices as the file has them; 0, 1, 2, … when it has none.
std::vector<std::uint32_t> readIndices(Document& document, const JsonView& view, std::size_t vertex_count)
{
    const std::optional<JsonView> where = view.find("indices");
    if (!where) {
        document.context().chargeVertices(vertex_count, view.pointer());
        document.context().chargeBytes(vertex_count * sizeof(std::uint32_t), view.pointer());
        std::vector<std::uint32_t> indices(vertex_count);
        for (std::size_t i = 0; i < vertex_count; ++i) {
            indices[i] = static_cast<std::uint32_t>(i);
        }
        return indices;
    }
    const Accessor& accessor = document.accessor(*where);
    expectFormat(*where, accessor, kIndexFormats);
    claimView(document, accessor, ViewUse::indices);
    noticeStride(document, accessor, "indices");
    std::vector<std::uint32_t> indices = readIntegers(document.context(), accessor);
    for (std::size_t i = 0; i < indices.size(); ++i) {
        if (indices[i] == restartValue(accessor.component)) {
            where->failFound("indices must not hold the primitive restart value",
                             std::to_string(indices[i]) + " as index " + std::to_string(i));
        }
        if (indices[i] >= vertex_count) {
            where->failFound("an index is out of range: there are " + std::to_string(vertex_count) + " vertices",
                             std::to_string(indices[i]) + " as index " + std::to_string(i));
        }
    }
    return indices;
}

/// Strips and fans become lists. Triangles with two equal indices only join strips and are left out.
std::vector<std::uint32_t> toTriangleList(std::vector<std::uint32_t> in, std::uint64_t mode)
{
    if (mode == kTriangles) {
        in.resize(in.size() / 3 * 3);
        return in;
    }
    std::vector<std::uint32_t> out;
    for (std::size_t i = 0; i + 2 < in.size(); ++i) {
        // glTF 2.0, 3.7.2.1: strip p_i = {v_i, v_(i+1+i%2), v_(i+2-i%2)}, fan p_i = {v_(i+1), v_(i+2), v_0}.
        const std::array<std::uint32_t, 3> triangle = mode == kTriangleStrip
                                                          ? std::array{in[i], in[i + 1 + i % 2], in[i + 2 - i % 2]}
                                                          : std::array{in[i + 1], in[i + 2], in[0]};
        if (triangle[0] != triangle[1] && triangle[1] != triangle[2] && triangle[2] != triangle[0]) {
            out.insert(out.end(), triangle.begin(), triangle.end());
        }
    }
    return out;
}

void readTargets(Document& document, const JsonView& view, Primitive& primitive)
{
    const std::optional<JsonView> targets = view.find("targets");
    const std::size_t count = targets ? targets->size() : 0;
    for (std::size_t i = 0; i < count; ++i) {
        primitive.morph_targets.push_back(
            readMorphTarget(document, targets->element(i), view.at("attributes"), primitive.positions.size()));
    }
}

/// Empty positions: there is nothing that could cast or show.
Primitive readPrimitive(Document& document, const JsonView& view)
{
    checkExtensions(view, Place::primitive);
    Primitive primitive;
    const std::optional<JsonView> mode_view = view.find("mode");
    std::uint64_t mode = mode_view ? mode_view->uint(0, 6) : kTriangles;
    primitive.material = view.index("material", document.scene.materials.size());
    std::vector<std::uint32_t> indices;
    const bool draco = isDraco(view);
    if (draco) {
        indices = unpackDraco(document, view);
        mode = kTriangles; // strips are taken apart, too
    }
    const bool has_positions = readAttributes(document, view.at("attributes"), primitive);
    if (!has_positions) {
        document.context().notice("primitive " + view.pointer() + " has no positions and was left out");
        return {};
    }
    if (!draco) {
        indices = readIndices(document, view, primitive.positions.size());
    }
    readTargets(document, view, primitive);
    if (mode < kTriangles) {
        document.context().notice("points and lines (" + view.pointer() + ") are not drawn and cast no shadow");
        return {};
    }
    if (mode != kTriangles) { // each index of a strip or fan makes up to three
        document.context().chargeVertices(indices.size() * 3ULL, view.pointer());
        document.context().chargeBytes(indices.size() * 3ULL * sizeof(std::uint32_t), view.pointer());
    }
    if (indices.size() < 3 || (mode == kTriangles && indices.size() % 3 != 0)) {
        document.context().notice("indices in " + view.pointer() + " that make no whole triangle were left out");
    }
    primitive.indices = toTriangleList(std::move(indices), mode);
    if (primitive.normals.empty()) { // flat normals give every corner a vertex of its own
        document.context().chargeVertices(primitive.indices.size(), view.pointer());
        document.context().chargeBytes(primitive.indices.size() * 2ULL * sizeof(glm::vec3), view.pointer());
    }
    return primitive;
}

std::size_t targetCount(const JsonView& primitive)
{
    const std::optional<JsonView> targets = primitive.find("targets");
    return targets ? targets->size() : 0;
}

/// Weights of morph targets, here or on a node.
std::vector<float> readMorphWeights(const JsonView& owner, std::size_t target_count)
{
    const std::optional<JsonView> weights = owner.find("weights");
    std::vector<float> out(target_count, 0.0F);
    if (!weights) {
        return out;
    }
    if (weights->size() != target_count) {
        weights->failFound("there must be one weight per morph target, " + std::to_string(target_count),
                           std::to_string(weights->size()));
    }
    weights->numbers(out);
    return out;
}

Mesh readMesh(Document& document, const JsonView& view)
{
    checkExtensions(view, Place::other);
    Mesh mesh;
    mesh.name = view.string("name", "");
    const JsonView primitives = view.at("primitives");
    const std::size_t count = primitives.size();
    std::uint32_t joint_limit = 0;
    std::uint64_t vertex_count = 0;
    bool all_skinned = true;
    for (std::size_t i = 0; i < count; ++i) {
        const JsonView element = primitives.element(i);
        Primitive primitive = readPrimitive(document, element);
        all_skinned = all_skinned && element.at("attributes").has("JOINTS_0");
        if (targetCount(element) != targetCount(primitives.element(0))) {
            element.failFound("all primitives of a mesh must have the same number of morph targets",
                              std::to_string(targetCount(element)) + " and " +
                                  std::to_string(targetCount(primitives.element(0))));
        }
        for (const glm::u16vec4& joints : primitive.joints) {
            const std::uint16_t largest = std::max(std::max(joints.x, joints.y), std::max(joints.z, joints.w));
            joint_limit = std::max(joint_limit, largest + 1U);
        }
        if (!primitive.indices.empty()) {
            // Without normals every corner of a triangle becomes a vertex.
            vertex_count += primitive.normals.empty() ? primitive.indices.size() : primitive.positions.size();
            mesh.primitives.push_back(std::move(primitive));
        }
    }
    mesh.morph_weights = readMorphWeights(view, targetCount(primitives.element(0)));
    document.vertex_counts.push_back(vertex_count);
    document.joint_limits.push_back(joint_limit);
    document.meshes_skinned.push_back(all_skinned);
    return mesh;
}

} // namespace

void readMeshes(Document& document)
{
    const std::size_t count = topLevelCount(document, "meshes");
    for (std::size_t i = 0; i < count; ++i) {
        document.scene.meshes.push_back(readMesh(document, document.root.at("meshes").element(i)));
    }
}

} // namespace gnomon::scene::gltf
