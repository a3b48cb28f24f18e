// SPDX-License-Identifier: Apache-2.0
// Short ways to put things into a Scene.
#pragma once

#include "scene_names.h"

#include <glm/vec3.hpp>

#include <string>

namespace gnomon::worlds {

/// Values of a material; all others keep a dielectric's defaults.
struct Finish {
    glm::vec4 base_colour{1.0F};
    float roughness = 0.9F;
    float metallic = 0.0F;
    std::uint32_t texture = kNone;
    std::uint32_t normal_texture = kNone;
    AlphaMode alpha_mode = AlphaMode::opaque;
    bool double_sided = false;
    glm::vec3 emissive{0.0F};
    float phong_exponent = 0.0F; // above 0 the material is ShadingModel::phong
    float lit_by_night = 0.0F;   // Material::lit_by_night
};

std::uint32_t addTexture(Scene& scene, Image image, Wrap wrap = Wrap::repeat);
std::uint32_t addMaterial(Scene& scene, const std::string& name, const Finish& finish);
std::uint32_t addMesh(Scene& scene, Mesh mesh);
std::uint32_t addNode(Scene& scene, const std::string& name, std::uint32_t mesh, const Transform& transform,
                      std::uint32_t parent = kNone);
/// A node that carries `light`, shining along `direction`.
std::uint32_t addLight(Scene& scene, const Light& light, const glm::vec3& position, const glm::vec3& direction);

/// Stands at `position`, turned by `yaw_rad` about +y.
[[nodiscard]] Transform standing(const glm::vec3& position, float yaw_rad = 0.0F, float scale = 1.0F);
/// Rotation that takes -z to `direction` with +y as near to up as can be.
[[nodiscard]] glm::quat lookAlong(const glm::vec3& direction);

} // namespace gnomon::worlds
