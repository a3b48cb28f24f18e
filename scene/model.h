// SPDX-License-Identifier: Apache-2.0
// The scene model: the content of a file or a built-in world, as plain data. Right-handed, +y up, metres, radians,
// linear colour, as in glTF 2.0. Indices are into the vectors of `Scene`; `kNone` is "none".
#pragma once

#include <gnomon/geometry.h>

#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace gnomon::scene {

inline constexpr std::uint32_t kNone = 0xFFFFFFFFU;

/// 8-bit RGBA, rows from the top, width * height * 4 bytes. Colour images hold sRGB-encoded values; an image's use
/// tells which it is (base colour and emissive are colour; normal, metallic-roughness, occlusion are data).
struct Image {
    std::string name;
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<std::uint8_t> rgba;
};

enum class Wrap : std::uint8_t { repeat, mirrored_repeat, clamp_to_edge };

struct Texture {
    std::uint32_t image = kNone;
    Wrap wrap_u = Wrap::repeat;
    Wrap wrap_v = Wrap::repeat;
    bool magnify_linear = true;
    bool minify_linear = true;
    bool mipmaps = true;
};

/// Use of a texture by a material. uv' = offset + rotation(counter-clockwise, radians) * scale * uv, as
/// KHR_texture_transform defines it.
struct TextureUse {
    std::uint32_t texture = kNone;
    std::uint32_t uv_set = 0; // 0 or 1
    glm::vec2 offset{0.0F};
    glm::vec2 scale{1.0F};
    float rotation_rad = 0.0F;
};

enum class AlphaMode : std::uint8_t { opaque, mask, blend };
/// `horizon`: metallic-roughness, and where the alpha of an opaque surface is below 1 it takes on the colour of the sky
/// behind it, so that a ground ends without an edge. Every mask has the surface all the same.
enum class ShadingModel : std::uint8_t { metallic_roughness, phong, unlit, horizon };

struct Material {
    std::string name;
    ShadingModel model = ShadingModel::metallic_roughness;
    AlphaMode alpha_mode = AlphaMode::opaque;
    float alpha_cutoff = 0.5F;
    bool double_sided = false;
    glm::vec4 base_colour{1.0F}; // linear, alpha is coverage
    float metallic = 1.0F;
    float roughness = 1.0F;
    /// Blended: the surface colours light and lets 1 - alpha (1 - colour) of it through; else 1 - alpha.
    bool stained = false;
    float phong_exponent = 8.0F; // for ShadingModel::phong only
    /// Opaque materials: the brightness of windows that are lit when a physical sky is dark. In full where the vertex
    /// colours' alpha is 0, not at all where it is 1.
    float lit_by_night = 0.0F;
    glm::vec3 emissive{0.0F}; // linear, KHR_materials_emissive_strength multiplied in
    float normal_scale = 1.0F;
    float occlusion_strength = 1.0F;
    TextureUse base_colour_texture;
    TextureUse metallic_roughness_texture; // G roughness, B metallic
    TextureUse normal_texture;
    TextureUse occlusion_texture; // R
    TextureUse emissive_texture;
};

/// Differences that a morph target adds; each vector is empty or as long as the primitive's positions.
struct MorphTarget {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<glm::vec3> tangents;
};

/// A prism's corners lean by 45 degrees where it has four sides, by 36 where it has five.
inline constexpr double kCreaseAngle_rad = 0.698; // 40 degrees

/// Triangles of one material. Every vector but `positions` and `indices` may be empty; what is there is as long as
/// `positions`. `normals` is always filled (the reader makes flat normals where a file has none). Quantised
/// attributes are already expanded. Indices are a triangle list, each below positions.size().
struct Primitive {
    std::vector<glm::vec3> positions; // from `origin`
    std::vector<glm::vec3> normals;
    std::vector<glm::vec4> tangents; // w = handedness
    std::vector<glm::vec2> uv0;
    std::vector<glm::vec2> uv1;
    std::vector<glm::vec4> colours; // linear RGBA
    std::vector<glm::u16vec4> joints;
    std::vector<glm::vec4> weights; // sum 1
    std::vector<std::uint32_t> indices;
    std::vector<MorphTarget> morph_targets;
    std::uint32_t material = kNone; // kNone: the default material
    Aabb bounds;                    // bounds of the undeformed positions, from `origin`
    /// In the mesh's space. Not 0 where the whole primitive lies far from that space's origin, so that single precision
    /// keeps its shape. Made by finishScene(); 0 where a skin deforms it.
    glm::vec3 origin{0.0F};
    /// 1 at a vertex whose normal leans away from one of its triangles' by more than kCreaseAngle_rad: it rounds off a
    /// real edge, or is not the surface's own, as with foliage. Made by finishScene().
    std::vector<std::uint8_t> creased;
};

struct Mesh {
    std::string name;
    std::vector<Primitive> primitives;
    std::vector<float> morph_weights; // defaults, one per target
};

/// Translation, then rotation, then scale, applied to a point in reverse order. A node given as a matrix that has no
/// such parts keeps the matrix, and no animation may target it.
struct Transform {
    glm::vec3 translation{0.0F};
    glm::quat rotation{1.0F, 0.0F, 0.0F, 0.0F};
    glm::vec3 scale{1.0F};

    [[nodiscard]] glm::mat4 matrix() const;
};

/// The planes that cut an object: where dot(plane.xyz, p) + plane.w < 0 for either plane, with p in the space of its
/// vertices, the object is neither seen, nor casts, nor receives. Normals are unit length.
using ClipPlanes = std::array<glm::vec4, 2>;
inline constexpr glm::vec4 kNoClipPlane{0.0F, 0.0F, 0.0F, 1.0F}; // cuts nothing
inline constexpr ClipPlanes kNoClipPlanes{kNoClipPlane, kNoClipPlane};

struct Node {
    std::string name;
    std::uint32_t parent = kNone; // always a smaller index than the node's own, or kNone
    Transform transform;
    glm::mat4 matrix{1.0F};
    bool use_matrix = false; // `matrix` holds instead of `transform`
    std::uint32_t mesh = kNone;
    std::uint32_t skin = kNone;
    std::uint32_t camera = kNone;
    std::uint32_t light = kNone;
    std::vector<float> morph_weights; // empty: the mesh's
    std::vector<glm::mat4> instances; // node_from_instance; empty: the node's mesh once at the node
    bool casts = true;                // per-object flags of the shadow system
    bool receives = true;
    std::uint32_t groups = 1; // caster groups, a bit each, that its mesh is in; 0: it casts to no map
    float bias_m = 0.0F;      // maps have its mesh this much farther from lights, metres; finite
    /// The planes of the node's mesh, or of each of its instances, in their own space; for a skinned mesh in world
    /// space, where its vertices are. Children have their own. Nothing animates them.
    ClipPlanes clip_planes = kNoClipPlanes;
    bool dynamic = false; // hint: moves by a procedural animator or an animation channel (filled by finishScene)
};

struct Skin {
    std::string name;
    std::vector<std::uint32_t> joints;   // nodes
    std::vector<glm::mat4> inverse_bind; // joint_from_mesh, as many as joints
};

enum class AnimationPath : std::uint8_t { translation, rotation, scale, weights };
enum class Interpolation : std::uint8_t { step, linear, cubic_spline };

/// `values` holds floats: 3, 4 (x y z w) or target-count components per key; three times as many for cubic_spline
/// (in-tangent, value, out-tangent). Times are strictly increasing, in seconds.
struct AnimationChannel {
    std::uint32_t node = kNone;
    AnimationPath path = AnimationPath::translation;
    Interpolation interpolation = Interpolation::linear;
    std::vector<float> times_s;
    std::vector<float> values;
};

struct Animation {
    std::string name;
    std::vector<AnimationChannel> channels;
    float duration_s = 0.0F;
};

/// Perspective (vertical field of view) or orthographic, looking down the node's -z.
struct Camera {
    std::string name;
    bool orthographic = false;
    float fov_y_rad = 0.8F;
    float half_height_m = 1.0F; // orthographic only
    float near_m = 0.1F;
    float far_m = 0.0F; // 0: infinite; renderers pick one from the scene's bounds
};

enum class LightType : std::uint8_t { directional, spot, point };

/// The body of a directional light under a physical sky. `sun` and `moon` have the colour and strength that the air
/// leaves them at their height; Light::colour is their light from above, for the moon the hue alone. `none`: it keeps
/// colour and strength, as lights of files do.
enum class Body : std::uint8_t { none, sun, moon };

/// KHR_lights_punctual, shining down the node's -z, with what shadows need besides.
struct Light {
    std::string name;
    LightType type = LightType::directional;
    glm::vec3 colour{1.0F};      // linear
    float intensity = 1.0F;      // lux for directional, candela for spot and point
    float range_m = 0.0F;        // 0: unlimited
    float inner_cone_rad = 0.0F; // half angles
    float outer_cone_rad = 0.7853982F;
    float angular_diameter_rad = 0.00925025F; // directional: 0.53 degrees, the sun
    float radius_m = 0.0F;                    // spot and point: sphere radius of the emitter
    std::uint32_t cookie = kNone;             // spot: an image projected down its cone, or kNone
    bool casts_shadow = true;
    std::uint32_t groups = 0xFFFFFFFFU; // groups of casters that it makes shadows of (Node::groups)
    Body body = Body::none;
};

/// Sky and ambient of a world; files get the defaults.
struct Environment {
    glm::vec3 sky_zenith{0.18F, 0.34F, 0.62F}; // linear radiance
    glm::vec3 sky_horizon{0.62F, 0.72F, 0.82F};
    glm::vec3 ground{0.22F, 0.20F, 0.17F};
    float ambient = 0.35F; // multiplies the hemisphere light
    float exposure = 1.0F;
    glm::vec3 ground_albedo{0.22F, 0.20F, 0.17F}; // under a physical sky, which ignores the others
};

/// A view by name: a camera that is not part of the node tree (built-in worlds).
struct NamedView {
    std::string name;
    glm::vec3 eye{0.0F};
    glm::vec3 target{0.0F, 0.0F, -1.0F};
    float fov_y_rad = 0.8F;
};

struct Scene {
    std::string name;
    std::vector<Image> images;
    std::vector<Texture> textures;
    std::vector<Material> materials;
    std::vector<Mesh> meshes;
    std::vector<Node> nodes; // parents before children
    std::vector<Skin> skins;
    std::vector<Animation> animations; // the first plays, unless another is asked for by name
    std::vector<Camera> cameras;
    std::vector<Light> lights;
    std::vector<NamedView> views;
    Environment environment;
    /// Built-in worlds move their nodes here: sets transforms of `nodes` for a time in seconds. Must be a pure
    /// function of the time (frames may be drawn in any order). Null for files.
    std::function<void(double time_s, std::vector<Node>& nodes)> procedural;
    /// Built-in worlds change their lights' strength and their sky here, as pure functions of the time as well.
    /// `strengths` has one per light, each 1 when it is called: what the light gives now for each colour channel, as a
    /// share of Light::colour * intensity. `environment` is Scene::environment when it is called. Null where neither
    /// changes.
    std::function<void(double time_s, std::span<glm::vec3> strengths, Environment& environment)> daylight;
    std::vector<std::string> notices; // things that were read and have no effect, a sentence each
};

} // namespace gnomon::scene
