// SPDX-License-Identifier: Apache-2.0
#define GNOMON_REAL double
#include "reference.h"

#include <shared/discs.h>

#include <algorithm>
#include <cmath>

namespace gnomon::test {
namespace {
const CpuMap* current_map = nullptr;
bool current_poisson = false;
int current_taps = 0;
double texel(std::int64_t x, std::int64_t y)
{
    const std::int64_t cx = std::clamp<std::int64_t>(x, 0, current_map->width - 1);
    const std::int64_t cy = std::clamp<std::int64_t>(y, 0, current_map->height - 1);
    return current_map->texels[static_cast<std::size_t>(cy * current_map->width + cx)];
}
} // namespace
} // namespace gnomon::test

GN_BEGIN
inline real mapTexel(real2 at, real)
{
    return test::texel(static_cast<std::int64_t>(at.x), static_cast<std::int64_t>(at.y));
}
inline real4 mapGather(real2 corner, real)
{
    const auto x = static_cast<std::int64_t>(corner.x);
    const auto y = static_cast<std::int64_t>(corner.y);
    return {test::texel(x - 1, y), test::texel(x, y), test::texel(x, y - 1), test::texel(x - 1, y - 1)};
}
inline real2 discPoint(int i)
{
    return test::current_poisson ? kPoissonPoints[i] : vogelPoint(i, test::current_taps);
}
GN_END

#include <lib/visibility.glsl>

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
    const glm::dvec4 w = rowOf(view.clip_from_world, 3);
    rows.x = 0.5 * view.tile.width * (rowOf(view.clip_from_world, 0) + w) + double(view.tile.x) * w;
    rows.y = 0.5 * view.tile.height * (rowOf(view.clip_from_world, 1) + w) + double(view.tile.y) * w;
    rows.w = w;
    rows.metric = view.metric.metric_ws;
    rows.texel_m = view.texel_m;
    rows.range_m = view.metric.far_m - view.metric.near_m;
    return rows;
}

BiasRule ruleOf(const vulkan::FilterOptions& options)
{
    const double width = widthOf(options.pcf_kernel);
    const double pcf_reach = width > 0 ? (width + 1) / 2 : double(options.disc_radius_texels) + 1.0;
    const BiasOptions& bias = options.bias;
    BiasRule rule;
    rule.automatic = bias.automatic ? 1.0 : 0.0;
    rule.constant_m = bias.constant_m;
    rule.slope = bias.slope;
    rule.normal_texels = bias.normal_texels;
    rule.receiver_plane = bias.receiver_plane ? 1.0 : 0.0;
    rule.reach_texels = options.filter == Filter::hard ? 0.5 : pcf_reach;
    rule.quantum = 4e-6 + (options.format == MapFormat::d16 ? 1.5 / 65535.0 : 0.0);
    return rule;
}

double edgeMargin(const vulkan::FilterOptions& options)
{
    const int width = widthOf(options.pcf_kernel);
    if (options.filter == Filter::hard) {
        return 1e-3;
    }
    return 1e-3 + (width > 0 ? width * 0.5 : double(options.disc_radius_texels) + 0.5);
}

} // namespace

std::vector<double> referenceMask(const Picture& picture, std::span<const Light> lights, const Plan& plan,
                                  std::uint32_t index, const CpuMap& map, const vulkan::FilterOptions& options)
{
    current_map = &map;
    const Light& light = lights[index];
    const View& view = plan.views[plan.lights[index].first_view];
    const MapRows rows = rowsOf(view);
    const BiasRule rule = ruleOf(options);
    FilterInput input{};
    input.kernel_width = widthOf(options.pcf_kernel);
    input.disc_taps = int(options.disc_taps);
    current_poisson = options.pcf_kernel == PcfKernel::poisson;
    current_taps = input.disc_taps;
    input.disc_radius = options.disc_radius_texels;
    input.kernel = shared::gaussianWeights(std::max(input.kernel_width, 1), double(options.gaussian_sigma_texels));
    const double margin = edgeMargin(options);
    std::vector<double> mask;
    for (std::size_t i = 0; i < picture.depth.size(); ++i) {
        const glm::dvec3 n = picture.normal[i];
        const glm::dvec3 p = picture.position[i];
        const glm::dvec3 to_light =
            light.type == LightType::directional ? -light.direction_ws : glm::normalize(light.position_ws - p);
        if (n == glm::dvec3(0.0)) {
            mask.push_back(1.0);
        } else if (!shared::facesDirection(n, to_light)) {
            mask.push_back(0.0);
        } else {
            const double w = shared::dotRow(rows.w, p);
            const double x = shared::dotRow(rows.x, p) / w - view.tile.x;
            const double y = shared::dotRow(rows.y, p) / w - view.tile.y;
            if (w <= 0.0 || x < margin || y < margin || x > view.tile.width - margin || y > view.tile.height - margin) {
                mask.push_back(1.0);
                continue;
            }
            input.pixel = glm::dvec2(i % picture.extent.width, i / picture.extent.width) + 0.5;
            const auto point = shared::projectReceiver(rows, rule, p, n);
            mask.push_back(
                shared::boundedVisibility(shared::applyFilter(static_cast<int>(options.filter), point, input)));
        }
    }
    current_map = nullptr;
    return mask;
}

} // namespace gnomon::test
