// SPDX-License-Identifier: Apache-2.0
#include "scene_maker.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include <cmath>
#include <utility>

namespace gnomon::worlds {

std::uint32_t addTexture(Scene& scene, Image image, Wrap wrap)
{
    scene.images.push_back(std::move(image));
    Texture texture;
    texture.image = static_cast<std::uint32_t>(scene.images.size() - 1);
    texture.wrap_u = texture.wrap_v = wrap;
    scene.textures.push_back(texture);
    return static_cast<std::uint32_t>(scene.textures.size() - 1);
}

std::uint32_t addMaterial(Scene& scene, const std::string& name, const Finish& finish)
{
    Material material;
    material.name = name;
    material.base_colour = finish.base_colour;
    material.roughness = finish.roughness;
    material.metallic = finish.metallic;
    material.base_colour_texture.texture = finish.texture;
    material.normal_texture.texture = finish.normal_texture;
    material.alpha_mode = finish.alpha_mode;
    material.double_sided = finish.double_sided;
    material.emissive = finish.emissive;
    material.lit_by_night = finish.lit_by_night;
    if (finish.phong_exponent > 0.0F) {
        material.model = ShadingModel::phong;
        material.phong_exponent = finish.phong_exponent;
    }
    scene.materials.push_back(std::move(material));
    return static_cast<std::uint32_t>(scene.materials.size() - 1);
}

std::uint32_t addMesh(Scene& scene, Mesh mesh)
{
    scene.meshes.push_back(std::move(mesh));
    return static_cast<std::uint32_t>(scene.meshes.size() - 1);
}

std::uint32_t addNode(Scene& scene, const std::string& name, std::uint32_t mesh, const Transform& transform,
                      std::uint32_t parent)
{
    Node& node = scene.nodes.emplace_back();
    node.name = name;
    node.mesh = mesh;
    node.transform = transform;
    node.parent = parent;
    return static_cast<std::uint32_t>(scene.nodes.size() - 1);
}

std::uint32_t addLight(Scene& scene, const Light& light, const glm::vec3& position, const glm::vec3& direction)
{
    scene.lights.push_back(light);
    Transform transform;
    transform.translation = position;
    transform.rotation = lookAlong(direction);
    const std::uint32_t node = addNode(scene, light.name, kNone, transform);
    scene.nodes[node].light = static_cast<std::uint32_t>(scene.lights.size() - 1);
    return node;
}

Transform standing(const glm::vec3& position, float yaw_rad, float scale)
{
    Transform transform;
    transform.translation = position;
    transform.rotation = glm::quat(std::cos(yaw_rad * 0.5F), 0.0F, std::sin(yaw_rad * 0.5F), 0.0F);
    transform.scale = glm::vec3(scale);
    return transform;
}

glm::quat lookAlong(const glm::vec3& direction)
{
    const glm::vec3 back = -glm::normalize(direction);
    const glm::vec3 helper = std::abs(back.y) < 0.999F ? glm::vec3(0, 1, 0) : glm::vec3(0, 0, -1);
    const glm::vec3 right = glm::normalize(glm::cross(helper, back));
    return glm::normalize(glm::quat_cast(glm::mat3(right, glm::cross(back, right), back)));
}

} // namespace gnomon::worlds
