// SPDX-License-Identifier: Apache-2.0
#include "scene/state.h"

#include "animation.h"
#include "deform.h"

#include "scene/clip.h"

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace gnomon::scene {

namespace {

/// Product of two affine matrices; the bottom row is known, which saves a quarter of the work.
glm::mat4 multiplyAffine(const glm::mat4& a, const glm::mat4& b)
{
    glm::mat4 r;
    for (int c = 0; c < 4; ++c) {
        r[c] = a[0] * b[c].x + a[1] * b[c].y + a[2] * b[c].z;
    }
    r[3] += a[3];
    return r;
}

void placeNode(State& state, std::uint32_t index)
{
    const Node& node = state.nodes[index];
    const glm::mat4 parent_from_node = node.use_matrix ? node.matrix : node.transform.matrix();
    state.world_from_node[index] =
        node.parent == kNone ? parent_from_node : multiplyAffine(state.world_from_node[node.parent], parent_from_node);
}

const Primitive& primitiveOf(const Scene& scene, const Object& object)
{
    return scene.meshes[object.mesh].primitives[object.primitive];
}

/// `box`: around its vertices.
void boundObject(Object& object, const Aabb& box)
{
    const Aabb left = clipped(box, object.clip_planes);
    object.bounds_ws = left.empty() ? left : transform(object.world_from_object, left);
}

void deformObject(const Scene& scene, State& state, Object& object)
{
    const Node& node = state.nodes[object.node];
    std::span<const glm::mat4> joint_matrices;
    if (node.skin != kNone) {
        const Skin& skin = scene.skins[node.skin];
        for (std::size_t j = 0; j < skin.joints.size(); ++j) {
            const glm::mat4& world_from_joint = state.world_from_node[skin.joints[j]];
            state.joint_matrices[j] =
                j < skin.inverse_bind.size() ? world_from_joint * skin.inverse_bind[j] : world_from_joint;
        }
        joint_matrices = std::span<const glm::mat4>(state.joint_matrices).first(skin.joints.size());
    }
    DeformedPrimitive& deformed = state.deformed[object.deformed];
    boundObject(object, deform(primitiveOf(scene, object), node.morph_weights, joint_matrices, deformed));
}

void placeObject(const Scene& scene, State& state, std::uint32_t index)
{
    Object& object = state.objects[index];
    const Node& node = state.nodes[object.node];
    const bool skinned = object.deformed != kNone && node.skin != kNone;
    if (!skinned) {
        const glm::mat4& world_from_node = state.world_from_node[object.node];
        object.world_from_object = object.instance == kNone
                                       ? world_from_node
                                       : multiplyAffine(world_from_node, node.instances[object.instance]);
        const glm::vec3& origin = primitiveOf(scene, object).origin;
        if (origin != glm::vec3(0.0F)) {
            object.world_from_object =
                multiplyAffine(object.world_from_object, glm::translate(glm::mat4(1.0F), origin));
        }
    }
    if (object.deformed != kNone) {
        deformObject(scene, state, object);
    } else {
        boundObject(object, primitiveOf(scene, object).bounds);
    }
}

glm::vec3 unitOr(const glm::vec3& v, const glm::vec3& otherwise)
{
    const float length = glm::length(v);
    return length > 0.0F && std::isfinite(length) ? v / length : otherwise;
}

struct Placement {
    glm::vec3 position{0.0F};
    glm::vec3 forward{0.0F, 0.0F, -1.0F};
    glm::vec3 up{0.0F, 1.0F, 0.0F};
};

/// Down -z with +y up, made orthonormal because a node may be scaled.
Placement placementOf(const glm::mat4& world_from_node)
{
    Placement p;
    p.position = glm::vec3(world_from_node[3]);
    p.forward = unitOr(-glm::vec3(world_from_node[2]), p.forward);
    const glm::vec3 right = unitOr(glm::cross(p.forward, glm::vec3(world_from_node[1])), {1.0F, 0.0F, 0.0F});
    p.up = unitOr(glm::cross(right, p.forward), p.up);
    return p;
}

void placeLightsAndCameras(State& state)
{
    std::size_t light = 0;
    std::size_t camera = 0;
    for (const std::uint32_t index : state.light_and_camera_nodes) {
        const Node& node = state.nodes[index];
        const Placement p = placementOf(state.world_from_node[index]);
        if (node.light != kNone) {
            state.lights[light++] = {node.light, p.position, p.forward, p.up, state.light_strengths[node.light]};
        }
        if (node.camera != kNone) {
            state.cameras[camera++] = {node.camera, p.position, p.forward, p.up};
        }
    }
}

void applyTime(const Scene& scene, const Animation* animation, double time_s, State& state)
{
    state.time_s = time_s;
    if (animation != nullptr) {
        applyAnimation(*animation, time_s, state.nodes);
    }
    if (scene.procedural) {
        scene.procedural(time_s, state.nodes);
    }
    state.environment = scene.environment;
    if (scene.daylight) {
        std::fill(state.light_strengths.begin(), state.light_strengths.end(), glm::vec3(1.0F));
        scene.daylight(time_s, state.light_strengths, state.environment);
    }
}

bool movesOrDeforms(const Scene& scene, const Node& node)
{
    if (node.dynamic || node.skin == kNone) {
        return node.dynamic;
    }
    const std::vector<std::uint32_t>& joints = scene.skins[node.skin].joints;
    return std::any_of(joints.begin(), joints.end(), [&](std::uint32_t j) { return scene.nodes[j].dynamic; });
}

void addObjects(const Scene& scene, std::uint32_t node_index, State& state)
{
    const Node& node = scene.nodes[node_index];
    const Mesh& mesh = scene.meshes[node.mesh];
    const bool dynamic = movesOrDeforms(scene, node);
    for (std::uint32_t p = 0; p < mesh.primitives.size(); ++p) {
        const Primitive& primitive = mesh.primitives[p];
        Object object{.node = node_index, .mesh = node.mesh, .primitive = p, .material = primitive.material};
        object.casts = node.casts;
        object.receives = node.receives;
        object.groups = node.groups;
        object.bias_m = node.bias_m;
        object.clip_planes = node.clip_planes;
        for (glm::vec4& plane : object.clip_planes) {
            plane.w += glm::dot(glm::vec3(plane), primitive.origin);
        }
        object.dynamic = dynamic;
        // Skinned vertices are in world space already, so there is one place only for them.
        const bool once = node.instances.empty() || (node.skin != kNone && deforms(node, primitive));
        const std::size_t copies = once ? 1 : node.instances.size();
        for (std::size_t i = 0; i < copies; ++i) {
            object.instance = once ? kNone : static_cast<std::uint32_t>(i);
            object.deformed = deforms(node, primitive) ? 0 : kNone; // numbered once the order is known
            state.objects.push_back(object);
        }
    }
}

void addDeformed(const Scene& scene, State& state)
{
    for (std::uint32_t i = 0; i < state.objects.size(); ++i) {
        Object& object = state.objects[i];
        if (object.deformed != kNone) {
            object.deformed = static_cast<std::uint32_t>(state.deformed.size());
            state.deformed.emplace_back().object = i;
            prepareDeformed(primitiveOf(scene, object), state.deformed.back());
        }
    }
}

/// Everything that does not depend on time.
State build(const Scene& scene)
{
    State state;
    state.nodes = scene.nodes;
    state.world_from_node.resize(scene.nodes.size(), glm::mat4(1.0F));
    for (std::uint32_t i = 0; i < scene.nodes.size(); ++i) {
        Node& node = state.nodes[i];
        if (node.mesh != kNone) {
            if (node.morph_weights.empty()) {
                node.morph_weights = scene.meshes[node.mesh].morph_weights;
            }
            addObjects(scene, i, state);
        }
        if (node.dynamic) {
            state.dynamic_nodes.push_back(i);
        }
        if (node.light != kNone || node.camera != kNone) {
            state.light_and_camera_nodes.push_back(i);
            state.lights.resize(state.lights.size() + (node.light != kNone ? 1 : 0));
            state.cameras.resize(state.cameras.size() + (node.camera != kNone ? 1 : 0));
        }
    }
    // A renderer can then merge neighbours into one instanced draw.
    std::stable_sort(state.objects.begin(), state.objects.end(), [](const Object& a, const Object& b) {
        return std::tie(a.mesh, a.primitive) < std::tie(b.mesh, b.primitive);
    });
    addDeformed(scene, state);
    std::size_t most_joints = 0;
    for (const Skin& skin : scene.skins) {
        most_joints = std::max(most_joints, skin.joints.size());
    }
    state.joint_matrices.resize(most_joints);
    state.light_strengths.resize(scene.lights.size(), glm::vec3(1.0F));
    return state;
}

} // namespace

State evaluate(const Scene& scene, double time_s, const std::string& animation)
{
    const Animation* playing = findAnimation(scene, animation);
    State state = build(scene);
    applyTime(scene, playing, time_s, state);
    for (std::uint32_t i = 0; i < state.nodes.size(); ++i) {
        placeNode(state, i);
    }
    for (std::uint32_t i = 0; i < state.objects.size(); ++i) {
        placeObject(scene, state, i);
        state.bounds_ws = merge(state.bounds_ws, state.objects[i].bounds_ws);
        if (state.objects[i].dynamic) {
            state.dynamic_objects.push_back(i);
        } else {
            state.static_bounds_ws = merge(state.static_bounds_ws, state.objects[i].bounds_ws);
        }
    }
    placeLightsAndCameras(state);
    return state;
}

void advance(const Scene& scene, double time_s, State& state, const std::string& animation)
{
    applyTime(scene, findAnimation(scene, animation), time_s, state);
    for (const std::uint32_t index : state.dynamic_nodes) {
        placeNode(state, index);
    }
    Aabb bounds_ws = state.static_bounds_ws;
    for (const std::uint32_t index : state.dynamic_objects) {
        placeObject(scene, state, index);
        bounds_ws = merge(bounds_ws, state.objects[index].bounds_ws);
    }
    state.bounds_ws = bounds_ws;
    placeLightsAndCameras(state);
}

} // namespace gnomon::scene
