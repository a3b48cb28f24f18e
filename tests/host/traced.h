// SPDX-License-Identifier: Apache-2.0
// Masks that are held against traced ones.
#pragma once

#include "host/frame_renderer.h"
#include "scene/model.h"
#include "scene/state.h"

#include <cstddef>
#include <cstdint>

namespace gnomon::host::test {

/// Hard truth of one of the scene's lights, as it is placed in `state`.
[[nodiscard]] ImageF tracedMask(const scene::Scene& scene, const scene::State& state, const Eye& eye,
                                std::uint32_t width, std::uint32_t height, std::uint32_t light);

/// How many pixels of a mask say the opposite of the truth.
[[nodiscard]] std::size_t wrongPixels(const ImageF& mask, const ImageF& truth);

} // namespace gnomon::host::test
