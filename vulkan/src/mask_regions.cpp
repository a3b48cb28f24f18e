// SPDX-License-Identifier: Apache-2.0
#include "mask_regions.h"

#include <gnomon/plan_views.h>

#include <algorithm>
#include <cmath>

namespace gnomon::vulkan {
namespace {

bool hasBand(const LightPlan& light)
{
    const SunSteps& steps = light.steps;
    return light.outcome.hasMap() && steps.paired && !steps.alternate && steps.band > 0.0;
}

// Pixels of the screen's width; a share of it that is not a number counts as 0.
std::uint32_t pixels(double share, std::uint32_t width, double (*round)(double))
{
    return share > 0.0 ? static_cast<std::uint32_t>(round(std::min(share, 1.0) * width)) : 0;
}

// Of a band: to the left of `begin` the later position alone counts, from `end` on the earlier one. Rounded outwards,
// so that a pixel on an edge is in the band.
struct BandPixels {
    std::uint32_t begin;
    std::uint32_t end;
};
BandPixels bandPixels(const SunSteps& steps, std::uint32_t width)
{
    return {pixels(steps.edge - steps.band, width, std::floor), pixels(steps.edge, width, std::ceil)};
}

// In a strip that begins at pixel x and has no edge of a band inside.
SunShown shownAt(const LightPlan& light, std::uint32_t x, std::uint32_t width)
{
    const SunSteps& steps = light.steps;
    if (!light.outcome.hasMap() || !steps.paired) {
        return SunShown::all;
    }
    if (steps.alternate) {
        return steps.read == SunPosition::later ? SunShown::later : SunShown::earlier;
    }
    if (hasBand(light)) {
        const BandPixels band = bandPixels(steps, width);
        return x < band.begin ? SunShown::later : x >= band.end ? SunShown::earlier : SunShown::all;
    }
    const double weight = laterWeight(steps, 0.0);
    return weight <= 0.0 ? SunShown::earlier : weight >= 1.0 ? SunShown::later : SunShown::all;
}

} // namespace

glm::vec4 stepRule(const SunSteps& steps)
{
    return {steps.share, steps.edge, steps.band > 0.0 ? 1.0 / steps.band : 0.0, steps.smooth ? 1.0 : 0.0};
}

ShownViews shownViews(const Plan& plan, const LightPlan& light, SunShown shown)
{
    if (!light.outcome.hasMap()) {
        return {};
    }
    if (!light.steps.paired) {
        return {light.first_view, light.view_count, 0, 0};
    }
    std::uint32_t earlier = 0;
    while (earlier < light.view_count && plan.views[light.first_view + earlier].sun != SunPosition::later) {
        ++earlier;
    }
    const std::uint32_t later = light.view_count - earlier;
    const std::uint32_t later_first = light.first_view + earlier;
    // A position without views says nothing: the other one stands for both.
    if (later == 0 || (shown == SunShown::earlier && earlier > 0)) {
        return {light.first_view, earlier, 0, 0};
    }
    if (earlier == 0 || shown == SunShown::later) {
        return {later_first, later, 0, 0};
    }
    return {light.first_view, earlier, later_first, later};
}

MaskRegions maskRegions(const Plan& plan, std::uint32_t layer, std::uint32_t width)
{
    std::array<std::uint32_t, MaskRegions::kMost + 1> edges{};
    std::uint32_t edge_count = 0;
    edges[edge_count++] = 0;
    edges[edge_count++] = width;
    for (const LightPlan& light : plan.lights) {
        if (light.mask_layer == layer && hasBand(light) && edge_count + 2 <= edges.size()) {
            const BandPixels band = bandPixels(light.steps, width);
            edges[edge_count++] = std::min(band.begin, width);
            edges[edge_count++] = std::min(band.end, width);
        }
    }
    std::sort(edges.begin(), edges.begin() + edge_count);
    MaskRegions result;
    for (std::uint32_t i = 0; i + 1 < edge_count; ++i) {
        if (edges[i] == edges[i + 1]) {
            continue;
        }
        MaskRegion& region = result.regions[result.count++];
        region.begin = edges[i];
        region.end = edges[i + 1];
        for (const LightPlan& light : plan.lights) {
            if (light.mask_layer == layer) {
                region.shown[light.mask_channel] = shownAt(light, region.begin, width);
            }
        }
    }
    return result;
}

} // namespace gnomon::vulkan
