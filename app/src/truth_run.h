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
    /// Of --truth, --samples, --seed and --no-cache; a progress bar runs on stderr while rays do. Precondition:
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
    /// The surfaces that trace() gave, from whoever needs them no more: the next light of the same moment is traced
    /// from them, where it would have to look for them again.
    void takeBack(truth::Surfaces surfaces);

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// By --truth, --samples, --truth-pixels and --seed.
[[nodiscard]] truth::Options truthOptions(const Settings& settings);

/// Whether the light is so small that area truth is the same as hard.
[[nodiscard]] bool isPointLike(const Light& light);

} // namespace gnomon::app
