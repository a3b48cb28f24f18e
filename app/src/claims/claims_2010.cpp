// SPDX-License-Identifier: Apache-2.0
// What P. Fortier claims of shadow maps under a sun that moves.
#include "claim.h"
#include "claim_runs.h"
#include "worked_out.h"

namespace gnomon::app {
namespace {

using Runs = ClaimRuns;

constexpr std::string_view kPanOfPlanes =
    "gnomon compare planes --preset plain --camera side --path pan --frames 0-5 --size 240x135 --truth hard --map-size "
    "512 --techniques hard,hard+snap";
/// The camera pans as ever while the world's time hardly goes on.
constexpr std::string_view kPanOfMeadow =
    "gnomon compare sundial --preset plain --camera meadow --sun 0.4,-0.8,0.5 --path pan --frames 0-3 --fps 10000 "
    "--set "
    "path.speed=333 --size 192x108 --truth hard --map-size 1024 --techniques hard,hard+snap";
/// A camera that pans while the scene's time goes on: under a sun that stands, and under the scene's own.
constexpr std::string_view kPanUnderStillSun =
    "gnomon compare sundial --preset plain --camera meadow --sun 0.4,-0.8,0.5 --time 120 --path pan --frames 0-9 --fps "
    "10 --size 256x144 --truth hard --map-size 1024 --techniques pcf,pcf+snap";
constexpr std::string_view kPanUnderMovingSun =
    "gnomon compare sundial --preset plain --camera meadow --light sun --time 120 --path pan --frames 0-9 --fps 10 "
    "--size 256x144 --truth hard --map-size 1024 --techniques pcf+snap";
constexpr std::string_view kSunOverMeadow =
    "gnomon compare sundial --preset plain --camera meadow --light sun --time 120 --path day --frames 0-19 --fps 10 "
    "--size 256x144 --samples 256 --map-size 1024 --techniques pcf,pcf+step-jump,pcf+step-band,"
    "pcf+step-blend";
/// As the document has it: nine samples, two depths in the channels of one texture, nothing kept, 1280x720.
constexpr std::string_view kSunTimes =
    "gnomon bench --preset icefall-2010 --time 300 --path day --frames 0-19 --fps 15 --size 1280x720 --set "
    "keep-still=never --techniques pcf+snap,pcf+step-band,pcf+step-blend,pcf+step-alternate";
constexpr std::string_view kTwoInOne =
    "gnomon compare sundial --preset plain --camera meadow --size 64x36 --truth hard --repetitions 1 --warmup 0 "
    "--map-size 1024 --techniques pcf+step-blend+map-format=rgba8,pcf+step-blend+map-format=r32f";

/// A frame by that of a single map that follows the sun.
double frameOver(const Runs& runs, std::string_view technique)
{
    return runs.ratio(technique, "pcf+snap", "/time_ms/frame");
}

const std::vector<Claim>& table2010()
{
    static const std::vector<Claim> table{
        {.id = "2010-snap",
         .claim = "A map that moves by whole texels does not swim when the camera moves",
         .commands = {kPanOfPlanes, kPanOfMeadow},
         .parts = {{"shimmer left on planes", "of that of a free map",
                    [](const Runs& r) {
                        return r.of("hard+snap", "/stability/shimmer") / r.of("hard", "/stability/shimmer");
                    },
                    0.0, 0.05},
                   {"on a meadow, its time standing still,", "of it",
                    [](const Runs& r) {
                        return r.of(1, "hard+snap", "/stability/shimmer") / r.of(1, "hard", "/stability/shimmer");
                    },
                    0.0, 0.05}},
         .verdict = Verdict::holds,
         .quick = true,
         .why =
             "Texels stay where they are in the world. What moves there flickers as before: trees, somebody who walks, "
             "and the scene's own sun, which is 2010-sun-swims."},
        {.id = "2010-sun-swims",
         .claim = "The swimming comes back as soon as the sun moves",
         .commands = {kPanUnderStillSun, kPanUnderMovingSun},
         .parts = {{"under a sun that stands, shimmer of a snapped map", "of that of a free one",
                    [](const Runs& r) { return r.ratio("pcf+snap", "pcf", "/stability/shimmer"); }, 0.0, 0.05},
                   {"under one that moves", "of it",
                    [](const Runs& r) {
                        return r.of(1, "pcf+snap", "/stability/shimmer") / r.of(0, "pcf", "/stability/shimmer");
                    },
                    0.8}},
         .verdict = Verdict::holds,
         .quick = true,
         .why = "The map turns with the light, and no whole texels undo that."},
        {.id = "2010-jump",
         .claim = "To move the sun seldom makes a jump that is seen; to blend two positions does not",
         .commands = {kSunOverMeadow},
         .parts = {{"the jump's worst frame changes", "times as much as a free map's",
                    [](const Runs& r) { return r.ratio("pcf+step-jump", "pcf", "/stability/pop"); }, 2.0},
                   {"the blend's", "of the jump's",
                    [](const Runs& r) { return r.ratio("pcf+step-blend", "pcf+step-jump", "/stability/pop"); }, 0.0,
                    0.1}},
         .verdict = Verdict::holds,
         .quick = false,
         .why = "Half a degree at once, or over the twenty frames between."},
        {.id = "2010-band-looks",
         .claim = "A band that sweeps over the screen looks less good than the full blend",
         .commands = {kSunOverMeadow},
         .parts = {{"shimmer of the band", "times that of the blend",
                    [](const Runs& r) { return r.ratio("pcf+step-band", "pcf+step-blend", "/stability/shimmer"); },
                    1.1},
                   {"its worst frame changes", "times as much",
                    [](const Runs& r) { return r.ratio("pcf+step-band", "pcf+step-blend", "/stability/pop"); }, 1.1}},
         .verdict = Verdict::holds,
         .quick = false,
         .why = "What a band changes at a place it changes within a quarter of the time."},
        {.id = "2010-band-cost",
         .claim = "The band takes 4 ms more than a single map's 48 ms (+8 %), on the Xbox 2.5 more than 26 (+10 %)",
         .commands = {kSunTimes},
         .parts = {{"a frame takes", "times one of a map that follows the sun",
                    [](const Runs& r) { return frameOver(r, "pcf+step-band"); }, 1.04, 1.2}},
         .verdict = Verdict::fails,
         .quick = false,
         .why = "Nothing is kept here, as in the document: every caster is drawn twice in every frame, which takes a "
                "software rasteriser a fifth of its time. Where maps are kept between steps, as they are by default, a "
                "frame takes less than with one map."},
        {.id = "2010-blend-cost",
         .claim = "The full blend takes 13 ms more than 48 (+27 %), on the Xbox 9.5 more than 26 (+37 %)",
         .commands = {kSunTimes},
         .parts = {{"a frame takes", "times one of a map that follows the sun",
                    [](const Runs& r) { return frameOver(r, "pcf+step-blend"); }, 1.2, 1.5}},
         .verdict = Verdict::holds,
         .quick = false,
         .why = "Casters and samples are twice as many all over the picture."},
        {.id = "2010-alternate",
         .claim = "To draw the two positions in alternate frames would be cheaper than the full blend, and take one "
                  "more target as large as the screen",
         .commands = {kSunTimes},
         .parts =
             {{"a frame takes", "of the blend's",
               [](const Runs& r) { return r.ratio("pcf+step-alternate", "pcf+step-blend", "/time_ms/frame"); }, 0.0,
               0.95},
              {"it draws", "of the blend's triangles",
               [](const Runs& r) { return r.ratio("pcf+step-alternate", "pcf+step-blend", "/counters/primitives"); },
               0.0, 0.75},
              {"memory", "times the blend's",
               [](const Runs& r) { return r.ratio("pcf+step-alternate", "pcf+step-blend", "/memory_bytes"); }, 1.0}},
         .verdict = Verdict::holds,
         .quick = false,
         .why = "It draws one map a frame instead of two, and keeps what was shown in the frame before."},
        {.id = "2010-two-in-one",
         .claim = "Two maps in the channels of one texture save memory",
         .commands = {kTwoInOne},
         .parts = {{"two in a texture take", "of two of 32 bits",
                    [](const Runs& r) {
                        return r.ratio("pcf+step-blend+map-format=rgba8", "pcf+step-blend+map-format=r32f",
                                       "/map/bytes");
                    },
                    0.0, 0.55},
                   {"with all that is needed", "of it",
                    [](const Runs& r) {
                        return r.ratio("pcf+step-blend+map-format=rgba8", "pcf+step-blend+map-format=r32f",
                                       "/memory_bytes");
                    },
                    0.0, 0.95}},
         .verdict = Verdict::holds,
         .quick = true,
         .why = "Colour targets, each with a depth buffer to be drawn with. Two depth maps of 16 bits take less "
                "(`map-format=d16`), and are what to use."},
        {.id = "2010-two-bytes",
         .claim = "Depth fits two channels of 8 bits",
         .parts = {{"the published code errs by", "steps of 16 bits",
                    [](const Runs&) { return errorOfPublishedBytes(); }, 0.0, 0.55},
                   {"ours by", "steps", [](const Runs&) { return errorOfBytes(); }, 0.0, 0.55}},
         .verdict = Verdict::holds,
         .quick = true,
         .why = "The published one shares a value between neighbours: 65,026 depths in place of 65,536."},
    };
    return table;
}

} // namespace

std::span<const Claim> claimsOf2010()
{
    return table2010();
}

} // namespace gnomon::app
