// SPDX-License-Identifier: Apache-2.0
// Techniques against the truth: lab/score/score.h for pictures of our host.
#pragma once

#include "lab/score/score.h"
#include "lab/texel_density.h"
#include "lab/timing.h"

#include <cstdint>

namespace gnomon::lab {

/// The camera's rays and the judged light of a subject as the tracer takes them.
[[nodiscard]] truth::View truthView(const Subject& subject, glm::uvec2 size_px);
[[nodiscard]] truth::Light truthLight(const Subject& subject);

/// `picture` has geometry. Both are of one size.
[[nodiscard]] CountedPixels countPixels(const Subject& subject, const truth::Surfaces& surfaces,
                                        const host::Picture& picture);

/// `options` as techniques are judged by: of the truth's size, with shadows, and without anti-aliasing, for the truth
/// looks through the middle of each pixel only.
[[nodiscard]] host::RenderOptions judgedOptions(const host::RenderOptions& options, glm::uvec2 size_px);
/// Holds the mask that `renderer`, made with judgedOptions(), drew last against the truth of the same subject.
[[nodiscard]] Score scoreDrawn(host::FrameRenderer& renderer, const Subject& subject, const truth::Traced& truth,
                               const host::RenderOptions& options, bool with_perception = true);
/// Draws the subject with one technique, at the truth's size and without anti-aliasing whatever `options` say, and
/// holds its mask against the truth. `with_perception`: ssim and flip too, which take longer than all else. `frames` >=
/// 1: how many are drawn, of which the last counts.
[[nodiscard]] Score scoreTechnique(const host::SceneOnGpu& scene, const Subject& subject, const truth::Traced& truth,
                                   const host::RenderOptions& options, bool with_perception = true,
                                   std::uint32_t frames = 1);
/// Scores any mask of the truth's size, with the geometry of `picture`; numbers about maps stay 0.
[[nodiscard]] Score scoreMask(const Subject& subject, const truth::Traced& truth, const host::Picture& picture,
                              const ImageF& mask, bool with_perception = true);

} // namespace gnomon::lab
