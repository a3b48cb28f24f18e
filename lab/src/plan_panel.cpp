// SPDX-License-Identifier: Apache-2.0
#include "plan_panel.h"

#include "false_colour.h"
#include "svg_text.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

namespace gnomon::lab {
namespace {

constexpr int kEighths = 8;

/// A window [-1, 1] x [-1, 1] of the plane, y down, drawn into a rectangle.
struct Panel {
    PixelRect rect;
    glm::dmat3 window_from_plane{1.0};
    std::string name; // the name of its clip path

    [[nodiscard]] glm::dvec2 pixel(const glm::dvec2& window) const
    {
        return {rect.x + (window.x * 0.5 + 0.5) * rect.width, rect.y + (window.y * 0.5 + 0.5) * rect.height};
    }
    [[nodiscard]] glm::dvec2 windowOf(const glm::dvec2& q) const
    {
        const glm::dvec3 p = window_from_plane * glm::dvec3(q, 1.0);
        return glm::dvec2(p) / p.z;
    }
};

/// A tenth of a pixel is enough, and keeps pictures of a thousand boxes small.
std::string at(const glm::dvec2& px)
{
    return svgNumber(std::round(px.x * 10.0) / 10.0) + " " + svgNumber(std::round(px.y * 10.0) / 10.0);
}

std::string pathOf(const Panel& panel, std::span<const glm::dvec2> window, bool closed)
{
    std::string d;
    for (const glm::dvec2& p : window) {
        d += (d.empty() ? "M" : "L") + at(panel.pixel(p));
    }
    return d.empty() ? d : "<path d=\"" + d + (closed ? "Z" : "") + "\"/>\n";
}

struct Extent {
    glm::dvec2 low{std::numeric_limits<double>::infinity()};
    glm::dvec2 high{-std::numeric_limits<double>::infinity()};

    void add(const glm::dvec2& q)
    {
        low = glm::min(low, q);
        high = glm::max(high, q);
    }
    [[nodiscard]] glm::dvec2 size() const { return high - low; }
};

/// A tenth of a pixel, from one corner to the next.
std::string by(double px)
{
    return svgNumber(std::round(px * 10.0) / 10.0);
}

/// A closed shape as part of a path's data. A shape of a few pixels is replaced by its box, whose text is a third as
/// long: a scene may have thousands.
std::string outlineOf(const Panel& panel, const Polygon& window)
{
    constexpr double kSmall_px = 4.0;
    Extent extent;
    for (const glm::dvec2& p : window) {
        extent.add(panel.pixel(p));
    }
    const glm::dvec2 size = extent.size();
    if (size.x < kSmall_px && size.y < kSmall_px) {
        return "M" + at(extent.low) + "h" + by(size.x) + "v" + by(size.y) + "h" + by(-size.x) + "z";
    }
    std::string d;
    for (const glm::dvec2& p : window) {
        d += (d.empty() ? "M" : "L") + at(panel.pixel(p));
    }
    return d + "z";
}

/// The visible part of a polygon. Lines along the cut lie outside, where nothing is shown.
std::string shapeOf(const Panel& panel, const Polygon& polygon)
{
    constexpr double kOutside = 1.05;
    const Polygon window = inWindow(polygon, panel.window_from_plane, kOutside);
    return window.size() < 3 ? "" : outlineOf(panel, window);
}

std::string group(const char* name, const std::string& style, const std::string& content)
{
    return content.empty() ? "" : "<g class=\"" + std::string(name) + "\" " + style + ">\n" + content + "</g>\n";
}

/// Many shapes as one, so that where they overlap nothing is painted twice.
std::string shapes(const char* name, const std::string& style, const std::string& data)
{
    return data.empty() ? "" : "<path class=\"" + std::string(name) + "\" " + style + " d=\"" + data + "\"/>\n";
}

std::string open(const Panel& panel)
{
    const PixelRect& r = panel.rect;
    const std::string place = "x=\"" + svgNumber(r.x) + "\" y=\"" + svgNumber(r.y) + "\" width=\"" +
                              svgNumber(r.width) + "\" height=\"" + svgNumber(r.height) + "\"";
    return "<clipPath id=\"" + panel.name + "\"><rect " + place + "/></clipPath>\n<rect " + place +
           " fill=\"#20252c\"/>\n<g clip-path=\"url(#" + panel.name + ")\" fill=\"none\" stroke-linejoin=\"round\">\n";
}

std::string drawObjects(const PlanScene& scene, const PlanLook& look, const Panel& panel,
                        const std::vector<bool>& drawn, bool with_culled)
{
    std::string culled;
    std::string seen;
    std::string casters;
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        const PlanObject& object = scene.objects[i];
        if (drawn[i]) {
            casters += shapeOf(panel, look.shapes[i]);
        } else if (object.seen) {
            seen += shapeOf(panel, look.shapes[i]);
        } else if (with_culled && object.casts) {
            culled += shapeOf(panel, look.shapes[i]);
        }
    }
    return shapes("culled", R"(stroke="#7d8896" stroke-width="0.7" stroke-dasharray="3 2.5")", culled) +
           shapes("casters",
                  R"(fill="#ffffff" fill-opacity="0.14" stroke="#ffffff" stroke-opacity="0.5" stroke-width="0.7")",
                  casters) +
           shapes("seen", R"(stroke="#6fcf97" stroke-width="0.8")", seen);
}

std::string drawSeen(const Polygon& seen, const Panel& panel, std::size_t index)
{
    const std::string colour = mapColour(index);
    return shapes("body",
                  "fill=\"" + colour + "\" fill-opacity=\"0.24\" stroke=\"" + colour +
                      "\" stroke-width=\"1.4\" stroke-dasharray=\"6 3\"",
                  shapeOf(panel, seen));
}

/// The map's edge, and lines at every eighth of it.
std::string drawFrame(const PlanMap& map, const Panel& panel, std::size_t index)
{
    const std::string style = "stroke=\"" + mapColour(index) + "\"";
    const auto line = [&](double ax, double ay, double bx, double by) {
        const std::array<glm::dvec2, 2> ends{panel.windowOf(planePoint(map.from_plane, ax, ay)),
                                             panel.windowOf(planePoint(map.from_plane, bx, by))};
        return pathOf(panel, ends, false);
    };
    std::string lines;
    for (int i = 1; i < kEighths; ++i) {
        const double s = 2.0 * i / kEighths - 1.0;
        lines += line(s, -1.0, s, 1.0) + line(-1.0, s, 1.0, s);
    }
    Polygon edge;
    for (const glm::dvec2& corner : kCorners) {
        edge.push_back(panel.windowOf(planePoint(map.from_plane, corner.x, corner.y)));
    }
    return group("eighths", style + " stroke-width=\"0.8\" stroke-opacity=\"0.5\"", lines) +
           group("edge", style + " stroke-width=\"2.2\"", pathOf(panel, edge, true));
}

/// The pyramid from above that a map covers, of a light with maps all around it.
std::string drawPyramid(const PlanMap& map, const Panel& panel, std::size_t index)
{
    Polygon edge;
    for (const glm::dvec2& q : map.outline_across) {
        edge.push_back(panel.windowOf(q));
    }
    return group("edge", "stroke=\"" + mapColour(index) + "\" stroke-width=\"2.2\"", pathOf(panel, edge, true));
}

bool isInside(const glm::dvec2& window)
{
    return std::abs(window.x) < 1.0 && std::abs(window.y) < 1.0;
}

/// The line of sight, as far as it is in the panel, with an arrow's head, and the eye if it is there.
std::string drawSight(const PlanLook& look, const Panel& panel)
{
    Polygon shown;
    for (const glm::dvec2& q : look.sight) {
        const glm::dvec3 p = panel.window_from_plane * glm::dvec3(q, 1.0);
        if (p.z > 0.0 && isInside(glm::dvec2(p) / p.z)) {
            shown.emplace_back(glm::dvec2(p) / p.z);
        } else if (!shown.empty()) {
            break;
        }
    }
    std::string out;
    const glm::dvec2 from = shown.empty() ? glm::dvec2(0.0) : panel.pixel(shown.front());
    const glm::dvec2 to = shown.empty() ? glm::dvec2(0.0) : panel.pixel(shown.back());
    if (const double length = glm::length(to - from); length > 24.0) {
        const glm::dvec2 along = (to - from) / length;
        const glm::dvec2 across(-along.y, along.x);
        const glm::dvec2 tip = from + along * (length * 0.5);
        out += "<path d=\"M" + at(from) + "L" + at(to) + "\" stroke-dasharray=\"2 5\"/>\n<path d=\"M" +
               at(tip - along * 12.0 + across * 6.0) + "L" + at(tip) + "L" + at(tip - along * 12.0 - across * 6.0) +
               "\" stroke-width=\"2.2\"/>\n";
    }
    if (look.eye) {
        const glm::dvec3 p = panel.window_from_plane * glm::dvec3(*look.eye, 1.0);
        if (p.z > 0.0 && isInside(glm::dvec2(p) / p.z)) {
            const glm::dvec2 px = panel.pixel(glm::dvec2(p) / p.z);
            out += "<circle cx=\"" + svgNumber(px.x) + "\" cy=\"" + svgNumber(px.y) + "\" r=\"5\" fill=\"#15181d\"/>\n";
        }
    }
    return group("sight", R"(stroke="#ffffff" stroke-width="1.6" stroke-linecap="round")", out);
}

/// Around all maps, with what is culled close by, and with the eye if it is not far off.
Extent extentOf(const PlanScene& scene)
{
    Extent extent;
    for (const PlanMap& map : scene.maps) {
        for (const glm::dvec2& q : map.outline_across) {
            extent.add(q);
        }
        for (const glm::dvec2& q : map.seen_across) {
            extent.add(q);
        }
    }
    if (scene.across.eye) {
        Extent more = extent;
        more.add(*scene.across.eye);
        constexpr double kMost = 1.3; // times as large
        const glm::dvec2 grown = more.size() / extent.size();
        extent = grown.x < kMost && grown.y < kMost ? more : extent;
    }
    return extent;
}

/// A length of 1, 2 or 5 times a power of ten that is at most `most` long.
double roundLength(double most)
{
    const double power = std::pow(10.0, std::floor(std::log10(most)));
    for (const double digit : {5.0, 2.0}) {
        if (digit * power <= most) {
            return digit * power;
        }
    }
    return power;
}

std::string drawScale(const PlanScene& scene, const Panel& panel, double px_per_unit)
{
    const double length = roundLength(0.25 * panel.rect.width / px_per_unit);
    const glm::dvec2 left(panel.rect.x + 14.0, panel.rect.y + panel.rect.height - 14.0);
    const double right = left.x + length * px_per_unit;
    std::array<char, 32> number{};
    (void)std::snprintf(number.data(), number.size(), "%.0f", length >= 1.0 ? length : 1000.0 * length);
    const std::string text = std::string(number.data()) + (length >= 1.0 ? " m" : " mm") +
                             (scene.across.plane.perspective ? " at 1 m from the light" : "");
    return "<path class=\"scale\" fill=\"none\" stroke=\"#ffffff\" stroke-width=\"1.6\" d=\"M" +
           at(left - glm::dvec2(0.0, 5.0)) + "L" + at(left) + "L" + at({right, left.y}) + "L" +
           at({right, left.y - 5.0}) + "\"/>\n<text x=\"" + svgNumber(right + 8.0) + "\" y=\"" +
           svgNumber(left.y + 1.0) + "\" fill=\"#ffffff\">" + text + "</text>\n";
}

} // namespace

std::string mapColour(std::size_t i)
{
    const Colour colour = tintColour(i);
    std::array<char, 8> text{};
    (void)std::snprintf(text.data(), text.size(), "#%02x%02x%02x", colour.red, colour.green, colour.blue);
    return text.data();
}

std::string drawAcross(const PlanScene& scene, const PixelRect& rect)
{
    constexpr double kRoom = 1.12; // around what has to be in it
    const Extent extent = extentOf(scene);
    const glm::dvec2 size = glm::max(extent.size() * kRoom, glm::dvec2(1e-9));
    const double px_per_unit = std::min(rect.width / size.x, rect.height / size.y);
    const glm::dvec2 scale(2.0 * px_per_unit / rect.width, -2.0 * px_per_unit / rect.height); // y up to y down
    const glm::dvec2 middle = (extent.low + extent.high) * 0.5;
    Panel panel{rect, glm::dmat3(1.0), "across"};
    panel.window_from_plane[0][0] = scale.x;
    panel.window_from_plane[1][1] = scale.y;
    panel.window_from_plane[2] = glm::dvec3(-middle * scale, 1.0);
    std::vector<bool> drawn;
    for (const PlanObject& object : scene.objects) {
        drawn.push_back(object.drawn);
    }
    std::string out = open(panel);
    for (std::size_t i = 0; i < scene.maps.size(); ++i) {
        out += drawSeen(scene.maps[i].seen_across, panel, i);
    }
    out += drawObjects(scene, scene.across, panel, drawn, true);
    for (std::size_t i = 0; i < scene.maps.size(); ++i) {
        out += scene.from_above ? drawPyramid(scene.maps[i], panel, i) : drawFrame(scene.maps[i], panel, i);
    }
    return out + drawSight(scene.across, panel) + "</g>\n" + drawScale(scene, panel, px_per_unit);
}

std::string drawInMap(const PlanScene& scene, std::size_t map, const PixelRect& rect)
{
    const PlanMap& shown = scene.maps[map];
    const Panel panel{rect, shown.from_plane, "map" + std::to_string(map)};
    std::vector<bool> drawn(scene.objects.size());
    for (const std::uint32_t caster : shown.casters) {
        drawn[caster] = true;
    }
    return open(panel) + drawSeen(shown.seen, panel, map) + drawObjects(scene, shown.look, panel, drawn, false) +
           drawFrame(shown, panel, map) + drawSight(shown.look, panel) + "</g>\n";
}

} // namespace gnomon::lab
