// SPDX-License-Identifier: Apache-2.0
// The instanced parts that a scene's objects draw, for the camera and for casters, grouped by material.
#pragma once

#include "geometry.h"
#include "materials.h"

#include "scene/adjacency.h"

#include <gnomon/vulkan/caster_drawer.h>

#include <vector>

namespace gnomon::host {

/// Objects that are drawn in one go.
struct Batch {
    SurfaceKind kind = SurfaceKind::plain;
    bool two_sided = false;
    bool mirrored = false;
    std::uint32_t material = 0;
    std::uint32_t cut = 0;                          // DrawTable::cuts; 0: nothing cuts it
    auto operator<=>(const Batch&) const = default; // NOLINT(modernize-use-nullptr)
};

[[nodiscard]] vulkan::Rows3x4 rowsOf(const glm::mat4& m);

struct DrawTable {
    /// `closed_meshes`: closures().
    DrawTable(const Geometry& geometry, const Materials& materials, const scene::Scene& scene,
              const scene::State& state, const std::vector<scene::MeshClosure>& closed_meshes);

    std::vector<Batch> batches;
    std::vector<scene::ClipPlanes> cuts; // the first cuts nothing
    std::vector<vulkan::DrawPart> parts;
    std::vector<vulkan::DrawObject> objects;
    std::vector<vulkan::Rows3x4> transforms; // per object, as `state` has them
    // Casters' batches, parts and objects.
    std::vector<vulkan::CasterBatch> caster_batches;
    std::vector<vulkan::DrawPart> caster_parts;
    std::vector<vulkan::DrawObject> caster_objects;
    std::vector<float> biases_m;        // per object, for CasterDrawer::setBiases()
    std::vector<std::uint8_t> blended;  // per object: it tints the light instead of blocking it
    std::vector<std::uint8_t> closed;   // closedObjects()
    std::vector<std::uint8_t> outlined; // outlinedObjects()
    std::vector<std::uint16_t> pieces;  // pieceCounts()
    std::vector<std::uint8_t> joined;   // joinedObjects()
    // About opaque objects.
    bool all_receive = true;
    bool any_smooth = false; // Geometry::isSmooth()
    /// The mesh and the primitive of an object.
    struct Source {
        std::uint32_t mesh = 0;
        std::uint32_t primitive = 0;
        auto operator<=>(const Source&) const = default; // NOLINT(modernize-use-nullptr)
    };
    std::vector<Source> sources;

private:
    std::vector<std::uint32_t> numberCuts(const scene::State& state);
    std::vector<std::uint32_t> makeCasterBatches(const Materials& materials, const scene::Scene& scene);
};

} // namespace gnomon::host
