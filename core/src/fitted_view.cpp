// SPDX-License-Identifier: Apache-2.0
#include <gnomon/plan.h>

#include <glm/gtc/matrix_access.hpp>

#include <algorithm>

namespace gnomon {

View viewAsFitted(const View& base, const FittedView& found)
{
    View view = base;
    const glm::dvec4 w = glm::row(base.projection.clip_from_world, 3);
    for (int axis = 0; axis < 2; ++axis) {
        const glm::dvec4 row = glm::row(base.projection.clip_from_world, axis);
        view.projection.clip_from_world =
            glm::row(view.projection.clip_from_world, axis, (row - w * found.centre[axis]) * found.scale[axis]);
    }
    view.projection.texel_xy_m = base.projection.texel_xy_m / found.scale;
    view.projection.texel_m = std::max(view.projection.texel_xy_m.x, view.projection.texel_xy_m.y);
    view.fit.finest_texel = base.fit.finest_texel / found.scale;
    view.fit.coarsest_texel = base.fit.coarsest_texel / found.scale;
    view.serves.slice.begin_m = found.begin_m;
    view.serves.slice.end_m = found.end_m;
    view.serves.slice.blend_m = found.blend_m;
    return view;
}

} // namespace gnomon
