// SPDX-License-Identifier: Apache-2.0
// Times of techniques that take turns in one process, so that anything that slows the machine down hits all alike.
#pragma once

#include "host/frame_renderer.h"
#include "lab/score/traffic.h"
#include "lab/spread.h"
#include "lab/waits.h"
#include "scene/model.h"
#include "scene/state.h"

#include <glm/vec2.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::lab {

/// One frame of a scene. `scene` and `state` outlive it. A SceneOnGpu that draws it is of the same scene.
struct Subject {
    const scene::Scene* scene = nullptr;
    const scene::State* state = nullptr;
    host::Eye eye;
    std::vector<host::ShadedLight> lights;
    std::uint32_t light = 0; // the one that is judged, index into `lights`
};

/// A technique by the options that make it and the name that results show.
struct Contestant {
    std::string name;
    host::RenderOptions options;
};

/// Milliseconds of one frame by the stages that results name. `filter` is 0 for filters that need no pass of their own.
/// None: the device has no timestamps. `plan` and `frame` are the CPU's, and always there.
struct StageTimes {
    std::optional<double> plan = 0.0;
    std::optional<double> maps = 0.0;
    std::optional<double> filter = 0.0;
    std::optional<double> mask = 0.0;
    std::optional<double> frame = 0.0;
};
[[nodiscard]] StageTimes stagesOf(const host::FrameTimes& times);

/// Work that does not depend on the machine, of one frame.
struct Counters {
    std::uint64_t texels_rendered = 0; // texels of all tiles that were drawn, and of kept layers
    bool has_statistics = false;       // the device counts: the next four hold
    std::uint64_t vertex_invocations = 0;
    std::uint64_t primitives = 0;
    std::uint64_t fragment_invocations = 0;
    std::uint64_t compute_invocations = 0;
    std::uint64_t draws = 0;
    std::uint64_t passes = 0;
    std::uint64_t bytes_minimum = 0; // leastBytes() of lab/score/traffic.h; 0 without shadows
    vulkan::FilterCost filter;       // the blur's cost; countersOf() leaves it at zeros
};
[[nodiscard]] Counters countersOf(const host::FrameTimes& times, const Plan& plan, bool redraws_all);

struct TimingOptions {
    std::uint32_t repetitions = 11; // timed frames of each; >= 1
    std::uint32_t warmup = 2;       // frames of each before them
    bool reuse_maps = false; // false: every map is drawn anew every frame; true: as each contestant's options say
};

/// The results of one technique's frames.
struct Timed {
    std::vector<host::FrameTimes> samples;
    Counters counters; // counters of the last frame
    LeastByPass least; // the least traffic of the last frame
    Plan plan;         // the plan of the last frame; without shadows: empty
    MapPages atlas;
    std::vector<std::pair<std::string, std::uint64_t>> added_memory; // beyond the frame without shadows, by purpose
    Waits waits;                                                     // between timeInTurn()'s samples; else empty
    double mean_texels_rendered = 0.0; // Counters::texels_rendered over the samples: less where maps are kept
    double baseline_ms = 0.0;          // median frame without shadows among the turns that these samples took
};
struct TimingResult {
    Timed baseline; // the same frame with no shadows: the samples of all groups
    std::vector<Timed> techniques;
    std::uint64_t baseline_bytes = 0;
};

/// The order in which `count` draw once in a round: 0 .. count - 1, and backwards in every other round.
[[nodiscard]] std::vector<std::size_t> turnsOf(std::uint32_t round, std::size_t count);

/// The most contestants that take turns together, and the most texels of maps that they may have among them (unless one
/// alone has more): their images are all in memory at once. A texel counts four bytes, so one of a filterable map
/// counts as several, with the images that it is made from. A depth map of 16384 and one of 8192 on a side fit
/// together.
inline constexpr std::size_t kMaxTogether = 8;
inline constexpr std::uint64_t kMaxTexelsTogether = std::uint64_t{1} << 29U;

/// How many contestants take turns together, group after group, in their order.
[[nodiscard]] std::vector<std::size_t> timingGroups(const std::vector<Contestant>& contestants, std::size_t lights);

/// Bytes of every image and buffer of a renderer.
[[nodiscard]] std::uint64_t totalBytes(const host::FrameRenderer& renderer);
/// The memory that one technique needs beyond the frame without shadows, by purpose.
[[nodiscard]] std::vector<std::pair<std::string, std::uint64_t>> addedMemory(const host::FrameRenderer& technique,
                                                                             const host::FrameRenderer& baseline);
/// The median of the whole frame, ms; 0 without samples.
[[nodiscard]] double medianFrame(const Timed& timed);

/// Takes the frame of the last sample into Timed::mean_texels_rendered.
void addTexels(Timed& timed, const Counters& frame);

/// The subject of a round, counted from 0, warm-up included. Called in order, once for each round of a group; a result
/// holds until the next call. Rounds differ in time, camera and lights only, not in the number of lights.
using SubjectAt = std::function<const Subject&(std::uint32_t round)>;

/// Draws every contestant of a group and the frame without shadows (the first contestant's options otherwise) once in
/// turn, again and again, in the order of turnsOf(), so that none always follows the same one; the frame without
/// shadows has place 0. Then the next of timingGroups(), with a frame without shadows of its own. `step` is called
/// after every frame drawn and may throw to stop; it may be empty. Precondition: one contestant at least.
[[nodiscard]] TimingResult timeInTurn(const host::SceneOnGpu& scene, const Subject& subject,
                                      const std::vector<Contestant>& contestants, const TimingOptions& options,
                                      const std::function<void()>& step);
/// Draws another subject in each round: frames of a path. Every group begins with round 0.
[[nodiscard]] TimingResult timeInTurn(const host::SceneOnGpu& scene, const SubjectAt& subject_at,
                                      const std::vector<Contestant>& contestants, const TimingOptions& options,
                                      const std::function<void()>& step);
/// How often timeInTurn() calls `step`.
[[nodiscard]] std::uint64_t timingSteps(const Subject& subject, const std::vector<Contestant>& contestants,
                                        const TimingOptions& options);

/// Median frame of `technique` divided by that of the frame without shadows that took turns with it; 0 when that has
/// none.
[[nodiscard]] double frameRatio(const Timed& technique);

} // namespace gnomon::lab
