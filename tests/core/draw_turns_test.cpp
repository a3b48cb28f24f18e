// SPDX-License-Identifier: Apache-2.0
// Whose maps are drawn where a frame may not draw all of them: the rule alone.
#include "store/draw_turns.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

namespace gnomon {
namespace {

std::vector<std::uint32_t> drawnOf(std::vector<DrawTurn> turns, std::uint64_t budget, std::uint32_t longest)
{
    DrawTurns order;
    order.take(turns, budget, longest);
    std::vector<std::uint32_t> drawn;
    for (const DrawTurn& turn : turns) {
        if (turn.drawn) {
            drawn.push_back(turn.light);
        }
    }
    return drawn;
}

TEST(DrawTurns, GoToWhatIsOwedMost)
{
    const DrawTurn small{0, 1.0, 100, 0, true, false};
    const DrawTurn large{1, 5.0, 100, 0, true, false};
    const DrawTurn patient{2, 2.0, 100, 3, true, false};
    using Lights = std::vector<std::uint32_t>;
    EXPECT_EQ(drawnOf({small, large, patient}, 100, 8), Lights{2}) << "2 times 4 frames";
    EXPECT_EQ(drawnOf({small, large, patient}, 200, 8), (Lights{1, 2}));
    EXPECT_EQ(drawnOf({small, large, patient}, 299, 8), (Lights{1, 2}));
    EXPECT_EQ(drawnOf({small, large, patient}, 300, 8), (Lights{0, 1, 2}));
    EXPECT_EQ(drawnOf({small, small}, 100, 8), Lights{0}) << "of two alike, the first";
}

TEST(DrawTurns, DrawOneWhateverItTakes)
{
    using Lights = std::vector<std::uint32_t>;
    const DrawTurn dear{0, 1.0, 1U << 30U, 0, true, false};
    const DrawTurn cheap{1, 0.5, 1, 0, true, false};
    EXPECT_EQ(drawnOf({dear, cheap}, 10, 8), Lights{0});
    const DrawTurn must{2, 0.0, 5, 0, false, false};
    EXPECT_EQ(drawnOf({dear, cheap, must}, 10, 8), (Lights{1, 2})) << "somebody is drawn, and the rest has room";
    EXPECT_EQ(drawnOf({dear, cheap, must}, 5, 8), Lights{2});
}

TEST(DrawTurns, EndWithTheLongestWait)
{
    using Lights = std::vector<std::uint32_t>;
    const DrawTurn overdue{0, 0.0, 50, 8, true, false};
    const DrawTurn due{1, 100.0, 50, 7, true, false};
    EXPECT_EQ(drawnOf({overdue, due}, 50, 8), Lights{0});
    EXPECT_EQ(drawnOf({overdue, due}, 50, 9), Lights{1}) << "not yet";
    const DrawTurn current{2, 0.0, 0, 0, true, false};
    EXPECT_EQ(drawnOf({overdue, due, current}, 50, 8), (Lights{0, 2})) << "what has nothing to draw takes no turn";
}
} // namespace
} // namespace gnomon
