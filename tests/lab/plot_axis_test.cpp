// SPDX-License-Identifier: Apache-2.0
// Numbers along an axis, and text as SVG takes it.
#include "lab/src/plot_axis.h"

#include "lab/src/svg_text.h"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

namespace gnomon::lab {
namespace {

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

TEST(PlotAxis, FewChosenValuesAreTheNumbers)
{
    const std::vector<double> sizes{256, 362, 512, 724, 1024, 1448, 2048, 2896, 4096};
    const Axis wide = makeAxisAt(sizes, 0.01);
    EXPECT_EQ(labels(wide), (Labels{"256", "362", "512", "724", "1024", "1448", "2048", "2896", "4096"}));
    EXPECT_EQ(wide.low, 256.0);
    EXPECT_EQ(wide.high, 4096.0);
    // Where there is room for half of them, the ends come first.
    const Axis narrow = makeAxisAt(sizes, 0.03);
    EXPECT_EQ(narrow.ticks.size(), sizes.size());
    EXPECT_EQ(labels(narrow), (Labels{"256", "512", "1024", "2048", "4096"}));
    EXPECT_EQ(labels(makeAxisAt({0.1, 0.1778279410038923, 1.0, 1.5e7}, 0.001)),
              (Labels{"0.1", "0.1778", "1", "1.5e7"}));
    EXPECT_EQ(labels(makeAxisAt({1.0, 1.0, 2.0}, 0.01)), (Labels{"1", "2"}));
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
