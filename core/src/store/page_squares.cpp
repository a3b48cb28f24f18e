// SPDX-License-Identifier: Apache-2.0
#include "store/page_squares.h"

#include <algorithm>
#include <cassert>

namespace gnomon {
namespace {

constexpr std::uint32_t kDeepest = 15; // Morton numbers have 32 bits

/// The square of a higher level around it.
PageSquare around(const PageSquare& square, std::uint32_t level)
{
    return {square.page, level, square.place >> (2 * (square.level - level))};
}

} // namespace

void PageSquares::begin(std::uint32_t side, std::uint32_t most_pages)
{
    assert(used_ == 0 && side > 0);
    side_ = side;
    most_pages_ = most_pages;
    pages_ = 0;
    free_.clear();
}

std::uint32_t PageSquares::levelOf(std::uint32_t side) const
{
    assert(side > 0 && side <= side_);
    std::uint32_t level = 0;
    while (level < kDeepest && (side_ >> (level + 1)) >= side) {
        ++level;
    }
    return level;
}

Tile PageSquares::tileOf(const PageSquare& square, std::uint32_t map_side) const
{
    Tile tile{square.page, 0, 0, map_side, map_side};
    for (std::uint32_t level = 1; level <= square.level; ++level) {
        const std::uint32_t quarter = around(square, level).place;
        tile.x += (quarter & 1U) * (side_ >> level);
        tile.y += ((quarter >> 1U) & 1U) * (side_ >> level);
    }
    return tile;
}

/// The free square that holds it, or null.
const PageSquare* PageSquares::freeAround(const PageSquare& square) const
{
    for (std::uint32_t level = 0; level <= square.level; ++level) {
        const PageSquare whole = around(square, level);
        const auto found = std::ranges::lower_bound(free_, whole);
        if (found != free_.end() && *found == whole) {
            return &*found;
        }
    }
    return nullptr;
}

/// Fills in what a run at its page and place costs; false if it cannot be had.
bool PageSquares::measure(std::uint32_t level, std::uint32_t count, Run& run) const
{
    if (count > most_pages_ || run.page > most_pages_ - count) {
        return false;
    }
    std::uint32_t deepest = 0;
    for (std::uint32_t page = run.page; page < std::min(run.page + count, pages_); ++page) {
        const PageSquare* const free = freeAround({page, level, run.place});
        if (free == nullptr) {
            return false;
        }
        deepest = std::max(deepest, free->level);
    }
    run.broken_level = level - deepest;
    run.new_pages = std::max(run.page + count, pages_) - pages_;
    return true;
}

// The smallest of a run's free squares lies within the same place of all others, so its first corner fits too.
bool PageSquares::findRun(std::uint32_t level, std::uint32_t count, Run& best) const
{
    best = {0, 0, pages_, 0};
    bool found = measure(level, count, best);
    for (const PageSquare& free : free_) {
        if (free.level > level) {
            continue;
        }
        const std::uint32_t first = free.page + 1 - std::min(count, free.page + 1);
        for (std::uint32_t page = first; page <= free.page; ++page) {
            Run run{0, 0, page, free.place << (2 * (level - free.level))};
            if (measure(level, count, run) && (!found || run < best)) {
                best = run;
                found = true;
            }
        }
    }
    return found;
}

bool PageSquares::take(std::uint32_t level, std::uint32_t count, std::vector<PageSquare>& out)
{
    Run run;
    if (findRun(level, count, run)) {
        claimRun(level, count, run, out);
        return true;
    }
    const std::size_t before = out.size();
    const std::uint32_t pages_before = pages_;
    for (std::uint32_t i = 0; i < count; ++i) {
        if (findRun(level, 1, run)) {
            claimRun(level, 1, run, out);
            continue;
        }
        for (; out.size() > before; out.pop_back()) {
            give(out.back());
        }
        dropPagesFrom(pages_before);
        return false;
    }
    return true;
}

bool PageSquares::takeAt(std::uint32_t level, std::uint32_t place, std::uint32_t count, std::vector<PageSquare>& out)
{
    for (Run run{0, 0, 0, place}; run.page <= pages_; ++run.page) {
        if (measure(level, count, run)) {
            claimRun(level, count, run, out);
            return true;
        }
    }
    return false;
}

void PageSquares::claimRun(std::uint32_t level, std::uint32_t count, const Run& run, std::vector<PageSquare>& out)
{
    for (; pages_ < run.page + count; ++pages_) {
        insert({pages_, 0, 0});
    }
    for (std::uint32_t i = 0; i < count; ++i) {
        out.push_back({run.page + i, level, run.place});
        claim(out.back());
    }
}

/// Splits the free square around it until it is one of the quarters.
void PageSquares::claim(const PageSquare& square)
{
    const PageSquare whole = *freeAround(square);
    erase(whole);
    for (std::uint32_t level = whole.level + 1; level <= square.level; ++level) {
        const PageSquare taken = around(square, level);
        for (std::uint32_t quarter = 0; quarter < 4; ++quarter) {
            if (quarter != (taken.place & 3U)) {
                insert({square.page, level, (taken.place & ~3U) + quarter});
            }
        }
    }
    ++used_;
}

void PageSquares::give(const PageSquare& square)
{
    assert(used_ > 0);
    if (--used_ == 0) {
        free_.clear();
        pages_ = 0;
        return;
    }
    PageSquare whole = square;
    insert(whole);
    while (whole.level > 0) {
        const PageSquare first{whole.page, whole.level, whole.place & ~3U};
        const auto found = std::ranges::lower_bound(free_, first);
        // The four quarters follow each other.
        const PageSquare last{first.page, first.level, first.place + 3};
        if (free_.end() - found < 4 || *found != first || found[3] != last) {
            return;
        }
        free_.erase(found, found + 4);
        whole = around(whole, whole.level - 1);
        insert(whole);
    }
}

void PageSquares::dropPagesFrom(std::uint32_t pages)
{
    for (; pages_ > pages; --pages_) {
        erase({pages_ - 1, 0, 0});
    }
}

void PageSquares::insert(const PageSquare& square)
{
    free_.insert(std::ranges::lower_bound(free_, square), square);
}

void PageSquares::erase(const PageSquare& square)
{
    free_.erase(std::ranges::lower_bound(free_, square));
}

} // namespace gnomon
