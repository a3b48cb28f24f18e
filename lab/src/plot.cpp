// SPDX-License-Identifier: Apache-2.0
// Colours based on: M. Okabe, K. Ito, Color Universal Design, 2002, without their yellow, which vanishes on white.
// Dashes, markers and colours repeat after 4, 5 and 7 lines, so that 140 lines differ, and 20 without colour.
#include "lab/plot.h"

#include "false_colour.h"
#include "plot_axis.h"
#include "svg_text.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdio>

namespace gnomon::lab {
namespace {

constexpr double kWidth_px = 860.0;
constexpr double kHeight_px = 480.0;
constexpr double kTop_px = 40.0;
constexpr double kBottom_px = kHeight_px - 52.0;
constexpr double kLetter_px = 6.7; // of a 12 px sans-serif letter, on the wide side
constexpr double kBoldLetter_px = 8.0;
constexpr double kSample_px = 40.0;
constexpr std::size_t kLegendColumns = 30;
constexpr std::size_t kMarkersPerLine = 12;

constexpr std::array<const char*, 7> kColours{"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                              "#e69f00", "#56b4e9", "#000000"};
constexpr std::array<const char*, 4> kDashes{"", "9 4", "2 3", "10 3 2 3"};
constexpr std::size_t kMarkers = 5;
constexpr const char* kBandColour = "#c8c8c8";
constexpr const char* kRimColour = "#484848"; // keeps a light line visible on white
constexpr std::size_t kFewValues = 12;        // on a logarithmic x axis: each has a tick

struct Point {
    double x = 0.0;
    double y = 0.0;
};

struct Layout {
    Axis x;
    Axis y;
    double left_px = 0.0;
    double right_px = 0.0;

    [[nodiscard]] double xOf(double value) const { return left_px + x.fraction(value) * (right_px - left_px); }
    [[nodiscard]] double yOf(double value) const { return kBottom_px + y.fraction(value) * (kTop_px - kBottom_px); }
};

std::string at(double x, double y)
{
    return svgNumber(x) + " " + svgNumber(y);
}

std::string attribute(const char* name, double value)
{
    return std::string(" ") + name + "=\"" + svgNumber(value) + "\"";
}

std::string lineOf(Point from, Point to, const char* style)
{
    return "<path d=\"M" + at(from.x, from.y) + "L" + at(to.x, to.y) + "\" " + style + "/>\n";
}

std::string textAt(Point where, const std::string& more, const std::string& escaped)
{
    return "<text" + attribute("x", where.x) + attribute("y", where.y) + more + ">" + escaped + "</text>\n";
}

std::string markerAt(Point p, std::size_t index, double radius)
{
    const double r = radius;
    const auto path = [&](std::initializer_list<Point> corners) {
        std::string d;
        for (const Point& corner : corners) {
            d += (d.empty() ? "M" : "L") + at(p.x + corner.x * r, p.y + corner.y * r);
        }
        return "<path d=\"" + d + "Z\" stroke-dasharray=\"none\"/>\n";
    };
    switch (index % kMarkers) {
    case 0:
        return "<circle" + attribute("cx", p.x) + attribute("cy", p.y) + attribute("r", r) +
               " stroke-dasharray=\"none\"/>\n";
    case 1:
        return path({{-0.9, -0.9}, {0.9, -0.9}, {0.9, 0.9}, {-0.9, 0.9}});
    case 2:
        return path({{0.0, -1.2}, {1.1, 0.9}, {-1.1, 0.9}});
    case 3:
        return path({{0.0, -1.3}, {1.3, 0.0}, {0.0, 1.3}, {-1.3, 0.0}});
    default: // a plus
        return path({{-0.4, -1.3},
                     {0.4, -1.3},
                     {0.4, -0.4},
                     {1.3, -0.4},
                     {1.3, 0.4},
                     {0.4, 0.4},
                     {0.4, 1.3},
                     {-0.4, 1.3},
                     {-0.4, 0.4},
                     {-1.3, 0.4},
                     {-1.3, -0.4},
                     {-0.4, -0.4}});
    }
}

struct Look {
    std::string colour;
    std::string dash; // empty: drawn through
    double width_px = 1.7;
    double marker_px = 3.2; // radius
    bool rim = false;
};

Look lookOf(const PlotLine& line, std::size_t index)
{
    if (line.emphasised) {
        return {kBandColour, "", 8.0, 5.0};
    }
    Look look{kColours[index % kColours.size()], kDashes[index % kDashes.size()]};
    if (line.error_class) {
        const Colour colour = classColour(*line.error_class);
        std::array<char, 8> text{};
        (void)std::snprintf(text.data(), text.size(), "#%02x%02x%02x", colour.red, colour.green, colour.blue);
        look.colour = text.data();
        look.rim = colour.green > 200; // the yellow
    }
    return look;
}

/// A line's parts in a group of its own: the path, of which `path` has the attributes that place it, and its markers.
std::string groupOf(const Look& look, const std::string& path, const std::string& markers)
{
    std::string group = "<g fill=\"" + look.colour + "\" stroke=\"" + look.colour + "\"" +
                        attribute("stroke-width", look.width_px) + " stroke-linejoin=\"round\"" +
                        (look.dash.empty() ? "" : " stroke-dasharray=\"" + look.dash + "\"") + ">\n";
    if (!look.rim) {
        return group + "<path " + path + "/>\n" + markers + "</g>\n";
    }
    const std::string rim = std::string(" stroke=\"") + kRimColour + "\"";
    return group + "<path " + path + rim + attribute("stroke-width", look.width_px + 1.8) + "/>\n<path " + path +
           "/>\n<g" + rim + " stroke-width=\"1\">\n" + markers + "</g>\n</g>\n";
}

/// The line, broken where a value cannot be shown. Markers sit on every point of a short line, on some of a long one
/// (on others for each line, so that they do not cover each other), and on every point that stands alone.
std::string drawLine(const Plot& plot, const Layout& layout, std::size_t index)
{
    const PlotLine& line = plot.lines[index];
    const Look look = lookOf(line, index);
    const std::size_t count = std::min(plot.x.size(), line.values.size());
    const auto shown = [&](std::size_t i) {
        return i < count && isPlottable(plot.x[i], layout.x.logarithmic) &&
               isPlottable(line.values[i], layout.y.logarithmic);
    };
    const std::size_t stride = count <= 2 * kMarkersPerLine ? 1 : count / kMarkersPerLine;
    const std::size_t offset = index * stride / std::max<std::size_t>(1, plot.lines.size());
    std::string d;
    std::string markers;
    for (std::size_t i = 0; i < count; ++i) {
        if (!shown(i)) {
            continue;
        }
        const Point p{layout.xOf(plot.x[i]), layout.yOf(line.values[i])};
        const bool starts = i == 0 || !shown(i - 1);
        d += (starts ? "M" : "L") + at(p.x, p.y);
        if (i % stride == offset || (starts && !shown(i + 1))) {
            markers += markerAt(p, index, look.marker_px);
        }
    }
    return d.empty() ? "" : groupOf(look, "d=\"" + d + "\" fill=\"none\"", markers);
}

std::string drawLegend(const Plot& plot, const Layout& layout)
{
    constexpr double kRow_px = 20.0;
    constexpr double kFont_px = 12.0;
    const double row = std::min(kRow_px, (kBottom_px - kTop_px) / static_cast<double>(plot.lines.size()));
    const double font = std::min(kFont_px, row);
    std::string out;
    for (std::size_t i = 0; i < plot.lines.size(); ++i) {
        const PlotLine& line = plot.lines[i];
        const double y = kTop_px + (static_cast<double>(i) + 0.5) * row;
        const double x = layout.right_px + 18.0;
        const Look look = lookOf(line, i);
        out += groupOf(look, "d=\"M" + at(x, y) + "L" + at(x + kSample_px, y) + "\"",
                       markerAt({x + kSample_px / 2.0, y}, i, std::min(look.marker_px, row / 3.0)));
        out += "<g>";
        if (columnsOf(line.name) > kLegendColumns) {
            out += "<title>" + svgText(line.name, line.name.size()) + "</title>"; // shown where the pointer rests
        }
        out += textAt({x + kSample_px + 8.0, y + font * 0.35},
                      attribute("font-size", font) + (line.emphasised ? " font-weight=\"bold\"" : ""),
                      svgText(line.name, kLegendColumns)) +
               "</g>\n";
    }
    return out;
}

std::string drawAxes(const Plot& plot, const Layout& layout)
{
    constexpr const char* kMajor = "stroke=\"#d0d0d0\"";
    constexpr const char* kMinor = "stroke=\"#ececec\"";
    constexpr const char* kFrame = "stroke=\"#404040\"";
    const double left = layout.left_px;
    const double right = layout.right_px;
    std::string out;
    for (const Tick& tick : layout.x.ticks) {
        const double x = layout.xOf(tick.value);
        out += lineOf({x, kTop_px}, {x, kBottom_px}, tick.label.empty() ? kMinor : kMajor);
        if (!tick.label.empty()) {
            out += textAt({x, kBottom_px + 17.0}, " text-anchor=\"middle\"", tick.label);
        }
    }
    for (const Tick& tick : layout.y.ticks) {
        const double y = layout.yOf(tick.value);
        out += lineOf({left, y}, {right, y}, tick.label.empty() ? kMinor : kMajor);
        if (!tick.label.empty()) {
            out += textAt({left - 7.0, y + 4.0}, " text-anchor=\"end\"", tick.label);
        }
    }
    out +=
        lineOf({left, kTop_px}, {left, kBottom_px}, kFrame) + lineOf({left, kBottom_px}, {right, kBottom_px}, kFrame);
    const auto columns = [](double length_px) {
        return static_cast<std::size_t>(length_px / kLetter_px);
    };
    const double middle_x = (left + right) / 2.0;
    const double middle_y = (kTop_px + kBottom_px) / 2.0;
    out +=
        textAt({middle_x, kHeight_px - 12.0}, " text-anchor=\"middle\"", svgText(plot.x_label, columns(right - left)));
    out += textAt({16.0, middle_y}, " text-anchor=\"middle\" transform=\"rotate(-90 " + at(16.0, middle_y) + ")\"",
                  svgText(plot.y_label, columns(kBottom_px - kTop_px)));
    out += textAt({kWidth_px / 2.0, 25.0}, " text-anchor=\"middle\" font-size=\"16\" font-weight=\"bold\"",
                  svgText(plot.title, columns(kWidth_px * 0.7)));
    return out;
}

Axis axisOfX(const Plot& plot, double length_px)
{
    constexpr int kNumbersAcross = 8;
    constexpr double kLeastSpan = 1e-3; // decades; in less, labels of four digits do not differ
    const auto plottable = [&](double x) {
        return isPlottable(x, plot.x_logarithmic);
    };
    if (plot.x_logarithmic && plot.x.size() <= kFewValues && plot.x.size() >= 2 &&
        std::all_of(plot.x.begin(), plot.x.end(), plottable) &&
        std::log10(plot.x.front()) + kLeastSpan < std::log10(plot.x.back())) {
        return makeAxisAt(plot.x, kLetter_px / length_px);
    }
    return makeAxis(plot.x, plot.x_logarithmic, Ends::tight, kNumbersAcross);
}

Layout layOut(const Plot& plot)
{
    constexpr int kNumbersUp = 6;
    std::vector<double> values;
    double names_px = 0.0;
    for (const PlotLine& line : plot.lines) {
        assert(line.values.size() == plot.x.size());
        const std::size_t count = std::min(plot.x.size(), line.values.size());
        for (std::size_t i = 0; i < count; ++i) {
            if (isPlottable(plot.x[i], plot.x_logarithmic)) {
                values.push_back(line.values[i]);
            }
        }
        const double letter_px = line.emphasised ? kBoldLetter_px : kLetter_px;
        names_px = std::max(names_px, letter_px * static_cast<double>(std::min(columnsOf(line.name), kLegendColumns)));
    }
    Layout layout;
    layout.y = makeAxis(values, plot.y_logarithmic, Ends::round, kNumbersUp);
    std::size_t number_columns = 0;
    for (const Tick& tick : layout.y.ticks) {
        number_columns = std::max(number_columns, tick.label.size());
    }
    layout.left_px = 36.0 + static_cast<double>(number_columns) * kLetter_px;
    layout.right_px = kWidth_px - 28.0;
    if (!plot.lines.empty()) {
        layout.right_px -= kSample_px + 10.0 + names_px;
    }
    layout.x = axisOfX(plot, layout.right_px - layout.left_px);
    return layout;
}

} // namespace

std::string plotSvg(const Plot& plot)
{
    const Layout layout = layOut(plot);
    std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\"" + attribute("width", kWidth_px) +
                      attribute("height", kHeight_px) + " viewBox=\"0 0 " + at(kWidth_px, kHeight_px) +
                      "\" font-family=\"sans-serif\" font-size=\"12\" fill=\"#202020\">\n" + "<title>" +
                      svgText(plot.title, plot.title.size()) + "</title>\n" +
                      "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n";
    svg += drawAxes(plot, layout);
    std::string lines;
    for (const bool emphasised : {true, false}) { // the latter on top
        for (std::size_t i = 0; i < plot.lines.size(); ++i) {
            if (plot.lines[i].emphasised == emphasised) {
                lines += drawLine(plot, layout, i);
            }
        }
    }
    if (lines.empty()) {
        lines = textAt({(layout.left_px + layout.right_px) / 2.0, (kTop_px + kBottom_px) / 2.0},
                       " text-anchor=\"middle\"", "no values");
    }
    svg += lines;
    if (!plot.lines.empty()) {
        svg += drawLegend(plot, layout);
    }
    return svg + "</svg>\n";
}

} // namespace gnomon::lab
