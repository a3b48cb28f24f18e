// SPDX-License-Identifier: Apache-2.0
// What A. S. Shastry claims of soft-edged shadows.
#include "claim.h"
#include "claim_runs.h"
#include "shared_commands.h"
#include "worked_out.h"

namespace gnomon::app {
namespace {

using Runs = ClaimRuns;

constexpr std::string_view kSoftened =
    "gnomon compare spotlit --preset plain --camera stage --light-size 0.2 --size 320x180 --samples 64 --repetitions 1 "
    "--warmup 0 --map-size 512 --set soften.edges=plain --set soften.taps=published --techniques hard,hard+blur,"
    "hard+blur+soften.size=half";
constexpr std::string_view kSoftenedTimes =
    "gnomon bench spotlit --preset plain --camera stage --size 640x360 --map-size 512 --repetitions 5 --warmup 1 "
    "--set soften.edges=plain --set soften.taps=published --techniques hard,hard+blur,hard+blur+soften.size=half";
constexpr const char* kScreenBlur = "/memory_by_purpose_bytes/screen blur";

/// The number of one run by that of another.
double byRun(const Runs& runs, std::size_t run, std::size_t other, std::string_view technique, const char* pointer)
{
    return runs.of(run, technique, pointer) / runs.of(other, technique, pointer);
}

const std::vector<Claim>& table2005()
{
    static const std::vector<Claim> table{
        {.id = "2005-float-depth",
         .claim = "R32F has sufficient precision for a lamp's depths from 1 to 1024",
         .parts = {{"a step just below 1024 is", "m", [](const Runs&) { return stepOfFloatsBelow(1024.0); }, 0.0,
                    1e-3}},
         .verdict = Verdict::holds,
         .quick = true,
         .why = "Metres as they are, not scaled to 0 to 1."},
        {.id = "2005-depth-per-vertex",
         .claim = "Depth may be worked out per vertex instead of per pixel",
         .parts = {{"interpolated z errs by", "m", [](const Runs&) { return errorOfClipDepth(); }, 0.0, 1e-12}},
         .verdict = Verdict::holds,
         .quick = true,
         .why = "Clip-space z is affine in the point. Distance from the lamp is not (2011-vertex-distance)."},
        {.id = "2005-pcf-smooth",
         .claim = "Nine comparisons averaged smooth jagged edges",
         .commands = {kStage},
         .parts = {{"rmse of the article's nine, each counting alike,", "of that of hard",
                    [](const Runs& r) { return r.ratio("pcf+pcf.kernel=3x3-box", "hard", "/error/rmse"); }, 0.0, 0.85},
                   {"error at edges", "of it",
                    [](const Runs& r) { return r.ratio("pcf+pcf.kernel=3x3-box", "hard", "/error/edge"); }, 0.0, 0.7}},
         .verdict = Verdict::fails,
         .quick = true,
         .why = "Held against a lamp 0.2 m across. They smooth a little, as meant, and not at all as published "
                "(2005-published-taps). The default of `pcf` weighs nine by a Gaussian and reads between texels: 0.75 "
                "and 0.54."},
        {.id = "2005-published-taps",
         .claim = "The nine published taps are the texel under test and the eight around it",
         .parts = {{"10 m from the lamp they are", "texels apart", [](const Runs&) { return publishedTapsApart(10.0); },
                    0.9, 1.1}},
         .verdict = Verdict::fails,
         .quick = true,
         .why = "The offset is added before the division by w. So all nine are in one texel nearly everywhere."},
        {.id = "2005-gaussian",
         .claim = "The published fifteen taps are a Gaussian blur",
         .parts = {{"their weights sum to", "", [](const Runs&) { return publishedBlur().sum; }, 0.99, 1.01},
                   {"the right side weighs", "times the left", [](const Runs&) { return publishedBlur().sides; }, 0.99,
                    1.01},
                   {"their centre is off by", "px", [](const Runs&) { return publishedBlur().centre_px; }, -0.01,
                    0.01}},
         .verdict = Verdict::fails,
         .quick = true,
         .why = "Seven odd places, each side weighed for another place, and the middle by another width. Shadows get "
                "lighter, are cut off at white, and move."},
        {.id = "2005-blur-edges",
         .claim = "Blurring the mask in screen space removes the aliasing of edges",
         .commands =
             {("gnomon render spotlit --preset plain --camera stage --light gear --mask --filter hard --map-size "
               "512 --size 320x180 -o hard_512.png"),
              ("gnomon render spotlit --preset plain --camera stage --light gear --mask --filter hard --map-size "
               "4096 --size 320x180 -o hard_4096.png"),
              ("gnomon render spotlit --preset plain --camera stage --light gear --mask --filter hard --soften "
               "blur --set soften.edges=plain --set soften.taps=published --map-size 512 --size 320x180 -o "
               "blur_512.png"),
              ("gnomon render spotlit --preset plain --camera stage --light gear --mask --filter hard --soften "
               "blur --set soften.edges=plain --set soften.taps=published --map-size 4096 --size 320x180 -o "
               "blur_4096.png"),
              "gnomon metrics hard_512.png hard_4096.png --json", "gnomon metrics blur_512.png blur_4096.png --json",
              kSoftened},
         .parts = {{"what coarse texels change, rmse,", "of what they change unblurred",
                    [](const Runs& r) { return r.number(5, "/error/rmse") / r.number(4, "/error/rmse"); }, 0.0, 0.25},
                   {"error at edges", "times that of hard",
                    [](const Runs& r) { return r.of(6, "hard+blur", "/error/edge") / r.of(6, "hard", "/error/edge"); },
                    0.0, 0.85},
                   {"rmse", "times hard's",
                    [](const Runs& r) { return r.of(6, "hard+blur", "/error/rmse") / r.of(6, "hard", "/error/rmse"); },
                    0.0, 0.85}},
         .verdict = Verdict::partly,
         .quick = true,
         .why = "As published, plain over silhouettes and with the article's taps: a quarter of what coarse texels "
                "change is left, and no steps are seen. Symmetric taps leave 0.18 of it, our blur that stops at edges "
                "0.35. Against a lamp 0.2 m across fifteen pixels are far too wide."},
        {.id = "2005-blur-memory",
         .claim = "Screen and blur buffers are common to all lights, so many lights take little memory",
         .commands = {"gnomon bench ring --preset plain --camera deck --partition cube --size 160x90 --map-size 64 "
                      "--repetitions 1 --warmup 0 --techniques hard,hard+blur",
                      "gnomon bench spotlit --preset plain --camera stage --size 160x90 --map-size 64 --repetitions 1 "
                      "--warmup 0 --techniques hard,hard+blur",
                      "gnomon bench rts --preset plain --camera camp --size 160x90 --map-size 64 --repetitions 1 "
                      "--warmup 0 --techniques hard,hard+blur"},
         .parts = {{"the blur's image for all lamps of a deck is", "times that for three",
                    [](const Runs& r) { return byRun(r, 0, 1, "hard+blur", kScreenBlur); }, 0.0, 1.1},
                   {"that for three is", "times that for one",
                    [](const Runs& r) { return byRun(r, 1, 2, "hard+blur", kScreenBlur); }, 0.0, 1.1}},
         .verdict = Verdict::partly,
         .quick = false,
         .why = "It is one layer of the mask, which has a channel for one light and four for more. The mask itself, "
                "which all lights are shaded from at once, grows by a layer for every four."},
        {.id = "2005-blur-cost",
         .claim = "It is a bit fill-rate intensive",
         .commands = {kSoftenedTimes},
         .parts = {{"a frame takes", "times that without",
                    [](const Runs& r) { return r.ratio("hard+blur", "hard", "/time_ms/frame"); }, 1.02, 1.6}},
         .verdict = Verdict::holds,
         .quick = false,
         .why = "With three lamps. Under one sun the blur is several times the work of the mask itself."},
        {.id = "2005-blur-half",
         .claim = "Smaller blur buffers cut that, for little quality",
         .commands = {kSoftenedTimes, kSoftened},
         .parts = {{"half the size takes", "of the blur's time",
                    [](const Runs& r) {
                        return r.passMs(0, "hard+blur+soften.size=half", "soften") / r.passMs(0, "hard+blur", "soften");
                    },
                    0.0, 0.4},
                   {"rmse", "times that of full size",
                    [](const Runs& r) {
                        return r.of(1, "hard+blur+soften.size=half", "/error/rmse") /
                               r.of(1, "hard+blur", "/error/rmse");
                    },
                    0.0, 1.1}},
         .verdict = Verdict::holds,
         .quick = false,
         .why = "A quarter of the pixels, and reading them back by depth and normal."},
        {.id = "2005-blur-volumes",
         .claim = "The blur works on shadow volumes too",
         .commands = {"gnomon compare planes --preset plain --camera side --sun-angle 10 --size 320x180 --samples 64 "
                      "--repetitions 1 --warmup 0 --set soften.edges=plain --set soften.taps=published --techniques "
                      "volumes+volumes.open=skip,volumes+volumes.open=skip+blur",
                      "gnomon compare planes --preset plain --camera side --sun-angle 2 --size 320x180 --samples 64 "
                      "--repetitions 1 --warmup 0 --set soften.edges=plain --set soften.taps=published --techniques "
                      "volumes+volumes.open=skip,volumes+volumes.open=skip+blur"},
         .parts = {{"under a sun of 10 degrees error at edges", "times that of volumes alone",
                    [](const Runs& r) {
                        return r.ratio("volumes+volumes.open=skip+blur", "volumes+volumes.open=skip", "/error/edge");
                    },
                    0.0, 0.85},
                   {"under one of 2", "times it",
                    [](const Runs& r) {
                        return r.of(1, "volumes+volumes.open=skip+blur", "/error/edge") /
                               r.of(1, "volumes+volumes.open=skip", "/error/edge");
                    },
                    0.0, 0.85}},
         .verdict = Verdict::partly,
         .quick = true,
         .why = "It blurs whatever mask there is. It is as wide under every sun, so it is right by chance."},
        {.id = "2005-volumes-accurate",
         .claim = "Shadow volumes are pixel-accurate and have no aliasing",
         .commands = {kBox},
         .parts = {{"rmse", "", [](const Runs& r) { return r.of("volumes+volumes.open=skip", "/error/rmse"); }, 0.0,
                    0.01}},
         .verdict = Verdict::holds,
         .quick = true,
         .why = "One pixel errs, at an edge, where a ray and a rasteriser round another way."},
        {.id = "2005-volumes-cost",
         .claim = "but depend heavily on geometry and fill rate",
         .commands = {kTimesAtCamp, kTimesOfBox},
         .parts = {{"at camp, fragments drawn", "times those of hard",
                    [](const Runs& r) {
                        return r.ratio("volumes+volumes.open=skip", "hard", "/counters/fragment_invocations");
                    },
                    1.5},
                   {"maps and mask take", "times as long",
                    [](const Runs& r) { return r.shadowMs(0, "volumes+volumes.open=skip") / r.shadowMs(0, "hard"); },
                    1.1},
                   {"on planes, of one box,", "times as long",
                    [](const Runs& r) { return r.shadowMs(1, "volumes+volumes.open=skip") / r.shadowMs(1, "hard"); },
                    0.0, 0.75}},
         .verdict = Verdict::holds,
         .quick = false,
         .why = "833 volumes at camp, though what is open casts nothing. Of one box they are the cheaper way."},
    };
    return table;
}

} // namespace

std::span<const Claim> claimsOf2005()
{
    return table2005();
}

} // namespace gnomon::app
