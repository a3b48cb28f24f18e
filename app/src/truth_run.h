// SPDX-License-Identifier: Apache-2.0
// The truth of a shot's lights, from the cache of truths where it is there, else traced and kept.
#pragma once

#include "app/shot.h"
#include "truth/cache.h"

#include <cstdint>
#include <memory>

namespace gnomon::app {

struct TruthRun {
    truth::Traced traced;
    scene::Hash128 key;
    bool from_cache = false;
    std::uint64_t rays = 0; // shadow rays, and the seconds that tracing them took when they were traced
    double seconds = 0.0;
};

class TruthTracer {
public:
    /// Traces by --truth, --samples, --seed and --no-cache, with a progress bar on stderr. Precondition:
    /// settings.truth. `shot` outlives the tracer.
    TruthTracer(const Shot& shot, const Settings& settings);
    ~TruthTracer();
    TruthTracer(const TruthTracer&) = delete;
    TruthTracer& operator=(const TruthTracer&) = delete;

    /// To be called when `shot` was moved to another moment.
    void moved();
    /// The truth of light `light` of the shot, of --size. The scene's acceleration structure is built at the first
    /// light that the cache does not have. A cache that cannot be written is a notice, once; it is read all the same.
    /// Throws Interrupted; Error when memory runs out.
    [[nodiscard]] TruthRun trace(std::size_t light);
    /// Takes back the surfaces that trace() gave, once they are not needed. The next light of the same moment reuses
    /// them instead of finding them again.
    void takeBack(truth::Surfaces surfaces);

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// The options that --truth, --samples, --truth-pixels and --seed give.
[[nodiscard]] truth::Options truthOptions(const Settings& settings);

/// Whether the light is so small that area truth is the same as hard.
[[nodiscard]] bool isPointLike(const Light& light);

} // namespace gnomon::app
