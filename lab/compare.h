// SPDX-License-Identifier: Apache-2.0
// Techniques against the truth: which pixels count, how wrong each mask is and why, what it cost.
#pragma once

#include "lab/metrics/error.h"
#include "lab/metrics/error_classes.h"
#include "lab/texel_density.h"
#include "lab/timing.h"
#include "truth/cache.h"
#include "truth/visibility.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::lab {

/// The camera's rays and the judged light of a subject as the tracer takes them. Light::near_m 0 becomes 1/1000 of the
/// light's reach, as for the planner.
[[nodiscard]] truth::View truthView(const Subject& subject, glm::uvec2 size_px);
[[nodiscard]] truth::Light truthLight(const Subject& subject);

/// Why pixels do not count, and how many do. A pixel that several reasons leave out belongs to the first of them.
struct PixelCounts {
    std::uint64_t counted = 0;
    std::uint64_t background = 0;   // neither side sees anything
    std::uint64_t other_object = 0; // the sides see different objects
    std::uint64_t facing_away = 0;  // N·L of the triangle is 0.05 or less
    std::uint64_t unlit = 0;        // outside the light's cone or farther than its range: nothing to shadow
    std::uint64_t no_receiver = 0;  // the object receives no shadow

    [[nodiscard]] std::uint64_t leftOut() const
    {
        return background + other_object + facing_away + unlit + no_receiver;
    }
};
struct CountedPixels {
    Counted counted;
    PixelCounts counts;
};
/// `picture` has geometry. Both are of one size.
[[nodiscard]] CountedPixels countPixels(const Subject& subject, const truth::Surfaces& surfaces,
                                        const host::Picture& picture);

/// All that one technique's mask says about it. The error numbers are absent when no pixel counts.
struct Score {
    ImageF mask;
    Outcome outcome; // of the light's map: without one the mask is all lit
    std::optional<ErrorNumbers> error;
    std::optional<double> ssim;
    std::optional<double> flip;
    std::optional<Classification> classification;
    CountedPixels pixels;
    TexelDensity density;
    double fit_efficiency = 0.0;
    AtlasSize atlas;
};

/// Draws the subject with one technique, at the truth's size and without anti-aliasing whatever `options` say, and
/// holds its mask against the truth. `with_perception`: ssim and flip too, which take longer than all else.
[[nodiscard]] Score scoreTechnique(host::Gpu& gpu, const Subject& subject, const truth::Traced& truth,
                                   const host::RenderOptions& options, bool with_perception = true);
/// The same for any mask of the truth's size, with the geometry of `picture`; what tells of maps stays 0.
[[nodiscard]] Score scoreMask(const Subject& subject, const truth::Traced& truth, const host::Picture& picture,
                              const ImageF& mask, bool with_perception = true);

/// Noise of the truth itself: sqrt of the mean squared standard error over the counted pixels, what it adds at most to
/// an rmse. 0 for hard truth; nothing when no pixel counts.
[[nodiscard]] std::optional<double> truthNoise(const truth::Visibility& visibility, const Counted& counted);

} // namespace gnomon::lab
