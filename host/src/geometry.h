// SPDX-License-Identifier: Apache-2.0
// A scene's triangles on the GPU: streams of positions, of texture coordinates and of all other attributes, so that
// shadow maps read 12 bytes a vertex. Deformed primitives have ranges of their own that are rewritten each frame.
#pragma once

#include "commands.h"
#include "scene/pieces.h"
#include "scene/state.h"

#include <gnomon/object_set.h>
#include <gnomon/vulkan/draw_batcher.h>

#include <glm/vec2.hpp>

#include <array>
#include <vector>

namespace gnomon::host {

/// One vertex of the attribute stream.
struct VertexAttributes {
    std::array<std::int16_t, 4> normal{};  // snorm; w: kCreasedVertex and scene::Pieces, as integers
    std::array<std::int8_t, 4> tangent{};  // snorm; w handedness, 0: no tangent
    std::array<std::uint16_t, 4> colour{}; // unorm, linear: casters read it, too
    glm::vec2 uv_other{0.0F};              // the set that the base colour does not use
};
static_assert(sizeof(VertexAttributes) == 28);

/// In the last of VertexAttributes::normal, above the vertex's piece: Primitive::creased.
inline constexpr std::int16_t kCreasedVertex = 4096;
static_assert(kCreasedVertex == kMostPieces && kMostPieces == scene::kMostPieces);

class Geometry {
public:
    Geometry(Memory& memory, Uploader& uploader, const scene::Scene& scene, const scene::State& state);

    /// Where the triangles of an object are.
    [[nodiscard]] vulkan::MeshRange range(const scene::Object& object) const;
    /// The number of pieces of an object, for ObjectFlags::pieces.
    [[nodiscard]] std::uint16_t pieces(const scene::Object& object) const;
    [[nodiscard]] bool deforms() const { return deformed_vertices_ > 0; }
    /// Do normals of its triangles lean, so that a smooth surface may lie over them (smooth_surface.h)?
    [[nodiscard]] bool isSmooth(const scene::Object& object) const;
    /// A buffer for one frame's deformed vertices.
    [[nodiscard]] Buffer makeStaging(Memory& memory) const;
    /// Writes the deformed vertices of `state` to `staging`, from where recordDeformed() copies them to their ranges.
    void writeDeformed(const scene::Scene& scene, const scene::State& state, const Buffer& staging) const;
    void recordDeformed(VkCommandBuffer commands, const Buffer& staging) const;

    Buffer positions;
    Buffer uvs;
    Buffer attributes;
    Buffer indices;

private:
    struct Range {
        std::uint32_t first_index = 0;
        std::uint32_t first_vertex = 0;
        bool used = false; // by an object that does not deform
        bool smooth = false;
    };
    void place(const scene::Scene& scene, const scene::State& state);
    void upload(Uploader& uploader, const scene::Scene& scene, const scene::State& state);
    void uploadRigid(Uploader& uploader, const scene::Primitive& primitive, const scene::Pieces& pieces,
                     const scene::Scene& scene, std::uint32_t first_vertex) const;

    std::vector<std::uint32_t> first_primitive_; // per mesh, into ranges_
    std::vector<Range> ranges_;
    std::vector<scene::Pieces> pieces_; // as ranges_; of those that are drawn
    std::vector<std::uint32_t> index_counts_;
    std::vector<std::uint32_t> deformed_first_; // per State::deformed, counted from static_vertices_
    std::uint32_t static_vertices_ = 0;
    std::uint32_t deformed_vertices_ = 0;
    std::uint32_t index_total_ = 0;
};

} // namespace gnomon::host
