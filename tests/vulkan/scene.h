// SPDX-License-Identifier: Apache-2.0
// Boxes over a ground plane, drawn for the maps by CasterDrawer and seen by the camera through rays, so that depth and
// normals owe nothing to a rasteriser.
#pragma once

#include "harness.h"

#include <gnomon/vulkan/caster_drawer.h>
#include <gnomon/vulkan/classics.h>

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace gnomon::test {

/// A box: centre, half extents, turned about y.
struct Box {
    glm::dvec3 centre{0.0};
    glm::dvec3 half{1.0};
    double angle = 0.0;
};

struct Hit {
    double t = 0.0;
    glm::dvec3 normal{0.0};
    std::uint32_t object = 0; // 0: ground; i + 1: box i
};

struct Scene {
    std::vector<Box> boxes;
    double ground_half = 30.0; // the ground is the square |x|, |z| <= this at y = 0

    [[nodiscard]] std::vector<vulkan::Rows3x4> transforms() const; // by object
    [[nodiscard]] std::optional<Hit> trace(const glm::dvec3& origin, const glm::dvec3& direction) const;
};
[[nodiscard]] Scene makeScene();

/// Edges of the scene's meshes, as FinDrawer has them: of the ground's quad, and of the cube.
struct SceneEdges {
    std::vector<glm::vec3> positions;
    std::vector<glm::uvec4> elements;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::array<vulkan::VolumeMesh, 2> meshes;
};
[[nodiscard]] SceneEdges sceneEdges();

/// The scene's mesh: a quad of 6 indices from vertex 0 on, then a cube of 36 from vertex 4 on.
struct TestMesh {
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> indices;
};
[[nodiscard]] TestMesh testMesh();

/// The scene's mesh (a unit quad and a unit cube) on the GPU and what CasterDrawer needs.
struct SceneMesh {
    vulkan::CasterGeometry geometry;
    std::vector<vulkan::DrawPart> parts;
    std::vector<vulkan::DrawObject> objects;
    std::vector<vulkan::CasterBatch> batches;
    vulkan::VolumeGeometry edges;
    std::vector<vulkan::VolumeMesh> outlines; // by object
    std::uint32_t vertex_count = 0;
    void* mapped_indices = nullptr;
};
[[nodiscard]] SceneMesh uploadMesh(Gpu& gpu, const Scene& scene);

/// Gives each side of the mesh's cube its own vertices, so that it has six pieces (CasterGeometry::pieces, of 32 bits).
/// `mapped_indices` and `vertex_count` are no longer of use.
inline constexpr vulkan::VertexAttribute kPieceOfVertex{VK_FORMAT_R32_UINT, 4, 0};
void partSides(Gpu& gpu, SceneMesh& mesh);

[[nodiscard]] Camera makeCamera(glm::dvec3 eye, glm::dvec3 target, double aspect, bool reversed_z = true);

/// The camera's picture, per pixel.
struct Picture {
    VkExtent2D extent{};
    std::vector<float> depth;
    std::vector<glm::dvec3> position; // on the surface; meaningless in the background
    std::vector<glm::dvec3> normal;   // 0 in the background
    std::vector<std::uint32_t> object_plus_one;
    std::vector<std::uint32_t> piece; // of the object, as partSides() has them
    std::vector<glm::i16vec2> octahedral;
};
[[nodiscard]] Picture tracePicture(const Scene& scene, const Camera& camera, VkExtent2D extent);

/// Lights and their views over the scene, made without the planner.
[[nodiscard]] Light makeSun(glm::dvec3 direction);
[[nodiscard]] Light makeSpot(glm::dvec3 position, glm::dvec3 target, double half_angle);
/// A view that covers the whole scene (sun) or cone (spot). `light` is its index.
[[nodiscard]] View makeView(const Scene& scene, const Light& light, std::uint32_t index, Tile tile);
/// As a planner with these options has them.
[[nodiscard]] std::shared_ptr<const std::vector<ResolvedOptions>> planOptions(const ShadowOptions& options);
/// One view a light; casters: everything.
[[nodiscard]] Plan makePlan(const Scene& scene, std::span<const Light> lights, std::span<const Tile> tiles,
                            MapPages atlas, const ShadowOptions& options = {.technique = kPlainTechnique});

/// Names the maps of plans that are made by hand, by their place among the views, and numbers their contents by what
/// the views' flags say of them: `redraw` makes something new of the map, `redraw_kept` of the kept one.
class MapNames {
public:
    /// To be called with each plan that is recorded, in their order.
    void name(Plan& plan);

private:
    struct Contents {
        ContentNumber map = 0;
        ContentNumber kept = 0;
    };
    std::vector<Contents> contents_; // by view
};

} // namespace gnomon::test
