// SPDX-License-Identifier: Apache-2.0
// Data derived from a scene's other data. Tangents based on: E. Lengyel, "Computing Tangent Space Basis Vectors for an
// Arbitrary Mesh", 2001.
#include "scene/state.h"

#include <gnomon/error.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace gnomon::scene {

namespace {

template <typename T>
void spread(std::vector<T>& values, const std::vector<std::uint32_t>& indices)
{
    if (values.empty()) {
        return;
    }
    std::vector<T> wide;
    wide.reserve(indices.size());
    for (const std::uint32_t index : indices) {
        wide.push_back(values[index]);
    }
    values = std::move(wide);
}

/// Gives every triangle corner a vertex of its own, so that a flat normal has a place to be.
void unweld(Primitive& primitive)
{
    spread(primitive.positions, primitive.indices);
    spread(primitive.tangents, primitive.indices);
    spread(primitive.uv0, primitive.indices);
    spread(primitive.uv1, primitive.indices);
    spread(primitive.colours, primitive.indices);
    spread(primitive.joints, primitive.indices);
    spread(primitive.weights, primitive.indices);
    for (MorphTarget& target : primitive.morph_targets) {
        spread(target.positions, primitive.indices);
        spread(target.normals, primitive.indices);
        spread(target.tangents, primitive.indices);
    }
    for (std::size_t i = 0; i < primitive.indices.size(); ++i) {
        primitive.indices[i] = static_cast<std::uint32_t>(i);
    }
}

void addFlatNormals(Primitive& primitive)
{
    unweld(primitive);
    primitive.normals.assign(primitive.positions.size(), glm::vec3(0.0F, 1.0F, 0.0F));
    for (std::size_t i = 0; i + 2 < primitive.positions.size(); i += 3) {
        const glm::vec3* p = &primitive.positions[i];
        const glm::vec3 n = glm::cross(p[1] - p[0], p[2] - p[0]);
        const float length = glm::length(n);
        if (length > 0.0F) { // a degenerate triangle keeps "up"; nobody sees it
            primitive.normals[i] = primitive.normals[i + 1] = primitive.normals[i + 2] = n / length;
        }
    }
}

/// Along the normal of the triangle of vertices v[0] to v[2], twice as long as its area.
glm::dvec3 acrossTriangle(const Primitive& primitive, const std::uint32_t* v)
{
    const glm::dvec3 first(primitive.positions[v[0]]);
    return glm::cross(glm::dvec3(primitive.positions[v[1]]) - first, glm::dvec3(primitive.positions[v[2]]) - first);
}

/// Normals of length 0 become those of the triangles around the vertex, by their areas.
void mendNormals(Primitive& primitive)
{
    std::vector<std::uint8_t> missing(primitive.normals.size(), 0);
    bool any = false;
    for (std::size_t i = 0; i < primitive.normals.size(); ++i) {
        missing[i] = primitive.normals[i] == glm::vec3(0.0F) ? 1 : 0;
        any = any || missing[i] != 0;
    }
    if (!any) {
        return;
    }
    std::vector<glm::dvec3> sums(primitive.normals.size(), glm::dvec3(0.0));
    for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
        const std::uint32_t* v = &primitive.indices[i];
        const glm::dvec3 across = acrossTriangle(primitive, v);
        for (int k = 0; k < 3; ++k) {
            sums[v[k]] += across;
        }
    }
    for (std::size_t i = 0; i < missing.size(); ++i) {
        const double length = glm::length(sums[i]);
        if (missing[i] != 0) { // around a vertex without a surface it does not matter
            primitive.normals[i] = length > 0.0 ? glm::vec3(sums[i] / length) : glm::vec3(0.0F, 1.0F, 0.0F);
        }
    }
}

glm::vec3 anyPerpendicular(const glm::vec3& n)
{
    const glm::vec3 axis = std::abs(n.x) < 0.8F ? glm::vec3(1.0F, 0.0F, 0.0F) : glm::vec3(0.0F, 1.0F, 0.0F);
    return glm::normalize(glm::cross(axis, n));
}

void addTangents(Primitive& primitive, const std::vector<glm::vec2>& uv)
{
    const std::size_t count = primitive.positions.size();
    std::vector<glm::vec3> along_u(count, glm::vec3(0.0F));
    std::vector<glm::vec3> along_v(count, glm::vec3(0.0F));
    for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
        const std::uint32_t* v = &primitive.indices[i];
        const glm::vec3 edge1 = primitive.positions[v[1]] - primitive.positions[v[0]];
        const glm::vec3 edge2 = primitive.positions[v[2]] - primitive.positions[v[0]];
        const glm::vec2 d1 = uv[v[1]] - uv[v[0]];
        const glm::vec2 d2 = uv[v[2]] - uv[v[0]];
        const float determinant = d1.x * d2.y - d2.x * d1.y;
        if (determinant == 0.0F || !std::isfinite(1.0F / determinant)) {
            continue;
        }
        const glm::vec3 u = (edge1 * d2.y - edge2 * d1.y) / determinant;
        const glm::vec3 w = (edge2 * d1.x - edge1 * d2.x) / determinant;
        for (int k = 0; k < 3; ++k) {
            along_u[v[k]] += u;
            along_v[v[k]] += w;
        }
    }
    primitive.tangents.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec3& n = primitive.normals[i];
        glm::vec3 t = along_u[i] - n * glm::dot(n, along_u[i]);
        const float length = glm::length(t);
        t = length > 1e-6F * glm::length(along_u[i]) && std::isfinite(length) ? t / length : anyPerpendicular(n);
        // glTF's v grows down the image and its green channel points up it, so the bitangent runs against v.
        const float hand = glm::dot(glm::cross(n, t), along_v[i]) > 0.0F ? -1.0F : 1.0F;
        primitive.tangents[i] = glm::vec4(t, hand);
    }
}

void markCreases(Primitive& primitive)
{
    const double least = std::cos(kCreaseAngle_rad);
    primitive.creased.assign(primitive.positions.size(), 0);
    for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
        const std::uint32_t* v = &primitive.indices[i];
        const glm::dvec3 across = acrossTriangle(primitive, v);
        const double length = glm::length(across);
        for (int k = 0; k < 3; ++k) {
            // Mirrored objects and backs have their normals turned.
            const double along = std::abs(glm::dot(across, glm::dvec3(primitive.normals[v[k]])));
            if (along < least * length) {
                primitive.creased[v[k]] = 1;
            }
        }
    }
}

void finishPrimitive(const Scene& scene, Primitive& primitive)
{
    if (primitive.normals.size() != primitive.positions.size()) {
        addFlatNormals(primitive);
        primitive.tangents.clear(); // they belonged to normals that nobody gave
    }
    mendNormals(primitive);
    if (primitive.tangents.empty() && primitive.material < scene.materials.size()) {
        const TextureUse& use = scene.materials[primitive.material].normal_texture;
        const std::vector<glm::vec2>& uv = use.uv_set == 1 ? primitive.uv1 : primitive.uv0;
        if (use.texture != kNone && uv.size() == primitive.positions.size()) {
            addTangents(primitive, uv);
        }
    }
    markCreases(primitive);
    primitive.bounds = {};
    for (const glm::vec3& p : primitive.positions) {
        primitive.bounds.min = glm::min(primitive.bounds.min, p);
        primitive.bounds.max = glm::max(primitive.bounds.max, p);
    }
}

/// The first vertex is on the grid that all of them were rounded to, so their differences are exact.
void recentre(Primitive& primitive)
{
    constexpr float kFar = 64.0F; // sizes away; single precision has 18 of its 24 bits left there
    const glm::vec3 away = glm::abs(primitive.bounds.centre());
    const glm::vec3 size = primitive.bounds.extent();
    const float size_m = std::max({size.x, size.y, size.z});
    if (!(size_m > 0.0F && std::max({away.x, away.y, away.z}) > kFar * size_m)) {
        return;
    }
    const glm::vec3 origin = primitive.positions.front();
    for (glm::vec3& p : primitive.positions) {
        p -= origin;
    }
    primitive.bounds = {primitive.bounds.min - origin, primitive.bounds.max - origin};
    primitive.origin += origin;
}

std::vector<bool> skinnedMeshes(const Scene& scene)
{
    std::vector<bool> skinned(scene.meshes.size());
    for (const Node& node : scene.nodes) {
        if (node.skin != kNone && node.mesh < skinned.size()) {
            skinned[node.mesh] = true;
        }
    }
    return skinned;
}

} // namespace

void finishScene(Scene& scene)
{
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        const std::uint32_t parent = scene.nodes[i].parent;
        if (parent != kNone && parent >= i) {
            throw Error("finishing scene '" + scene.name + "'",
                        "node " + std::to_string(i) + " comes before its parent " + std::to_string(parent),
                        "order the nodes so that parents come first");
        }
    }
    const std::vector<bool> skinned = skinnedMeshes(scene);
    for (std::size_t mesh = 0; mesh < scene.meshes.size(); ++mesh) {
        for (Primitive& primitive : scene.meshes[mesh].primitives) {
            finishPrimitive(scene, primitive);
            if (!skinned[mesh]) {
                recentre(primitive);
            }
        }
    }
    for (const Animation& animation : scene.animations) {
        for (const AnimationChannel& channel : animation.channels) {
            if (channel.node < scene.nodes.size()) {
                scene.nodes[channel.node].dynamic = true;
            }
        }
    }
    for (Node& node : scene.nodes) { // parents come first, so one pass carries the hint all the way down
        if (node.parent != kNone && scene.nodes[node.parent].dynamic) {
            node.dynamic = true;
        }
    }
}

} // namespace gnomon::scene
