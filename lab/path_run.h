// SPDX-License-Identifier: Apache-2.0
// Techniques along a path of camera or light, against the truth of every frame: errors, stability, times.
#pragma once

#include "lab/compare.h"
#include "lab/score/path_score.h"
#include "lab/score/stability.h"
#include "lab/timing.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace gnomon::lab {

/// The mask and the classes of one frame, for pictures.
struct ShownFrame {
    ImageF mask;
    Counted counted;
    ImageOf<ErrorClass> classes; // left_out everywhere when no pixel counts
};

/// Takes its pictures from a score.
[[nodiscard]] ShownFrame shownOf(Score& score);

struct PathTechnique {
    Score score;                             // PathScore::mean()
    std::optional<Stability> stability;      // absent with one frame, and where no pixel has a match
    std::vector<std::optional<double>> rmse; // by frame; absent where no pixel counts
    std::vector<StabilityMeter::Step> steps; // by frame, from the second on
    Timed timed;                             // every frame but the first, which warms up, unless there is but one
    std::vector<ShownFrame> shown;           // the frames that were to be shown
};

/// Contestants that walk a path together. Each has one renderer from the first frame to the last, so that valid maps
/// are kept and motions remember. Masks and truths of two frames are held at a time.
class PathRun {
public:
    /// `first` as in add(). Pictures are of `size_px`, without anti-aliasing whatever options say. Throws Error.
    PathRun(const host::SceneOnGpu& scene, glm::uvec2 size_px, const std::vector<Contestant>& contestants);
    ~PathRun();
    PathRun(const PathRun&) = delete;
    PathRun& operator=(const PathRun&) = delete;

    /// The next frame: one light (`subject.lights` holds the judged one alone), any time and camera of the same scene.
    /// All draw in the order of turnsOf(), the frame without shadows too; then their masks are compared with `truth`,
    /// which has the run's size. `show`: keep pictures of it. `step` is called after each technique and may throw to
    /// stop.
    void add(const Subject& subject, truth::Traced truth, bool show, const std::function<void()>& step);

    /// Draws the frame added last again, from the next frame's camera: `subject` differs by its eye alone, `truth` is
    /// of that. To be called before add() where the camera moves, so that changes are measured at a point of the world
    /// and not in pixels around it. No effect on techniques that cannot be drawn again
    /// (host::FrameRenderer::drawAgain()).
    void revisit(const Subject& subject, const truth::Traced& truth);

    /// Noise of the truths: the root of the mean square over the frames; nothing when no frame has a counted pixel.
    [[nodiscard]] std::optional<double> noise() const;
    struct Result {
        std::vector<PathTechnique> techniques; // in the contestants' order
        Timed baseline;                        // without shadows
        std::uint64_t baseline_bytes = 0;
    };
    /// Ends the run. `last` is the frame added last, unchanged. Precondition: a frame was added.
    [[nodiscard]] Result finish(const Subject& last);

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace gnomon::lab
