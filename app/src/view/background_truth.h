// SPDX-License-Identifier: Apache-2.0
// The ray tracer at work behind the window: few rays first, then more, until there are as many as `render` traces.
#pragma once

#include "app/shot.h"
#include "truth/cache.h"

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace gnomon::app::view {

class BackgroundTruth {
public:
    /// `scene` outlives it.
    explicit BackgroundTruth(const scene::Scene& scene);
    ~BackgroundTruth();
    BackgroundTruth(const BackgroundTruth&) = delete;
    BackgroundTruth& operator=(const BackgroundTruth&) = delete;

    /// Begins anew with the shot as it is now; what was under way is given up. `light` is the one that is judged.
    /// Precondition: settings.truth.
    void begin(const Shot& shot, const Settings& settings, std::size_t light);
    void stop();

    /// What rays have found so far.
    struct Level {
        std::uint32_t rays = 0;              // per pixel and light
        bool is_last = false;                // it is what `render --truth` draws with
        std::vector<ImageF> masks;           // one for each light
        std::optional<truth::Traced> judged; // of the light that is judged; nothing where it casts no shadow
    };
    /// The newest one, once.
    [[nodiscard]] std::optional<Level> take();
    /// [0, 1] of all rays; 1 when nothing is under way.
    [[nodiscard]] double progress() const { return progress_; }
    /// Why nothing more will come; empty: nothing is wrong.
    [[nodiscard]] std::string fault() const;

private:
    struct Work;
    void trace(const Work& work);

    const scene::Scene& scene_;
    std::atomic<bool> cancel_{false};
    std::atomic<double> progress_{1.0};
    mutable std::mutex mutex_; // of what follows
    std::optional<Level> ready_;
    std::string fault_;
    std::thread thread_;
};

} // namespace gnomon::app::view
