// SPDX-License-Identifier: Apache-2.0
#define GNOMON_REAL double
#define GNOMON_SMOOTHIES
#include "reference_maps.h"

#include "reference.h"

#include "cpu_fins.h"
#include "cpu_smoothies.h"
#include "harness.h"
#include "moment_numbers.h"

#include <gnomon/object_ids.h>
#include <gnomon/plan_views.h>

#include <gnomon/shared/sun_steps.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>

#include <gnomon/lib/visibility.glsl>

namespace gnomon::test {
namespace {

using shared::BiasRule;
using shared::FilterInput;
using shared::MapRows;

int widthOf(PcfKernel kernel)
{
    switch (kernel) {
    case PcfKernel::bilinear_2x2:
        return 1;
    case PcfKernel::gaussian_3x3:
        return 3;
    case PcfKernel::gaussian_5x5:
        return 5;
    case PcfKernel::gaussian_7x7:
        return 7;
    case PcfKernel::box_3x3:
        return shared::kBoxKernel;
    case PcfKernel::projected_3x3:
        return shared::kProjectedKernel;
    default:
        return 0;
    }
}

glm::dvec4 rowOf(const glm::dmat4& m, int i)
{
    return {m[0][i], m[1][i], m[2][i], m[3][i]};
}

MapRows rowsOf(const View& view)
{
    MapRows rows;
    const glm::dvec4 w = rowOf(view.projection.clip_from_world, 3);
    rows.x =
        0.5 * view.place.tile.width * (rowOf(view.projection.clip_from_world, 0) + w) + double(view.place.tile.x) * w;
    rows.y =
        0.5 * view.place.tile.height * (rowOf(view.projection.clip_from_world, 1) + w) + double(view.place.tile.y) * w;
    rows.w = w;
    rows.metric = view.projection.metric.metric_ws;
    rows.texel_m = view.projection.texel_m;
    rows.range_m = view.projection.metric.far_m - view.projection.metric.near_m;
    return rows;
}

/// The rows of a view at a point. For a paraboloid they are those of the perspective map whose axis is the ray to the
/// point, with slopes from differences.
MapRows rowsAt(const View& view, const glm::dvec3& p)
{
    MapRows rows = rowsOf(view);
    if (!view.projection.paraboloid) {
        return rows;
    }
    const auto texel = [&](const glm::dvec3& at) {
        const glm::dvec2 place = placeOnMap(view, at).value_or(glm::dvec2(0.0));
        return glm::dvec2(view.place.tile.x, view.place.tile.y) +
               (place * 0.5 + 0.5) * glm::dvec2(view.place.tile.width, view.place.tile.height);
    };
    const glm::dvec3 ray = p - view.projection.light_place_ws;
    const double distance = glm::length(ray);
    const double h = 1e-4 * distance;
    glm::dvec3 across(0.0);
    glm::dvec3 down(0.0);
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 step(0.0);
        step[axis] = h;
        const glm::dvec2 slope = (texel(p + step) - texel(p - step)) * (distance / (2.0 * h));
        across[axis] = slope.x;
        down[axis] = slope.y;
    }
    const glm::dvec2 here = texel(p);
    rows.w = glm::dvec4(ray / distance, -glm::dot(ray / distance, view.projection.light_place_ws));
    rows.x = glm::dvec4(across, -glm::dot(across, p)) + rows.w * here.x;
    rows.y = glm::dvec4(down, -glm::dot(down, p)) + rows.w * here.y;
    rows.metric = rows.w / rows.range_m;
    rows.metric.w -= view.projection.metric.near_m / rows.range_m;
    return rows;
}

// Error of what a texel holds.
double quantumOf(MapFormat format)
{
    switch (format) {
    case MapFormat::d16:
    case MapFormat::rg16:
    case MapFormat::rgba16:
    case MapFormat::rgba8:
        return 4e-6 + 1.5 / 65535.0;
    case MapFormat::r16f:
    case MapFormat::rg16f:
    case MapFormat::rgba16f:
        return 1.0 / 2048.0;
    default:
        return 4e-6;
    }
}

bool comparesInCone(const ShadowOptions& options)
{
    return options.technique.filter == Filter::pcss || options.technique.filter == Filter::raymarch;
}

// How far from the receiver the centres of the texels are that the filter reads.
double reachOf(const ShadowOptions& options)
{
    if (options.technique.filter == Filter::hard) {
        return hasSmoothies(options) ? 1.0 : 0.5;
    }
    if (filterTraits(options.technique.filter)->ids) {
        return 1.0;
    }
    if (comparesInCone(options)) {
        return 2.0;
    }
    if (isFilterable(options.technique.filter)) {
        return blurRadius(options.moments) + 1.0;
    }
    const double width = widthOf(options.pcf.kernel);
    if (width < 0) {
        return 1.5; // a texel and a half of nine point samples
    }
    return width > 0 ? (width + 1) / 2 : double(options.pcf.radius_texels) + 1.0;
}

// How far away what the receiver is compared with typically is.
double biasReachOf(const ShadowOptions& options)
{
    if (!isFilterable(options.technique.filter)) {
        return reachOf(options);
    }
    const MomentOptions& o = options.moments;
    const double radius = blurRadius(o);
    const double of_blur =
        blurOf(o) == BlurKind::gaussian ? std::min(double(o.blur_sigma_texels), radius) : radius / std::sqrt(3.0);
    return std::max(of_blur + 0.5, options.technique.filter == Filter::esm ? 3.0 : 0.0);
}

int holdingOf(const ShadowOptions& options)
{
    if (isFilterable(options.technique.filter) || options.technique.filter == Filter::id) {
        return shared::kDepthAlone;
    }
    if (options.technique.filter == Filter::depth_id) {
        return shared::kDepthChannel;
    }
    const MapFormat format = formatOf(options);
    return format == MapFormat::rg16 || format == MapFormat::rg16f ? shared::kDepthChannel
           : format == MapFormat::rgba8                            ? shared::kDepthBytes
                                                                   : shared::kDepthAlone;
}

BiasRule ruleOf(const ShadowOptions& options)
{
    const BiasOptions& bias = options.bias;
    BiasRule rule;
    rule.automatic = bias.automatic ? 1.0 : 0.0;
    rule.constant_m = bias.constant_m;
    rule.slope = bias.slope;
    rule.normal_texels = bias.normal_texels;
    rule.receiver_plane = bias.receiver_plane ? 1.0 : 0.0;
    rule.reach_texels = biasReachOf(options);
    const bool own_range = options.technique.filter == Filter::id ||
                           (options.technique.filter == Filter::depth_id && options.ids.depth == IdDepth::object);
    rule.quantum = quantumOf(own_range ? MapFormat::d32f : formatOf(options));
    rule.exact_plane = comparesInCone(options) ? 1.0 : 0.0;
    // Two steps of the device's grid; 16-bit octahedral normals, and what led to them.
    rule.snap_texels = 2.0 / double(1U << gpu().limits().subPixelPrecisionBits);
    rule.off_plane_m = 0.0; // of each receiver
    rule.normal_error = 1e-4 + 3.0 * std::sqrt(2.0) / 65536.0;
    return rule;
}

shared::MomentRule momentsOf(const ShadowOptions& options)
{
    const MomentNumbers n = momentNumbers(options);
    shared::MomentRule rule;
    rule.flags = n.flags;
    rule.sampling = n.sampling;
    rule.layers = n.layers;
    rule.exponent = n.exponent;
    rule.exponent_negative = n.exponent_negative;
    rule.moment_bias = n.moment_bias;
    rule.min_variance = n.min_variance;
    rule.min_variance_texels = n.min_variance_texels;
    rule.rounding = n.rounding;
    rule.rounding_negative = n.rounding_negative;
    rule.linstep = n.linstep;
    rule.power = n.power;
    rule.lighten = n.lighten;
    rule.lighten_cut = n.lighten_cut;
    rule.anisotropy = n.anisotropy;
    return rule;
}

FilterInput inputOf(const ReferenceScene& scene, const View& view, const ShadowOptions& options)
{
    FilterInput input{};
    input.layer = view.place.tile.layer;
    input.part = view.place.part == TexelPart::second ? 1.0 : 0.0;
    input.kernel_width = widthOf(options.pcf.kernel);
    input.disc_taps = int(options.pcf.taps);
    input.disc_radius = options.pcf.radius_texels;
    input.kernel =
        shared::gaussianWeights(std::max(input.kernel_width, 1), double(options.pcf.sigma_texels.value_or(0.0F)));
    input.smoothies = hasSmoothies(options) ? double(options.smoothies.reach_texels) : 0.0;
    if (filterTraits(options.technique.filter)->ids) {
        const MapFormat format = formatOf(options);
        const double ids = format == MapFormat::r8 || format == MapFormat::rg8 ? 255.0 : 65535.0;
        const double steps = format == MapFormat::rg32f ? 8388608.0 : ids;
        const bool any = options.technique.filter == Filter::id;
        input.kernel = {options.ids.test == IdTest::automatic ? (any ? 1.0 : 2.0) : double(options.ids.test),
                        any || options.ids.of == IdOf::face ? ids : -ids,
                        options.ids.bias ? double(*options.ids.bias) : -1.0,
                        options.ids.depth == IdDepth::global ? -steps : steps};
    }
    input.moments = momentsOf(options);
    input.tile = glm::dvec4(view.place.tile.x, view.place.tile.y, view.place.tile.x + view.place.tile.width,
                            view.place.tile.y + view.place.tile.height);
    const MapPages& pages = scene.plan.pages[0];
    input.coarsest = comparesInCone(options) ? std::bit_width(std::max(pages.width, pages.height) - 1U)
                                             : coarsestOf(view.place.tile, levelsOf(options, pages));
    input.near_over_far =
        view.projection.orthographic ? 1.0 : view.projection.metric.near_m / view.projection.metric.far_m;
    return input;
}

// From a receiver to the light, and the light's size at that distance: a sphere's is that of the cone that touches it.
void turnToLight(const Light& light, const MapRows& rows, const glm::dvec3& p, const glm::dvec3& n, FilterInput& input)
{
    input.rows = rows;
    input.n = n;
    if (light.type == LightType::directional) {
        input.toward = -glm::normalize(light.direction_ws);
        input.spread = std::tan(0.5 * light.angular_diameter_rad);
        return;
    }
    input.toward = light.position_ws - p;
    const double distance_m = glm::length(input.toward);
    input.spread = distance_m * std::tan(std::asin(std::min(light.radius_m / distance_m, 0.9)));
}

// The receiver's footprint on the map. In world space: the camera's rays are those of its whole matrix.
class Footprint {
public:
    Footprint(const ReferenceScene& scene, const MapRows& rows)
        : camera_(scene.camera), rows_(rows), world_from_ndc_(glm::inverse(scene.camera.clip_from_world)),
          pixel_(2.0 / glm::dvec2(scene.picture.extent.width, scene.picture.extent.height))
    {
    }
    void fill(const shared::MapPoint& point, const glm::dvec3& p, const glm::dvec3& n, FilterInput& input) const
    {
        const double w = wOf(p);
        const glm::dvec4 right = world_from_ndc_[0] * (pixel_.x / w);
        const glm::dvec4 below = world_from_ndc_[1] * (pixel_.y / w);
        const glm::dvec4 along = world_from_ndc_[2] / w;
        input.footprint_x = shared::footprintOf(rows_, point.texel, point.w, p, n, right, along);
        input.footprint_y = shared::footprintOf(rows_, point.texel, point.w, p, n, below, along);
    }

    /// How far off its plane the receiver may be: its point is moved by `snap_px` along each axis of the picture, and
    /// by what the depth buffer rounds.
    [[nodiscard]] double offPlane(const glm::dvec3& p, const glm::dvec3& n, double snap_px, double rounding) const
    {
        const glm::dvec4 ndc = (camera_.clip_from_world * glm::dvec4(p, 1.0)) * wOf(p);
        const auto away = [&](const glm::dvec4& step) {
            const glm::dvec4 moved = world_from_ndc_ * (ndc + step);
            return std::abs(glm::dot(n, glm::dvec3(moved) / moved.w - p));
        };
        return away({snap_px * pixel_.x, 0.0, 0.0, 0.0}) + away({0.0, snap_px * pixel_.y, 0.0, 0.0}) +
               away({0.0, 0.0, rounding, 0.0});
    }

private:
    /// The matrix takes the pixel to (p, 1) times the reciprocal of clip space's w.
    [[nodiscard]] double wOf(const glm::dvec3& p) const
    {
        return 1.0 / (camera_.clip_from_world * glm::dvec4(p, 1.0)).w;
    }
    const Camera& camera_;
    const MapRows& rows_;
    glm::dmat4 world_from_ndc_;
    glm::dvec2 pixel_;
};

constexpr double kElsewhere = -1.0;

/// The mask of one view alone; kElsewhere where it does not serve the pixel.
std::vector<double> maskOfView(const ReferenceScene& scene, const Light& light, const View& view,
                               const ShadowOptions& options, std::span<const pack::DepthLayer> layers)
{
    current_maps = scene.maps;
    current_layers = layers;
    current_nudge = scene.nudge;
    current_relative_nudge = scene.relative_nudge;
    current_poisson = options.pcf.kernel == PcfKernel::poisson;
    current_taps = int(options.pcf.taps);
    current_holding = holdingOf(options);
    current_blocks.clear();
    if (comparesInCone(options)) {
        std::ranges::transform(scene.maps, std::back_inserter(current_blocks), blocksOf);
    }
    if (hasSmoothies(options)) {
        smoothies_tile = view.place.tile;
        const int reach = int(options.smoothies.reach_texels);
        const double quantum = quantumOf(formatOf(options));
        current_smoothies = options.technique.filter == Filter::smoothies
                                ? finsOf(*scene.scene, view, mapOf(view.place.tile.layer), reach, quantum)
                                : smoothiesOf(mapOf(view.place.tile.layer), view.place.tile, reach, quantum);
    }
    const Picture& picture = scene.picture;
    MapRows rows = rowsOf(view);
    BiasRule rule = ruleOf(options);
    const Footprint footprint(scene, rows);
    FilterInput input = inputOf(scene, view, options);
    const double margin = 1e-3 + reachOf(options) - 0.5;
    std::vector<double> mask;
    for (std::size_t i = 0; i < picture.depth.size(); ++i) {
        const glm::dvec3 n = picture.normal[i];
        const glm::dvec3 p = picture.position[i];
        turnToLight(light, rows, p, n, input);
        const double most = shared::shareOverHorizon(n, input.toward, input.spread);
        if (n == glm::dvec3(0.0)) {
            mask.push_back(1.0);
        } else if (most == 0.0) {
            mask.push_back(0.0);
        } else {
            rows = rowsAt(view, p);
            const double w = shared::dotRow(rows.w, p);
            const double x = shared::dotRow(rows.x, p) / w - view.place.tile.x;
            const double y = shared::dotRow(rows.y, p) / w - view.place.tile.y;
            if (w <= 0.0 || x < margin || y < margin || x > view.place.tile.width - margin ||
                y > view.place.tile.height - margin || !view.serves.sector.holds(p)) {
                mask.push_back(kElsewhere);
                continue;
            }
            input.pixel = glm::dvec2(i % picture.extent.width, i / picture.extent.width) + 0.5;
            rule.off_plane_m = footprint.offPlane(p, n, rule.snap_texels, scene.camera.reversed_z ? 0.0 : 0x1p-25);
            const auto point = shared::projectReceiver(rows, rule, p, n);
            turnToLight(light, rows, p, n, input);
            if (filterTraits(options.technique.filter)->ids) {
                const std::uint32_t object = picture.object_plus_one[i] - 1;
                const Aabb& box = scene.plan.object_bounds[object];
                input.id = objectIdsOf(scene.plan, view.light)[object];
                if (options.ids.of == IdOf::face) {
                    input.id = shared::idOfPiece(input.id, picture.piece[i], input.kernel.y);
                }
                input.place = p;
                input.object_centre = 0.5 * (glm::dvec3(box.min) + glm::dvec3(box.max));
                input.object_half = 0.5 * (glm::dvec3(box.max) - glm::dvec3(box.min));
            }
            if (options.moments.sampling >= MapSampling::trilinear) {
                footprint.fill(point, p, n, input);
            }
            const bool has_fins = options.technique.filter == Filter::smoothies; // its map is read as pcf reads it
            const Filter read_by = has_fins ? Filter::pcf : options.technique.filter;
            const double filtered = shared::applyFilter(static_cast<int>(read_by), point, input);
            mask.push_back(
                std::min(most, shared::lightenedVisibility(shared::boundedVisibility(filtered), input.moments.lighten,
                                                           input.moments.lighten_cut)));
        }
    }
    current_maps = {};
    current_layers = {};
    current_nudge = {};
    current_relative_nudge = {};
    return mask;
}

/// The mask of the first view that serves each pixel; 1 where none does.
std::vector<double> maskOfViews(const ReferenceScene& scene, const Light& light, std::span<const View> views,
                                const ShadowOptions& options, std::span<const pack::DepthLayer> layers)
{
    std::vector<double> mask(scene.picture.depth.size(), kElsewhere);
    for (const View& view : views) {
        const std::vector<double> here = maskOfView(scene, light, view, options, layers);
        std::ranges::transform(mask, here, mask.begin(),
                               [](double before, double v) { return before == kElsewhere ? v : before; });
    }
    std::ranges::replace(mask, kElsewhere, 1.0);
    return mask;
}

} // namespace

std::vector<double> referenceMask(const ReferenceScene& scene, std::uint32_t index, const ShadowOptions& options,
                                  std::span<const pack::DepthLayer> layers)
{
    const Light& light = scene.lights[index];
    const LightPlan& planned = scene.plan.lights[index];
    const std::span views = std::span(scene.plan.views).subspan(planned.first_view, planned.view_count);
    const SunSteps& steps = planned.steps;
    std::vector<double> mask = maskOfViews(scene, light, steps.paired ? views.first(1) : views, options, layers);
    if (steps.paired) {
        const std::vector<double> later = maskOfViews(scene, light, views.subspan(1), options, layers);
        const glm::dvec4 rule(steps.share, steps.edge, steps.band > 0.0 ? 1.0 / steps.band : 0.0,
                              steps.smooth ? 1.0 : 0.0);
        const std::uint32_t width = scene.picture.extent.width;
        for (std::size_t i = 0; i < mask.size(); ++i) {
            const double weight = shared::stepWeight(rule, (double(i % width) + 0.5) / width);
            mask[i] = shared::steppedVisibility(mask[i], later[i], weight);
        }
    }
    return mask;
}

} // namespace gnomon::test
