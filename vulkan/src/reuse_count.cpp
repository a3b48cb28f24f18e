// SPDX-License-Identifier: Apache-2.0
#include "reuse_count.h"

#include "draw_view.h"

#include <gnomon/plan_views.h>

namespace gnomon::vulkan {

MapReuse countReuse(const Plan& plan, std::span<const pack::ViewWork> work)
{
    MapReuse reuse;
    for (std::size_t i = 0; i < plan.views.size(); ++i) {
        const View& view = plan.views[i];
        const auto count = [&](pack::CasterShare share) {
            return static_cast<std::uint32_t>(pack::castersOf(plan, view, share).size());
        };
        const bool kept = view.contents.kept_layer != kNoIndex;
        if (!work[i].draw) {
            ++reuse.held;
        } else if (!kept) {
            ++reuse.drawn;
            reuse.casters_at_once += count(pack::CasterShare::all);
        } else {
            if (work[i].draw_kept) {
                ++reuse.kept_drawn;
                reuse.still_casters += count(pack::CasterShare::still);
            }
            const VkRect2D area =
                optionsOf(plan, view).filterable() ? areaOf(view.place.tile) : redrawnArea(view, work[i].whole);
            ++reuse.restored;
            reuse.restored_texels += std::uint64_t{area.extent.width} * area.extent.height;
            reuse.moving_casters += count(pack::CasterShare::moving);
        }
    }
    for (std::uint32_t i = 0; i < plan.views.size();) {
        const std::uint32_t count = drawnTogether(plan, work, i);
        reuse.together += count > 1 ? count : 0;
        i += count;
    }
    return reuse;
}

} // namespace gnomon::vulkan
