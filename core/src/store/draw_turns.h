// SPDX-License-Identifier: Apache-2.0
// Whose maps are drawn in a frame, where drawing all that are out of date is more than the frame may.
#pragma once

#include <gnomon/plan.h>

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace gnomon {

inline constexpr std::uint64_t kNoDrawBudget = std::numeric_limits<std::uint64_t>::max();

/// A light's claim to have its maps drawn in this frame, or that of one map by itself.
struct DrawTurn {
    std::uint32_t light = 0;
    double share = 0.0;            // that the picture owes to it, >= 0
    std::uint64_t texels = 0;      // that have to be drawn for it; 0: it has nothing to wait for
    std::uint32_t waited = 0;      // frames before this one in which its turn did not come
    bool may_wait = false;         // false: it is drawn, whatever that takes
    bool drawn = false;            // what it comes to
    std::uint32_t view = kNoIndex; // of Plan::views; kNoIndex: it is of all the light's maps
};

/// First come those that cannot wait, or have waited for the longest time that there is; then by share times frames,
/// the first of them in any case where nobody was drawn yet, the others if what they take is left of the budget. Of two
/// that are owed alike the first light comes first. Takes n log n steps, and nothing from the heap once warm.
class DrawTurns {
public:
    void take(std::span<DrawTurn> turns, std::uint64_t budget_texels, std::uint32_t longest_wait);

private:
    std::vector<std::uint32_t> order_;
};

} // namespace gnomon
