// SPDX-License-Identifier: Apache-2.0
#include <gnomon/pack/caster_rows.h>

#include <gnomon/object_ids.h>
#include <gnomon/plan_views.h>

#include <gnomon/shared/object_ids.h>

#include <glm/gtc/matrix_access.hpp>

namespace gnomon::pack {
namespace {

// Row vector of the map times an object's transform: what the vertex shader multiplies the object's own points by.
glm::vec4 composed(const glm::dvec4& row, const Rows3x4& t)
{
    return {row.x * glm::dvec4(t.x) + row.y * glm::dvec4(t.y) + row.z * glm::dvec4(t.z) +
            glm::dvec4(0.0, 0.0, 0.0, row.w)};
}

} // namespace

CasterRows::CasterRows(const View& view)
    : count_(casterRowCount(view.projection.orthographic)),
      per_metre_(1.0 / (view.projection.metric.far_m - view.projection.metric.near_m))
{
    const auto row = [&](int i) {
        return glm::row(view.projection.clip_from_world, i);
    };
    const glm::dvec4 metric = view.projection.metric.metric_ws;
    if (view.projection.orthographic) {
        rows_ = {row(0), row(1), metric};
    } else {
        rows_ = {row(0), row(1), row(2), row(3), metric};
    }
}

glm::vec4* CasterRows::write(const Rows3x4& world_from_object, glm::vec4* out, double bias_m) const
{
    for (std::uint32_t i = 0; i < count_; ++i) {
        glm::dvec4 row = rows_[i];
        row.w += i + 1 == count_ ? bias_m * per_metre_ : 0.0; // the metric is the last
        *out++ = composed(row, world_from_object);
    }
    return out;
}

glm::vec4 composedRow(const glm::dvec4& row_ws, const Rows3x4& world_from_object)
{
    return composed(row_ws, world_from_object);
}

CasterId casterIdOf(const Plan& plan, const View& view, std::uint32_t object)
{
    const ResolvedOptions& options = optionsOf(plan, view);
    CasterId caster;
    caster.ids = static_cast<float>(idsOf(options.format()));
    caster.id = static_cast<float>(objectIdsOf(plan, view.light)[object]) / caster.ids;
    caster.depth_ws = view.projection.metric.metric_ws;
    if (options.ids().depth == IdDepth::object) {
        // objectDepth() of gnomon/shared/object_ids.h, in double precision.
        const Aabb& box = plan.object_bounds[object];
        const glm::dvec3 centre = 0.5 * (glm::dvec3(box.min) + glm::dvec3(box.max));
        const glm::dvec3 half = 0.5 * (glm::dvec3(box.max) - glm::dvec3(box.min));
        const glm::dvec3 along(view.projection.metric.metric_ws);
        const double extent =
            glm::dot(glm::abs(along), half) + double{shared::kObjectPad} * glm::length(along) * glm::length(half);
        caster.depth_ws = glm::dvec4(0.0, 0.0, 0.0, 0.5);
        if (extent > 0.0) {
            const glm::dvec3 row = along / (2.0 * extent);
            caster.depth_ws = glm::dvec4(row, 0.5 - glm::dot(row, centre));
        }
    }
    return caster;
}

} // namespace gnomon::pack
