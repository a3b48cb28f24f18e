// SPDX-License-Identifier: Apache-2.0
#include <gnomon/pack/cascade_lights.h>

#include <gnomon/error.h>
#include <gnomon/plan_views.h>

#include <glm/gtc/matrix_access.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/vec3.hpp>

#include <algorithm>

namespace gnomon::pack {
namespace {

static_assert(shared::kMostCascades == static_cast<int>(kMaxCascades));

bool isFirst(const View& view)
{
    return view.projection.gpu_cascade == 0;
}

/// The light that the base map `view`, the plan's view `index`, belongs to.
shared::GpuCascadeLight describe(const Plan& plan, std::uint32_t index, glm::uvec2 screen_px)
{
    const View& view = plan.views[index];
    const Camera& camera = plan.made_for.camera;
    const glm::dmat4 world_from_eye = glm::translate(glm::dmat4(1.0), camera.eye_ws);
    const glm::dmat4 eye_from_ndc = glm::inverse(clipFromWorld(camera) * world_from_eye);
    const glm::dmat4 base_from_eye = view.projection.clip_from_world * world_from_eye;
    const ResolvedOptions& options = optionsOf(plan, view);
    const CascadeOptions& cascades = options.cascades();
    const double margin_texels = tileMarginTexels(static_cast<double>(options.reach_texels()));
    const glm::dvec2 texels(view.place.tile.width, view.place.tile.height);
    const glm::dvec2 widen = texels / (texels - 2.0 * options.borderOf(view.place.tile.width));
    const glm::dvec2 inside = 1.0 - 2.0 * margin_texels / texels;
    constexpr double kAnywhere_m = 1e18;
    const bool perspective = glm::length(glm::dvec3(glm::row(camera.clip_from_world, 3))) > 0.0;

    shared::GpuCascadeLight light;
    light.eye_x = glm::row(eye_from_ndc, 0);
    light.eye_y = glm::row(eye_from_ndc, 1);
    light.eye_z = glm::row(eye_from_ndc, 2);
    light.eye_w = glm::row(eye_from_ndc, 3);
    light.view_axis = glm::vec4(glm::vec3(view.serves.slice.axis), 0.0F);
    const glm::vec2 size(screen_px);
    light.screen = {size, 1.0F / size};
    light.base_x = glm::row(base_from_eye, 0);
    light.base_y = glm::row(base_from_eye, 1);
    light.base_w = glm::row(base_from_eye, 3);
    light.reach = glm::dvec4(camera.reversed_z ? 0.0 : 1.0,
                             options.fadeEnd_m() > 0.0 ? options.fadeEnd_m() : kAnywhere_m, inside.x, inside.y);
    light.split = glm::dvec4(cascades.lambda, cascades.blend, widen.x, widen.y);
    const std::uint32_t count = plan.lights[view.light].view_count; // partition auto has one, whatever its options say
    const bool explicit_ends = cascades.explicitEnds() && count == cascades.count;
    light.cascades = {count, index, explicit_ends ? 1U : 0U, perspective ? 1U : 0U};
    const auto& ends = cascades.ends_m;
    light.ends[0] = glm::dvec4(ends[0], ends[1], ends[2], ends[3]);
    light.ends[1] = glm::dvec4(ends[4], 0.0, 0.0, 0.0);
    light.texel = glm::dvec4(view.projection.texel_xy_m, view.projection.grid_move_texels * 2.0 / texels);
    // Texels of the base map are at their finest where w is 1.
    light.room = glm::dvec4(2.0 * view.projection.light_reach / (view.fit.finest_texel * texels),
                            view.projection.parallel ? 1.0 : 0.0, 0.0);
    return light;
}

} // namespace

std::uint32_t cascadeLightCount(const Plan& plan)
{
    return static_cast<std::uint32_t>(std::ranges::count_if(plan.views, isFirst));
}

std::uint32_t fillCascadeLights(const Plan& plan, glm::uvec2 screen_px, std::span<shared::GpuCascadeLight> out)
{
    std::uint32_t count = 0;
    for (std::uint32_t i = 0; i < plan.views.size(); ++i) {
        if (isFirst(plan.views[i])) {
            if (count >= out.size()) {
                throw Error("describe cascades to shaders", "there is no room for the plan's lights",
                            "give room for cascadeLightCount()");
            }
            out[count++] = describe(plan, i, screen_px);
        }
    }
    return count;
}

glm::uvec2 groupsOver(glm::uvec2 screen_px)
{
    constexpr std::uint32_t kSide = shared::kBoundsPixels * shared::kBoundsGroup;
    return (screen_px + (kSide - 1)) / kSide;
}

FittedView describeFitted(const shared::GpuFittedView& gpu)
{
    constexpr float kEndless = 1e30F;
    FittedView view;
    view.scale = glm::dvec2(gpu.place.x, gpu.place.y);
    view.centre = glm::dvec2(gpu.place.z, gpu.place.w);
    if (gpu.slice.x > -kEndless) {
        view.begin_m = gpu.slice.x;
    }
    if (gpu.slice.y < kEndless) {
        view.end_m = gpu.slice.y;
    }
    view.blend_m = gpu.slice.z > 0.0F ? 1.0 / gpu.slice.z : 0.0;
    view.seen_low = glm::dvec2(gpu.seen.x, gpu.seen.y);
    view.seen_high = glm::dvec2(gpu.seen.z, gpu.seen.w);
    return view;
}

} // namespace gnomon::pack
