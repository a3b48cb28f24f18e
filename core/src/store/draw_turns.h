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
    bool may_wait = false;         // false: it is drawn at any cost
    bool drawn = false;            // the result
    std::uint32_t view = kNoIndex; // index into Plan::views; kNoIndex: the turn is for all the light's maps
};

/// First come turns that cannot wait, or have waited as long as they may. The others follow by share times frames: the
/// first of them in any case where none was drawn yet, the rest if the budget has room. Among equals the first light
/// comes first. Takes n log n steps, and nothing from the heap once warm.
class DrawTurns {
public:
    void take(std::span<DrawTurn> turns, std::uint64_t budget_texels, std::uint32_t longest_wait);

private:
    std::vector<std::uint32_t> order_;
};

} // namespace gnomon
