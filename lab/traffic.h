// SPDX-License-Identifier: Apache-2.0
// lab/score/traffic.h for pictures of our host.
#pragma once

#include "lab/score/traffic.h"
#include "lab/timing.h"

#include <cstdint>

namespace gnomon::lab {

/// Depths and normals of the last frame of the subject that `renderer`, made with `options`, has drawn. Reading them
/// back makes the renderer's memory grow. Where it keeps none, this draws a frame without shadows for them.
[[nodiscard]] host::Picture geometryOf(const host::SceneOnGpu& scene, host::FrameRenderer& renderer,
                                       const Subject& subject, host::RenderOptions options);
/// leastBytes() of that frame, which shows `geometry`; 0 without shadows.
[[nodiscard]] std::uint64_t leastBytes(const host::Picture& geometry, const host::FrameRenderer& renderer,
                                       const Subject& subject, const host::RenderOptions& options);
/// leastByPass() of that frame; nothing without shadows.
[[nodiscard]] LeastByPass leastByPass(const host::FrameRenderer& renderer, const host::RenderOptions& options);

} // namespace gnomon::lab
