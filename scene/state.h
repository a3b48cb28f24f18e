// SPDX-License-Identifier: Apache-2.0
// A scene at one moment: the places of all objects, and deformed geometry. Only this evaluates animation, skins and
// morph targets; the rasteriser and the ray tracer both draw its result.
#pragma once

#include "scene/model.h"

#include <string>
#include <vector>

namespace gnomon::scene {

/// One thing to draw: a primitive at a place. Its index in State::objects is stable over time; the object id that
/// shows up in id buffers is index + 1.
struct Object {
    std::uint32_t node = kNone;
    std::uint32_t mesh = kNone;
    std::uint32_t primitive = 0;    // within the mesh
    std::uint32_t instance = kNone; // within Node::instances, or kNone
    std::uint32_t deformed = kNone; // index into State::deformed when skinned or morphed
    std::uint32_t material = kNone;
    bool casts = true;
    bool receives = true;
    std::uint32_t groups = 1;               // Node::groups
    float bias_m = 0.0F;                    // Node::bias_m
    bool dynamic = false;                   // may move or deform over time
    ClipPlanes clip_planes = kNoClipPlanes; // in the space of its vertices
    glm::mat4 world_from_object{1.0F};      // identity for skinned objects: their vertices are in world space
    Aabb bounds_ws;                         // bounds of the part that the planes leave; empty where they leave nothing
};

/// Vertices of a skinned or morphed primitive now, as long as the primitive's positions. Skinned: world space.
/// Morphed only: object space.
struct DeformedPrimitive {
    std::uint32_t object = kNone;
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<glm::vec4> tangents; // empty if the primitive has none
};

struct PlacedLight {
    std::uint32_t light = kNone; // index into Scene::lights
    glm::vec3 position_ws{0.0F};
    glm::vec3 direction_ws{0.0F, -1.0F, 0.0F}; // unit, the way the light travels
    glm::vec3 up_ws{0.0F, 0.0F, 1.0F};         // unit, perpendicular to direction: orients a cookie
    glm::vec3 strength{1.0F}; // >= 0: the present share of the light's colour * intensity; 0: it is out
};

struct PlacedCamera {
    std::uint32_t camera = kNone;
    glm::vec3 eye_ws{0.0F};
    glm::vec3 forward_ws{0.0F, 0.0F, -1.0F};
    glm::vec3 up_ws{0.0F, 1.0F, 0.0F};
};

struct State {
    double time_s = 0.0;
    std::vector<Node> nodes; // Scene::nodes with animated transforms
    std::vector<glm::mat4> world_from_node;
    std::vector<Object> objects;
    std::vector<DeformedPrimitive> deformed;
    std::vector<PlacedLight> lights;
    std::vector<PlacedCamera> cameras;
    Environment environment; // sky and ambient now
    Aabb bounds_ws;          // bounds of all objects

    // Indices that `advance` visits, ascending, and its working memory; made by `evaluate`.
    std::vector<std::uint32_t> dynamic_nodes;
    std::vector<std::uint32_t> dynamic_objects;
    std::vector<std::uint32_t> light_and_camera_nodes;
    std::vector<glm::mat4> joint_matrices;
    std::vector<glm::vec3> light_strengths; // one per light of the scene
    Aabb static_bounds_ws;                  // bounds of the objects that never move
};

/// Builds the objects of `scene` and evaluates it at `time_s`. `animation` names the animation to play; empty plays
/// the first. Throws Error (gnomon/error.h) naming the animations there are when `animation` is none of them.
[[nodiscard]] State evaluate(const Scene& scene, double time_s, const std::string& animation = {});

/// Moves `state` (made by `evaluate` from the same scene and animation) to another time. Allocates nothing once
/// warm; static objects are not touched.
void advance(const Scene& scene, double time_s, State& state, const std::string& animation = {});

/// Fills derived data: primitive bounds, normals that are missing or of length 0, tangents where a normal map needs
/// them, Node::dynamic. Readers and world makers call it last. Throws Error when a parent does not precede its child.
void finishScene(Scene& scene);

} // namespace gnomon::scene
