// SPDX-License-Identifier: Apache-2.0
// Tiles of an image over threads.
#pragma once

#include "truth/visibility.h"

#include <glm/vec2.hpp>

#include <functional>

namespace gnomon::truth {

/// Pixels from `min` to before `max`.
struct Tile {
    glm::uvec2 min{0};
    glm::uvec2 max{0};
};

/// Calls `work` once for each tile of an image of `size_px`, in any order. The calling thread and options.threads - 1
/// others take the tiles, with denormal numbers off as Embree asks; where the system gives fewer threads, fewer do. The
/// calling thread reports progress after each tile of its own. Returns false when cancelled: then tiles were left out.
/// Throws what `work` or options.progress throws.
[[nodiscard]] bool forEachTile(const glm::uvec2& size_px, const Options& options,
                               const std::function<void(const Tile&)>& work);

} // namespace gnomon::truth
