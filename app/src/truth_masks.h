// SPDX-License-Identifier: Apache-2.0
// The ray tracer's masks for `render`, with their notices and summary.
#pragma once

#include "app/shot.h"
#include "truth_run.h"

#include <cstdint>
#include <string>
#include <vector>

namespace gnomon::app {

class TruthMasks {
public:
    /// `shot` outlives it and may be moved between calls. Throws Error when the picture is larger than a truth may be.
    TruthMasks(const Shot& shot, const Settings& settings);

    /// Throws Error for a light that casts no shadow.
    [[nodiscard]] ImageF ofLight(std::size_t light);
    /// One for each light, all lit for those that cast no shadow.
    [[nodiscard]] std::vector<ImageF> ofAllLights();

    /// Notices for lights so small that area truth is the same as hard.
    void noteSizes() const;
    void noteSize(std::size_t light) const;

    /// "truth area of light sun, 256 rays per pixel, standard error 0.0021, 22.1 million rays at 9.8 million a second,
    /// from the cache".
    [[nodiscard]] std::string summary() const;

private:
    ImageF take(std::size_t light);

    const Shot& shot_;
    const Settings& settings_;
    TruthTracer tracer_;
    std::uint64_t moves_;    // Shot::moves at the last trace
    std::string light_name_; // when it was one light
    std::uint64_t traces_ = 0;
    std::uint64_t from_cache_ = 0;
    std::uint64_t rays_ = 0;
    double seconds_ = 0.0;
    // Over all pixels that see a surface.
    double squared_error_ = 0.0;
    std::uint64_t pixels_ = 0;
};

} // namespace gnomon::app
