// SPDX-License-Identifier: Apache-2.0
#include "store/draw_turns.h"

#include <algorithm>

namespace gnomon {
namespace {

/// Maps that nobody sees are drawn last, and after those that waited longer.
constexpr double kLeastShare = 1e-6;

double owedTo(const DrawTurn& turn)
{
    return std::max(turn.share, kLeastShare) * (turn.waited + 1.0);
}

} // namespace

void DrawTurns::take(std::span<DrawTurn> turns, std::uint64_t budget_texels, std::uint32_t longest_wait)
{
    std::uint64_t spent_texels = 0;
    order_.clear();
    for (std::uint32_t i = 0; i < turns.size(); ++i) {
        DrawTurn& turn = turns[i];
        turn.drawn = turn.texels == 0 || !turn.may_wait || turn.waited >= longest_wait;
        spent_texels += turn.drawn ? turn.texels : 0;
        if (!turn.drawn) {
            order_.push_back(i);
        }
    }
    std::ranges::sort(order_, [&](std::uint32_t a, std::uint32_t b) {
        const double of_a = owedTo(turns[a]);
        const double of_b = owedTo(turns[b]);
        return of_a != of_b ? of_a > of_b : a < b;
    });
    for (const std::uint32_t i : order_) {
        DrawTurn& turn = turns[i];
        const bool fits = spent_texels <= budget_texels && turn.texels <= budget_texels - spent_texels;
        if (spent_texels == 0 || fits) {
            turn.drawn = true;
            spent_texels += turn.texels;
        }
    }
}

} // namespace gnomon
