// SPDX-License-Identifier: Apache-2.0
// What a comparison found, before anyone puts it into words.
#pragma once

#include "app/shot.h"
#include "equal_error.h"
#include "lab/compare.h"
#include "sweep.h"

#include <optional>
#include <string>
#include <vector>

namespace gnomon::app {

struct ComparedTechnique {
    Settings settings;
    std::string name;
    lab::Score score;
    lab::Timed timed;
    std::optional<EqualError> equal_error;
};

struct CompareResult {
    std::string device;
    std::string driver;
    std::string scene_hash;
    host::ShadedLight light; // the one that is judged, alone in the frame
    truth::Traced truth;
    std::uint32_t samples = 1;            // rays per pixel
    std::optional<double> standard_error; // of the truth; absent when no pixel counts
    bool from_cache = false;
    lab::PixelCounts pixels;
    lab::Timed baseline; // without shadows
    std::uint64_t baseline_bytes = 0;
    std::vector<ComparedTechnique> techniques; // best first
    std::optional<SweepResult> sweep;          // then there are no techniques
    std::vector<std::string> notes;            // sentences: what kept a number from being there
};

} // namespace gnomon::app
