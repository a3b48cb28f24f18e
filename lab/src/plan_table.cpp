// SPDX-License-Identifier: Apache-2.0
#include "plan_table.h"

#include "svg_text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>

namespace gnomon::lab {
namespace {

constexpr double kRow_px = 20.0;
constexpr double kAtlas_px = 330.0;   // room for the atlas on the right
constexpr std::size_t kMostRows = 12; // rows of the table
constexpr std::uint32_t kMostLayers = 15;

/// To three digits, whatever the locale.
std::string numberOf(double value)
{
    std::array<char, 64> room{};
    char* const end = room.data() + room.size();
    const bool whole = std::abs(value) >= 100.0 && std::abs(value) < 1e9;
    return {room.data(), whole ? std::to_chars(room.data(), end, value, std::chars_format::fixed, 0).ptr
                               : std::to_chars(room.data(), end, value, std::chars_format::general, 3).ptr};
}

std::string textAt(double x, double y, const char* more, std::string_view text)
{
    return "<text x=\"" + svgNumber(x) + "\" y=\"" + svgNumber(y) + "\"" + more + ">" + svgText(text, 170) +
           "</text>\n";
}

std::string boxAt(const PixelRect& r, const std::string& style)
{
    return "<rect x=\"" + svgNumber(r.x) + "\" y=\"" + svgNumber(r.y) + "\" width=\"" + svgNumber(r.width) +
           "\" height=\"" + svgNumber(r.height) + "\" " + style + "/>\n";
}

/// The meanings of the panels' lines and fills.
std::string drawKey(const PlanScene& scene, double x, double y)
{
    struct Sample {
        const char* style;
        const char* text;
    };
    static constexpr std::array kSamples{
        Sample{R"(fill="#ffffff" fill-opacity="0.14" stroke="#ffffff" stroke-opacity="0.5")", "caster, drawn"},
        Sample{R"(fill="none" stroke="#7d8896" stroke-dasharray="3 2.5")", "caster, culled"},
        Sample{R"(fill="none" stroke="#6fcf97")", "receiver in sight"},
    };
    std::string out;
    const std::string first = mapColour(0);
    const auto entry = [&](const std::string& style, std::string_view text) {
        out += boxAt({x, y - 10.0, 22.0, 12.0}, style) + textAt(x + 29.0, y, "", text);
        x += 29.0 + 6.6 * static_cast<double>(text.size()) + 20.0;
    };
    entry("fill=\"none\" stroke=\"" + first + "\" stroke-width=\"2.2\"", scene.from_above ? "what a map may hold"
                                                                         : scene.maps.size() > 1
                                                                             ? "a map and its eighths"
                                                                             : "the map and its eighths");
    entry("fill=\"" + first + "\" fill-opacity=\"0.24\" stroke=\"" + first + "\" stroke-dasharray=\"6 3\"",
          scene.maps.size() > 1 ? "in sight, of its slice" : "in sight and in the light's reach");
    for (const Sample& sample : kSamples) {
        entry(sample.style, sample.text);
    }
    out += "<path d=\"M" + svgNumber(x) + " " + svgNumber(y - 4.0) +
           "h22m-8 -4l8 4l-8 4\" fill=\"none\" stroke=\"#ffffff\" stroke-width=\"1.6\"/>\n" +
           textAt(x + 29.0, y, "", "the camera's line of sight");
    return out;
}

std::string sliceOf(const View& view)
{
    if (!view.serves.slice.bounded()) {
        return "all";
    }
    const std::string unit =
        std::string(view.serves.slice.isRatio() ? " x lamp's" : " m") + (view.serves.slice.across ? " across" : "");
    if (view.serves.slice.across && !std::isfinite(view.serves.slice.begin_m)) {
        return "to " + numberOf(view.serves.slice.end_m) + unit;
    }
    const std::string begin = std::isfinite(view.serves.slice.begin_m) ? numberOf(view.serves.slice.begin_m) : "0";
    return std::isfinite(view.serves.slice.end_m) ? begin + " to " + numberOf(view.serves.slice.end_m) + unit
                                                  : "from " + begin + unit;
}

std::string texelOf(const glm::dvec2& texel)
{
    return numberOf(texel.x) + " x " + numberOf(texel.y);
}

std::string drawRows(const Plan& plan, const PlanScene& scene, const PixelRect& rect)
{
    struct Column {
        double x;
        const char* name;
    };
    const char* const unit = scene.maps.front().look.plane.perspective ? "texel, m at 1 m" : "texel, m";
    const std::array columns{Column{36.0, "depth of view"}, Column{155.0, unit},      Column{290.0, "at its finest"},
                             Column{425.0, "warp"},         Column{490.0, "casters"}, Column{560.0, "layer"},
                             Column{615.0, "in this frame"}};
    std::string out;
    double y = rect.y;
    for (const Column& column : columns) {
        out += textAt(rect.x + column.x, y, " class=\"f\"", column.name);
    }
    for (std::size_t i = 0; i < std::min(scene.maps.size(), kMostRows); ++i) {
        const View& view = plan.views[scene.maps[i].view];
        y += kRow_px;
        const bool warped = view.fit.strength > 1.0;
        const std::array<std::string, columns.size()> cells{sliceOf(view),
                                                            texelOf(view.projection.texel_xy_m),
                                                            warped ? texelOf(view.fit.finest_texel) : "as everywhere",
                                                            warped ? numberOf(view.fit.strength) + " x" : "none",
                                                            std::to_string(view.casters.count),
                                                            std::to_string(view.place.tile.layer),
                                                            view.contents.redraw ? "drawn" : "kept"};
        out += boxAt({rect.x, y - 10.0, 12.0, 12.0}, "fill=\"" + mapColour(i) + "\"") +
               textAt(rect.x + 18.0, y, "", std::to_string(i).substr(0, 2));
        for (std::size_t c = 0; c < columns.size(); ++c) {
            out += textAt(rect.x + columns[c].x + (c == 0 ? 6.0 : 0.0), y, "", cells[c]);
        }
    }
    if (scene.maps.size() > kMostRows) {
        y += kRow_px;
        out +=
            textAt(rect.x + 18.0, y, " class=\"f\"", "and " + std::to_string(scene.maps.size() - kMostRows) + " more");
    }
    return out;
}

/// Layers of the atlas side by side, with the tiles that this frame has.
DrawnBelow drawAtlas(const Plan& plan, const PlanScene& scene, const PixelRect& rect)
{
    constexpr double kGap_px = 8.0;
    constexpr std::uint32_t kAcross = 5;
    const MapPages& atlas = plan.pages[0];
    const double side = (rect.width - (kAcross - 1) * kGap_px) / kAcross;
    const double scale = side / std::max({atlas.width, atlas.height, 1U});
    const std::uint32_t layers = std::min(atlas.layers, kMostLayers);
    const auto corner = [&](std::uint32_t layer) {
        const std::uint32_t row = layer / kAcross;
        return glm::dvec2(rect.x + (layer % kAcross) * (side + kGap_px), rect.y + 10.0 + row * (side + kGap_px));
    };
    DrawnBelow drawn;
    drawn.svg = textAt(rect.x, rect.y, " class=\"f\"",
                       "atlas: " + std::to_string(atlas.layers) + (atlas.layers == 1 ? " layer of " : " layers of ") +
                           std::to_string(atlas.width) + " x " + std::to_string(atlas.height) +
                           (atlas.layers > layers ? ", the first " + std::to_string(layers) + ":" : ""));
    for (std::uint32_t layer = 0; layer < layers; ++layer) {
        const glm::dvec2 at = corner(layer);
        drawn.svg += boxAt({at.x, at.y, atlas.width * scale, atlas.height * scale}, "fill=\"#20252c\"");
        drawn.end_px = at.y + side;
    }
    for (std::size_t i = 0; i < plan.views.size(); ++i) {
        const Tile& tile = plan.views[i].place.tile;
        if (tile.layer >= layers) {
            continue;
        }
        const auto own =
            std::find_if(scene.maps.begin(), scene.maps.end(), [&](const PlanMap& map) { return map.view == i; });
        const std::string colour =
            own == scene.maps.end() ? "#4a525c" : mapColour(static_cast<std::size_t>(own - scene.maps.begin()));
        const glm::dvec2 at = corner(tile.layer) + glm::dvec2(tile.x, tile.y) * scale;
        std::string look = "class=\"tile\" fill-opacity=\"0.4\" fill=\"";
        look += colour;
        look += "\" stroke=\"";
        look += colour;
        look += '"';
        drawn.svg += boxAt({at.x, at.y, tile.width * scale, tile.height * scale}, look);
    }
    return drawn;
}

} // namespace

DrawnBelow drawTable(const Plan& plan, const PlanScene& scene, std::uint32_t light, const PixelRect& rect)
{
    DrawnBelow drawn;
    drawn.svg = drawKey(scene, rect.x, rect.y);
    const double top = rect.y + 34.0;
    drawn.svg += drawRows(plan, scene, {rect.x, top, rect.width - kAtlas_px, 0.0});
    const double rows = static_cast<double>(std::min(scene.maps.size(), kMostRows + 1));
    const DrawnBelow atlas = drawAtlas(plan, scene, {rect.x + rect.width - kAtlas_px, top, kAtlas_px, 0.0});
    drawn.svg += atlas.svg;
    drawn.end_px = std::max(top + rows * kRow_px, atlas.end_px);
    const Outcome& outcome = plan.lights[light].outcome;
    if (!outcome.reason.empty()) {
        drawn.end_px += 26.0;
        drawn.svg +=
            textAt(rect.x, drawn.end_px, "", std::string(nameOf(outcome.kind)) + ": " + std::string(outcome.reason));
    }
    return drawn;
}

} // namespace gnomon::lab
