// SPDX-License-Identifier: Apache-2.0
// From a Frame to a Plan. Keeps which maps the lights have and what these hold, how far suns that move in steps have
// got, and its scratch memory; nothing else.
#pragma once

#include <gnomon/choices.h>
#include <gnomon/frame.h>
#include <gnomon/plan.h>

#include <cstdint>
#include <memory>
#include <span>

namespace gnomon {

/// When a sun that moves in steps takes the next one.
enum class StepBy : std::uint8_t { angle, time };

/// How the step motions divide a sun's course.
struct StepOptions {
    StepBy by = StepBy::angle;
    double angle_rad = 0.00872664626; // by angle: 0.5 degrees, about the sun's own width; 0.0001 .. 0.5
    double interval_s = 2.0;          // by time: 0.01 .. 86400, of Frame::time_s
    bool smooth = false;              // step-blend, -band, -alternate: the share as a cubic, else linear
    double band = 0.25;               // step-band: its width, share of the picture's: 0.01 .. 1
};

/// Whether what stands still is drawn apart and kept, so that where something moves only that has to be drawn again.
enum class KeepStill : std::uint8_t {
    automatic, // where a motion holds a map for many frames under a moving sun: the step motions
    never,
    always,
};

struct PlanOptions {
    Technique technique;
    std::uint32_t map_size = 2048; // texels on a side of one map; 16 .. 16384
    /// Receivers farther than this from the eye get no shadow, metres; 0: no limit.
    double max_distance_m = 0.0;
    double fade = 0.1; // share of max_distance_m over which shadows fade away: 0 .. 1
    CascadeOptions cascades;
    StepOptions steps;
    KeepStill keep_still = KeepStill::automatic;
    /// The map format has two maps a texel: a light's two positions of a stepping sun share their tiles.
    bool paired_maps = false;
    /// Room around the fitted rectangle for the filter's kernel, texels; 0 .. 64.
    double border_texels = 4.0; // at most a quarter of map_size is used, so that half of the map is left
    /// Filterable maps under parallel light: measure depth from a plane that leans with what receives shadow, so that
    /// level ground is level in depth whatever the sun's height. It is still metres along the ray. False: along the
    /// light's axis, as maps of bare depth always do.
    bool level_depth = true;
    /// Pages that the maps of these options may take, and again those of still casters: 1 .. 2048. Lights that find no
    /// room get Outcome atlas_full: first come, first served, and a light that is in every frame keeps its place.
    std::uint32_t max_layers = 64;
};

/// Deterministic: the same frames and options give the same plans, bit for bit. Not thread-safe; make one per thread.
class Planner {
public:
    /// Lights whose combination with the technique is refused (refusal()) get Outcome refused; that is no error.
    /// Precondition: map_size and the other options are in range (assert).
    explicit Planner(const PlanOptions& options);
    /// Several options, of which each light names its own (Light::options). Precondition: at least one.
    explicit Planner(std::span<const PlanOptions> options);
    ~Planner();
    Planner(Planner&&) noexcept;
    Planner& operator=(Planner&&) noexcept;

    /// The plan holds until the next call. Allocates nothing once warm (same counts as before).
    ///
    /// The planner takes it that its plans are drawn, one after the other. A backend that compares View::presumes with
    /// what it drew needs no more. One that doesn't says what it has not, or no longer: lost() or reset().
    [[nodiscard]] const Plan& plan(const Frame& frame);
    /// A map's texels are gone, or were not drawn: it is drawn whole when it is read next. A name of old is no error.
    void lost(const MapId& map);
    /// All maps are lost. Suns go on in their steps.
    void reset();
    /// Those that Light::options = `index` stands for.
    [[nodiscard]] const PlanOptions& options(std::uint32_t index = 0) const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace gnomon
