// SPDX-License-Identifier: Apache-2.0
// Tiles of an image over threads.
#pragma once

#include "patience.h"

#include "truth/visibility.h"

#include <glm/vec2.hpp>

#include <functional>

namespace gnomon::truth {

/// Pixels from `min` to before `max`.
struct Tile {
    glm::uvec2 min{0};
    glm::uvec2 max{0};
    Patience* patience = nullptr; // the patience of the thread that waits for it

    /// Calls `f(x, y)` for each pixel, row by row.
    template <typename F>
    void forEachPixel(const F& f) const
    {
        for (std::uint32_t y = min.y; y < max.y; ++y) {
            for (std::uint32_t x = min.x; x < max.x; ++x) {
                f(x, y);
            }
            patience->goOn();
        }
    }
};

/// Calls `work` once for each tile of an image of `size_px`, in any order. The calling thread and options.threads - 1
/// others take the tiles, with denormal numbers off as Embree asks; where the system gives fewer threads, fewer do. The
/// calling thread reports progress after each tile of its own. Returns false when cancelled: then tiles were left out.
/// Where no row of any tile is finished for options.patience_s seconds, the process ends (patience.h). Throws what
/// `work` or options.progress throws.
[[nodiscard]] bool forEachTile(const glm::uvec2& size_px, const Options& options,
                               const std::function<void(const Tile&)>& work);

} // namespace gnomon::truth
