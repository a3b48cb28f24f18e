// SPDX-License-Identifier: Apache-2.0
// The hashes of a scene and of a state. A structured binding names all members of each struct, so that a new member
// does not compile until somebody has decided here whether it counts.
#include "scene/hash.h"

#include <cstdint>
#include <type_traits>
#include <vector>

namespace gnomon::scene {
namespace {

/// Numbers, and glm's vectors and matrices of them: nothing but their bytes.
template <typename T>
inline constexpr bool kIsFlat = std::is_arithmetic_v<T>;
template <glm::length_t N, typename T>
inline constexpr bool kIsFlat<glm::vec<N, T>> = sizeof(glm::vec<N, T>) == N * sizeof(T);
template <glm::length_t C, glm::length_t R, typename T>
inline constexpr bool kIsFlat<glm::mat<C, R, T>> = sizeof(glm::mat<C, R, T>) == sizeof(T) * C* R;

/// One overload per type; members of a class, so that each sees all others.
class Walk {
public:
    explicit Walk(Hasher& hasher) : hasher_(hasher) {}

    template <typename... T>
    void addEach(const T&... values)
    {
        (add(values), ...);
    }

private:
    template <typename T>
    requires std::is_arithmetic_v<T> || std::is_enum_v<T>
    void add(T value) { hasher_.add(value); }
    template <glm::length_t N, typename T>
    void add(const glm::vec<N, T>& value)
    {
        for (glm::length_t i = 0; i < N; ++i) {
            add(value[i]);
        }
    }
    template <glm::length_t C, glm::length_t R, typename T>
    void add(const glm::mat<C, R, T>& value)
    {
        for (glm::length_t i = 0; i < C; ++i) {
            add(value[i]);
        }
    }
    /// Its order in memory depends on how glm was configured.
    void add(const glm::quat& value) { addEach(value.w, value.x, value.y, value.z); }

    template <typename T>
    void add(const std::vector<T>& values)
    {
        if constexpr (kIsFlat<T>) {
            hasher_.addAll(values);
        } else {
            add(static_cast<std::uint64_t>(values.size()));
            for (const T& value : values) {
                add(value);
            }
        }
    }

    void add(const ClipPlanes& planes)
    {
        for (const glm::vec4& plane : planes) {
            add(plane);
        }
    }

    void add(const Aabb& box)
    {
        const auto& [min, max] = box;
        addEach(min);
        addEach(max);
    }

    void add(const Image& image)
    {
        const auto& [name, width, height, rgba] = image;
        addEach(width, height);
        addEach(rgba);
    }

    void add(const Texture& texture)
    {
        const auto& [image, wrap_u, wrap_v, magnify_linear, minify_linear, mipmaps] = texture;
        addEach(image, wrap_u, wrap_v, magnify_linear, minify_linear, mipmaps);
    }

    void add(const TextureUse& use)
    {
        const auto& [texture, uv_set, offset, scale, rotation_rad] = use;
        addEach(texture, uv_set, offset, scale, rotation_rad);
    }

    void add(const Material& material)
    {
        const auto& [name, model, alpha_mode, alpha_cutoff, double_sided, base_colour, metallic, roughness, stained,
                     phong_exponent, lit_by_night, emissive, normal_scale, occlusion_strength, base_colour_texture,
                     metallic_roughness_texture, normal_texture, occlusion_texture, emissive_texture] = material;
        addEach(model, alpha_mode, alpha_cutoff, double_sided, base_colour, metallic, roughness, phong_exponent);
        addEach(stained, lit_by_night);
        addEach(emissive, normal_scale, occlusion_strength, base_colour_texture, metallic_roughness_texture);
        addEach(normal_texture, occlusion_texture, emissive_texture);
    }

    void add(const MorphTarget& target)
    {
        const auto& [positions, normals, tangents] = target;
        addEach(positions, normals, tangents);
    }

    void add(const Primitive& primitive)
    {
        const auto& [positions, normals, tangents, uv0, uv1, colours, joints, weights, indices, morph_targets, material,
                     bounds, origin, creased] = primitive;
        addEach(positions, normals, tangents, uv0, uv1, colours, joints, weights, indices);
        addEach(morph_targets);
        addEach(material, bounds, origin);
    }

    void add(const Mesh& mesh)
    {
        const auto& [name, primitives, morph_weights] = mesh;
        addEach(primitives);
        addEach(morph_weights);
    }

    void add(const Transform& transform)
    {
        const auto& [translation, rotation, scale] = transform;
        addEach(translation, rotation, scale);
    }

    void add(const Node& node)
    {
        const auto& [name, parent, transform, matrix, use_matrix, mesh, skin, camera, light, morph_weights, instances,
                     casts, receives, groups, bias_m, clip_planes, dynamic] = node;
        addEach(parent, transform, matrix, use_matrix, mesh, skin, camera, light);
        addEach(morph_weights, instances);
        addEach(casts, receives, groups, bias_m, clip_planes, dynamic);
    }

    void add(const Skin& skin)
    {
        const auto& [name, joints, inverse_bind] = skin;
        addEach(joints, inverse_bind);
    }

    void add(const AnimationChannel& channel)
    {
        const auto& [node, path, interpolation, times_s, values] = channel;
        addEach(node, path, interpolation);
        addEach(times_s, values);
    }

    void add(const Animation& animation)
    {
        const auto& [name, channels, duration_s] = animation;
        addEach(channels);
        addEach(duration_s);
    }

    void add(const Camera& camera)
    {
        const auto& [name, orthographic, fov_y_rad, half_height_m, near_m, far_m] = camera;
        addEach(orthographic, fov_y_rad, half_height_m, near_m, far_m);
    }

    void add(const Light& light)
    {
        const auto& [name, type, colour, intensity, range_m, inner_cone_rad, outer_cone_rad, angular_diameter_rad,
                     radius_m, cookie, casts_shadow, groups, body] = light;
        addEach(type, colour, intensity, range_m, inner_cone_rad, outer_cone_rad, angular_diameter_rad, radius_m);
        addEach(cookie, casts_shadow, groups, body);
    }

    void add(const Environment& environment)
    {
        const auto& [sky_zenith, sky_horizon, ground, ambient, exposure, ground_albedo] = environment;
        addEach(sky_zenith, sky_horizon, ground, ambient, exposure, ground_albedo);
    }

    void add(const NamedView& view)
    {
        const auto& [name, eye, target, fov_y_rad] = view;
        addEach(eye, target, fov_y_rad);
    }

    void add(const Object& object)
    {
        const auto& [node, mesh, primitive, instance, deformed, material, casts, receives, groups, bias_m, dynamic,
                     clip_planes, world_from_object, bounds_ws] = object;
        addEach(node, mesh, primitive, instance, deformed, material, casts, receives, groups, bias_m, dynamic);
        addEach(clip_planes, world_from_object, bounds_ws);
    }

    void add(const DeformedPrimitive& deformed)
    {
        const auto& [object, positions, normals, tangents] = deformed;
        addEach(object);
        addEach(positions, normals, tangents);
    }

    void add(const PlacedLight& placed)
    {
        const auto& [light, position_ws, direction_ws, up_ws, strength] = placed;
        addEach(light, position_ws, direction_ws, up_ws);
    }

    void add(const PlacedCamera& placed)
    {
        const auto& [camera, eye_ws, forward_ws, up_ws] = placed;
        addEach(camera, eye_ws, forward_ws, up_ws);
    }

    Hasher& hasher_;
};

} // namespace

Hash128 sceneHash(const Scene& scene)
{
    // `procedural` and `daylight` are code; what they do to a moment is in the state.
    const auto& [name, images, textures, materials, meshes, nodes, skins, animations, cameras, lights, views,
                 environment, procedural, daylight, notices] = scene;
    Hasher hasher;
    Walk(hasher).addEach(images, textures, materials, meshes, nodes, skins, animations, cameras, lights, views,
                         environment);
    return hasher.value();
}

Hash128 stateHash(const State& state)
{
    // The time is left out: a world that stands still is the same at every moment. The hashed members already follow
    // from the nodes. The memory of `advance` does not describe this moment. The brightness of lights and sky changes
    // no visibility, for which a state is hashed.
    const auto& [time_s, nodes, world_from_node, objects, deformed, lights, cameras, sky, bounds_ws, dynamic_nodes,
                 dynamic_objects, light_and_camera_nodes, joint_matrices, light_strengths, static_bounds_ws] = state;
    Hasher hasher;
    Walk(hasher).addEach(world_from_node, objects, deformed, lights, cameras, bounds_ws);
    return hasher.value();
}

} // namespace gnomon::scene
