// SPDX-License-Identifier: Apache-2.0
// What A. Marinescu claims of layered variance shadow maps and of the settings of his game.
#include "claim.h"
#include "claim_runs.h"
#include "shared_commands.h"
#include "worked_out.h"

#include <algorithm>

namespace gnomon::app {
namespace {

using Runs = ClaimRuns;

/// Each means against aliasing, beside a map of which one texel is read.
constexpr std::string_view kPoint = "vsm+msaa=1+blur=none+map-sampling=nearest";
constexpr std::string_view kAllMeans = "vsm+blur=none+map-sampling=anisotropic";
constexpr std::string_view kMeans =
    "gnomon compare rts --preset plain --camera camp --size 320x180 --samples 64 --repetitions 1 --warmup 0 --map-size "
    "1024 --techniques vsm+msaa=1+blur=none+map-sampling=nearest,vsm+msaa=1+blur=none,vsm+blur=none,vsm+msaa=1,"
    "vsm+msaa=1+blur=none+map-sampling=trilinear,vsm+msaa=1+blur=none+map-sampling=anisotropic";
constexpr std::string_view kMeansInMotion =
    "gnomon compare rts --preset plain --camera camp --path orbit --frames 0-3 --size 192x108 --truth hard --map-size "
    "1024 --techniques vsm+msaa=1+blur=none+map-sampling=nearest,vsm+blur=none+map-sampling=anisotropic";
/// Steps of 16 bits and nothing that hides them: no bias, no blur, one sample, no least variance.
constexpr std::string_view kLayers =
    "gnomon compare rts --preset plain --camera map --size 320x180 --samples 64 --repetitions 1 --warmup 0 --map-size "
    "512 --bias none --set msaa=1 --set blur=none --set min-variance=0 --techniques vsm+map-format=rg16,"
    "lvsm+lvsm.placement=uniform,lvsm+lvsm.placement=uniform+lvsm.layers=4,"
    "lvsm+lvsm.placement=hand+lvsm.splits=0.35,lvsm+lvsm.placement=hand+lvsm.splits=0.65";

double meansRmse(const Runs& runs, std::string_view means)
{
    return runs.ratio(means, kPoint, "/error/rmse");
}

double equalLayersAcne(const Runs& runs, std::string_view unequal)
{
    return runs.ratio("lvsm+lvsm.placement=uniform", unequal, "/error/acne");
}

/// A camera that pans beside a box, under lamps in one direction.
constexpr std::string_view kLampAt10m =
    "gnomon compare planes --preset plain --partition multi --camera side --point=-3,9,3,20 --map-size auto --texels "
    "262144 --path pan --frames 0-11 --size 240x135 --truth hard --techniques hard+snap";
constexpr std::string_view kLampAt100km =
    "gnomon compare planes --preset plain --partition multi --camera side --point=-30000,90000,30000,200000 --map-size "
    "auto --texels 262144 --path pan --frames 0-11 --size 240x135 --truth hard --techniques hard+snap";

/// How many times the triangles of the second command the first draws.
double trianglesOver(const Runs& runs)
{
    return runs.of(0, "hard", "/counters/primitives") / runs.of(1, "hard", "/counters/primitives");
}

/// Casters that the first view draws, of all objects that cast.
double drawnShare(const Json& plan)
{
    const Json& objects = plan.at("objects");
    const auto casters =
        std::count_if(objects.begin(), objects.end(), [](const Json& object) { return object.at("casts") == true; });
    return static_cast<double>(plan.at("views").at(0).at("casters").size()) / static_cast<double>(casters);
}

const std::vector<Claim>& table2011()
{
    static const std::vector<Claim> table{
        {.id = "2011-range",
         .claim = "Near and far planes at 1 and 100 make stored depth 100 times as accurate as at 1 and 10,000",
         .parts = {{"a metre takes", "times as much of the range", [](const Runs&) { return precisionOfTightPlanes(); },
                    90.0, 110.0}},
         .verdict = Verdict::holds,
         .quick = true,
         .why = "Depth is linear, so its step is the range's length over the number of codes: 9999 over 99."},
        {.id = "2011-float-digits",
         .claim = "Floats of 32 bits are accurate to 1e-6 only: finer differences of depth are not seen",
         .parts = {{"a step of floats just below 1 is", "", [](const Runs&) { return stepOfFloats(); }, 1e-6},
                   {"two moments lose a deviation of", "of the range",
                    [](const Runs&) { return deviationLostByMoments(); }, 1e-6}},
         .verdict = Verdict::partly,
         .quick = true,
         .why = "A plain map keeps far finer steps. A map of moments keeps far coarser ones, because a variance is the "
                "difference of two squares."},
        {.id = "2011-flicker",
         .claim =
             "Errors of floats make the boundary of shadows flicker, the more the farther light and camera are apart",
         .commands = {kLampAt10m, kLampAt100km},
         .parts = {{"shimmer of a map that holds still, the lamp 100 km away, less that at 10 m", "",
                    [](const Runs& r) {
                        return r.of(1, "hard+snap", "/stability/shimmer") - r.of(0, "hard+snap", "/stability/shimmer");
                    },
                    1e-3}},
         .verdict = Verdict::fails,
         .quick = true,
         .why =
             "The paper's own remedy is always on: a map's planes are close around what is seen. Matrices are made in "
             "double precision, relative to the eye."},
        {.id = "2011-vertex-distance",
         .claim = "Under a sun the distance to the light's plane may be worked out per vertex; that to a place may not",
         .parts = {{"interpolated distance to a plane errs by", "m", [](const Runs&) { return errorOfPlaneDistance(); },
                    0.0, 1e-12},
                   {"to a place by", "m", [](const Runs&) { return errorOfPlaceDistance(); }, 0.1}},
         .verdict = Verdict::holds,
         .quick = true,
         .why =
             "The first is affine in the point, the second is not. A triangle 20 m across was tried, some 10 m away."},
        {.id = "2011-planar-bound",
         .claim = "Chebyshev's bound is exact for one flat occluder over one flat receiver",
         .parts = {{"the bound errs by", "at most", [](const Runs&) { return errorOfPlanarBound(); }, 0.0, 1e-9}},
         .verdict = Verdict::holds,
         .quick = true,
         .why = "Two depths with shares p and 1 - p have the variance that makes it an equality."},
        {.id = "2011-double-storage",
         .claim = "A variance map takes twice the memory of a plain map",
         .commands = {kCanopies},
         .parts = {{"the map takes", "times as much",
                    [](const Runs& r) { return r.ratio("vsm", "hard", "/map/bytes"); }, 1.9, 2.1}},
         .verdict = Verdict::holds,
         .quick = true,
         .why = "Depth and its square. While it is made, four samples a texel and the blur's second image come on top: "
                "7 times in all."},
        {.id = "2011-minimum-variance",
         .claim = "A small least variance, once tuned, nearly removes the artefacts of inexact numbers",
         .commands = {kCamp},
         .parts = {{"acne left by a least variance of 0.0001,", "of that without, moments in 16 bits",
                    [](const Runs& r) {
                        return r.ratio("vsm+bias=none+map-format=rg16+msaa=1+blur=none+min-variance=0.0001",
                                       "vsm+bias=none+map-format=rg16+msaa=1+blur=none+min-variance=0", "/error/acne");
                    },
                    0.0, 0.1}},
         .verdict = Verdict::holds,
         .quick = true,
         .why = "No bias, blur or samples helped. It is a hundredth of the paper's value."},
        {.id = "2011-published-variance",
         .claim = "0.01 is such a value",
         .commands = {("gnomon compare --preset rts-2011 --camera camp --set lighten=0 --size 320x180 --samples 64 "
                       "--repetitions 1 --warmup 0 --techniques lvsm+bias=none,lvsm+bias=none+min-variance=0")},
         .parts =
             {{"acne", "of that without",
               [](const Runs& r) { return r.ratio("lvsm+bias=none", "lvsm+bias=none+min-variance=0", "/error/acne"); },
               0.0, 0.1},
              {"rmse", "of it",
               [](const Runs& r) { return r.ratio("lvsm+bias=none", "lvsm+bias=none+min-variance=0", "/error/rmse"); },
               0.0, 1.05}},
         .verdict = Verdict::holds,
         .quick = true,
         .why = "In the paper's layers, which are thin volumes of the world. Over a range of more than 100 m it is a "
                "deviation of 10 m, and with `vsm+min-variance=0.01` no unit casts a dark shadow."},
        {.id = "2011-bleeding-reduction",
         .claim = "Light bleeding is attenuated by cutting off low visibility, or by a power of it",
         .commands = {kCanopies},
         .parts = {{"cut off at 0.3, bleeding left", "of that without",
                    [](const Runs& r) { return r.ratio("vsm+bleeding.linstep=0.3", "vsm", "/error/bleeding"); }, 0.0,
                    0.5},
                   {"the paper's power of 1.3 leaves", "of it",
                    [](const Runs& r) { return r.ratio("vsm+bleeding.power=1.3", "vsm", "/error/bleeding"); }, 0.0,
                    0.75}},
         .verdict = Verdict::holds,
         .quick = true,
         .why = "What it costs is in 2014-fat-shadows."},
        {.id = "2011-one-layer",
         .claim = "It is enough to sample the one layer that holds the receiver, and layers reduce bleeding",
         .commands = {kCanopies},
         .parts = {{"bleeding with two layers", "of vsm's",
                    [](const Runs& r) { return r.ratio("lvsm", "vsm", "/error/bleeding"); }, 0.0, 0.05},
                   {"rmse", "times vsm's", [](const Runs& r) { return r.ratio("lvsm", "vsm", "/error/rmse"); }, 0.0,
                    0.9}},
         .verdict = Verdict::holds,
         .quick = true,
         .why = "For the layer of the receiver all casters of nearer layers are one flat caster."},
        {.id = "2011-layers-precision",
         .claim = "Layers make depth more precise, because their near and far planes are closer together",
         .commands = {kLayers},
         .parts = {{"acne of two layers of 16 bits", "of vsm's",
                    [](const Runs& r) {
                        return r.ratio("lvsm+lvsm.placement=uniform", "vsm+map-format=rg16", "/error/acne");
                    },
                    0.0, 0.75},
                   {"of four", "of vsm's",
                    [](const Runs& r) {
                        return r.ratio("lvsm+lvsm.placement=uniform+lvsm.layers=4", "vsm+map-format=rg16",
                                       "/error/acne");
                    },
                    0.0, 0.5}},
         .verdict = Verdict::holds,
         .quick = true,
         .why = "Nothing else hides rounding here: no bias, no blur, one sample, no least variance."},
        {.id = "2011-uniform-layers",
         .claim = "Layers of equal thickness are the most precise; against bleeding, place them by what is there",
         .commands = {kLayers, kCanopies},
         .parts = {{"acne of two equal layers of 16 bits", "of that of layers that meet at 0.35",
                    [](const Runs& r) { return equalLayersAcne(r, "lvsm+lvsm.placement=hand+lvsm.splits=0.35"); }, 0.0,
                    1.0},
                   {"it is", "of that of layers that meet at 0.65",
                    [](const Runs& r) { return equalLayersAcne(r, "lvsm+lvsm.placement=hand+lvsm.splits=0.65"); }, 0.0,
                    1.0},
                   {"layers placed in gaps bleed", "of what equal ones do",
                    [](const Runs& r) {
                        return r.of(1, "lvsm", "/error/bleeding") /
                               r.of(1, "lvsm+lvsm.placement=uniform", "/error/bleeding");
                    },
                    0.0, 0.5}},
         .verdict = Verdict::holds,
         .quick = true,
         .why = "The default, `gaps`, looks for where the least light bleeds."},
        {.id = "2011-filtering-cheap",
         .claim = "Bilinear reads, samples, a blur, mip levels and anisotropic reads make variance maps much better",
         .commands = {kMeans, kMeansInMotion},
         .parts =
             {{"beside point sampling, rmse with bilinear reads", "of that without",
               [](const Runs& r) { return meansRmse(r, "vsm+msaa=1+blur=none"); }, 0.0, 0.85},
              {"with those and four samples", "of it", [](const Runs& r) { return meansRmse(r, "vsm+blur=none"); }, 0.0,
               0.85},
              {"with those and a blur", "of it", [](const Runs& r) { return meansRmse(r, "vsm+msaa=1"); }, 0.0, 0.85},
              {"with mip levels", "of it",
               [](const Runs& r) { return meansRmse(r, "vsm+msaa=1+blur=none+map-sampling=trilinear"); }, 0.0, 0.85},
              {"with anisotropic reads", "of it",
               [](const Runs& r) { return meansRmse(r, "vsm+msaa=1+blur=none+map-sampling=anisotropic"); }, 0.0, 0.85},
              {"shimmer under a camera that goes round, with samples and anisotropic reads,", "of that without",
               [](const Runs& r) {
                   return r.of(1, kAllMeans, "/stability/shimmer") / r.of(1, kPoint, "/stability/shimmer");
               },
               0.0, 0.85}},
         .verdict = Verdict::partly,
         .quick = true,
         .why = "In a still picture bilinear reads do most of it. Mip levels, anisotropic reads and a blur make "
                "variances of wider places, which bleed; under a camera that moves they flicker less, which is what "
                "they are for."},
        {.id = "2011-filtering-cost",
         .claim = "Mip levels, anisotropic reading and samples do so at almost no extra cost",
         .commands = {kTimesOfTaps},
         .parts = {{"a frame with all three takes", "times that with point sampling",
                    [](const Runs& r) { return r.ratio(kAllMeans, kPoint, "/time_ms/frame"); }, 0.0, 1.1}},
         .verdict = Verdict::fails,
         .quick = false,
         .why = "On a software rasteriser, which has no fixed units for samples and filters."},
        {.id = "2011-bloom",
         .claim = "Bloom helps to hide what artefacts remain",
         .commands = {("gnomon render --preset rts-2011 --set bloom=0 --size 320x180 --truth area --samples 64 -o "
                       "truth.png"),
                      "gnomon render --preset rts-2011 --size 320x180 --truth area --samples 64 -o truth_bloom.png",
                      "gnomon render --preset rts-2011 --set lighten=0 --set bloom=0 --size 320x180 -o plain.png",
                      "gnomon render --preset rts-2011 --set lighten=0 --size 320x180 -o bloom.png",
                      "gnomon metrics plain.png truth.png --json", "gnomon metrics bloom.png truth_bloom.png --json"},
         .parts = {{"rmse to the truth with bloom in both", "of that without",
                    [](const Runs& r) { return r.number(5, "/error/rmse") / r.number(4, "/error/rmse"); }, 0.0, 0.95},
                   {"FLIP", "of that without",
                    [](const Runs& r) { return r.number(5, "/error/flip") / r.number(4, "/error/flip"); }, 0.0, 0.95}},
         .verdict = Verdict::partly,
         .quick = true,
         .why = "It lowers the contrast at edges, and with it an error in numbers. The eye sees it as before. With "
                "`bloom.threshold` 0.3, as in the preset; at 0.8 bloom could not be seen."},
        {.id = "2011-4096",
         .claim = "There are situations in which even a map of 4096 texels is too small",
         .commands = {("gnomon compare rts --preset plain --camera unit --size 320x180 --truth hard --repetitions 1 "
                       "--warmup 0 --techniques hard+map-size=4096,hard+map-size=1024")},
         .parts = {{"texels a pixel, in the median,", "",
                    [](const Runs& r) { return r.of("hard+map-size=4096", "/texel_density/p50"); }, 0.0, 1.0}},
         .verdict = Verdict::holds,
         .quick = true,
         .why = "One map from a unit's feet to the horizon; 320x180 pixels were too many for it."},
        {.id = "2011-larger-maps",
         .claim = "Larger maps make shadows better, and cost memory",
         .commands = {("gnomon compare rts --preset plain --camera unit --size 320x180 --truth hard --repetitions 1 "
                       "--warmup 0 --techniques hard+map-size=4096,hard+map-size=1024")},
         .parts = {{"rmse of a map of 4096", "of one of 1024",
                    [](const Runs& r) { return r.ratio("hard+map-size=4096", "hard+map-size=1024", "/error/rmse"); },
                    0.0, 0.8},
                   {"memory", "times as much",
                    [](const Runs& r) { return r.ratio("hard+map-size=4096", "hard+map-size=1024", "/map/bytes"); },
                    15.0, 17.0}},
         .verdict = Verdict::holds,
         .quick = true,
         .why = "Sixteen times the memory does not nearly divide the error by four: what is thinner than a texel "
                "is missed until texels are finer."},
        {.id = "2011-octree",
         .claim = "An octree culls efficiently what need not be drawn",
         .commands = {"gnomon plan rts --preset plain --camera unit --json"},
         .parts = {{"casters drawn", "of all", [](const Runs& r) { return drawnShare(r.json(0)); }, 0.0, 0.5}},
         .verdict = Verdict::holds,
         .quick = true,
         .why = "Of a view to the horizon; those that cannot shadow anything in sight are left out. How much sooner a "
                "tree finds them "
                "than a list is not tried."},
        {.id = "2011-complexity",
         .claim = "Shadow maps depend little on a scene's complexity, shadow volumes highly",
         .commands = {kTimesAtCamp, kTimesOfBox},
         .parts = {{"from one box to a camp a map draws", "times the triangles",
                    [](const Runs& r) { return trianglesOver(r); }, 100.0},
                   {"maps and mask take", "times as long",
                    [](const Runs& r) { return r.shadowMs(0, "hard") / r.shadowMs(1, "hard"); }, 0.0, 10.0},
                   {"with volumes", "times as long as that",
                    [](const Runs& r) {
                        constexpr std::string_view kVolumes = "volumes+volumes.open=skip";
                        return r.shadowMs(0, kVolumes) / r.shadowMs(1, kVolumes) /
                               (r.shadowMs(0, "hard") / r.shadowMs(1, "hard"));
                    },
                    2.0}},
         .verdict = Verdict::holds,
         .quick = false,
         .why = "A map's time is mostly that of texels and pixels. A volume is drawn over all that lies behind its "
                "caster, and at camp there are 833."},
        {.id = "2011-world-layers",
         .claim = "Two layers are to be volumes of the world, with a least variance of 0.01",
         .commands = {("gnomon compare --preset rts-2011 --camera camp --set lighten=0 --size 320x180 --samples 64 "
                       "--repetitions 1 --warmup 0 --techniques lvsm,lvsm+lvsm.placement=gaps")},
         .parts = {{"rmse", "of that of layers found in gaps",
                    [](const Runs& r) { return r.ratio("lvsm", "lvsm+lvsm.placement=gaps", "/error/rmse"); }, 0.0,
                    0.85},
                   {"light at contacts", "of it",
                    [](const Runs& r) { return r.ratio("lvsm", "lvsm+lvsm.placement=gaps", "/error/detached"); }, 0.0,
                    0.5}},
         .verdict = Verdict::holds,
         .quick = true,
         .why = "Over a slab of 6 m, 0.01 is a deviation of 0.6 m. Over the whole range it is too large "
                "(2011-published-variance)."},
        {.id = "2011-animated",
         .claim = "All geometry casts soft shadows, units with an animation system too",
         .commands =
             {("gnomon render --preset rts-2011 --camera giant --time 0.5 --set lighten=0 --mask --size 320x180 "
               "-o giant.png"),
              ("gnomon render --preset rts-2011 --camera giant --time 0.5 --set lighten=0 --mask --size 320x180 "
               "--set object=giant/skin:casts=false -o no_giant.png"),
              ("gnomon render --preset rts-2011 --camera giant --time 0.5 --mask --size 320x180 --truth area "
               "--samples 64 -o giant_truth.png"),
              ("gnomon render --preset rts-2011 --camera giant --time 0.5 --mask --size 320x180 --truth area "
               "--samples 64 --set object=giant/skin:casts=false -o no_giant_truth.png"),
              "gnomon metrics giant.png no_giant.png --json",
              "gnomon metrics giant_truth.png no_giant_truth.png --json"},
         .parts = {{"the one unit with a skin, half a second into its walk, changes the mask, rmse, by",
                    "of what it changes of the truth",
                    [](const Runs& r) { return r.number(4, "/error/rmse") / r.number(5, "/error/rmse"); }, 0.5, 1.5}},
         .verdict = Verdict::holds,
         .quick = true,
         .why = "His vertices are made anew in each frame."},
        {.id = "2011-matrices-once",
         .claim = "The light's matrices need making only once, when a map is loaded",
         .commands = {("gnomon compare planes --preset plain --camera side --path pan --frames 0-5 --size 192x108 "
                       "--truth hard --map-size 512 --techniques hard,hard+scene"),
                      ("gnomon compare rts --preset plain --camera map --size 320x180 --truth hard --repetitions 1 "
                       "--warmup 0 --map-size 1024 --techniques hard,hard+scene"),
                      ("gnomon compare rts --preset plain --camera camp --size 320x180 --truth hard --repetitions 1 "
                       "--warmup 0 --map-size 1024 --techniques hard,hard+scene")},
         .parts = {{"shimmer while the camera pans", "of that of a map that follows it",
                    [](const Runs& r) { return r.ratio("hard+scene", "hard", "/stability/shimmer"); }, 0.0, 0.05},
                   {"at map, rmse", "times its",
                    [](const Runs& r) { return r.of(1, "hard+scene", "/error/rmse") / r.of(1, "hard", "/error/rmse"); },
                    0.0, 1.1},
                   {"at camp", "times its",
                    [](const Runs& r) { return r.of(2, "hard+scene", "/error/rmse") / r.of(2, "hard", "/error/rmse"); },
                    0.0, 1.1}},
         .verdict = Verdict::partly,
         .quick = true,
         .why = "Nothing swims, and the whole map seen from above loses nothing. Closer by, texels stay as coarse as "
                "the map is large."},
        {.id = "2011-volumes-accurate",
         .claim = "Shadow volumes are extremely accurate, regardless of the distance from caster to receiver",
         .commands = {kBox,
                      ("gnomon compare planes --preset plain --camera side --sun=0.3,-0.5,1 --size 320x180 --truth "
                       "hard --repetitions 1 --warmup 0 --map-size 512 --techniques "
                       "hard,volumes+volumes.open=skip")},
         .parts = {{"rmse", "of that of a map of 512",
                    [](const Runs& r) { return r.ratio("volumes+volumes.open=skip", "hard", "/error/rmse"); }, 0.0,
                    0.5},
                   {"where the shadow is long", "of it",
                    [](const Runs& r) {
                        return r.of(1, "volumes+volumes.open=skip", "/error/rmse") / r.of(1, "hard", "/error/rmse");
                    },
                    0.0, 0.5},
                   {"itself", "", [](const Runs& r) { return r.of(1, "volumes+volumes.open=skip", "/error/rmse"); },
                    0.0, 0.01}},
         .verdict = Verdict::holds,
         .quick = true,
         .why = "Edges are those of the picture's pixels, wherever they fall."},
    };
    return table;
}

} // namespace

std::span<const Claim> claimsOf2011()
{
    return table2011();
}

} // namespace gnomon::app
