// SPDX-License-Identifier: Apache-2.0
// A mask against the truth: which pixels count, how wrong it is and why. It takes plain images, so an engine can score
// its own masks without our host.
#pragma once

#include "lab/metrics/error.h"
#include "lab/metrics/error_classes.h"
#include "lab/score/texel_density.h"
#include "truth/cache.h"
#include "truth/visibility.h"

#include <gnomon/frame.h>
#include <gnomon/plan.h>

#include <glm/vec2.hpp>

#include <cstdint>
#include <optional>

namespace gnomon::scene {
struct State;
}

namespace gnomon::lab {

/// A camera's rays and a light as the tracer takes them. Where a light's near_m is 0, all objects cast in the truth,
/// however near they are.
[[nodiscard]] truth::View truthView(const Camera& camera, glm::uvec2 size_px);
[[nodiscard]] truth::Light truthLight(const Light& light);

/// Why pixels do not count, and how many do. A pixel that several reasons leave out belongs to the first of them.
struct PixelCounts {
    std::uint64_t counted = 0;
    std::uint64_t terminator = 0;   // counted pixels at the terminator
    std::uint64_t background = 0;   // neither side sees anything
    std::uint64_t other_object = 0; // the sides see different objects
    std::uint64_t facing_away = 0;  // N·L of the smooth surface, else of the triangle, is 0 or less
    std::uint64_t unlit = 0;        // outside the light's cone or farther than its range: nothing to shadow
    std::uint64_t no_receiver = 0;  // the object receives no shadow
    std::uint64_t grazing = 0;      // N·L is more than 0 and at most 0.05: light all but grazes it

    [[nodiscard]] std::uint64_t leftOut() const
    {
        return background + other_object + facing_away + unlit + no_receiver + grazing;
    }
};
struct CountedPixels {
    Counted counted;
    /// 1 where the smooth surface faces the light and the triangle under it does not: the terminator.
    Counted terminator;
    Counted grazing; // 1 where PixelCounts::grazing has it
    PixelCounts counts;
};

/// The scene at the moment that is judged, the camera and the light.
struct Judged {
    const scene::State& state; // that the truth was traced in
    const Camera& camera;
    const Light& light;
};
/// `object_ids` of the picture that is judged: index into State::objects + 1, 0 for background; one channel, the size
/// of `surfaces`.
[[nodiscard]] CountedPixels countPixels(const Judged& judged, const truth::Surfaces& surfaces,
                                        const ImageOf<std::uint32_t>& object_ids);

/// All numbers of one technique's mask. The error numbers are absent when no pixel counts.
struct Score {
    ImageF mask;
    Outcome outcome; // the outcome of the light's map: without one the mask is all lit
    std::optional<ErrorNumbers> error;
    std::optional<double> grazing_rmse; // rmse over the pixels that light all but grazes; absent where there are none
    std::optional<double> ssim;
    std::optional<double> flip;
    std::optional<Classification> classification;
    CountedPixels pixels;
    TexelDensity density;
    double fit_efficiency = 0.0;
    MapPages atlas;
};
/// `mask`: one channel, visibility in [0, 1], of the size of the truth, from the same camera through the same centres
/// of pixels. `with_perception`: ssim and flip too, which take longer than all else. Numbers about maps stay 0;
/// texelDensity() and texelUse() give them where there is a plan.
[[nodiscard]] Score scoreMask(const Judged& judged, const truth::Traced& truth,
                              const ImageOf<std::uint32_t>& object_ids, const ImageF& mask,
                              bool with_perception = true);

/// Noise of the truth itself: sqrt of the mean squared standard error over the counted pixels, the most that it adds to
/// an rmse. 0 for hard truth; nothing when no pixel counts.
[[nodiscard]] std::optional<double> truthNoise(const truth::Visibility& visibility, const Counted& counted);

} // namespace gnomon::lab
