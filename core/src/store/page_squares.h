// SPDX-License-Identifier: Apache-2.0
// Which squares of the pages are free. A page is a quadtree: its side halved k times, rounded down, is the side of a
// square of level k.
#pragma once

#include <gnomon/plan.h>

#include <cstdint>
#include <vector>

namespace gnomon {

/// One square: the Morton number `place` tells the 4^level squares of a level apart.
struct PageSquare {
    std::uint32_t page = 0;
    std::uint32_t level = 0;
    std::uint32_t place = 0;

    // clang-tidy 14 takes the comparison with 0 that the compiler writes for ours.
    friend auto operator<=>(const PageSquare&, const PageSquare&) = default; // NOLINT(modernize-use-nullptr)
};

/// Deterministic: the same calls give the same squares. Only a new square may take memory from the heap.
class PageSquares {
public:
    /// Precondition: no square is in use. `side` > 0.
    void begin(std::uint32_t side, std::uint32_t most_pages);

    /// The deepest level whose squares hold a map of `side` texels. Precondition: a page holds it.
    [[nodiscard]] std::uint32_t levelOf(std::uint32_t side) const;
    /// Appends `count` squares, at one place of consecutive pages where there is such a run. New pages are added only
    /// where none of the old ones will do. False: there is no room, and nothing is appended.
    [[nodiscard]] bool take(std::uint32_t level, std::uint32_t count, std::vector<PageSquare>& out);
    /// The same of one place alone, without a choice but of the page.
    [[nodiscard]] bool takeAt(std::uint32_t level, std::uint32_t place, std::uint32_t count,
                              std::vector<PageSquare>& out);
    void give(const PageSquare& square);
    /// After an attempt whose squares were given back: takes the pages away that it added. `pages` of before it.
    void dropPagesFrom(std::uint32_t pages);

    /// How many pages there are. It falls only when no square is in use any more, then to 0.
    [[nodiscard]] std::uint32_t pages() const { return pages_; }
    [[nodiscard]] std::uint32_t mostPages() const { return most_pages_; }
    [[nodiscard]] std::uint32_t side() const { return side_; }
    /// A map's texels in its square.
    [[nodiscard]] Tile tileOf(const PageSquare& square, std::uint32_t map_side) const;

private:
    /// A run that could be taken, better ones first: those that add few pages, then those that break up small squares.
    struct Run {
        std::uint32_t new_pages = 0;
        std::uint32_t broken_level = 0; // how deep the smallest free square around one of its own is, upside down
        std::uint32_t page = 0;
        std::uint32_t place = 0;
        friend auto operator<=>(const Run&, const Run&) = default; // NOLINT(modernize-use-nullptr)
    };
    [[nodiscard]] const PageSquare* freeAround(const PageSquare& square) const;
    [[nodiscard]] bool measure(std::uint32_t level, std::uint32_t count, Run& run) const;
    [[nodiscard]] bool findRun(std::uint32_t level, std::uint32_t count, Run& best) const;
    void claimRun(std::uint32_t level, std::uint32_t count, const Run& run, std::vector<PageSquare>& out);
    void claim(const PageSquare& square);
    void insert(const PageSquare& square);
    void erase(const PageSquare& square);

    std::uint32_t side_ = 0;
    std::uint32_t most_pages_ = 0;
    std::uint32_t pages_ = 0;
    std::uint32_t used_ = 0;
    std::vector<PageSquare> free_; // sorted; none is within another one
};

} // namespace gnomon
