// SPDX-License-Identifier: Apache-2.0
#include "debug_views.h"

#include "debug_drawn.h"
#include "files/files.h"
#include "lab/map_picture.h"
#include "lab/tint.h"
#include "layer_depths.h"
#include "streams.h"

#include <gnomon/error.h>
#include <gnomon/object_ids.h>
#include <gnomon/pack/filter_rule.h>
#include <gnomon/plan_views.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>

namespace gnomon::app {
namespace {

/// The first of a light's views that has a point, or kNoIndex; of a sun between two positions, of the stronger one's.
std::uint32_t viewOf(const Plan& plan, std::uint32_t light, const glm::dvec3& point_ws)
{
    for (const View& view : viewsOf(plan, light, strongerPosition(plan.lights[light].steps))) {
        const glm::dvec4 clip = view.projection.clip_from_world * glm::dvec4(point_ws, 1.0);
        const bool inside = clip.w > 0.0 && std::abs(clip.x) <= clip.w && std::abs(clip.y) <= clip.w;
        if (inside && view.serves.slice.holds(point_ws) && view.serves.sector.holds(point_ws)) {
            return static_cast<std::uint32_t>(&view - plan.views.data());
        }
    }
    return kNoIndex;
}

/// 1 + the layer that each receiver reads; 0 for the background and what is in no map.
ImageOf<std::uint8_t> layersOfPixels(const Drawn& drawn, const std::vector<std::vector<pack::DepthLayer>>& layers)
{
    const ImageF& depth = drawn.picture.depth;
    const Camera camera = host::cameraOf(drawn.shot.eye, depth.width, depth.height, drawn.shot.state.bounds_ws);
    const glm::dmat4 world_from_clip = glm::inverse(camera.clip_from_world);
    const LightPlan& light = drawn.plan.lights[drawn.light];
    ImageOf<std::uint8_t> kinds(depth.width, depth.height, 1);
    for (std::uint32_t y = 0; y < depth.height; ++y) {
        for (std::uint32_t x = 0; x < depth.width; ++x) {
            if (*drawn.picture.object_ids.pixel(x, y) == 0) {
                continue;
            }
            const glm::dvec4 ndc(2.0 * (x + 0.5) / depth.width - 1.0, 2.0 * (y + 0.5) / depth.height - 1.0,
                                 *depth.pixel(x, y), 1.0);
            const glm::dvec4 place = world_from_clip * ndc;
            const glm::dvec3 point_ws = glm::dvec3(place) / place.w;
            const std::uint32_t view = viewOf(drawn.plan, static_cast<std::uint32_t>(drawn.light), point_ws);
            if (view != kNoIndex) {
                const double d = storedDepth(drawn.plan.views[view], drawn.settings.shadow.moments, point_ws);
                *kinds.pixel(x, y) = static_cast<std::uint8_t>(1 + layerOf(layers[view - light.first_view], d));
            }
        }
    }
    return kinds;
}

Image8 layersPicture(const Drawn& drawn)
{
    const LightPlan& light = drawn.plan.lights[drawn.light];
    requireMap(drawn, "layers");
    std::vector<std::vector<pack::DepthLayer>> layers;
    for (std::uint32_t i = 0; i < light.view_count; ++i) {
        layers.push_back(drawn.renderer.depthLayers(light.first_view + i));
    }
    const MomentOptions& options = drawn.settings.shadow.moments;
    lab::TintLegend legend;
    legend.title =
        fmt::format("Layers of depth, placed {}", options.placement == LayerPlacement::by_hand ? "by hand"
                                                  : options.placement == LayerPlacement::lloyd ? "by Lloyd relaxation"
                                                  : options.placement == LayerPlacement::gaps  ? "by gaps"
                                                  : options.placement == LayerPlacement::world ? "in the world"
                                                                                               : "uniformly");
    legend.subtitle = "the layer a receiver reads; grey: no map here";
    for (std::uint32_t i = 0; i < options.layers; ++i) {
        const View& view = drawn.plan.views[light.first_view];
        const std::vector<pack::DepthLayer>& first = layers.front();
        const double ends = i + 1 < first.size() ? static_cast<double>(first[i + 1].begins) : 1.0;
        legend.kinds.push_back(light.view_count > 1
                                   ? fmt::format("layer {}", i)
                                   : fmt::format("layer {}: {:.2f} to {:.2f} m", i,
                                                 metresOf(view, options, static_cast<double>(first[i].begins)),
                                                 metresOf(view, options, ends)));
    }
    return lab::tintedPicture(drawn.picture.colour, layersOfPixels(drawn, layers), legend);
}

/// The map with the meaning of each texel as it is read: metres along the light, or the id with filter id. For lvsm it
/// is the first layer; filters that blur have it blurred. `map`: the image that it lies in.
lab::MapPanel panelOf(const ImageF& map, const ResolvedOptions& options, const View& view)
{
    const Tile& tile = view.place.tile;
    const bool has_ids = options.filter() == Filter::id;
    lab::MapPanel panel{"", ImageF(tile.width, tile.height, 1)};
    for (std::uint32_t y = 0; y < tile.height; ++y) {
        for (std::uint32_t x = 0; x < tile.width; ++x) {
            const float stored =
                pack::mapDepth(options, {map.pixel(tile.x + x, tile.y + y), map.channels}, view.place.part);
            *panel.values.pixel(x, y) =
                has_ids ? stored * static_cast<float>(idsOf(options.format()))
                        : static_cast<float>(metresOf(view, options.moments(), static_cast<double>(stored)));
        }
    }
    return panel;
}

/// A parallel light has no place to measure from: the nearest texel is its 0.
void measureFromNearest(std::vector<lab::MapPanel>& panels)
{
    const float least = lab::rangeOf(panels).least;
    for (lab::MapPanel& panel : panels) {
        for (float& value : panel.values.values) {
            value -= least;
        }
    }
}

/// All of the light's maps; of a sun between two positions, the stronger one's, which are drawn for certain.
Image8 mapsPicture(const Drawn& drawn)
{
    requireMap(drawn, "map");
    const ResolvedOptions options = resolvedOrThrow(drawn.settings.shadow);
    const LightPlan& light = drawn.plan.lights[drawn.light];
    auto views = viewsOf(drawn.plan, static_cast<std::uint32_t>(drawn.light), strongerPosition(light.steps));
    if (views.empty()) { // a position may have none
        views = std::span(drawn.plan.views).subspan(light.first_view, 1);
    }
    const std::string& name = drawn.shot.lights[drawn.light].name;
    const bool has_ids = options.filter() == Filter::id;
    std::vector<lab::MapPanel> panels;
    std::map<std::uint32_t, ImageF> images; // by Tile::layer: hundreds of maps may lie in one
    for (const View& view : views) {
        if (const Tile& tile = view.place.tile; tile.width > 0) {
            if (!images.contains(tile.layer)) {
                const std::uint32_t layers = imageLayersPerMap(options.filter(), options.moments());
                images.emplace(tile.layer, drawn.renderer.readMap(tile.layer * layers));
            }
            panels.push_back(panelOf(images.at(tile.layer), options, view));
            panels.back().name = fmt::format("{}, map {} of {}", name, panels.size(), views.size());
        }
    }
    lab::MapLegend legend;
    legend.title = fmt::format("Map{} of light {:.30}", panels.size() > 1 ? "s" : "", name);
    if (has_ids) {
        legend.subtitle = "the object that is nearest to the light; 0: none";
        legend.low = "ids";
    } else {
        const bool is_parallel = views.front().projection.parallel;
        if (is_parallel) {
            measureFromNearest(panels);
        }
        legend.subtitle =
            is_parallel ? "how far along its rays, from the nearest texel" : "how far along the map's axis";
        legend.low = "near";
        legend.high = "far, or nothing there";
    }
    const std::string_view unit = has_ids ? "" : " m";
    legend.text_of = [has_ids](double value) {
        return has_ids ? fmt::format("{:.0f}", value) : fmt::format("{:.3g} m", value);
    };
    const lab::ValueRange range = lab::rangeOf(panels);
    if (range.greatest >= range.least) {
        notice(fmt::format("light {}: its map's {} is {:.6g}{} where black and {:.6g}{} where white", name,
                           has_ids ? "id" : "depth", range.least, unit, range.greatest, unit));
    }
    return lab::mapPicture(panels, legend);
}

struct DebugView {
    std::string_view name;
    bool (*used)(const Settings&);
    std::string_view used_when;
    Image8 (*paint)(const Drawn&);
};
bool always(const Settings&)
{
    return true;
}

bool isMapped(const Settings& s)
{
    return hasMaps(s.shadow);
}

bool fades(const Settings& s)
{
    const Technique& technique = s.shadow.technique;
    return technique.partition == Partition::multi && technique.motion == Motion::snap &&
           s.shadow.multi.fade_frames > 0;
}

bool steps(const Settings& s)
{
    const Motion motion = s.shadow.technique.motion;
    return motion != Motion::free && motion != Motion::snap;
}

constexpr std::array kViews{
    DebugView{"density", isMapped, "a technique that has a map", densityView},
    DebugView{"faded", fades, "partition multi, motion snap and multi.fade not 0", fadedView},
    DebugView{"layers", [](const Settings& s) { return s.shadow.technique.filter == Filter::lvsm; },
              "filter lvsm: the others have no layers of depth", layersPicture},
    DebugView{"light-count", always, "a technique that has a map", lightCountView},
    DebugView{"map", isMapped, "a technique that has a map", mapsPicture},
    DebugView{"octree", isMapped, "a technique that has a map", octreeView},
    DebugView{"rays",
              [](const Settings& s) {
                  return filterOf(s.shadow) == Filter::raymarch && s.shadow.technique.soften == Soften::none &&
                         s.shadow.mask_size == MaskSize::full;
              },
              "filter raymarch, soften none and mask-size full", raysView},
    DebugView{"steps", steps, "a motion that steps", stepsView},
    DebugView{"views", isMapped, "a technique that has a map", viewsView},
};

const DebugView* findView(std::string_view name)
{
    const auto* const found =
        std::find_if(kViews.begin(), kViews.end(), [&](const DebugView& view) { return view.name == name; });
    return found != kViews.end() ? found : nullptr;
}

} // namespace

std::vector<std::string_view> debugViewNames()
{
    std::vector<std::string_view> names{"none"};
    for (const DebugView& view : kViews) {
        names.push_back(view.name);
    }
    return names;
}

void requireDebugView(const Settings& settings)
{
    const DebugView* view = findView(settings.debug);
    if (view == nullptr) {
        return;
    }
    if (settings.mask || settings.truth) {
        throw UsageError(fmt::format("--debug {} shows a technique's picture, so it cannot be had with {}", view->name,
                                     settings.mask ? "--mask" : "--truth"));
    }
    if (hasExtension(settings.output, ".exr")) {
        throw UsageError(fmt::format("--debug {} makes a picture of 8 bits; write it as .png", view->name));
    }
    if (!view->used(settings)) {
        throw UsageError(fmt::format("--debug {} needs {}", view->name, view->used_when));
    }
}

Image8 debugPicture(host::FrameRenderer& renderer, const Shot& shot, const Settings& settings, std::size_t light)
{
    const host::Picture picture = renderer.read({.colour = true, .linear = false, .masks = true, .geometry = true});
    return findView(settings.debug)->paint({picture, renderer.plan(), renderer, shot, settings, light});
}

} // namespace gnomon::app
