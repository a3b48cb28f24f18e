// SPDX-License-Identifier: Apache-2.0
// Inputs of the passes of Partition::sdsm, which fit cascades to the camera's depth buffer. A host whose own code
// dispatches them (door 3) does so in this order, with barriers between them; all shaders lie in shaders/passes, and
// all bindings are in set 0:
//   keys cleared to 0
//   cascade_depth.comp, cascade_bounds.comp   (groups over the screen, groupsOver(), 1 along z for each light)
//   cascade_finish.comp                       (1, 1, lights)
//   0  storage: GpuCascadeLight by light          3  storage: GpuFittedView by view of the plan, a copy for reports
//   1  storage: GpuCascadeKeys by light           4  sampled image: the camera's depth
//   2  storage: GpuFittedView by view of the plan 5  sampled image: object ids (variant GNOMON_OBJECT_IDS)
// Casters are then drawn with the base map's matrix and the view's GpuFittedView::place (gnomonCasterPlaced() in
// gnomon/caster.glsl). cascade_constants.comp completes the GpuViews that fillViews() wrote: 0 the fitted views, 1
// the GpuViews.
#pragma once

#include <gnomon/export.h>
#include <gnomon/plan.h>

#include <gnomon/shared/gpu_cascades.h>

#include <span>

namespace gnomon::pack {

/// Lights of the plan that are fitted on the GPU.
[[nodiscard]] GNOMON_API std::uint32_t cascadeLightCount(const Plan& plan);
/// Writes one entry for each of these lights, in the plan's order. `screen_px`: size of the depth buffer. Returns how
/// many it wrote. Throws Error where there is no room for them.
GNOMON_API std::uint32_t fillCascadeLights(const Plan& plan, glm::uvec2 screen_px,
                                           std::span<shared::GpuCascadeLight> out);
/// Groups of the passes that look at pixels.
[[nodiscard]] GNOMON_API glm::uvec2 groupsOver(glm::uvec2 screen_px);
/// Converts the fit that the GPU found for viewAsFitted().
[[nodiscard]] GNOMON_API FittedView describeFitted(const shared::GpuFittedView& gpu);

} // namespace gnomon::pack
