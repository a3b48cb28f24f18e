// SPDX-License-Identifier: Apache-2.0
#include "small_scene.h"

#include "scene/state.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace gnomon::host::test {
namespace {

void addQuad(scene::Primitive& out, glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d)
{
    const auto first = static_cast<std::uint32_t>(out.positions.size());
    const glm::vec3 normal = glm::normalize(glm::cross(b - a, d - a));
    for (const glm::vec3& p : {a, b, c, d}) {
        out.positions.push_back(p);
        out.normals.push_back(normal);
    }
    for (const glm::vec2 uv : {glm::vec2{0, 1}, glm::vec2{1, 1}, glm::vec2{1, 0}, glm::vec2{0, 0}}) {
        out.uv0.push_back(uv);
    }
    for (const std::uint32_t i : {0U, 1U, 2U, 0U, 2U, 3U}) {
        out.indices.push_back(first + i);
    }
}

scene::Primitive box(float h)
{
    scene::Primitive p;
    addQuad(p, {-h, -h, h}, {h, -h, h}, {h, h, h}, {-h, h, h});
    addQuad(p, {h, -h, -h}, {-h, -h, -h}, {-h, h, -h}, {h, h, -h});
    addQuad(p, {h, -h, h}, {h, -h, -h}, {h, h, -h}, {h, h, h});
    addQuad(p, {-h, -h, -h}, {-h, -h, h}, {-h, h, h}, {-h, h, -h});
    addQuad(p, {-h, h, h}, {h, h, h}, {h, h, -h}, {-h, h, -h});
    addQuad(p, {-h, -h, -h}, {h, -h, -h}, {h, -h, h}, {-h, -h, h});
    return p;
}

scene::Primitive quad(float h)
{
    scene::Primitive p;
    addQuad(p, {-h, -h, 0}, {h, -h, 0}, {h, h, 0}, {-h, h, 0});
    return p;
}

scene::Image checker()
{
    scene::Image image{"checker", 8, 8, {}};
    for (std::uint32_t i = 0; i < 64; ++i) {
        const bool on = ((i / 8 + i) & 1U) != 0;
        const std::uint8_t v = on ? 255 : 60;
        image.rgba.insert(image.rgba.end(), {v, v, v, static_cast<std::uint8_t>(on ? 255 : 0)});
    }
    return image;
}

std::uint32_t addNode(scene::Scene& scene, const char* name, scene::Primitive primitive, std::uint32_t material,
                      glm::vec3 at)
{
    primitive.material = material;
    scene::Mesh mesh;
    mesh.name = name;
    mesh.primitives.push_back(std::move(primitive));
    scene.meshes.push_back(std::move(mesh));
    scene::Node node;
    node.name = name;
    node.transform.translation = at;
    node.mesh = static_cast<std::uint32_t>(scene.meshes.size()) - 1;
    scene.nodes.push_back(node);
    return static_cast<std::uint32_t>(scene.nodes.size()) - 1;
}

void addMaterials(scene::Scene& scene)
{
    scene.images.push_back(checker());
    scene.textures.push_back({0});
    scene::Material stone;
    stone.roughness = 0.7F;
    stone.metallic = 0.0F;
    stone.normal_texture.texture = scene::kNone;
    stone.base_colour_texture.texture = 0;
    scene::Material fence;
    fence.alpha_mode = scene::AlphaMode::mask;
    fence.double_sided = true;
    fence.base_colour_texture.texture = 0;
    scene::Material glass;
    glass.alpha_mode = scene::AlphaMode::blend;
    glass.stained = true;
    glass.base_colour = {0.3F, 0.6F, 1.0F, 0.4F};
    scene::Material glow;
    glow.model = scene::ShadingModel::phong;
    glow.emissive = {2.0F, 1.0F, 0.2F};
    scene.materials = {stone, fence, glass, glow};
}

void addLights(scene::Scene& scene)
{
    scene::Light sun;
    sun.intensity = 3.0F;
    scene::Light spot;
    spot.type = scene::LightType::spot;
    spot.intensity = 60.0F;
    spot.outer_cone_rad = 0.5F;
    spot.range_m = 20.0F;
    spot.cookie = 0;
    scene.lights = {sun, spot};
    for (std::uint32_t i = 0; i < 2; ++i) {
        scene::Node node;
        node.light = i;
        node.transform.translation = {i == 0 ? 0.0F : 2.0F, 8.0F, 0.0F};
        // -z turned down, and a little to the side.
        node.transform.rotation = glm::angleAxis(-1.2F, glm::vec3{1.0F, 0.0F, 0.0F});
        scene.nodes.push_back(node);
    }
}

} // namespace

void addMesh(scene::Scene& scene, scene::Primitive primitive)
{
    scene::Mesh mesh;
    mesh.primitives.push_back(std::move(primitive));
    scene.meshes.push_back(std::move(mesh));
    scene::Node node;
    node.mesh = static_cast<std::uint32_t>(scene.meshes.size() - 1);
    scene.nodes.push_back(std::move(node));
}

scene::Scene smallScene()
{
    scene::Scene scene;
    scene.name = "small";
    addMaterials(scene);
    scene::Primitive ground;
    addQuad(ground, {-8, 0, 8}, {8, 0, 8}, {8, 0, -8}, {-8, 0, -8});
    addNode(scene, "ground", ground, 0, {});
    addNode(scene, "mover", box(0.5F), scene::kNone, {-3.0F, 1.5F, 0.0F});
    addNode(scene, "fence", quad(1.0F), 1, {0.0F, 1.0F, 1.0F});
    addNode(scene, "glass", quad(1.0F), 2, {2.0F, 1.0F, 2.0F});
    addNode(scene, "glow", box(0.3F), 3, {3.0F, 0.5F, 0.0F});
    scene::Node joint;
    joint.name = "joint";
    scene.nodes.push_back(joint);
    scene::Primitive flag = quad(0.7F);
    flag.joints.assign(flag.positions.size(), glm::u16vec4{0});
    flag.weights.assign(flag.positions.size(), glm::vec4{1.0F, 0.0F, 0.0F, 0.0F});
    const std::uint32_t flag_node = addNode(scene, "flag", flag, scene::kNone, {});
    scene.skins.push_back({"skin", {kJointNode}, {glm::mat4(1.0F)}});
    scene.nodes[flag_node].skin = 0;
    scene.nodes[addNode(scene, "shy", box(0.4F), scene::kNone, {-4.5F, 0.4F, 3.0F})].receives = false;
    addLights(scene);
    for (const std::uint32_t moving : {kMoverNode, kJointNode, kFlagNode}) {
        scene.nodes[moving].dynamic = true;
    }
    scene.procedural = [](double time_s, std::vector<scene::Node>& nodes) {
        const auto t = static_cast<float>(time_s);
        nodes[kMoverNode].transform.translation.x = -3.0F + t;
        nodes[kJointNode].transform.translation = {0.0F, 2.5F + 0.3F * std::sin(t), -1.0F};
    };
    scene::finishScene(scene);
    return scene;
}

Eye smallEye()
{
    Eye eye;
    eye.position_ws = {0.0, 5.0, 9.0};
    eye.target_ws = {0.0, 0.8, 0.0};
    return eye;
}

std::size_t differing(const ImageF& a, const ImageF& b, float share)
{
    const float most = share * *std::ranges::max_element(b.values);
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.values.size(); ++i) {
        count += std::abs(a.values[i] - b.values[i]) <= most ? 0 : 1; // NaN differs
    }
    return count;
}

} // namespace gnomon::host::test
