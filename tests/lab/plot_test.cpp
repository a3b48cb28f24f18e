// SPDX-License-Identifier: Apache-2.0
// Plots are read back from their SVG: well-formed, with points where they belong and gaps where there is nothing.
#include "lab/plot.h"

#include "lab/src/plot_axis.h"
#include "lab/src/svg_text.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <clocale>
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

/// Checks what is inside a tag: name, then attributes in double quotes, each once.
std::string whyTagIsBad(std::string_view tag)
{
    std::set<std::string> seen;
    std::size_t at = tag.find_first_of(" /");
    while (at < tag.size() && tag[at] == ' ') {
        const std::size_t equals = tag.find("=\"", at);
        const std::size_t end = equals == std::string_view::npos ? equals : tag.find('"', equals + 2);
        if (end == std::string_view::npos) {
            return "attribute without value in " + std::string(tag);
        }
        if (!seen.emplace(tag.substr(at + 1, equals - at - 1)).second) {
            return "attribute twice in " + std::string(tag);
        }
        at = end + 1;
    }
    return at >= tag.size() || tag.substr(at) == "/" ? "" : "stray text in " + std::string(tag);
}

std::string whyTextIsBad(std::string_view text)
{
    for (std::size_t at = text.find('&'); at != std::string_view::npos; at = text.find('&', at + 1)) {
        bool known = false;
        for (const std::string_view entity : {"&amp;", "&lt;", "&gt;", "&quot;", "&#39;"}) {
            known = known || text.substr(at).starts_with(entity);
        }
        if (!known) {
            return "unknown entity in " + std::string(text);
        }
    }
    return "";
}

/// Empty when every tag is closed in order and every & begins an entity; else what is wrong.
std::string whyNotWellFormed(std::string_view xml)
{
    std::vector<std::string> open;
    while (!xml.empty()) {
        const std::size_t less = std::min(xml.find('<'), xml.size());
        std::string why = whyTextIsBad(xml.substr(0, less));
        if (less == xml.size()) {
            return !why.empty() ? why : open.empty() ? "" : open.back() + " is not closed";
        }
        const std::size_t greater = xml.find('>', less);
        if (greater == std::string_view::npos) {
            return "a tag has no end";
        }
        const std::string_view tag = xml.substr(less + 1, greater - less - 1);
        xml.remove_prefix(greater + 1);
        if (why.empty() && tag.starts_with('/')) {
            if (open.empty() || open.back() != tag.substr(1)) {
                return std::string(tag) + " closes what is not open";
            }
            open.pop_back();
            continue;
        }
        why += whyTagIsBad(tag) + whyTextIsBad(tag) + (tag.find('<') == std::string_view::npos ? "" : "< in a tag");
        if (!why.empty()) {
            return why;
        }
        if (!tag.ends_with('/')) {
            open.emplace_back(tag.substr(0, tag.find(' ')));
        }
    }
    return open.empty() ? "" : open.back() + " is not closed";
}

std::size_t count(std::string_view text, std::string_view what)
{
    std::size_t found = 0;
    for (std::size_t at = text.find(what); at != std::string_view::npos; at = text.find(what, at + 1)) {
        ++found;
    }
    return found;
}

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

std::vector<std::string> labels(const Axis& axis)
{
    std::vector<std::string> found;
    for (const Tick& tick : axis.ticks) {
        EXPECT_GE(tick.value, axis.low);
        EXPECT_LE(tick.value, axis.high);
        if (!tick.label.empty()) {
            found.push_back(tick.label);
        }
    }
    return found;
}

using Labels = std::vector<std::string>;

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
    EXPECT_EQ(count(svg, "stroke-width=\"3.4\""), 2U);
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

TEST(PlotAxis, NumbersAreRound)
{
    EXPECT_EQ(labels(makeAxis({0, 10}, false, Ends::round, 6)), (Labels{"0", "2", "4", "6", "8", "10"}));
    EXPECT_EQ(labels(makeAxis({0.1, 0.7}, false, Ends::tight, 6)),
              (Labels{"0.1", "0.2", "0.3", "0.4", "0.5", "0.6", "0.7"}));
    EXPECT_EQ(labels(makeAxis({0, 239}, false, Ends::tight, 8)), (Labels{"0", "50", "100", "150", "200"}));
    EXPECT_EQ(labels(makeAxis({-3, 3}, false, Ends::round, 6)), (Labels{"-3", "-2", "-1", "0", "1", "2", "3"}));
    EXPECT_EQ(labels(makeAxis({0, 3e-7}, false, Ends::round, 3)), (Labels{"0", "1e-7", "2e-7", "3e-7"}));
    EXPECT_EQ(labels(makeAxis({0, 2.5e6}, false, Ends::round, 3)), (Labels{"0", "1e6", "2e6", "3e6"}));
}

TEST(PlotAxis, StartsAtZeroWhereThatIsNear)
{
    EXPECT_DOUBLE_EQ(makeAxis({3, 10}, false, Ends::round, 6).low, 0.0);
    EXPECT_DOUBLE_EQ(makeAxis({90, 100}, false, Ends::round, 6).low, 90.0);
    EXPECT_DOUBLE_EQ(makeAxis({-10, -3}, false, Ends::round, 6).high, 0.0);
    EXPECT_DOUBLE_EQ(makeAxis({3, 10}, false, Ends::tight, 6).low, 3.0);
}

TEST(PlotAxis, LogarithmicNumbersAreOneTwoFive)
{
    EXPECT_EQ(labels(makeAxis({1, 64}, true, Ends::round, 6)), (Labels{"1", "2", "5", "10", "20", "50", "100"}));
    EXPECT_EQ(labels(makeAxis({0.003, 40}, true, Ends::round, 6)), (Labels{"0.01", "0.1", "1", "10"}));
    EXPECT_EQ(labels(makeAxis({1e-12, 1e12}, true, Ends::round, 6)),
              (Labels{"1e-12", "1e-8", "0.0001", "1", "10000", "1e8", "1e12"}));
    EXPECT_EQ(labels(makeAxis({1, 1}, true, Ends::round, 6)), (Labels{"0.5", "1", "2"}));
    EXPECT_EQ(labels(makeAxis({}, true, Ends::round, 6)), (Labels{"1", "2", "5", "10"}));
}

TEST(PlotAxis, ManyRangesHaveAFewNumbersInOrder)
{
    for (const bool logarithmic : {false, true}) {
        for (const Ends ends : {Ends::tight, Ends::round}) {
            for (double low = 1e-9; low < 1e9; low *= 3.7) {
                for (double factor = 1.0001; factor < 1e6; factor *= 4.3) {
                    const Axis axis = makeAxis({low, low * factor}, logarithmic, ends, 6);
                    EXPECT_LE(axis.low, low);
                    EXPECT_GE(axis.high, low * factor);
                    const Labels found = labels(axis);
                    EXPECT_GE(found.size(), 2U) << low << " x " << factor;
                    EXPECT_LE(found.size(), 9U) << low << " x " << factor;
                    EXPECT_EQ(std::set<std::string>(found.begin(), found.end()).size(), found.size());
                    for (std::size_t i = 1; i < axis.ticks.size(); ++i) {
                        EXPECT_LT(axis.ticks[i - 1].value, axis.ticks[i].value);
                    }
                }
            }
        }
    }
}

TEST(SvgText, CutsBetweenCharacters)
{
    EXPECT_EQ(svgText("abcdef", 6), "abcdef");
    EXPECT_EQ(svgText("abcdefg", 6), "abcde\xE2\x80\xA6");
    EXPECT_EQ(svgText("\xC3\xA4\xC3\xB6\xC3\xBC", 2), "\xC3\xA4\xE2\x80\xA6");
    EXPECT_EQ(columnsOf("\xE5\xBD\xB1"), 2U); // one character, as wide as two letters
    EXPECT_EQ(svgText("a<b", 3), "a&lt;b");
    EXPECT_EQ(svgText("\xF0\x9F\x8C\x9E", 9), "\xF0\x9F\x8C\x9E");
    EXPECT_EQ(svgText("\xE5\xBD", 9), "\xEF\xBF\xBD\xEF\xBF\xBD"); // torn
}

TEST(SvgText, NumbersHaveNoNeedlessDigits)
{
    EXPECT_EQ(svgNumber(12.0), "12");
    EXPECT_EQ(svgNumber(0.1 + 0.2), "0.3");
    EXPECT_EQ(svgNumber(-0.001), "0");
    EXPECT_EQ(svgNumber(100.0), "100");
    EXPECT_EQ(svgNumber(-3.456), "-3.46");
}

} // namespace
} // namespace gnomon::lab
