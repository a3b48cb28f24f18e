// SPDX-License-Identifier: Apache-2.0
// One light of a shot and its truth, with which every technique is compared.
#pragma once

#include "app/shot.h"
#include "lab/compare.h"

#include <cstdint>
#include <memory>

namespace gnomon::app {

/// How a truth was made.
struct TruthFacts {
    truth::Kind kind = truth::Kind::hard;
    std::uint32_t samples = 1; // rays per pixel
    truth::PixelTruth pixels = truth::PixelTruth::centre;
    std::uint64_t seed = 0;
    std::uint64_t rays = 0; // all of them, and the seconds that they took when they were traced
    double seconds = 0.0;
    bool from_cache = false;
    bool point_like = false; // the light has no extent, so that area truth is the hard one
};

/// The facts that follow from the options and the light; rays, seconds and from_cache keep their defaults.
[[nodiscard]] TruthFacts truthFacts(const Settings& settings, const Light& light);

struct Judged {
    lab::Subject subject; // the light is alone in the frame
    truth::Traced truth;
    TruthFacts facts;
};
/// Traces the light that --light names, or takes its truth from the cache. `shot` outlives the result. Throws
/// Interrupted; UsageError for a light that is not there; Error when memory runs out.
[[nodiscard]] Judged judge(const Shot& shot, const Settings& settings);

/// A shot of its own with its judged light.
struct JudgedShot {
    Shot shot;
    Judged judged;
};
/// Throws as makeShot(), noteSizesWithoutEffect() and judge() do. In place, for `judged` looks at `shot`.
[[nodiscard]] std::unique_ptr<const JudgedShot> judgeShot(const Settings& settings);

} // namespace gnomon::app
