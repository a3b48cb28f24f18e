// SPDX-License-Identifier: Apache-2.0
// Based on: Khronos Group, "glTF 2.0 Specification", 3.7.2.2 (morph targets) and 3.7.3.3 (skinned mesh attributes).
#include "deform.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include <algorithm>
#include <cmath>

namespace gnomon::scene {

namespace {

void addScaled(std::vector<glm::vec3>& to, const std::vector<glm::vec3>& differences, float weight)
{
    const std::size_t count = std::min(to.size(), differences.size());
    for (std::size_t i = 0; i < count; ++i) {
        to[i] += differences[i] * weight;
    }
}

void morph(const Primitive& primitive, std::span<const float> weights, DeformedPrimitive& deformed)
{
    const std::size_t targets = std::min(weights.size(), primitive.morph_targets.size());
    for (std::size_t t = 0; t < targets; ++t) {
        const MorphTarget& target = primitive.morph_targets[t];
        if (weights[t] == 0.0F) {
            continue;
        }
        addScaled(deformed.positions, target.positions, weights[t]);
        addScaled(deformed.normals, target.normals, weights[t]);
        const std::size_t count = std::min(deformed.tangents.size(), target.tangents.size());
        for (std::size_t i = 0; i < count; ++i) {
            deformed.tangents[i] += glm::vec4(target.tangents[i] * weights[t], 0.0F);
        }
    }
}

/// Normals go with the cofactors, which is the inverse transpose up to a factor and needs no division.
glm::mat3 cofactors(const glm::mat4& m)
{
    const glm::vec3 x(m[0]);
    const glm::vec3 y(m[1]);
    const glm::vec3 z(m[2]);
    const float sign = glm::dot(glm::cross(x, y), z) < 0.0F ? -1.0F : 1.0F; // a mirror must not turn them inside out
    return {glm::cross(y, z) * sign, glm::cross(z, x) * sign, glm::cross(x, y) * sign};
}

glm::vec3 normaliseOr(const glm::vec3& v, const glm::vec3& otherwise)
{
    const float length2 = glm::dot(v, v);
    if (length2 > 1e-20F) {
        return v * (1.0F / std::sqrt(length2));
    }
    // Cofactors of a small object are squares of its scale, whose own squares single precision has no room for.
    const glm::vec3 larger = v * 0x1p60F;
    const float larger2 = glm::dot(larger, larger);
    return larger2 > 1e-20F ? larger * (1.0F / std::sqrt(larger2)) : otherwise;
}

void skin(const Primitive& primitive, std::span<const glm::mat4> joint_matrices, DeformedPrimitive& deformed)
{
    for (std::size_t i = 0; i < deformed.positions.size(); ++i) {
        glm::mat4 blended(0.0F);
        for (int k = 0; k < 4; ++k) {
            const float weight = primitive.weights[i][k];
            const std::size_t joint = primitive.joints[i][k];
            if (weight != 0.0F && joint < joint_matrices.size()) {
                blended += joint_matrices[joint] * weight;
            }
        }
        deformed.positions[i] = glm::vec3(blended * glm::vec4(deformed.positions[i], 1.0F));
        deformed.normals[i] = cofactors(blended) * deformed.normals[i];
        if (!deformed.tangents.empty()) {
            const glm::vec4 tangent = deformed.tangents[i];
            deformed.tangents[i] = glm::vec4(glm::mat3(blended) * glm::vec3(tangent), tangent.w);
        }
    }
}

bool isSkinned(const Primitive& primitive)
{
    return !primitive.positions.empty() && primitive.joints.size() == primitive.positions.size() &&
           primitive.weights.size() == primitive.positions.size();
}

} // namespace

bool deforms(const Node& node, const Primitive& primitive)
{
    return !primitive.morph_targets.empty() || (node.skin != kNone && isSkinned(primitive));
}

void prepareDeformed(const Primitive& primitive, DeformedPrimitive& deformed)
{
    deformed.positions.resize(primitive.positions.size());
    deformed.normals.resize(primitive.normals.size());
    deformed.tangents.resize(primitive.tangents.size());
}

Aabb deform(const Primitive& primitive, std::span<const float> morph_weights, std::span<const glm::mat4> joint_matrices,
            DeformedPrimitive& deformed)
{
    std::copy(primitive.positions.begin(), primitive.positions.end(), deformed.positions.begin());
    std::copy(primitive.normals.begin(), primitive.normals.end(), deformed.normals.begin());
    std::copy(primitive.tangents.begin(), primitive.tangents.end(), deformed.tangents.begin());
    morph(primitive, morph_weights, deformed);
    if (!joint_matrices.empty() && isSkinned(primitive)) {
        skin(primitive, joint_matrices, deformed);
    }
    Aabb box;
    for (const glm::vec3& p : deformed.positions) {
        box.min = glm::min(box.min, p);
        box.max = glm::max(box.max, p);
    }
    for (std::size_t i = 0; i < deformed.normals.size(); ++i) {
        deformed.normals[i] = normaliseOr(deformed.normals[i], primitive.normals[i]);
    }
    for (std::size_t i = 0; i < deformed.tangents.size(); ++i) {
        const glm::vec4 tangent = deformed.tangents[i];
        deformed.tangents[i] = glm::vec4(normaliseOr(glm::vec3(tangent), glm::vec3(primitive.tangents[i])), tangent.w);
    }
    return box;
}

} // namespace gnomon::scene
