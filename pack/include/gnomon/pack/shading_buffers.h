// SPDX-License-Identifier: Apache-2.0
// The buffers that shaders/include/gnomon/visibility.glsl reads, filled from a plan: everything relative to the eye,
// in double precision until the last moment. The mask pass is filled by the same functions.
//
// A pass that shades lights of one of the planner's options binds the constants and maps of these options, and all
// lights and views. With lights of several options it draws once for each, or has a set for each.
#pragma once

#include <gnomon/export.h>
#include <gnomon/pack/filter_rule.h>
#include <gnomon/plan.h>

#include <gnomon/shared/gpu_structs.h>

#include <span>

namespace gnomon::pack {

/// The image that has the maps of one of Plan::options. Filterable maps have mipLevels().
struct MapImage {
    glm::uvec2 size_px{1};    // texels of a page
    std::uint32_t levels = 1; // mip levels
};

/// Fills in the constants of lights whose LightPlan::options is `options`. `screen_px`: the size of the picture. Throws
/// Error where the plan has no such options, or a size is 0.
GNOMON_API void fillConstants(const Plan& plan, std::uint32_t options, glm::uvec2 screen_px, const MapImage& maps,
                              const DrawPrecision& precision, shared::GpuConstants& out);
/// Writes light i of the frame to lights[i]; entries beyond the frame's lights get no views. Lights without a map have
/// none. A light with SunSteps::alternate has only the views of SunSteps::read, whose maps this frame draws. Throws
/// Error where there is no room for all, or Plan::made_for has other lights.
GNOMON_API void fillLights(const Plan& plan, std::span<shared::GpuLight> lights);
/// Writes view i of the plan to views[i]. `maps`: by options. Views with ViewProjection::gpu_cascade describe their
/// base map until the GPU completes them: slice.w, which is 0 for others, is then one past the view's number
/// (shaders/passes/cascade_constants.comp). Up to kFewViews, entries beyond the plan's views serve no depth. Throws
/// Error where there is no room for all, or there are fewer maps than options.
GNOMON_API void fillViews(const Plan& plan, std::span<const MapImage> maps, std::span<shared::GpuView> views);

/// How many vectors fillObjects() writes: 0 where no light has ids (filters id and depth-id).
[[nodiscard]] GNOMON_API std::size_t objectVectorCount(const Plan& plan);
/// Writes the storage buffer by which filters id and depth-id know receiving objects. It has two vectors for each
/// object, its box's centre, relative to the eye, and half its size; then for each light that has ids one number for
/// each object, four to a vector (GpuLight::options). Throws Error where there is no room for all.
GNOMON_API void fillObjects(const Plan& plan, std::span<glm::vec4> out);

} // namespace gnomon::pack
