// SPDX-License-Identifier: Apache-2.0
#include "mask_constants.h"

#include "mip_level.h"
#include "moment_rule_of.h"

#include <discs.h>
#include <pcf_weights.h>

#include <glm/gtc/matrix_access.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cassert>

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
    return gpu;
}

shared::GpuLight gpuLight(const Light& light, const glm::dvec3& eye_ws)
{
    shared::GpuLight gpu{};
    gpu.place = light.type == LightType::directional ? glm::vec4(glm::vec3(glm::normalize(-light.direction_ws)), 0.0F)
                                                     : glm::vec4(glm::vec3(light.position_ws - eye_ws), 1.0F);
    return gpu;
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

void fillMoments(const FilterOptions& filter, shared::GpuMaskLayer& out)
{
    const shared::MomentRule rule = isFilterable(filter.filter) ? momentRuleOf(filter) : shared::MomentRule{};
    out.moment_warp = {rule.exponent, rule.exponent_negative, rule.moment_bias, rule.anisotropy};
    out.moment_variance = {rule.min_variance, rule.min_variance_texels, rule.rounding, rule.rounding_negative};
    out.moment_shape = {rule.linstep, rule.power, rule.lighten, 0.0F};
}

void fillFilter(const FilterOptions& filter, float quantum, shared::GpuMaskLayer& out)
{
    const BiasOptions& bias = filter.bias;
    out.bias = {bias.automatic ? 1.0F : 0.0F, bias.constant_m, bias.slope, bias.normal_texels};
    out.bias_more = {bias.receiver_plane ? 1.0F : 0.0F, biasReachTexels(filter), quantum, 0.0F};
    out.kernel = shared::gaussianWeights(std::max(kernelWidth(filter), 1), filter.gaussian_sigma_texels);
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
}

} // namespace

int kernelWidth(const FilterOptions& filter)
{
    switch (filter.pcf_kernel) {
    case PcfKernel::bilinear_2x2:
        return 1;
    case PcfKernel::gaussian_3x3:
        return 3;
    case PcfKernel::gaussian_5x5:
        return 5;
    case PcfKernel::gaussian_7x7:
        return 7;
    case PcfKernel::poisson:
    case PcfKernel::vogel:
        return 0;
    }
    return 0;
}

float filterReachTexels(const FilterOptions& filter)
{
    if (filter.filter == Filter::hard) {
        return 0.5F;
    }
    if (isFilterable(filter.filter)) {
        return static_cast<float>(blurRadius(filter.moments)) + 1.0F; // and a bilinear read of what was blurred
    }
    const int width = kernelWidth(filter);
    return width > 0 ? static_cast<float>(width + 1) * 0.5F : filter.disc_radius_texels + 1.0F;
}

MaskLayerShape describeMaskLayer(const Plan& plan, std::uint32_t layer, const MaskRegion& region)
{
    MaskLayerShape shape;
    for (const LightPlan& light : plan.lights) {
        if (light.mask_layer != layer) {
            continue;
        }
        shape.lights = std::max(shape.lights, light.mask_channel + 1);
        const ShownViews views = shownViews(plan, light, region.shown[light.mask_channel]);
        shape.further_views += views.count > 1 ? views.count - 1 : 0;
        shape.further_views += views.later_count > 1 ? views.later_count - 1 : 0;
        shape.paired |= views.later_count > 0 ? 1U << light.mask_channel : 0U;
        for (std::uint32_t i = 0; i < views.count; ++i) {
            shape.orthographic = shape.orthographic && plan.views[views.first + i].orthographic;
        }
        for (std::uint32_t i = 0; i < views.later_count; ++i) {
            shape.orthographic = shape.orthographic && plan.views[views.later_first + i].orthographic;
        }
    }
    return shape;
}

namespace {

void fillViews(const Frame& frame, const Plan& plan, std::uint32_t layer, const MaskRegion& region,
               const MaskSurroundings& around, shared::GpuMaskLayer& out)
{
    const glm::dmat4 world_from_eye = glm::translate(glm::dmat4(1.0), frame.camera.eye_ws);
    const double margin = tileMarginTexels(static_cast<double>(filterReachTexels(around.filter)));
    const auto viewOf = [&](std::uint32_t index) {
        const View& view = plan.views[index];
        shared::GpuView gpu = gpuView(view, world_from_eye, margin);
        const double near_over_far = view.parallel ? 1.0 : view.metric.near_m / view.metric.far_m;
        gpu.more =
            glm::dvec4(around.placer.slotOf(index), coarsestLevel(view.tile, around.map_levels), near_over_far, 0.0);
        if (view.gpu_cascade != kNoIndex) { // filled in for its base map: CascadeFitter::recordConstants
            gpu.slice.w = static_cast<float>(index + 1);
        }
        return gpu;
    };
    const std::uint32_t firsts = firstViews(describeMaskLayer(plan, layer, region));
    std::uint32_t further = firsts;
    const auto addFurther = [&](std::uint32_t first, std::uint32_t count) {
        for (std::uint32_t v = 1; v < count; ++v) {
            assert(further < shared::kViewsPerLayer);
            out.views[further++] = viewOf(first + v);
        }
        return count > 1 ? count - 1 : 0U;
    };
    for (shared::GpuLight& light : out.lights) {
        light = {}; // no map
    }
    for (std::uint32_t i = 0; i < firsts; ++i) {
        out.views[i] = {};
    }
    for (std::size_t i = 0; i < plan.lights.size(); ++i) {
        const LightPlan& light = plan.lights[i];
        if (light.mask_layer != layer) {
            continue;
        }
        const std::uint32_t channel = light.mask_channel;
        assert(channel < shared::kLightsPerLayer);
        const ShownViews views = shownViews(plan, light, region.shown[channel]);
        if (views.count == 0) {
            continue;
        }
        shared::GpuLight& gpu = out.lights[channel];
        gpu = gpuLight(frame.lights[i], frame.camera.eye_ws);
        gpu.views = {further, 0U, 1U, 0U};
        out.steps[channel] = stepRule(light.steps);
        out.views[channel] = viewOf(views.first);
        gpu.views.y = addFurther(views.first, views.count);
        if (views.later_count > 0) {
            out.views[shared::kLightsPerLayer + channel] = viewOf(views.later_first);
            gpu.views.w = addFurther(views.later_first, views.later_count);
        }
    }
}

} // namespace

void fillMaskLayer(const Frame& frame, const Plan& plan, std::uint32_t layer, const MaskRegion& region,
                   const MaskSurroundings& around, shared::GpuMaskLayer& out)
{
    const Camera& camera = frame.camera;
    const glm::dmat4 world_from_eye = glm::translate(glm::dmat4(1.0), camera.eye_ws);
    const glm::dmat4 eye_from_ndc = glm::inverse(camera.clip_from_world * world_from_eye);
    out.eye_x = glm::row(eye_from_ndc, 0);
    out.eye_y = glm::row(eye_from_ndc, 1);
    out.eye_z = glm::row(eye_from_ndc, 2);
    out.eye_w = glm::row(eye_from_ndc, 3);
    out.view_axis = glm::vec4(0.0F);
    for (const View& view : plan.views) {
        if (view.slice.bounded() || view.gpu_cascade != kNoIndex) { // all of them along the one camera's view
            out.view_axis = glm::vec4(glm::vec3(view.slice.axis), 0.0F);
        }
    }
    const double fade_m = plan.fade_end_m - plan.fade_begin_m;
    out.fade = plan.fade_end_m > 0.0 ? glm::vec4(plan.fade_begin_m, 1.0 / std::max(fade_m, 1e-3), 0.0F, 0.0F)
                                     : glm::vec4(0.0F);
    const glm::vec2 size(around.screen.width, around.screen.height);
    out.screen = {size, 1.0F / size};
    fillFilter(around.filter, around.quantum, out);

    fillViews(frame, plan, layer, region, around, out);
    out.atlas = {1.0F / static_cast<float>(around.atlas.width), 1.0F / static_cast<float>(around.atlas.height),
                 camera.reversed_z ? 0.0F : 1.0F, 0.0F};
}

} // namespace gnomon::vulkan
