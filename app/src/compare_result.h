// SPDX-License-Identifier: Apache-2.0
// The results of a comparison. Its JSON is made from them (compareJson()), and all that is shown is made from the
// JSON.
#pragma once

#include "app/shot.h"
#include "compare_judged.h"
#include "equal_error.h"
#include "image/image.h"
#include "lab/compare.h"
#include "lab/path_run.h"
#include "sweep.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::app {

/// The kind of truth that was traced: hard instead of area for a light without extent.
[[nodiscard]] inline truth::Kind tracedKind(const TruthFacts& truth)
{
    return truth.point_like ? truth::Kind::hard : truth.kind;
}

/// One technique along --path.
struct TechniqueOnPath {
    std::optional<lab::Stability> stability;
    std::vector<std::optional<double>> rmse;      // by frame; absent where no pixel counts
    std::vector<lab::StabilityMeter::Step> steps; // by frame, from the second on
};

/// A frame with all of its light and with none: every picture of it lies between the two, as its mask says.
struct Shades {
    Image8 lit;
    Image8 unlit;
};

/// The data that all techniques share along --path.
struct PathResult {
    std::string name; // or file
    FrameRange frames;
    std::vector<std::uint32_t> shown; // first, middle and last frame
    std::vector<ImageF> truths;       // truths of those frames; none without a report
};

struct ComparedTechnique {
    Settings settings;
    std::string name;
    lab::Score score;
    lab::Timed timed;
    std::optional<EqualError> equal_error;
    std::vector<lab::ShownFrame> shown;  // the frame, or those of PathResult::shown; none without a report
    std::optional<TechniqueOnPath> path; // then `score` is of all its frames
};

struct CompareResult {
    std::string device;
    std::string driver;
    std::string scene_hash;
    Judged judged;                        // in a sweep these three are at its first value
    std::optional<double> standard_error; // the truth's standard error; absent when no pixel counts
    lab::PixelCounts pixels;
    lab::Timed baseline; // without shadows
    std::uint64_t baseline_bytes = 0;
    std::vector<ComparedTechnique> techniques; // best first
    std::vector<Shades> shades;                // shades of the frame, or of PathResult::shown; none without a report
    std::optional<SweepResult> sweep;          // then there are no techniques
    std::optional<PathResult> path;            // then `judged` is of its first frame and has no truth

    [[nodiscard]] const host::ShadedLight& light() const { return judged.subject.lights.front(); }
};

} // namespace gnomon::app
