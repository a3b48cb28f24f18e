// SPDX-License-Identifier: Apache-2.0
// A scene with one of everything, and a change for every member that there is.
#pragma once

#include "scene/state.h"

#include <array>
#include <cstring>
#include <functional>
#include <type_traits>
#include <vector>

namespace gnomon::scene {

inline Primitive samplePrimitive()
{
    Primitive primitive;
    primitive.positions = {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}};
    primitive.normals.assign(3, {0, 1, 0});
    primitive.tangents.assign(3, {1, 0, 0, 1});
    primitive.uv0.assign(3, {0.25F, 0.75F});
    primitive.uv1.assign(3, {0.5F, 0.5F});
    primitive.colours.assign(3, {1, 1, 1, 1});
    primitive.joints.assign(3, {0, 0, 0, 0});
    primitive.weights.assign(3, {1, 0, 0, 0});
    primitive.indices = {0, 2, 1};
    primitive.morph_targets.resize(1);
    primitive.morph_targets[0].positions.assign(3, {0, 1, 0});
    primitive.morph_targets[0].normals.assign(3, {0, 0, 0});
    primitive.morph_targets[0].tangents.assign(3, {0, 0, 0});
    primitive.material = 0;
    primitive.bounds = {{0, 0, 0}, {1, 0, 1}};
    return primitive;
}

/// One of everything, and nothing empty.
inline Scene sample()
{
    Scene scene;
    scene.name = "sample";
    scene.images.push_back({"image", 1, 2, {1, 2, 3, 4, 5, 6, 7, 8}});
    scene.textures.push_back({0, Wrap::repeat, Wrap::repeat, true, true, true});
    scene.materials.resize(1);
    scene.meshes.push_back({"mesh", {samplePrimitive()}, {0.5F}});
    scene.nodes.resize(2);
    scene.nodes[1].parent = 0;
    scene.nodes[1].mesh = 0;
    scene.nodes[1].morph_weights = {0.5F};
    scene.nodes[1].instances = {glm::mat4(1.0F)};
    scene.nodes[1].camera = 0;
    scene.nodes[1].light = 0;
    scene.skins.push_back({"skin", {0}, {glm::mat4(1.0F)}});
    scene.animations.push_back(
        {"animation", {{1, AnimationPath::translation, Interpolation::linear, {0}, {1, 2, 3}}}, 1.0F});
    scene.cameras.resize(1);
    scene.lights.resize(1);
    scene.views.resize(1);
    scene.notices = {"a notice"};
    return scene;
}

/// The smallest change there is: one bit, of the last component of the last element.
template <typename T>
void alter(T& value)
{
    if constexpr (std::is_same_v<T, bool>) {
        value = !value;
    } else if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
        std::array<unsigned char, sizeof(T)> bytes{};
        std::memcpy(bytes.data(), &value, sizeof(T));
        bytes[0] ^= 1U;
        std::memcpy(&value, bytes.data(), sizeof(T));
    } else if constexpr (std::is_same_v<T, glm::quat>) {
        alter(value.z);
    } else if constexpr (requires { value.back(); }) {
        alter(value.back());
    } else {
        alter(value[value.length() - 1]);
    }
}

template <typename T>
struct Change {
    const char* what;
    std::function<void(T&)> apply;
};

/// Alters one member.
template <typename T, typename Member>
Change<T> of(const char* name, Member T::*member)
{
    return {name, [member](T& owner) {
                alter(owner.*member);
            }};
}

/// Adds an empty element.
template <typename T, typename Element>
Change<T> more(const char* name, std::vector<Element> T::*member)
{
    return {name, [member](T& owner) {
                (owner.*member).emplace_back();
            }};
}

inline const std::vector<Change<Image>> kImageChanges{
    of("width", &Image::width),
    of("height", &Image::height),
    of("rgba", &Image::rgba),
};
inline const std::vector<Change<Texture>> kTextureChanges{
    of("image", &Texture::image),
    of("wrap_u", &Texture::wrap_u),
    of("wrap_v", &Texture::wrap_v),
    of("magnify_linear", &Texture::magnify_linear),
    of("minify_linear", &Texture::minify_linear),
    of("mipmaps", &Texture::mipmaps),
};
inline const std::vector<Change<TextureUse>> kTextureUseChanges{
    of("texture", &TextureUse::texture),
    of("uv_set", &TextureUse::uv_set),
    of("offset", &TextureUse::offset),
    of("scale", &TextureUse::scale),
    of("rotation_rad", &TextureUse::rotation_rad),
};
inline const std::vector<Change<Material>> kMaterialChanges{
    of("model", &Material::model),
    of("alpha_mode", &Material::alpha_mode),
    of("alpha_cutoff", &Material::alpha_cutoff),
    of("double_sided", &Material::double_sided),
    of("base_colour", &Material::base_colour),
    of("metallic", &Material::metallic),
    of("roughness", &Material::roughness),
    of("phong_exponent", &Material::phong_exponent),
    of("lit_by_night", &Material::lit_by_night),
    of("emissive", &Material::emissive),
    of("normal_scale", &Material::normal_scale),
    of("occlusion_strength", &Material::occlusion_strength),
};
inline const std::vector<Change<MorphTarget>> kMorphTargetChanges{
    of("positions", &MorphTarget::positions),
    of("normals", &MorphTarget::normals),
    of("tangents", &MorphTarget::tangents),
};
inline const std::vector<Change<Primitive>> kPrimitiveChanges{
    of("positions", &Primitive::positions),
    of("normals", &Primitive::normals),
    of("tangents", &Primitive::tangents),
    of("uv0", &Primitive::uv0),
    of("uv1", &Primitive::uv1),
    of("colours", &Primitive::colours),
    of("joints", &Primitive::joints),
    of("weights", &Primitive::weights),
    of("indices", &Primitive::indices),
    of("material", &Primitive::material),
    more("another target", &Primitive::morph_targets),
};
inline const std::vector<Change<Aabb>> kAabbChanges{
    of("min", &Aabb::min),
    of("max", &Aabb::max),
};
inline const std::vector<Change<Mesh>> kMeshChanges{
    of("morph_weights", &Mesh::morph_weights),
    more("another primitive", &Mesh::primitives),
};
inline const std::vector<Change<Node>> kNodeChanges{
    of("parent", &Node::parent),
    of("matrix", &Node::matrix),
    of("use_matrix", &Node::use_matrix),
    of("mesh", &Node::mesh),
    of("skin", &Node::skin),
    of("camera", &Node::camera),
    of("light", &Node::light),
    of("morph_weights", &Node::morph_weights),
    of("instances", &Node::instances),
    of("casts", &Node::casts),
    of("receives", &Node::receives),
    of("groups", &Node::groups),
    of("bias_m", &Node::bias_m),
    of("clip_planes", &Node::clip_planes),
    of("dynamic", &Node::dynamic),
};
inline const std::vector<Change<Transform>> kTransformChanges{
    of("translation", &Transform::translation),
    of("rotation", &Transform::rotation),
    of("scale", &Transform::scale),
};
inline const std::vector<Change<Skin>> kSkinChanges{
    of("joints", &Skin::joints),
    of("inverse_bind", &Skin::inverse_bind),
};
inline const std::vector<Change<AnimationChannel>> kAnimationChannelChanges{
    of("node", &AnimationChannel::node),
    of("path", &AnimationChannel::path),
    of("interpolation", &AnimationChannel::interpolation),
    of("times_s", &AnimationChannel::times_s),
    of("values", &AnimationChannel::values),
};
inline const std::vector<Change<Animation>> kAnimationChanges{
    of("duration_s", &Animation::duration_s),
    more("another channel", &Animation::channels),
};
inline const std::vector<Change<Camera>> kCameraChanges{
    of("orthographic", &Camera::orthographic),
    of("fov_y_rad", &Camera::fov_y_rad),
    of("half_height_m", &Camera::half_height_m),
    of("near_m", &Camera::near_m),
    of("far_m", &Camera::far_m),
};
inline const std::vector<Change<Light>> kLightChanges{
    of("type", &Light::type),
    of("colour", &Light::colour),
    of("intensity", &Light::intensity),
    of("range_m", &Light::range_m),
    of("inner_cone_rad", &Light::inner_cone_rad),
    of("outer_cone_rad", &Light::outer_cone_rad),
    of("angular_diameter_rad", &Light::angular_diameter_rad),
    of("radius_m", &Light::radius_m),
    of("cookie", &Light::cookie),
    of("casts_shadow", &Light::casts_shadow),
    of("groups", &Light::groups),
    of("body", &Light::body),
};
inline const std::vector<Change<NamedView>> kNamedViewChanges{
    of("eye", &NamedView::eye),
    of("target", &NamedView::target),
    of("fov_y_rad", &NamedView::fov_y_rad),
};
inline const std::vector<Change<Environment>> kEnvironmentChanges{
    of("sky_zenith", &Environment::sky_zenith), of("sky_horizon", &Environment::sky_horizon),
    of("ground", &Environment::ground),         of("ambient", &Environment::ambient),
    of("exposure", &Environment::exposure),     of("ground_albedo", &Environment::ground_albedo),
};
inline const std::vector<Change<Scene>> kSceneChanges{
    more("images", &Scene::images),
    more("textures", &Scene::textures),
    more("materials", &Scene::materials),
    more("meshes", &Scene::meshes),
    more("nodes", &Scene::nodes),
    more("skins", &Scene::skins),
    more("animations", &Scene::animations),
    more("cameras", &Scene::cameras),
    more("lights", &Scene::lights),
    more("views", &Scene::views),
    {"one array's end becomes the next one's start",
     [](Scene& scene) {
         Primitive& primitive = scene.meshes[0].primitives[0];
         primitive.normals.insert(primitive.normals.begin(), primitive.positions.back());
         primitive.positions.pop_back();
     }},
};

inline const std::vector<Change<Object>> kObjectChanges{
    of("node", &Object::node),
    of("mesh", &Object::mesh),
    of("primitive", &Object::primitive),
    of("instance", &Object::instance),
    of("deformed", &Object::deformed),
    of("material", &Object::material),
    of("casts", &Object::casts),
    of("receives", &Object::receives),
    of("groups", &Object::groups),
    of("bias_m", &Object::bias_m),
    of("dynamic", &Object::dynamic),
    of("clip_planes", &Object::clip_planes),
    of("world_from_object", &Object::world_from_object),
};
inline const std::vector<Change<DeformedPrimitive>> kDeformedChanges{
    of("object", &DeformedPrimitive::object),
    of("positions", &DeformedPrimitive::positions),
    of("normals", &DeformedPrimitive::normals),
    of("tangents", &DeformedPrimitive::tangents),
};
inline const std::vector<Change<PlacedLight>> kPlacedLightChanges{
    of("light", &PlacedLight::light),
    of("position_ws", &PlacedLight::position_ws),
    of("direction_ws", &PlacedLight::direction_ws),
    of("up_ws", &PlacedLight::up_ws),
};
inline const std::vector<Change<PlacedCamera>> kPlacedCameraChanges{
    of("camera", &PlacedCamera::camera),
    of("eye_ws", &PlacedCamera::eye_ws),
    of("forward_ws", &PlacedCamera::forward_ws),
    of("up_ws", &PlacedCamera::up_ws),
};
inline const std::vector<Change<State>> kStateChanges{
    of("world_from_node", &State::world_from_node), more("another of objects", &State::objects),
    more("another of deformed", &State::deformed),  more("another of lights", &State::lights),
    more("another of cameras", &State::cameras),
};

} // namespace gnomon::scene
