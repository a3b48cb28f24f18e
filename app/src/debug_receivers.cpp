// SPDX-License-Identifier: Apache-2.0
#include "debug_drawn.h"

#include "lab/report.h"
#include "lab/score/view_shares.h"
#include "lab/texel_density.h"
#include "lab/tint.h"
#include "streams.h"

#include <gnomon/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>
#include <vector>

namespace gnomon::app {
namespace {

Camera cameraOf(const Drawn& drawn)
{
    const ImageF& depth = drawn.picture.depth;
    return host::cameraOf(drawn.shot.eye, depth.width, depth.height, drawn.shot.state.bounds_ws);
}

double reachOf(const Drawn& drawn)
{
    return static_cast<double>(reachTexels(drawn.settings.shadow));
}

ImageF sharesOf(const Drawn& drawn)
{
    const Camera camera = cameraOf(drawn);
    return lab::viewShares({camera, drawn.picture.depth, drawn.picture.normals}, drawn.plan,
                           static_cast<std::uint32_t>(drawn.light), reachOf(drawn));
}

/// The pixels that its light shines on, if nothing is in the way.
lab::Counted reachedBy(const Drawn& drawn)
{
    const Camera camera = cameraOf(drawn);
    return lab::reachedPixels({camera, drawn.picture.depth, drawn.picture.normals},
                              drawn.shot.lights[drawn.light].caster);
}

const LightPlan& lightOf(const Drawn& drawn)
{
    return drawn.plan.lights[drawn.light];
}

/// The kind of each of a light's views, from 0: a slice is of one kind, for whichever of the sun's positions it is.
std::vector<std::uint32_t> kindsOf(std::span<const View> views)
{
    std::vector<std::uint32_t> kinds;
    std::uint32_t count = 0;
    for (const View& view : views) {
        const auto twin = std::find_if(views.begin(), views.end(), [&](const View& other) {
            return view.serves.sun == SunPosition::later && other.serves.sun == SunPosition::earlier &&
                   other.serves.slice.begin_m == view.serves.slice.begin_m &&
                   other.serves.slice.end_m == view.serves.slice.end_m;
        });
        kinds.push_back(twin == views.end() ? count++ : kinds[static_cast<std::size_t>(twin - views.begin())]);
    }
    return kinds;
}

std::string nameOfView(const View& view, std::uint32_t index)
{
    const ViewSlice& slice = view.serves.slice;
    std::string name = fmt::format("map {}: ", index);
    if (slice.bounded()) {
        name += slice.across ? "across the light " : slice.isRatio() ? "eye / lamp depth " : "";
        name += std::isfinite(slice.begin_m) ? fmt::format("from {:.3g} ", slice.begin_m) : "";
        name += std::isfinite(slice.end_m) ? fmt::format("to {:.3g} ", slice.end_m) : "";
        name.insert(name.size() - 1, slice.isRatio() ? "," : " m,");
    }
    return fmt::format("{}texel {:.3g} m{}", name, view.projection.texel_m, view.projection.parallel ? "" : " at 1 m");
}

} // namespace

void requireMap(const Drawn& drawn, std::string_view what)
{
    const Outcome& outcome = lightOf(drawn).outcome;
    if (!outcome.hasMap()) {
        throw Error(fmt::format("showing the {} of light {}", what, drawn.shot.lights[drawn.light].name),
                    std::string(outcome.reason));
    }
}

Image8 densityView(const Drawn& drawn)
{
    requireMap(drawn, "density");
    const Camera camera = cameraOf(drawn);
    const lab::Counted facing = lab::facingPixels(drawn.picture, camera, drawn.shot.lights[drawn.light].caster);
    return lab::densityPicture(lab::texelDensity(drawn.picture, facing, camera, drawn.plan,
                                                 static_cast<std::uint32_t>(drawn.light), reachOf(drawn))
                                   .map);
}

Image8 viewsView(const Drawn& drawn)
{
    requireMap(drawn, "views");
    const LightPlan& light = lightOf(drawn);
    const std::span<const View> views = std::span(drawn.plan.views).subspan(light.first_view, light.view_count);
    const std::vector<std::uint32_t> kinds = kindsOf(views);
    const std::uint32_t most = *std::max_element(kinds.begin(), kinds.end());
    const ImageF shares = sharesOf(drawn);
    ImageF joined(shares.width, shares.height, std::min<std::uint32_t>(most + 1, lab::kMostTints));
    lab::TintLegend legend;
    legend.title = "Which map a pixel is shadowed from";
    legend.subtitle = "mixed where two are; grey: no map, or out of reach";
    for (std::size_t i = 0; i < views.size() && legend.kinds.size() < joined.channels; ++i) {
        if (kinds[i] == legend.kinds.size()) {
            legend.kinds.push_back(nameOfView(views[i], kinds[i]));
        }
    }
    const lab::Counted reached = reachedBy(drawn);
    for (std::uint32_t y = 0; y < shares.height; ++y) {
        for (std::uint32_t x = 0; x < shares.width; ++x) {
            for (std::size_t i = 0; *reached.pixel(x, y) != 0 && i < views.size(); ++i) {
                joined.pixel(x, y)[kinds[i] % joined.channels] += shares.pixel(x, y)[i];
            }
        }
    }
    return lab::tintedPicture(drawn.picture.colour, joined, legend);
}

Image8 fadedView(const Drawn& drawn)
{
    requireMap(drawn, "faded");
    const LightPlan& light = lightOf(drawn);
    const std::span<const View> views = std::span(drawn.plan.views).subspan(light.first_view, light.view_count);
    const ImageF shares = sharesOf(drawn);
    const lab::Counted reached = reachedBy(drawn);
    ImageF joined(shares.width, shares.height, 2);
    for (std::uint32_t y = 0; y < shares.height; ++y) {
        for (std::uint32_t x = 0; x < shares.width; ++x) {
            for (std::size_t i = 0; *reached.pixel(x, y) != 0 && i < views.size(); ++i) {
                joined.pixel(x, y)[views[i].serves.faded_in < 1.0 ? 1 : 0] += shares.pixel(x, y)[i];
            }
        }
    }
    lab::TintLegend legend;
    legend.title = "What fades in";
    legend.subtitle = "mixed by what each counts for; grey: no map, or out of reach";
    legend.kinds = {"maps that were there", "maps that fade in over them"};
    const auto coming =
        std::count_if(views.begin(), views.end(), [](const View& view) { return view.serves.faded_in < 1.0; });
    notice(fmt::format("light {}: {} of {} maps fade in", drawn.shot.lights[drawn.light].name, coming, views.size()));
    return lab::tintedPicture(drawn.picture.colour, joined, legend);
}

Image8 lightCountView(const Drawn& drawn)
{
    const Camera camera = cameraOf(drawn);
    const lab::Sight seen{camera, drawn.picture.depth, drawn.picture.normals};
    ImageOf<std::uint8_t> lights(seen.depth.width, seen.depth.height, 1);
    for (std::size_t light = 0; light < drawn.plan.lights.size(); ++light) {
        if (!drawn.plan.lights[light].outcome.hasMap()) {
            continue;
        }
        const lab::Counted facing = lab::facingPixels(seen, drawn.shot.lights[light].caster);
        const lab::Counted reached = lab::reachedPixels(seen, drawn.shot.lights[light].caster);
        for (std::size_t i = 0; i < lights.values.size(); ++i) {
            lights.values[i] = static_cast<std::uint8_t>(lights.values[i] + (facing.values[i] & reached.values[i]));
        }
    }
    std::uint64_t surfaces = 0;
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < lights.values.size(); ++i) {
        surfaces += drawn.picture.object_ids.values[i] != 0 ? 1 : 0;
        sum += lights.values[i];
    }
    notice(fmt::format("{:.2f} lights with a shadow reach a pixel that sees a surface, {} at most",
                       static_cast<double>(sum) / static_cast<double>(std::max<std::uint64_t>(surfaces, 1)),
                       *std::max_element(lights.values.begin(), lights.values.end())));
    return lab::lightCountPicture(lights);
}

Image8 raysView(const Drawn& drawn)
{
    requireMap(drawn, "rays");
    const auto& mask = drawn.picture.masks[drawn.light];
    ImageOf<std::uint8_t> kinds(mask.width, mask.height, 1);
    std::array<std::size_t, 4> pixels{};
    for (std::uint32_t y = 0; y < mask.height; ++y) {
        for (std::uint32_t x = 0; x < mask.width; ++x) {
            // The nearest of them, for two cascades may have been read; 0 and 1 say nothing of rays.
            const auto quarters = static_cast<std::uint8_t>(std::lround(*mask.pixel(x, y) * 4.0F));
            const bool asked = *drawn.picture.object_ids.pixel(x, y) != 0 && quarters >= 1 && quarters <= 3;
            *kinds.pixel(x, y) = asked ? quarters : 0;
            ++pixels[*kinds.pixel(x, y)];
        }
    }
    const double all = std::max<double>(1.0, static_cast<double>(pixels[1] + pixels[2] + pixels[3]));
    const auto share = [&](std::size_t kind) {
        return 100.0 * static_cast<double>(pixels[kind]) / all;
    };
    notice(
        fmt::format("light {}: {:.1f} % of the pixels that face it take rays, {:.1f} % come to the ceiling of raymarch",
                    drawn.shot.lights[drawn.light].name, share(2) + share(3), share(3)));
    lab::TintLegend legend;
    legend.title = "Rays of raymarch";
    legend.subtitle = "grey: faces away from the light, or is in no map";
    legend.kinds = {"none: decided by blocks", "as many as wanted", "ceiling: fewer, or ended early"};
    return lab::tintedPicture(drawn.picture.colour, kinds, legend);
}

Image8 stepsView(const Drawn& drawn)
{
    requireMap(drawn, "steps");
    const LightPlan& light = lightOf(drawn);
    const ImageF shares = sharesOf(drawn);
    ImageF positions(shares.width, shares.height, 2);
    for (std::uint32_t y = 0; y < shares.height; ++y) {
        for (std::uint32_t x = 0; x < shares.width; ++x) {
            for (std::uint32_t i = 0; i < light.view_count; ++i) {
                const bool later = drawn.plan.views[light.first_view + i].serves.sun == SunPosition::later;
                positions.pixel(x, y)[later ? 1 : 0] += shares.pixel(x, y)[i];
            }
        }
    }
    lab::TintLegend legend;
    legend.title = "Which of the sun's two positions shadows";
    legend.subtitle = fmt::format("{:.0f} % of the way gone; grey: no map here", 100.0 * light.steps.share);
    legend.kinds = {"the earlier", "the later"};
    return lab::tintedPicture(drawn.picture.colour, positions, legend);
}

} // namespace gnomon::app
