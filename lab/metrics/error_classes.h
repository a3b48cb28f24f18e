// SPDX-License-Identifier: Apache-2.0
// Where a mask's error comes from: each counted pixel belongs to one class, so the classes' squared errors add up to
// the whole.
#pragma once

#include "image/image.h"
#include "lab/metrics/error.h"

#include <cstdint>
#include <optional>

namespace gnomon::lab {

enum class ErrorClass : std::uint8_t {
    left_out,   // does not count
    edge,       // within kEdgeReachPx of the penumbra or of a truth's edge: aliasing, wrong penumbra width
    acne,       // lit by the truth, darker in the test: false self-shadowing
    detached,   // in the umbra by the truth, lighter in the test, blocker near: peter-panning, leaks at contact
    bleeding,   // in the umbra by the truth, lighter in the test, blocker farther: light bleeding
    terminator, // where a smooth body turns away from the light; whatever else it may be
    correct,    // away from edges and equal to the truth
};

inline constexpr int kEdgeReachPx = 3;   // along x and y each: a square of 7 x 7
inline constexpr double kEdgeStep = 0.5; // two neighbours (of 8) whose truths differ by more make an edge
inline constexpr double kContactShareOfDiagonal = 0.01; // blockers nearer than this share of the scene's diagonal

/// Mean squared error of each class over all counted pixels: their sum is rmse^2.
struct ClassErrors {
    double edge = 0.0;
    double acne = 0.0;
    double detached = 0.0;
    double bleeding = 0.0;
    double terminator = 0.0;
};

struct Classification {
    ImageOf<ErrorClass> classes; // one channel
    ClassErrors errors;
};

/// `first_blocker_m`: distance from each pixel's surface to the first thing that blocks its light, +infinity for none.
/// `scene_diagonal_m` > 0 where a pixel counts. Counted pixels strictly between 0 and 1 in `truth` are penumbra. Edges
/// are looked for between counted neighbours, in hard and area truth alike; both pixels of such a pair are edge pixels.
/// `terminator`: 1 where a counted pixel is of that class, which none makes an edge for others.
/// An error that is not a number makes its class's error NaN; it and one to the side that masks in [0, 1] do not allow
/// go by the pixel's place: near an edge, else lit (acne), else by the blocker. Nothing when no pixel counts.
/// Precondition: all images of one size and one channel.
[[nodiscard]] std::optional<Classification> classifyErrors(const ImageF& test, const ImageF& truth,
                                                           const Counted& counted, const Counted& terminator,
                                                           const ImageF& first_blocker_m, double scene_diagonal_m);

} // namespace gnomon::lab
