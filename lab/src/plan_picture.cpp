// SPDX-License-Identifier: Apache-2.0
#include "lab/plan_picture.h"

#include "plan_panel.h"
#include "plan_table.h"
#include "svg_text.h"

#include <algorithm>
#include <cmath>

namespace gnomon::lab {
namespace {

constexpr double kWidth_px = 1180.0;
constexpr double kMargin_px = 24.0;
constexpr double kTop_px = 84.0;
constexpr PixelRect kAcross{kMargin_px, kTop_px, 620.0, 560.0};
constexpr double kMaps_px = 488.0; // room on the right for the maps
constexpr double kMapGap_px = 16.0;
constexpr double kTitle_px = 20.0; // above a panel
constexpr std::size_t kMostMaps = 9;
constexpr std::size_t kColumns = 130; // columns of the title

std::string textAt(double x, double y, const char* more, std::string_view text, std::size_t columns)
{
    return "<text x=\"" + svgNumber(x) + "\" y=\"" + svgNumber(y) + "\"" + more + ">" + svgText(text, columns) +
           "</text>\n";
}

/// The light's maps, of a stepping sun those of one position.
std::vector<std::uint32_t> shownViews(const Plan& plan, std::uint32_t light)
{
    const LightPlan& planned = plan.lights[light];
    std::vector<std::uint32_t> shown;
    for (std::uint32_t i = planned.first_view; i < planned.first_view + planned.view_count; ++i) {
        if (planned.outcome.hasMap() && plan.views[i].serves.sun != SunPosition::later) {
            shown.push_back(i);
        }
    }
    return shown;
}

PlanLook lookOf(const LightPlane& plane, const Frame& frame)
{
    PlanLook look;
    look.plane = plane;
    const ObjectSet& objects = *frame.objects;
    look.shapes.resize(objects.size());
    for (std::uint32_t i = 0; i < objects.size(); ++i) {
        if (objects.alive(i)) {
            look.shapes[i] = shadowOf(plane, ConvexBody::fromAabb(objects.bounds(i)));
        }
    }
    const glm::dvec3 forward = forwardOf(frame.camera);
    const Aabb bounds = objects.bounds();
    const double far_m =
        glm::length(glm::dvec3(bounds.extent())) + glm::length(glm::dvec3(bounds.centre()) - frame.camera.eye_ws);
    look.eye = plane.project(frame.camera.eye_ws);
    constexpr int kSteps = 256; // where the light has a place, some of the line is behind it
    for (int i = 0; i <= kSteps; ++i) {
        const double share = static_cast<double>(i) / kSteps;
        if (const auto q = plane.project(frame.camera.eye_ws + forward * (far_m * share * share))) {
            look.sight.push_back(*q);
        }
    }
    return look;
}

Polygon cornersOf(const glm::dmat3& map_from_plane)
{
    Polygon corners;
    for (const glm::dvec2& corner : kCorners) {
        corners.push_back(planePoint(map_from_plane, corner.x, corner.y));
    }
    return corners;
}

/// The drawn height of a point light's pyramids.
double reachOf(const Light& light, const ObjectSet& objects)
{
    const double scene_m = glm::length(glm::dvec3(objects.bounds().extent()));
    return light.range_m > 0.0 ? std::min(light.range_m, scene_m) : scene_m;
}

PlanMap mapOf(const PlanScene& scene, const Frame& frame, const Plan& plan, std::uint32_t index)
{
    const View& view = plan.views[index];
    PlanMap map;
    map.view = index;
    map.look = scene.from_above ? lookOf(lightPlaneOf(view, frame.camera), frame) : scene.across;
    map.from_plane = mapFromPlane(map.look.plane, view);
    map.seen = seenFrom(map.look.plane, frame, plan, view);
    if (scene.from_above) {
        map.seen_across = seenFrom(scene.across.plane, frame, plan, view);
        map.outline_across = pyramidOf(scene.across.plane, {map.look.plane, map.from_plane},
                                       reachOf(frame.lights[view.light], *frame.objects));
    } else {
        map.seen_across = map.seen;
        map.outline_across = cornersOf(map.from_plane);
    }
    const auto casters = std::span(plan.casters).subspan(view.casters.first, view.casters.count);
    map.casters.assign(casters.begin(), casters.end());
    return map;
}

PlanScene sceneOf(const Frame& frame, const Plan& plan, std::uint32_t light)
{
    const std::vector<std::uint32_t> shown = shownViews(plan, light);
    PlanScene scene;
    if (shown.empty()) {
        return scene;
    }
    const View& first = plan.views[shown.front()];
    scene.from_above = frame.lights[light].type == LightType::point;
    scene.across = lookOf(scene.from_above ? planeFromAbove(first.projection.light_place_ws, frame.camera)
                                           : lightPlaneOf(first, frame.camera),
                          frame);
    scene.objects.resize(frame.objects->size());
    for (std::uint32_t i = 0; i < frame.objects->size(); ++i) {
        scene.objects[i].casts = frame.objects->alive(i) && frame.objects->flags(i).casts;
    }
    for (const std::uint32_t object : plan.receivers) {
        scene.objects[object].seen = true;
    }
    for (const std::uint32_t index : shown) {
        scene.maps.push_back(mapOf(scene, frame, plan, index));
        for (const std::uint32_t caster : scene.maps.back().casters) {
            scene.objects[caster].drawn = true;
        }
    }
    return scene;
}

std::string mapName(const Plan& plan, const PlanScene& scene, std::size_t i)
{
    const View& view = plan.views[scene.maps[i].view];
    return (scene.maps.size() > 1 ? "Map " + std::to_string(i) : std::string("In the map")) + ": " +
           std::to_string(view.place.tile.width) + " x " + std::to_string(view.place.tile.height) +
           (scene.maps.size() > 4 ? "" : " texels"); // three in a row have no room for it
}

std::string drawMaps(const Plan& plan, const PlanScene& scene)
{
    const std::size_t count = std::min(scene.maps.size(), kMostMaps);
    const double across = std::ceil(std::sqrt(static_cast<double>(count)));
    // Two maps, too, have one column's width each, and one has all the room there is.
    const double side = (kMaps_px - (across - 1.0) * kMapGap_px) / across;
    const double left = kAcross.x + kAcross.width + kMargin_px;
    std::string out;
    for (std::size_t i = 0; i < count; ++i) {
        const double column = static_cast<double>(i % static_cast<std::size_t>(across));
        const double row = std::floor(static_cast<double>(i) / across);
        const PixelRect rect{left + column * (side + kMapGap_px), kTop_px + row * (side + kMapGap_px + kTitle_px), side,
                             side};
        out += textAt(rect.x, rect.y - 7.0, " class=\"h\"", mapName(plan, scene, i), 40);
        out += drawInMap(scene, i, rect);
    }
    return out;
}

double mapsEnd(const PlanScene& scene)
{
    const double count = static_cast<double>(std::min(scene.maps.size(), kMostMaps));
    const double across = std::ceil(std::sqrt(count));
    const double rows = std::ceil(count / across);
    const double side = (kMaps_px - (across - 1.0) * kMapGap_px) / across;
    return kTop_px + rows * side + (rows - 1.0) * (kMapGap_px + kTitle_px);
}

std::string opening(double height_px)
{
    return "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + svgNumber(kWidth_px) + "\" height=\"" +
           svgNumber(height_px) + "\" viewBox=\"0 0 " + svgNumber(kWidth_px) + " " + svgNumber(height_px) +
           "\" font-family=\"sans-serif\" font-size=\"12\" fill=\"#d7dce2\">\n"
           "<style>.h{font-weight:bold}.t{font-size:18px;font-weight:bold;fill:#ffffff}.f{fill:#9aa4b0}"
           ".n{text-anchor:end}.m{text-anchor:middle}</style>\n";
}

} // namespace

std::string planSvg(const Frame& frame, const Plan& plan, std::uint32_t light, const PlanCaption& caption)
{
    const std::vector<std::uint32_t> shown = shownViews(plan, light);
    const bool bent = !shown.empty() && plan.views[shown.front()].projection.paraboloid;
    const PlanScene scene = bent ? PlanScene{} : sceneOf(frame, plan, light);
    const Outcome& outcome = plan.lights[light].outcome;
    std::string body = "<title>" + svgText(caption.title, caption.title.size()) + "</title>\n" +
                       "<rect width=\"100%\" height=\"100%\" rx=\"8\" fill=\"#15181d\"/>\n" +
                       textAt(kMargin_px, 34.0, " class=\"t\"", caption.title, kColumns * 2 / 3) +
                       textAt(kMargin_px, 54.0, " class=\"f\"", caption.subtitle, kColumns);
    if (scene.maps.empty()) {
        constexpr double kHeight_px = 160.0;
        const std::string bends = "not drawn: a paraboloid shows a half space, which no plane across the light holds";
        const std::string why = bent ? bends
                                     : std::string("no map: ") + std::string(nameOf(outcome.kind)) +
                                           (outcome.reason.empty() ? "" : ": ") + std::string(outcome.reason);
        return opening(kHeight_px) + body + textAt(kWidth_px / 2.0, 108.0, " class=\"m\"", why, kColumns) + "</svg>\n";
    }
    body += textAt(kAcross.x, kAcross.y - 7.0, " class=\"h\"",
                   scene.from_above ? "From above: what each map may hold, around the light"
                                    : "Across the rays, as the light sees the scene",
                   60);
    body += drawAcross(scene, kAcross);
    body += drawMaps(plan, scene);
    const double below = std::max(kAcross.y + kAcross.height, mapsEnd(scene)) + 28.0;
    const DrawnBelow table = drawTable(plan, scene, light, {kMargin_px, below, kWidth_px - 2.0 * kMargin_px, 0.0});
    return opening(table.end_px + kMargin_px) + body + table.svg + "</svg>\n";
}

} // namespace gnomon::lab
