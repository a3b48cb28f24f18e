// SPDX-License-Identifier: Apache-2.0
#include "mask_constants.h"

#include "map_storage.h"
#include "mip_level.h"
#include "moment_rule_of.h"

#include <discs.h>
#include <pcf_weights.h>

#include <glm/gtc/matrix_access.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace gnomon::vulkan {
namespace {

shared::GpuView gpuView(const View& view, const glm::dmat4& world_from_eye, double margin)
{
    const glm::dmat4 clip_from_eye = view.clip_from_world * world_from_eye;
    const glm::dvec4 w = glm::row(clip_from_eye, 3);
    const auto texels = [&](int axis, double first, double size) {
        return glm::row(clip_from_eye, axis) * (0.5 * size) + w * (0.5 * size + first);
    };
    const Tile& tile = view.tile;
    const double x0 = tile.x;
    const double y0 = tile.y;
    shared::GpuView gpu{};
    gpu.x = texels(0, x0, tile.width);
    gpu.y = texels(1, y0, tile.height);
    gpu.w = w;
    gpu.metric = view.metric.metric_ws * world_from_eye; // a row vector
    gpu.tile = glm::dvec4(x0 + margin, y0 + margin, x0 + tile.width - margin, y0 + tile.height - margin);
    gpu.scale = glm::dvec4(view.texel_m, view.metric.far_m - view.metric.near_m, tile.layer,
                           view.part == TexelPart::second ? 1.0 : 0.0);
    const glm::dvec3 x = glm::dvec4(gpu.x);
    const glm::dvec3 y = glm::dvec4(gpu.y);
    const glm::dvec3 metric = glm::dvec4(gpu.metric);
    const glm::dvec3 across = glm::cross(x, y);
    gpu.plane_x = glm::dvec4(glm::cross(metric, y), 0.0);
    gpu.plane_y = glm::dvec4(glm::cross(x, metric), 0.0);
    gpu.plane_w = glm::dvec4(across, 1e-6 * glm::length(across));
    gpu.whole = glm::dvec4(x0, y0, x0 + tile.width, y0 + tile.height);
    const ViewSlice& slice = view.slice;
    // A shader need not know infinities.
    constexpr double kEndless = 1e30;
    // Depths count from the eye for which the plan was made, which need not be the one that looks now.
    const double gone_m = glm::dot(slice.axis, world_from_eye[3]);
    gpu.slice = glm::dvec4(std::max(slice.begin_m - gone_m, -kEndless), std::min(slice.end_m - gone_m, kEndless),
                           slice.blend_m > 0.0 ? 1.0 / slice.blend_m : 0.0, 0.0);
    gpu.more.z = static_cast<float>(view.parallel ? 1.0 : view.metric.near_m / view.metric.far_m);
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

/// How far away what a filter compares a receiver with typically is, for the bias. Averages are compared with the
/// receiver alone: on a plane they are the plane's depth there, however far the kernel reaches, so what its ends may be
/// off does not matter; where a surface bends, an average is off as a texel at the kernel's root mean square distance
/// is.
float biasReachTexels(const FilterOptions& filter)
{
    if (!isFilterable(filter.filter)) {
        return filterReachTexels(filter);
    }
    const MomentOptions& o = filter.moments;
    const auto radius = static_cast<float>(blurRadius(o));
    const float of_blur = o.blur == BlurKind::gaussian ? std::min(o.blur_sigma_texels, radius) : radius * 0.57735F;
    constexpr float kOfBilinear = 0.5F;
    constexpr float kOfRing = 3.0F; // esm also compares single reads that far off (shaders/lib/esm.glsl)
    return std::max(of_blur + kOfBilinear, filter.filter == Filter::esm ? kOfRing : 0.0F);
}

void fillMoments(const FilterOptions& filter, shared::GpuRule& out)
{
    const shared::MomentRule rule = isFilterable(filter.filter) ? momentRuleOf(filter) : shared::MomentRule{};
    out.moment_warp = {rule.exponent, rule.exponent_negative, rule.moment_bias, rule.anisotropy};
    out.moment_variance = {rule.min_variance, rule.min_variance_texels, rule.rounding, rule.rounding_negative};
    out.moment_shape = {rule.linstep, rule.power, rule.lighten, 0.0F};
    out.moments = {rule.flags, rule.sampling, rule.layers, 0};
}

void fillFilter(const FilterOptions& filter, float quantum, shared::GpuRule& out)
{
    const BiasOptions& bias = filter.bias;
    out.bias = {bias.automatic ? 1.0F : 0.0F, bias.constant_m, bias.slope, bias.normal_texels};
    out.bias_more = {bias.receiver_plane ? 1.0F : 0.0F, biasReachTexels(filter), quantum, 0.0F};
    out.kernel = shared::gaussianWeights(std::max(kernelWidth(filter.pcf_kernel), 1), filter.gaussian_sigma_texels);
    out.disc = {filter.disc_radius_texels, 0.0F, 0.0F, 0.0F};
    const auto taps = static_cast<int>(filter.disc_taps);
    for (int i = 0; i < taps; ++i) {
        const glm::vec2 point =
            filter.pcf_kernel == PcfKernel::poisson ? shared::kPoissonPoints[i] : shared::vogelPoint(i, taps);
        glm::vec4& two = out.disc_points[i / 2];
        (i % 2 == 0 ? two.x : two.z) = point.x;
        (i % 2 == 0 ? two.y : two.w) = point.y;
    }
    fillMoments(filter, out);
    out.reading = {static_cast<int>(filter.filter), kernelWidth(filter.pcf_kernel), taps,
                   depthHolding(filter.filter, filter.format)};
}

} // namespace

namespace {

// The light of mask channel `channel`, as a strip of the screen shows it.
void fillLight(const Frame& frame, const Plan& plan, std::size_t index, SunShown shown, shared::GpuLight& out)
{
    const LightPlan& light = plan.lights[index];
    const ShownViews views = shownViews(plan, light, shown);
    if (views.count == 0) {
        return;
    }
    placeLight(frame.lights[index], frame.camera.eye_ws, out);
    out.views = {views.first, views.count, views.later_first, views.later_count};
    out.steps = stepRule(light.steps);
}

bool isOrthographic(const Plan& plan, const shared::GpuLight& light)
{
    const auto all = [&](std::uint32_t first, std::uint32_t count) {
        return std::all_of(plan.views.begin() + first, plan.views.begin() + first + count,
                           [](const View& view) { return view.orthographic; });
    };
    return all(light.views.x, light.views.y) && all(light.views.z, light.views.w);
}

} // namespace

std::uint32_t fewViews(const Plan& plan)
{
    const bool steps = plan.technique.motion != Motion::free && plan.technique.motion != Motion::snap;
    if (plan.lights.size() != 1 || steps || plan.lights.front().steps.paired) {
        return 0;
    }
    const ShownViews views = shownViews(plan, plan.lights.front(), SunShown::all);
    return views.first == 0 && views.count == plan.views.size() && views.count <= shared::kFewViews ? views.count : 0;
}

std::uint32_t maskLightCount(std::uint32_t layers, bool strips)
{
    return layers * shared::kLightsPerLayer * (strips ? 1 + MaskRegions::kMost : 1U);
}

void fillMaskLights(const Frame& frame, const Plan& plan, std::uint32_t width, std::span<shared::GpuLight> lights,
                    std::vector<MaskDraw>& draws)
{
    draws.clear();
    std::fill(lights.begin(), lights.end(), shared::GpuLight{});
    const std::uint32_t layers = std::max(plan.mask_layers, 1U);
    std::uint32_t next = layers * shared::kLightsPerLayer;
    for (std::uint32_t layer = 0; layer < layers; ++layer) {
        const MaskRegions regions = maskRegions(plan, layer, width);
        for (const MaskRegion& region : regions) {
            MaskDraw draw{layer, region.begin, region.end, layer * shared::kLightsPerLayer, 0, true, fewViews(plan)};
            if (regions.count > 1) { // the lights of this strip alone; `lights` by index serve all of the screen
                draw.first_light = next;
                next += shared::kLightsPerLayer;
            }
            for (std::size_t i = 0; i < plan.lights.size(); ++i) {
                const LightPlan& light = plan.lights[i];
                if (light.mask_layer != layer) {
                    continue;
                }
                draw.channels |= 1U << light.mask_channel;
                shared::GpuLight& own = lights[draw.first_light + light.mask_channel];
                fillLight(frame, plan, i, region.shown[light.mask_channel], own);
                draw.orthographic = draw.orthographic && isOrthographic(plan, own);
                if (regions.count > 1 && region.begin == 0) {
                    const std::uint32_t all = layer * shared::kLightsPerLayer + light.mask_channel;
                    fillLight(frame, plan, i, SunShown::all, lights[all]);
                }
            }
            draw.channels = std::max(draw.channels, 1U); // a picture without lights is lit
            draws.push_back(draw);
        }
    }
}

void fillMaskViews(const Frame& frame, const Plan& plan, const MaskSurroundings& around,
                   std::span<shared::GpuView> views)
{
    assert(views.size() >= plan.views.size());
    const glm::dmat4 world_from_eye = glm::translate(glm::dmat4(1.0), frame.camera.eye_ws);
    const double margin = tileMarginTexels(static_cast<double>(filterReachTexels(around.filter)));
    for (std::uint32_t i = 0; i < plan.views.size(); ++i) {
        const View& view = plan.views[i];
        shared::GpuView gpu = gpuView(view, world_from_eye, margin);
        gpu.more.x = static_cast<float>(around.placer.slotOf(i));
        gpu.more.y = static_cast<float>(coarsestLevel(view.tile, around.map_levels));
        if (view.gpu_cascade != kNoIndex) { // filled in for its base map: CascadeFitter::recordConstants
            gpu.slice.w = static_cast<float>(i + 1);
        }
        views[i] = gpu;
    }
}

void fillMaskConstants(const Frame& frame, const Plan& plan, const MaskSurroundings& around, shared::GpuConstants& out)
{
    const Camera& camera = frame.camera;
    const glm::dmat4 world_from_eye = glm::translate(glm::dmat4(1.0), camera.eye_ws);
    const glm::dmat4 clip_from_eye = camera.clip_from_world * world_from_eye;
    const glm::dmat4 eye_from_ndc = glm::inverse(clip_from_eye);
    shared::GpuScreen& screen = out.screen;
    screen.eye_x = glm::row(eye_from_ndc, 0);
    screen.eye_y = glm::row(eye_from_ndc, 1);
    screen.eye_z = glm::row(eye_from_ndc, 2);
    screen.eye_w = glm::row(eye_from_ndc, 3);
    screen.clip_w = glm::row(clip_from_eye, 3);
    screen.view_axis = {0.0F, 0.0F, 0.0F, camera.reversed_z ? 0.0F : 1.0F};
    for (const View& view : plan.views) {
        if (view.slice.bounded() || view.gpu_cascade != kNoIndex) { // all of them along the one camera's view
            screen.view_axis = glm::vec4(glm::vec3(view.slice.axis), screen.view_axis.w);
        }
    }
    const double fade_m = plan.fade_end_m - plan.fade_begin_m;
    screen.fade = plan.fade_end_m > 0.0 ? glm::vec4(plan.fade_begin_m, 1.0 / std::max(fade_m, 1e-3), 0.0F, 0.0F)
                                        : glm::vec4(0.0F);
    const glm::vec2 size(around.screen.width, around.screen.height);
    screen.size = {size, 1.0F / size};
    fillFilter(around.filter, around.quantum, out.rule);
    out.rule.disc.z = 1.0F / static_cast<float>(around.atlas.width);
    out.rule.disc.w = 1.0F / static_cast<float>(around.atlas.height);
}

} // namespace gnomon::vulkan
