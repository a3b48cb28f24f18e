// SPDX-License-Identifier: Apache-2.0
// Rows that take an object's own points to a map, for vertex shaders with gnomon/caster.glsl.
#pragma once

#include <gnomon/export.h>
#include <gnomon/plan.h>

#include <glm/vec4.hpp>

#include <array>
#include <cstdint>

namespace gnomon::pack {

/// An affine transform: its three rows. p_ws[i] = dot(row i, (p, 1)).
struct Rows3x4 {
    glm::vec4 x{1.0F, 0.0F, 0.0F, 0.0F}; // row of x
    glm::vec4 y{0.0F, 1.0F, 0.0F, 0.0F}; // row of y
    glm::vec4 z{0.0F, 0.0F, 1.0F, 0.0F}; // row of z
};

/// The number of rows in an instance's data: x, y and the metric for an orthographic view; x, y, z, w and the metric
/// for any other. For a paraboloid only the last number of w and of the metric counts (ViewProjection::paraboloid).
[[nodiscard]] constexpr std::uint32_t casterRowCount(bool orthographic)
{
    return orthographic ? 3 : 5;
}

/// The rows of one view, to be composed with the transforms of many objects.
class GNOMON_API CasterRows {
public:
    CasterRows() = default;
    /// The rows of this view; it need not outlive the call.
    explicit CasterRows(const View& view);
    /// Writes casterRowCount() rows, each the view's times the object's transform, composed in double precision:
    /// objects may be at any distance from the world's origin. Depth is moved `bias_m` metres (DepthMetric's) away from
    /// the light. Returns one past the last.
    glm::vec4* write(const Rows3x4& world_from_object, glm::vec4* out, double bias_m = 0.0) const;

private:
    std::array<glm::dvec4, casterRowCount(false)> rows_{};
    std::uint32_t count_ = 0;
    double per_metre_ = 0.0; // growth of the metric per metre
};

/// The inputs of gnomonCasterIdTexel() (caster.glsl), by which a caster writes to a map of filter id or depth-id; with
/// IdOf::face also of gnomonCasterPieceId().
struct CasterId {
    /// Takes a point of the world to the depth that goes beside the id, 0 .. 1: IdDepth.
    glm::dvec4 depth_ws{0.0};
    float id = 0.0F;  // as stored, 0 .. 1; with IdOf::face the id of the object's first piece
    float ids = 1.0F; // the number of ids besides 0
};
/// The id of an object of the plan, in a view of a light that has ids (Plan::object_ids).
[[nodiscard]] GNOMON_API CasterId casterIdOf(const Plan& plan, const View& view, std::uint32_t object);
/// Turns a row for points of the world into one for the object's own points.
[[nodiscard]] GNOMON_API glm::vec4 composedRow(const glm::dvec4& row_ws, const Rows3x4& world_from_object);

} // namespace gnomon::pack
