// SPDX-License-Identifier: Apache-2.0
// Words and numbers in SVG, and the check that other tests hold whole pictures to.
#include "lab/src/svg_text.h"

#include "xml.h"

#include <gtest/gtest.h>

namespace gnomon::lab {
namespace {

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

} // namespace
} // namespace gnomon::lab
