// SPDX-License-Identifier: Apache-2.0
// lab/score/traffic.h for what our host draws.
#pragma once

#include "lab/score/traffic.h"
#include "lab/timing.h"

#include <cstdint>

namespace gnomon::lab {

/// leastBytes() of the last frame that `renderer`, made with `options`, has drawn of the subject; 0 without shadows.
/// Reads the geometry back, so the renderer's memory grows by the buffer for that.
[[nodiscard]] std::uint64_t leastBytes(host::FrameRenderer& renderer, const Subject& subject,
                                       const host::RenderOptions& options);

} // namespace gnomon::lab
