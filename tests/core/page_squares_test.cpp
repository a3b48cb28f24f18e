// SPDX-License-Identifier: Apache-2.0
#include "store/light_rows.h"
#include "store/page_squares.h"
#include "worlds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

namespace gnomon {
namespace {

/// Counts the maps on each texel of the pages.
struct Ground {
    explicit Ground(std::uint32_t page_side) : side(page_side) {}
    void add(const Tile& tile, int what)
    {
        ASSERT_LE(tile.x + tile.width, side);
        ASSERT_LE(tile.y + tile.height, side);
        std::vector<int>& page = pages[tile.layer];
        page.resize(std::size_t{side} * side);
        for (std::uint32_t y = tile.y; y < tile.y + tile.height; ++y)
            for (std::uint32_t x = tile.x; x < tile.x + tile.width; ++x) {
                int& texel = page[std::size_t{y} * side + x];
                texel += what;
                ASSERT_TRUE(texel == 0 || texel == 1);
            }
    }
    std::uint32_t side;
    std::map<std::uint32_t, std::vector<int>> pages;
};

struct Taken {
    std::uint32_t map_side = 0;
    std::vector<PageSquare> squares;
};

TEST(PageSquares, NeverOverlapAndComeBackWhole)
{
    for (const std::uint32_t side : {64U, 100U, 37U}) {
        test::Random random(side);
        PageSquares squares;
        constexpr std::uint32_t kMost = 6;
        squares.begin(side, kMost);
        Ground ground(side);
        std::vector<Taken> taken;
        int refused = 0;
        for (int step = 0; step < 3000; ++step) {
            const std::uint32_t before = squares.pages();
            if (!taken.empty() && (random.below(2) == 0 || taken.size() > 40)) {
                const std::size_t which = random.below(static_cast<std::uint32_t>(taken.size()));
                for (const PageSquare& square : taken[which].squares) {
                    ground.add(squares.tileOf(square, taken[which].map_side), -1);
                    squares.give(square);
                }
                taken.erase(taken.begin() + static_cast<std::ptrdiff_t>(which));
                EXPECT_EQ(squares.pages(), taken.empty() ? 0U : before);
                continue;
            }
            Taken one;
            one.map_side = 1 + random.below(random.below(3) == 0 ? side : side / 3);
            const std::uint32_t level = squares.levelOf(one.map_side);
            EXPECT_GE(side >> level, one.map_side);
            EXPECT_LT(side >> (level + 1), one.map_side);
            const std::uint32_t count = 1 + random.below(4);
            if (!squares.take(level, count, one.squares)) {
                EXPECT_TRUE(one.squares.empty());
                EXPECT_EQ(squares.pages(), before);
                ++refused;
                continue;
            }
            ASSERT_EQ(one.squares.size(), count);
            for (const PageSquare& square : one.squares)
                ASSERT_NO_FATAL_FAILURE(ground.add(squares.tileOf(square, one.map_side), 1));
            EXPECT_LE(squares.pages(), kMost);
            EXPECT_GE(squares.pages(), before);
            taken.push_back(one);
        }
        EXPECT_GT(refused, 50);
        for (const Taken& one : taken)
            std::ranges::for_each(one.squares, [&](const PageSquare& square) { squares.give(square); });
        EXPECT_EQ(squares.pages(), 0U);
        std::vector<PageSquare> all;
        EXPECT_TRUE(squares.take(0, kMost, all));
    }
}

TEST(PageSquares, ARunIsAtOnePlaceOfConsecutivePages)
{
    PageSquares squares;
    squares.begin(64, 8);
    std::vector<PageSquare> out;
    ASSERT_TRUE(squares.take(0, 1, out));
    ASSERT_TRUE(squares.take(1, 4, out));
    ASSERT_TRUE(squares.take(1, 4, out)); // beside them
    EXPECT_EQ(squares.pages(), 5U);
    for (std::uint32_t i = 1; i < 9; ++i) {
        EXPECT_EQ(out[i].page, 1 + (i - 1) % 4);
        EXPECT_EQ(out[i].place, (i - 1) / 4);
    }
    // Where no run is left, single ones will do; and nothing is taken where they won't either.
    std::vector<PageSquare> rest;
    ASSERT_TRUE(squares.take(0, 3, rest));
    ASSERT_TRUE(squares.take(1, 8, rest));
    EXPECT_FALSE(squares.take(1, 1, rest));
    EXPECT_EQ(rest.size(), 11U);
    squares.give(out[2]);
    EXPECT_FALSE(squares.take(1, 2, rest));
    EXPECT_TRUE(squares.takeAt(1, out[2].place, 1, rest));
    EXPECT_FALSE(squares.takeAt(1, out[2].place, 1, rest));
}

TEST(LightRows, StayWithTheirLights)
{
    test::Random random(5);
    LightRows rows;
    std::vector<std::uint64_t> keys;
    std::map<std::pair<std::uint64_t, std::uint32_t>, std::uint32_t> known; // key and turn to row
    for (int frame = 0; frame < 2000; ++frame) {
        for (int change = 0; change < 3; ++change) {
            if (!keys.empty() && random.below(2) == 0)
                keys.erase(keys.begin() + random.below(static_cast<std::uint32_t>(keys.size())));
            else
                keys.insert(keys.begin() + random.below(static_cast<std::uint32_t>(keys.size() + 1)), random.below(9));
        }
        rows.follow(keys);
        decltype(known) now;
        std::map<std::uint64_t, std::uint32_t> turns;
        std::map<std::uint32_t, int> used;
        for (std::size_t light = 0; light < keys.size(); ++light) {
            const std::pair<std::uint64_t, std::uint32_t> name{keys[light], turns[keys[light]]++};
            now[name] = rows.rowOf(light);
            EXPECT_LT(rows.rowOf(light), rows.end());
            EXPECT_EQ(++used[rows.rowOf(light)], 1);
            if (known.contains(name)) {
                EXPECT_EQ(known[name], now[name]);
            }
        }
        std::size_t gone = 0;
        for (const auto& [name, row] : known)
            if (!now.contains(name)) {
                ++gone;
                EXPECT_EQ(std::ranges::count(rows.gone(), row), 1);
                EXPECT_FALSE(used.contains(row));
            }
        EXPECT_EQ(rows.gone().size(), gone);
        known = now;
    }
    EXPECT_LT(rows.end(), 200U);
}

} // namespace
} // namespace gnomon
