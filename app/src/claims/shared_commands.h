// SPDX-License-Identifier: Apache-2.0
// Commands that claims of several documents name, so that each is run once.
#pragma once

#include <string_view>

namespace gnomon::app {

/// Roofs over each other: what bleeds.
inline constexpr std::string_view kCanopies =
    "gnomon compare canopies --preset plain --camera side --size 320x180 --samples 64 --repetitions 1 --warmup 0 "
    "--map-size 512 --techniques hard,pcf,vsm,lvsm,lvsm+lvsm.placement=uniform,vsm+bleeding.linstep=0.3,"
    "vsm+bleeding.power=1.3,esm";
/// Tents, units and foliage on open ground, against a sun's disc.
inline constexpr std::string_view kCamp =
    "gnomon compare rts --preset plain --camera camp --size 320x180 --samples 64 --repetitions 1 --warmup 0 "
    "--map-size 512 --techniques hard+bias=none,vsm,vsm+bias=none,"
    "vsm+bias=none+map-format=rg16+msaa=1+blur=none+min-variance=0,"
    "vsm+bias=none+map-format=rg16+msaa=1+blur=none+min-variance=0.0001,esm";
/// The same against the sun's centre: bias, and depth aliasing of warps with one bias for all.
inline constexpr std::string_view kCampOfPoint =
    "gnomon compare rts --preset plain --camera camp --size 320x180 --truth hard --repetitions 1 --warmup 0 --map-size "
    "512 --techniques hard,hard+bias=none,hard+bias=none+map-format=d16,hard+bias=none+bias.constant=3,"
    "hard+bias=none+bias.constant=0.3,hard+lispsm+bias=none+bias.constant=0.3,"
    "hard+lispsm-simple+bias=none+bias.constant=0.3,hard+tsm+bias=none+bias.constant=0.3";
/// A lamp over a stage.
inline constexpr std::string_view kStage =
    "gnomon compare spotlit --preset plain --camera stage --light-size 0.2 --size 320x180 --samples 64 --repetitions 1 "
    "--warmup 0 --map-size 512 --techniques vsm,vsm+depth-metric=z-over-w,esm,vsm+map-format=rg16f,"
    "vsm+map-format=rg16f+depth-remap=1";
/// Closed bodies nearby: which faces a map holds.
inline constexpr std::string_view kClose =
    "gnomon compare spotlit --preset plain --camera close --size 320x180 --truth hard --repetitions 1 --warmup 0 "
    "--map-size 512 --techniques hard+bias=none,hard+bias=none+caster-faces=midpoint,vsm+bias=none,"
    "vsm+bias=none+caster-cull=front";
/// One closed box, by volumes and by a map.
inline constexpr std::string_view kBox =
    "gnomon compare planes --preset plain --camera side --size 320x180 --truth hard --repetitions 1 --warmup 0 "
    "--map-size 512 --techniques hard,volumes+volumes.open=skip";
/// Many casters, and one; by volumes and by a map.
inline constexpr std::string_view kTimesAtCamp =
    "gnomon bench rts --preset plain --camera camp --size 640x360 --map-size 512 --repetitions 3 --warmup 1 "
    "--techniques hard,volumes+volumes.open=skip";
inline constexpr std::string_view kTimesOfBox =
    "gnomon bench planes --preset plain --camera side --size 640x360 --map-size 512 --repetitions 3 --warmup 1 "
    "--techniques hard,volumes+volumes.open=skip";
/// Times of frames of which nothing is kept.
inline constexpr std::string_view kTimes =
    "gnomon bench spotlit --preset plain --camera stage --size 640x360 --map-size 512 --repetitions 11 --warmup 1 "
    "--techniques hard,hard+caster-faces=midpoint,pcf+pcf.kernel=7x7,vsm,esm";
inline constexpr std::string_view kTimesOfTaps =
    "gnomon bench rts --preset plain --camera camp --size 640x360 --map-size 1024 --repetitions 11 --warmup 1 "
    "--techniques pcf,pcf+pcf.kernel=7x7,vsm+msaa=1+blur=none+map-sampling=nearest,"
    "vsm+blur=none+map-sampling=anisotropic";

} // namespace gnomon::app
