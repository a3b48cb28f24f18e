// SPDX-License-Identifier: Apache-2.0
// What A. S. Shastry claims of soft-edged shadows.
#include "claim.h"
#include "claim_runs.h"
#include "shared_commands.h"
#include "worked_out.h"

namespace gnomon::app {
namespace {

using Runs = ClaimRuns;

/// The blur as published: of nine comparisons as published, plain over silhouettes, by the article's taps.
constexpr std::string_view kBlurred =
    "gnomon render spotlit --preset plain --camera stage --light gear --mask --filter pcf --set "
    "pcf.kernel=3x3-projected --soften blur --set soften.edges=plain --set soften.taps=published --map-size 512 --size "
    "320x180 -o blur_512.png";
constexpr std::string_view kHard512 =
    "gnomon render spotlit --preset plain --camera stage --light gear --mask --filter hard --map-size 512 --size "
    "320x180 -o hard_512.png";
constexpr std::string_view kHard4096 =
    "gnomon render spotlit --preset plain --camera stage --light gear --mask --filter hard --map-size 4096 --size "
    "320x180 -o hard_4096.png";
constexpr std::string_view kCoarseAndFine = "gnomon metrics hard_512.png hard_4096.png --json";
constexpr std::string_view kSoftenedTimes =
    "gnomon bench spotlit --preset plain --camera stage --size 640x360 --map-size 512 --repetitions 11 --warmup 1 "
    "--set pcf.kernel=3x3-projected --set soften.edges=plain --set soften.taps=published --techniques "
    "pcf,pcf+blur,pcf+blur+soften.size=half";
constexpr const char* kScreenBlur = "/memory_by_purpose_bytes/screen blur";

/// How far two pictures are apart, by how far two others are.
double apart(const Runs& runs, std::size_t metrics, std::size_t others)
{
    return runs.number(metrics, "/error/rmse") / runs.number(others, "/error/rmse");
}

/// The number of one run by that of another.
double byRun(const Runs& runs, std::size_t run, std::size_t other, const char* pointer)
{
    return runs.of(run, "hard+blur", pointer) / runs.of(other, "hard+blur", pointer);
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
         .commands = {kHard512, kHard4096,
                      ("gnomon render spotlit --preset plain --camera stage --light gear --mask --filter pcf --set "
                       "pcf.kernel=3x3-box --map-size 512 --size 320x180 -o box_512.png"),
                      ("gnomon render spotlit --preset plain --camera stage --light gear --mask --filter pcf --set "
                       "pcf.kernel=3x3-box --map-size 4096 --size 320x180 -o box_4096.png"),
                      kCoarseAndFine, "gnomon metrics box_512.png box_4096.png --json"},
         .parts = {{"what coarse texels change, rmse,", "of what they change of hard shadows",
                    [](const Runs& r) { return apart(r, 5, 4); }, 0.0, 0.25}},
         .verdict = Verdict::fails,
         .quick = true,
         .why = "Nine points of equal weight make steps of a ninth, each as long as a texel. As published they are one "
                "point nearly everywhere (2005-published-taps)."},
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
         .commands = {kHard512, kHard4096, kBlurred,
                      ("gnomon render spotlit --preset plain --camera stage --light gear --mask --filter pcf --set "
                       "pcf.kernel=3x3-projected --soften blur --set soften.edges=plain --set soften.taps=published "
                       "--map-size 4096 --size 320x180 -o blur_4096.png"),
                      kCoarseAndFine, "gnomon metrics blur_512.png blur_4096.png --json"},
         .parts = {{"what coarse texels change, rmse,", "of what they change of hard shadows",
                    [](const Runs& r) { return apart(r, 5, 4); }, 0.0, 0.25}},
         .verdict = Verdict::holds,
         .quick = true,
         .why = "As published: nine comparisons, a blur over silhouettes, and the article's taps. No steps are seen. "
                "Edges that lie elsewhere are left."},
        {.id = "2005-blur-memory",
         .claim = "Screen and blur buffers are common to all lights, so many lights take little memory",
         .commands = {("gnomon bench planes --preset plain --camera side --partition cube --point=-3,3,-2,20 --size "
                       "160x90 --map-size 64 --repetitions 1 --warmup 0 --techniques hard+blur"),
                      ("gnomon bench planes --preset plain --camera side --partition cube "
                       "--point=-3,3,-2,20,-1,3,-2,20,1,3,-2,20 --size 160x90 --map-size 64 --repetitions 1 --warmup 0 "
                       "--techniques hard+blur"),
                      ("gnomon bench planes --preset plain --camera side --partition cube "
                       "--point=-3,3,-2,20,-1,3,-2,20,1,3,-2,20,3,3,-2,20,-3,3,1,20,-1,3,1,20,1,3,1,20,3,3,1,20 --size "
                       "160x90 --map-size 64 --repetitions 1 --warmup 0 --techniques hard+blur")},
         .parts = {{"the blur's image for eight lamps is", "times that for three",
                    [](const Runs& r) { return byRun(r, 2, 1, kScreenBlur); }, 0.0, 1.1},
                   {"that for three is", "times that for one",
                    [](const Runs& r) { return byRun(r, 1, 0, kScreenBlur); }, 0.0, 1.1},
                   {"the screen's buffer, our mask, for eight is", "times that for one",
                    [](const Runs& r) { return byRun(r, 2, 0, "/memory_by_purpose_bytes/mask"); }, 0.0, 1.1}},
         .verdict = Verdict::partly,
         .quick = false,
         .why = "The blur's image is one layer of the mask, which has a channel for one light and four for more. The "
                "mask has a layer for every four, because all lights are shaded from it at once; the article draws "
                "light by light."},
        {.id = "2005-blur-cost",
         .claim = "It is a bit fill-rate intensive",
         .commands = {kSoftenedTimes},
         .parts = {{"a frame takes", "times that without",
                    [](const Runs& r) { return r.ratio("pcf+blur", "pcf", "/time_ms/frame"); }, 1.02, 1.6}},
         .verdict = Verdict::holds,
         .quick = false,
         .why = "With three lamps. Under one sun the blur is several times the work of the mask itself."},
        {.id = "2005-blur-half",
         .claim = "Smaller blur buffers cut that, for little quality",
         .commands = {kSoftenedTimes, kBlurred,
                      ("gnomon render spotlit --preset plain --camera stage --light gear --mask --filter pcf --set "
                       "pcf.kernel=3x3-projected --soften none --map-size 512 --size 320x180 -o unblurred.png"),
                      ("gnomon render spotlit --preset plain --camera stage --light gear --mask --filter pcf --set "
                       "pcf.kernel=3x3-projected --soften blur --set soften.edges=plain --set soften.taps=published "
                       "--set soften.size=half --map-size 512 --size 320x180 -o half.png"),
                      "gnomon metrics half.png blur_512.png --json",
                      "gnomon metrics unblurred.png blur_512.png --json"},
         .parts = {{"half the size takes", "of the blur's time",
                    [](const Runs& r) {
                        return r.passMs(0, "pcf+blur+soften.size=half", "soften") / r.passMs(0, "pcf+blur", "soften");
                    },
                    0.0, 0.4},
                   {"it differs from full size, rmse, by", "of what the blur changes",
                    [](const Runs& r) { return apart(r, 4, 5); }, 0.0, 0.25}},
         .verdict = Verdict::holds,
         .quick = false,
         .why = "A quarter of the pixels, and reading them back by depth and normal."},
        {.id = "2005-blur-volumes",
         .claim = "The blur works on shadow volumes too",
         .commands =
             {("gnomon render planes --preset plain --camera side --mask --filter volumes --set "
               "volumes.open=skip --size 320x180 -o volumes.png"),
              ("gnomon render planes --preset plain --camera side --mask --filter volumes --set "
               "volumes.open=skip --soften blur --set soften.edges=plain --set soften.taps=published --size "
               "320x180 -o volumes_blur.png"),
              ("gnomon render planes --preset plain --camera side --mask --filter hard --map-size 4096 --size "
               "320x180 -o map.png"),
              ("gnomon render planes --preset plain --camera side --mask --filter hard --map-size 4096 --soften "
               "blur --set soften.edges=plain --set soften.taps=published --size 320x180 -o map_blur.png"),
              "gnomon metrics volumes_blur.png volumes.png --json", "gnomon metrics map_blur.png map.png --json"},
         .parts = {{"it changes the mask of volumes, rmse, by", "times what it changes that of a map",
                    [](const Runs& r) { return apart(r, 4, 5); }, 0.8, 1.25}},
         .verdict = Verdict::holds,
         .quick = true,
         .why = "It blurs whatever mask there is."},
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
