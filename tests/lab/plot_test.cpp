// SPDX-License-Identifier: Apache-2.0
// Plots are read back from their SVG: well-formed, with points where they belong and gaps where there is nothing.
#include "lab/plot.h"

#include "lab/src/svg_text.h"
#include "xml.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <clocale>
#include <cmath>
#include <cstdio>
#include <limits>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gnomon::lab {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The path of the one line of a plot.
std::string pathOf(const std::string& svg)
{
    const std::size_t fill = svg.find("\" fill=\"none\"/>");
    if (fill == std::string::npos) {
        return "";
    }
    const std::size_t start = svg.rfind("d=\"", fill) + 3;
    return svg.substr(start, fill - start);
}

Plot plotOf(std::vector<double> x, std::vector<double> values)
{
    Plot plot{"title", "x (m)", "y (ms)", std::move(x), {}};
    plot.lines.push_back({"line", std::move(values)});
    return plot;
}

TEST(WellFormedness, IsNoticedWhenItIsMissing)
{
    EXPECT_EQ(whyNotWellFormed("<a b=\"1\"><c/>x &amp; y</a>"), "");
    for (const char* bad : {"<a>", "</a>", "<a></b>", "<a", "<a>&x;</a>", "<a b=\"&\"/>", "<a b=1/>",
                            "<a b=\"1\" b=\"2\"/>", "<a b=\"<\"/>", "<a><b></a></b>", "a & b"}) {
        EXPECT_NE(whyNotWellFormed(bad), "") << bad;
    }
}

TEST(Plot, IsWellFormedWhateverTheNames)
{
    const std::string evil = "</text><script>\"&'<\x01\xFF\xC0\x80\xED\xA0\x80 \xC3\xA4";
    Plot plot{evil, evil, evil, {1.0, 2.0}, {}};
    plot.lines.push_back({evil, {1.0, 2.0}, true});
    plot.lines.push_back({evil + std::string(200, 'x'), {2.0, 1.0}, false});
    const std::string svg = plotSvg(plot);
    EXPECT_EQ(whyNotWellFormed(svg), "");
    EXPECT_EQ(count(svg, "<script"), 0U);
    EXPECT_GE(count(svg, "&lt;script&gt;&quot;&amp;&#39;&lt;"), 5U);
    EXPECT_GE(count(svg, " \xC3\xA4"), 2U);
    EXPECT_EQ(svg.find('\x01'), std::string::npos);
    EXPECT_EQ(svg.find('\xFF'), std::string::npos);
    EXPECT_EQ(svg.find("\xED\xA0\x80"), std::string::npos);
    EXPECT_NE(svg.find("width=\"860\" height=\"480\""), std::string::npos);
}

TEST(Plot, BreaksTheLineAtEveryGap)
{
    const std::string svg = plotSvg(plotOf({0, 1, 2, 3, 4, 5, 6}, {1, 2, kNan, 3, kInfinity, 5, 6}));
    EXPECT_EQ(whyNotWellFormed(svg), "");
    EXPECT_EQ(count(pathOf(svg), "M"), 3U); // 0 and 1, 3 alone, 5 and 6
    EXPECT_EQ(count(pathOf(svg), "L"), 2U);
    EXPECT_EQ(count(svg, "<circle"), 5U + 1U); // each point and the legend
    EXPECT_EQ(count(svg, "nan") + count(svg, "inf"), 0U);
}

TEST(Plot, ShowsAPointThatStandsAloneInALongLine)
{
    std::vector<double> x(240);
    std::vector<double> values(240, kNan);
    for (std::size_t i = 0; i < x.size(); ++i) {
        x[i] = static_cast<double>(i);
    }
    values[101] = 1.0;
    EXPECT_EQ(count(plotSvg(plotOf(x, values)), "<circle"), 1U + 1U);
    values.assign(240, 2.0);
    const std::size_t markers = count(plotSvg(plotOf(x, values)), "<circle");
    EXPECT_GE(markers, 10U);
    EXPECT_LE(markers, 16U);
}

TEST(Plot, PutsPointsWhereTheyBelong)
{
    // y from 0 to 10, so 5 is half way between 428 and 40 px; x ends at the values themselves.
    const std::string path = pathOf(plotSvg(plotOf({1, 2, 3}, {0, 5, 10})));
    double x[3] = {};
    double y[3] = {};
    ASSERT_EQ(std::sscanf(path.c_str(), "M%lf %lfL%lf %lfL%lf %lf", &x[0], &y[0], &x[1], &y[1], &x[2], &y[2]), 6);
    EXPECT_DOUBLE_EQ(y[0], 428.0);
    EXPECT_DOUBLE_EQ(y[1], 234.0);
    EXPECT_DOUBLE_EQ(y[2], 40.0);
    EXPECT_NEAR(x[1] - x[0], x[2] - x[1], 0.011);
    EXPECT_GT(x[1], x[0] + 100.0);
    // On a logarithmic axis equal factors are equal lengths.
    Plot plot = plotOf({1, 10, 100}, {1, 10, 100});
    plot.x_logarithmic = plot.y_logarithmic = true;
    const std::string log_path = pathOf(plotSvg(plot));
    ASSERT_EQ(std::sscanf(log_path.c_str(), "M%lf %lfL%lf %lfL%lf %lf", &x[0], &y[0], &x[1], &y[1], &x[2], &y[2]), 6);
    EXPECT_DOUBLE_EQ(y[1], 234.0);
    EXPECT_NEAR(x[1] - x[0], x[2] - x[1], 0.011);
}

TEST(Plot, TakesSinglePointsEqualValuesAndNothing)
{
    for (const bool logarithmic : {false, true}) {
        for (Plot plot : {plotOf({3}, {7}), plotOf({3}, {0}), plotOf({1, 2}, {5, 5}), plotOf({1, 2}, {-5, -5}),
                          plotOf({1, 2}, {kNan, kNan}), plotOf({}, {}), plotOf({0, 0}, {0, 0}),
                          plotOf({1e300, 1e301}, {-1e308, 1e308}), plotOf({1, 2}, {5e-324, 1e-310}),
                          plotOf({1, 2}, {1e-300, 1e300}), plotOf({1e15, 1e15 + 1}, {1e15, 1e15 + 1})}) {
            plot.x_logarithmic = plot.y_logarithmic = logarithmic;
            const std::string svg = plotSvg(plot);
            EXPECT_EQ(whyNotWellFormed(svg), "");
            EXPECT_EQ(count(svg, "nan") + count(svg, "inf"), 0U);
            EXPECT_LT(svg.size(), 50'000U);
        }
    }
    EXPECT_EQ(pathOf(plotSvg(plotOf({3}, {7}))).substr(0, 1), "M");
    EXPECT_EQ(count(plotSvg(plotOf({3}, {7})), "no values"), 0U);
    EXPECT_EQ(count(plotSvg(plotOf({3}, {kNan})), "no values"), 1U);
    EXPECT_EQ(whyNotWellFormed(plotSvg(Plot())), "");
}

TEST(Plot, LeavesGapsAtWhatHasNoLogarithm)
{
    Plot plot = plotOf({0, 1, 2, 3, 4}, {1, 2, 0, 3, -1});
    plot.y_logarithmic = true;
    EXPECT_EQ(count(pathOf(plotSvg(plot)), "M"), 2U);
    plot.x_logarithmic = true; // x = 0 goes too
    EXPECT_EQ(count(plotSvg(plot), "<circle"), 2U + 1U);
}

TEST(Plot, TellsLinesApartWithoutColour)
{
    Plot plot{"title", "x", "y", {1, 2}, {}};
    for (int i = 0; i < 24; ++i) {
        plot.lines.push_back({"line " + std::to_string(i), {1.0 * i, 2.0 * i}, i == 3});
    }
    const std::string svg = plotSvg(plot);
    EXPECT_EQ(whyNotWellFormed(svg), "");
    for (int i = 0; i < 24; ++i) {
        EXPECT_EQ(count(svg, ">line " + std::to_string(i) + "<"), 1U);
    }
    // Marker and dash of the legend's samples. A marker's first corner, seen from its centre, tells which it is.
    std::set<std::string> looks;
    for (std::size_t at = svg.find("<g fill"); at != std::string::npos; at = svg.find("<g fill", at + 1)) {
        const std::string group = svg.substr(at, svg.find("</g>", at) - at);
        if (group.find("fill=\"none\"") != std::string::npos) {
            continue; // the line itself
        }
        const std::string head = group.substr(0, group.find('>'));
        const std::size_t dash = head.find("stroke-dasharray");
        std::string look = dash == std::string::npos ? "solid" : head.substr(dash);
        double x = 0.0;
        double y = 0.0;
        ASSERT_EQ(std::sscanf(group.c_str() + group.find("d=\"M"), "d=\"M%lf %lf", &x, &y), 2);
        if (const std::size_t marker = group.rfind("d=\"M"); marker != group.find("d=\"M")) {
            double corner_x = 0.0;
            double corner_y = 0.0;
            ASSERT_EQ(std::sscanf(group.c_str() + marker, "d=\"M%lf %lf", &corner_x, &corner_y), 2);
            look += " " + svgNumber(corner_x - x) + " " + svgNumber(corner_y - y);
        }
        looks.insert(look);
    }
    EXPECT_GE(looks.size(), 20U);
    EXPECT_EQ(count(svg, "font-weight=\"bold\">line 3<"), 1U);
    // A band below all others, in the plot and in the legend.
    EXPECT_EQ(count(svg, "stroke-width=\"8\""), 2U);
    EXPECT_LT(svg.find("stroke-width=\"8\""), svg.find("stroke-width=\"1.7\""));
}

TEST(Plot, ClassesHaveTheColoursOfTheirPictures)
{
    Plot plot{"title", "x", "y", {1, 2}, {}};
    plot.lines.push_back({"all", {1.0, 2.0}, true});
    plot.lines.push_back({"other", {2.0, 3.0}, false});
    plot.lines.push_back({"bleeding", {1.0, 2.0}, false, ErrorClass::bleeding});
    plot.lines.push_back({"detached", {2.0, 3.0}, false, ErrorClass::detached});
    const std::string svg = plotSvg(plot);
    EXPECT_EQ(whyNotWellFormed(svg), "");
    EXPECT_EQ(count(svg, "<g fill=\"#cc79a7\""), 2U); // as in ReportColour, whatever the place
    EXPECT_EQ(count(svg, "<g fill=\"#f0e442\""), 2U);
    // Yellow vanishes on white: it alone has a rim, as line and around its markers.
    EXPECT_EQ(count(svg, " stroke=\"#484848\""), 4U);
}

TEST(Plot, IsTheSameInEveryLocale)
{
    Plot plot = plotOf({0.25, 1.5}, {0.125, 1234.5});
    const std::string before = plotSvg(plot);
    const std::string kept = std::setlocale(LC_ALL, nullptr);
    bool changed = false;
    for (const char* name : {"de_DE.UTF-8", "fr_FR.UTF-8", "C.UTF-8"}) {
        changed = changed || std::setlocale(LC_ALL, name) != nullptr;
    }
    EXPECT_EQ(plotSvg(plot), before);
    std::setlocale(LC_ALL, kept.c_str());
    if (!changed) {
        GTEST_SKIP() << "no other locale here";
    }
}

TEST(Plot, HasItsTicksAtTheValuesOfALogarithmicAxis)
{
    Plot plot = plotOf({256, 724, 4096}, {1, 2, 3});
    plot.x_logarithmic = true;
    const std::string few = plotSvg(plot);
    EXPECT_EQ(count(few, ">724</text>"), 1U);
    EXPECT_EQ(count(few, ">500</text>"), 0U);
    plot = plotOf({}, {});
    plot.x_logarithmic = true;
    plot.lines[0].values.clear();
    for (int i = 0; i < 30; ++i) {
        plot.x.push_back(256.0 * std::exp2(i / 7.0));
        plot.lines[0].values.push_back(i);
    }
    EXPECT_EQ(count(plotSvg(plot), ">500</text>"), 1U);
}

} // namespace
} // namespace gnomon::lab
