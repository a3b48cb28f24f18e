// SPDX-License-Identifier: Apache-2.0
#include <gnomon/pack/shading_buffers.h>

#include "light_strip.h"

#include <gnomon/error.h>
#include <gnomon/object_ids.h>
#include <gnomon/pack/depth_layers.h>
#include <gnomon/pack/filter_rule.h>
#include <gnomon/pack/page_table.h>
#include <gnomon/plan_views.h>

#include <glm/gtc/matrix_access.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>

namespace gnomon::pack {
namespace {

/// Where its map has a point, in the place of the rows of other views: gpu_structs.h.
void placeParaboloid(const View& view, const glm::dmat4& clip_from_eye, shared::GpuView& gpu)
{
    gpu.x = glm::row(clip_from_eye, 0);
    gpu.y = glm::row(clip_from_eye, 1);
    gpu.w = glm::row(clip_from_eye, 2);
    const glm::dvec2 half = 0.5 * glm::dvec2(view.place.tile.width, view.place.tile.height);
    const glm::dvec2 radius = half / view.projection.clip_from_world[3][3];
    gpu.plane_x = glm::dvec4(radius, glm::dvec2(view.place.tile.x, view.place.tile.y) + half);
    gpu.plane_y = {0.0F, 0.0F, 0.0F, 1.0F};
    gpu.plane_w = {};
}

shared::GpuView gpuView(const View& view, const glm::dmat4& world_from_eye, double margin)
{
    const glm::dmat4 clip_from_eye = view.projection.clip_from_world * world_from_eye;
    const glm::dvec4 w = glm::row(clip_from_eye, 3);
    const auto texels = [&](int axis, double first, double size) {
        return glm::row(clip_from_eye, axis) * (0.5 * size) + w * (0.5 * size + first);
    };
    const Tile& tile = view.place.tile;
    const double x0 = tile.x;
    const double y0 = tile.y;
    shared::GpuView gpu{};
    gpu.x = texels(0, x0, tile.width);
    gpu.y = texels(1, y0, tile.height);
    gpu.w = w;
    gpu.metric = view.projection.metric.metric_ws * world_from_eye; // a row vector
    gpu.tile = glm::dvec4(x0 + margin, y0 + margin, x0 + tile.width - margin, y0 + tile.height - margin);
    gpu.scale = glm::dvec4(view.projection.texel_m, view.projection.metric.far_m - view.projection.metric.near_m,
                           tile.layer, view.place.part == TexelPart::second ? 1.0 : 0.0);
    const glm::dvec3 x = glm::dvec4(gpu.x);
    const glm::dvec3 y = glm::dvec4(gpu.y);
    const glm::dvec3 metric = glm::dvec4(gpu.metric);
    const glm::dvec3 across = glm::cross(x, y);
    constexpr double kAtOnce = 1e6; // one over the width of a blend that is next to none
    gpu.plane_x = glm::dvec4(glm::cross(metric, y), !view.serves.layered    ? 0.0
                                                    : view.serves.rim > 0.0 ? 1.0 / view.serves.rim
                                                                            : kAtOnce);
    gpu.plane_y = glm::dvec4(glm::cross(x, metric), 0.0);
    gpu.plane_w = glm::dvec4(across, 1e-6 * glm::length(across));
    gpu.whole = glm::dvec4(x0, y0, x0 + tile.width, y0 + tile.height);
    const ViewSlice& slice = view.serves.slice;
    // A shader need not know infinities.
    constexpr double kEndless = 1e30;
    gpu.slice = glm::dvec4(std::max(slice.begin_m, -kEndless), std::min(slice.end_m, kEndless),
                           slice.blend_m > 0.0          ? 1.0 / slice.blend_m
                           : view.serves.faded_in < 1.0 ? kAtOnce
                                                        : 0.0,
                           view.serves.faded_in);
    gpu.slice_axis = slice.axis * world_from_eye; // whichever eye the plan was made for
    gpu.sector_x = view.serves.sector.x * world_from_eye;
    gpu.sector_y = view.serves.sector.y * world_from_eye;
    gpu.sector_w = view.serves.sector.w * world_from_eye;
    gpu.more.z = static_cast<float>(
        view.projection.parallel ? 1.0 : view.projection.metric.near_m / view.projection.metric.far_m);
    if (view.projection.paraboloid) {
        placeParaboloid(view, clip_from_eye, gpu);
    }
    return gpu;
}

void placeLight(const Light& light, const glm::dvec3& eye_ws, shared::GpuLight& gpu)
{
    const bool parallel = light.type == LightType::directional;
    gpu.place = parallel ? glm::vec4(glm::vec3(glm::normalize(-light.direction_ws)), 0.0F)
                         : glm::vec4(glm::vec3(light.position_ws - eye_ws), 1.0F);
    const double size = parallel ? std::tan(0.5 * light.angular_diameter_rad) : light.radius_m;
    gpu.size = glm::dvec4(size, light.direction_ws);
}

/// Vectors that one light's ids take.
std::uint32_t idVectors(const Plan& plan)
{
    return (static_cast<std::uint32_t>(plan.object_bounds.size()) + 3) / 4;
}

/// Which of fillObjects()'s vectors is the first of a light's ids.
std::uint32_t firstIdVector(const Plan& plan, const LightPlan& light)
{
    const auto objects = static_cast<std::uint32_t>(plan.object_bounds.size());
    return 2 * objects + light.first_object_id / objects * idVectors(plan);
}

} // namespace

void fillLight(const Plan& plan, std::size_t index, SunShown shown, shared::GpuLight& out)
{
    const LightPlan& light = plan.lights[index];
    const ShownViews views = shownViews(plan, light, shown);
    if (views.count == 0) {
        return;
    }
    Light from = plan.made_for.lights[index];
    if (light.sample.joined) {
        from.position_ws = light.sample.position_ws;
        from.direction_ws = light.sample.direction_ws;
        if (!(*plan.options)[light.options].integratesLight()) { // it shines from a place of its own, which has no size
            from.angular_diameter_rad = 0.0;
            from.radius_m = 0.0;
        }
    }
    placeLight(from, plan.made_for.camera.eye_ws, out);
    out.views = {views.first, views.count, views.later_first, views.later_count};
    out.steps = stepRule(light.steps);
    out.options.x = light.options;
    if (hasPages((*plan.options)[light.options])) {
        out.options.y = kPageFaces * static_cast<std::uint32_t>(index);
    }
    if (light.first_object_id != kNoIndex) {
        out.options.y = firstIdVector(plan, light);
        out.options.z = static_cast<std::uint32_t>(plan.object_bounds.size());
        out.options.w = (*plan.options)[light.options].ids().of == IdOf::face ? 1 : 0;
    }
}

void fillLights(const Plan& plan, std::span<shared::GpuLight> lights)
{
    if (lights.size() < plan.lights.size() || plan.made_for.lights.size() != plan.lights.size()) {
        throw Error("describe lights to shaders",
                    "there is no room for the plan's lights, or the plan does not say what they are (Plan::made_for)",
                    "give room for plan.lights.size()");
    }
    std::fill(lights.begin(), lights.end(), shared::GpuLight{});
    for (std::size_t i = 0; i < plan.lights.size(); ++i) {
        const SunSteps& steps = plan.lights[i].steps;
        // By turns, the maps of the other position are not those of its views.
        const SunShown read = steps.read == SunPosition::later ? SunShown::later : SunShown::earlier;
        fillLight(plan, i, steps.paired && steps.alternate ? read : SunShown::all, lights[i]);
    }
}

void fillViews(const Plan& plan, std::span<const MapImage> maps, std::span<shared::GpuView> views)
{
    if (plan.options == nullptr || views.size() < plan.views.size() || maps.size() < plan.options->size()) {
        throw Error("describe views to shaders", "there is no room for the plan's views, or too few maps are given",
                    "give room for plan.views.size(), and one map for each of plan.options");
    }
    const glm::dmat4 world_from_eye = glm::translate(glm::dmat4(1.0), plan.made_for.camera.eye_ws);
    for (std::uint32_t i = 0; i < plan.views.size(); ++i) {
        const View& view = plan.views[i];
        const ResolvedOptions& options = optionsOf(plan, view);
        shared::GpuView gpu =
            gpuView(view, world_from_eye, tileMarginTexels(static_cast<double>(options.reach_texels())));
        gpu.more.x = options.filter() == Filter::lvsm ? static_cast<float>(depthLayersSlot(plan, i)) : 0.0F;
        const MapImage& image = maps[optionsIndexOf(plan, view)];
        gpu.more.y =
            static_cast<float>(options.traits().integrates_light ? blockLevels(image.size_px)
                                                                 : coarsestLevel(view.place.tile, image.levels));
        if (view.projection.gpu_cascade != kNoIndex) {
            gpu.slice.w = -static_cast<float>(i + 1);
        }
        views[i] = gpu;
    }
    const std::size_t few = std::min<std::size_t>(views.size(), shared::kFewViews);
    for (std::size_t i = plan.views.size(); i < few; ++i) { // a shader may look at as many: they serve no depth
        views[i] = {};
        views[i].tile = {1.0F, 1.0F, -1.0F, -1.0F};
        views[i].slice = {1.0F, -1.0F, 0.0F, 0.0F};
        views[i].sector_w = {0.0F, 0.0F, 0.0F, 1.0F};
    }
}

void fillConstants(const Plan& plan, std::uint32_t index, glm::uvec2 screen_px, const MapImage& maps,
                   const DrawPrecision& precision, shared::GpuConstants& out)
{
    if (plan.options == nullptr || index >= plan.options->size()) {
        throw Error("describe a frame to shaders", "the plan has no options of that index",
                    "give an index into plan.options");
    }
    if (screen_px.x == 0 || screen_px.y == 0 || maps.size_px.x == 0 || maps.size_px.y == 0) {
        throw Error("describe a frame to shaders", "the picture or the maps have no pixels", "give their sizes");
    }
    const Camera& camera = plan.made_for.camera;
    const glm::dmat4 world_from_eye = glm::translate(glm::dmat4(1.0), camera.eye_ws);
    const glm::dmat4 clip_from_eye = clipFromWorld(camera) * world_from_eye;
    const glm::dmat4 eye_from_ndc = glm::inverse(clip_from_eye);
    shared::GpuScreen& screen = out.screen;
    screen.eye_x = glm::row(eye_from_ndc, 0);
    screen.eye_y = glm::row(eye_from_ndc, 1);
    screen.eye_z = glm::row(eye_from_ndc, 2);
    screen.eye_w = glm::row(eye_from_ndc, 3);
    screen.clip_w = glm::row(clip_from_eye, 3);
    const ResolvedOptions& options = (*plan.options)[index];
    const double begin_m = options.fadeBegin_m();
    const double fade_m = options.fadeEnd_m() - begin_m;
    constexpr double kLeastFade = 1e-5; // share of the distance
    screen.fade = glm::vec4(0.0F, 0.0F, camera.reversed_z ? 0.0F : 1.0F, 0.0F);
    if (options.fadeEnd_m() > 0.0) {
        screen.fade.x = static_cast<float>(begin_m);
        screen.fade.y = static_cast<float>(1.0 / std::max(fade_m, kLeastFade * options.fadeEnd_m()));
    }
    const glm::vec2 size(screen_px);
    screen.size = {size, 1.0F / size};
    fillRule(options, precision, out.rule);
    const auto light = std::ranges::find(plan.lights, index, &LightPlan::options);
    out.rule.disc.y = light != plan.lights.end() ? static_cast<float>(light->sample.number) : 0.0F;
    out.rule.disc.z = 1.0F / static_cast<float>(maps.size_px.x);
    out.rule.disc.w = 1.0F / static_cast<float>(maps.size_px.y);
}

std::size_t objectVectorCount(const Plan& plan)
{
    const std::size_t objects = plan.object_bounds.size();
    return objects == 0 ? 0 : 2 * objects + plan.object_ids.size() / objects * idVectors(plan);
}

void fillObjects(const Plan& plan, std::span<glm::vec4> out)
{
    if (out.size() < objectVectorCount(plan)) {
        throw Error("describe objects to shaders", "there is no room for the plan's objects and ids",
                    "give room for objectVectorCount()");
    }
    std::size_t next = 0;
    for (const Aabb& box : plan.object_bounds) {
        const bool is_somewhere = !box.empty();
        const glm::dvec3 low(is_somewhere ? box.min : glm::vec3(0.0F));
        const glm::dvec3 high(is_somewhere ? box.max : glm::vec3(0.0F));
        out[next++] = glm::dvec4(0.5 * (low + high) - plan.made_for.camera.eye_ws, 0.0);
        out[next++] = glm::dvec4(0.5 * (high - low), 0.0);
    }
    for (std::uint32_t light = 0; light < plan.lights.size(); ++light) {
        const std::span<const std::uint16_t> ids = objectIdsOf(plan, light);
        for (std::size_t i = 0; i < ids.size(); i += 4) {
            glm::vec4 four(0.0F);
            for (std::size_t k = 0; k < 4 && i + k < ids.size(); ++k) {
                four[static_cast<int>(k)] = static_cast<float>(ids[i + k]);
            }
            out[next++] = four;
        }
    }
}

} // namespace gnomon::pack
