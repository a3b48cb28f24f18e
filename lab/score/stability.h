// SPDX-License-Identifier: Apache-2.0
// How steadily masks change along a path of camera or light. Changes of the truth itself, such as a shadow that moves
// with its sun, are subtracted. It takes plain images.
//
//     D_t = (M_t - M_{t-1}) - (T_t - T_{t-1})
//
// M is the technique's mask and T the truth; values of t-1 are fetched where the pixel's world point was seen then.
// Both are fetched alike and fetching is linear, so with the error e = M - T this is D_t = e_t - fetch(e_{t-1}): an
// error that stays at its place in the world is no shimmer.
#pragma once

#include "lab/metrics/error.h"
#include "truth/visibility.h"

#include <gnomon/frame.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace gnomon::lab {

/// One frame of a path. All images are of one size, and so are those of the frame before it.
struct SeenFrame {
    const Camera& camera;
    const truth::Surfaces& surfaces; // points relative to camera.eye_ws
    const Counted& counted;
};

/// For each pixel of a frame, the place of its surface in the last frame.
///
/// A counted pixel's world point P is projected with the last frame's camera. Each of the four pixels whose centres
/// surround that place matches when it counted, saw the same object, and saw it at a point Q no farther off the plane
/// through P (with P's normal) than a pixel is wide there. A flat surface then always matches, however slanted it is
/// seen; a step less high than a pixel is wide does not count as a step; surfaces behind or before do not match. Since
/// Q lies on a ray at most one pixel in x and y beside P, that bounds its place on the surface too. Single precision of
/// points adds 2^-22 of the distances to both eyes. Matching pixels are weighed bilinearly, weights made to sum to 1.
class Reprojection {
public:
    Reprojection(const SeenFrame& now, const SeenFrame& before);

    /// Pixels that have a match.
    [[nodiscard]] std::uint64_t matched() const { return matched_; }
    /// The value of the last frame's image of one channel at the world point of pixel number `pixel` (rows from the
    /// top); nothing without a match.
    [[nodiscard]] std::optional<double> fetch(const ImageF& before, std::size_t pixel) const;

private:
    struct Fetch {
        std::array<std::uint32_t, 4> pixels{};
        std::array<float, 4> weights{}; // all 0: no match
    };
    std::vector<Fetch> fetches_;
    std::uint64_t matched_ = 0;
};

/// The last frame, with which a frame is compared.
struct FrameBefore {
    const Reprojection& match; // onto the last frame as it was seen then: these pixels count
    /// The error of the last frame drawn again with this frame's camera, and the match onto it: each pixel maps to
    /// itself where it sees the same surface. Null: the error is fetched with `match` from the pixels around. That is
    /// right where the camera stands still; else edges of shadows differ by fractions of a pixel.
    const Reprojection* here = nullptr;
    const ImageF* error_here = nullptr;
};

/// Mask less truth.
[[nodiscard]] ImageF errorOf(const ImageF& mask, const ImageF& truth);

struct Stability {
    double shimmer = 0.0;      // sqrt(mean D^2) over every matched pixel of every step; 0 is best
    double pop = 0.0;          // mean |D| of the step where that is largest; 0 is best
    std::size_t pop_frame = 0; // the frame that step leads to, the path's first being 0
};

/// One technique along a path. Keeps the error of one frame, whatever the path's length.
class StabilityMeter {
public:
    /// A step of the path: from one frame to the next.
    struct Step {
        std::uint64_t matched = 0;
        double mean_abs = 0.0;     // mean of |D|; 0 when nothing matched
        double mean_squared = 0.0; // mean of D squared; 0 when nothing matched
    };

    /// Frames in order. `before`: null at the first. One channel each, of one size. A value that is not a number makes
    /// shimmer and pop NaN, as in errorNumbers().
    void add(const ImageF& mask, const ImageF& truth, const FrameBefore* before);
    /// The steps; one less than frames added.
    [[nodiscard]] const std::vector<Step>& steps() const { return steps_; }
    /// Nothing when no pixel of any step has a match.
    [[nodiscard]] std::optional<Stability> stability() const;

private:
    ImageF error_before_;
    std::vector<Step> steps_;
};

} // namespace gnomon::lab
