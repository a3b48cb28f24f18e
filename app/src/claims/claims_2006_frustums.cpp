// SPDX-License-Identifier: Apache-2.0
#include "claims_2006_frustums.h"

#include "claim_runs.h"

#include <array>
#include <cmath>
#include <limits>

namespace gnomon::app {
namespace {

using Runs = ClaimRuns;

constexpr std::string_view kLanternTwo =
    "gnomon compare ring --camera duel --light \"lantern 2\" --light-size 0.02 --size 320x180 --samples 64 "
    "--repetitions 1 --warmup 0 --texels 1048576 --techniques hard+multi,hard+cube";
constexpr std::string_view kPendant =
    "gnomon compare ring --camera bar --light \"pendant 13\" --light-size 0.02 --size 320x180 --samples 64 "
    "--repetitions 1 --warmup 0 --texels 1048576 --techniques hard+multi,hard+cube";
constexpr std::string_view kPendantOfDeck =
    "gnomon compare ring --camera deck --light \"pendant 15\" --light-size 0.02 --size 320x180 --samples 64 "
    "--repetitions 1 --warmup 0 --texels 1048576 --techniques hard+multi,hard+cube";
/// A lamp at the far end of a floor, before an eye at the near end; and one that the ring's view looks into.
constexpr std::string_view kDuelOnPlanes =
    "gnomon compare planes --preset plain --partition cube --map-size auto --eye 0,1.5,9 --target 0,1.2,-9 --point "
    "0,2,-8,40 --size 240x135 --truth hard --repetitions 1 --warmup 0 --texels 1048576 --techniques "
    "hard+cube,hard+multi+multi.most-times=4";
constexpr std::string_view kDuelOfReactor =
    "gnomon compare ring --preset plain --partition cube --map-size auto --camera duel --light \"reactor 12\" --size "
    "240x135 --truth hard --repetitions 1 --warmup 0 --texels 1048576 --techniques "
    "hard+cube,hard+multi+multi.most-times=4";
/// The first two cameras all but stand.
constexpr std::array<std::string_view, 7> kPopping{
    "gnomon compare ring --preset plain --partition cube --camera duel --light \"lantern 2\" --map-size auto --size "
    "240x135 --truth hard --frames 0-7 --path pan --set path.speed=0.001 --techniques hard+multi,hard+multi+snap",
    "gnomon compare ring --preset plain --partition cube --camera duel --light \"reactor 12\" --map-size auto --size "
    "240x135 --truth hard --frames 0-7 --path pan --set path.speed=0.001 --techniques hard+multi,hard+multi+snap",
    "gnomon compare ring --preset plain --partition cube --camera duel --light \"lantern 2\" --map-size auto --size "
    "240x135 --truth hard --frames 0-7 --path orbit --techniques hard+multi,hard+multi+snap",
    "gnomon compare ring --preset plain --partition cube --camera duel --light \"reactor 12\" --map-size auto --size "
    "240x135 --truth hard --frames 0-7 --path orbit --techniques hard+multi,hard+multi+snap",
    "gnomon compare ring --preset plain --partition cube --camera duel --light \"lantern 2\" --map-size auto --size "
    "240x135 --truth hard --frames 0-7 --path pan --techniques hard+multi,hard+multi+snap",
    "gnomon compare ring --preset plain --partition cube --camera duel --light \"reactor 12\" --map-size auto --size "
    "240x135 --truth hard --frames 0-7 --path pan --techniques hard+multi,hard+multi+snap",
    "gnomon compare ring --preset plain --partition cube --camera deck --light \"lantern 0\" --map-size auto --size "
    "240x135 --truth hard --frames 0-7 --path pan --techniques hard+multi,hard+multi+snap"};
constexpr std::string_view kDuelPlan = "gnomon plan ring --camera duel --partition multi --json";

/// The pop in the worst frame of a path: held frustums' by free ones'.
double popLeft(const Runs& runs, std::size_t run)
{
    return runs.of(run, "hard+multi+snap", "/stability/pop") / runs.of(run, "hard+multi", "/stability/pop");
}

/// The lights of a plan that have maps, of all that cast shadows.
double lightsWithMaps(const Json& plan)
{
    double with = 0.0;
    double casting = 0.0;
    for (const Json& light : plan.at("lights")) {
        with += light.at("view_count") > 0 ? 1.0 : 0.0;
        casting += light.at("outcome") == "no_shadow_wanted" ? 0.0 : 1.0;
    }
    return with / casting;
}

/// How uneven texels are on what faces eye and lamp: the finest hundredth by the coarsest.
double unevenness(const Runs& runs, std::size_t run, std::string_view technique)
{
    return runs.of(run, technique, "/texel_density/facing/p99") / runs.of(run, technique, "/texel_density/facing/p01");
}

/// Into how many parts, in each of which one to four times the texels are enough, the texels of a uniform map part what
/// is seen. Nothing bounds it.
double regionsOf(const Runs& runs, std::size_t run)
{
    return std::ceil(std::log2(unevenness(runs, run, "hard+cube")) / 2.0);
}

/// How much fading over is left to do in a picture, by how much in one with hard edges. NaN where the seams of that are
/// less than a step of 8 bits, so that there is nothing to hide.
double seamsLeft(const Runs& runs, std::size_t picture, std::size_t hard, const char* pointer)
{
    const double visible = runs.number(hard, "/error/rmse") * 255.0;
    return visible >= 1.0 ? runs.number(picture, pointer) / runs.number(hard, pointer)
                          : std::numeric_limits<double>::quiet_NaN();
}

} // namespace

const std::vector<Claim>& frustums2006()
{
    static const std::vector<Claim> table{
        {.id = "2006-even-texels",
         .claim = "With many frustums texels are even: the best has 4 times those of the worst",
         .commands = {kLanternTwo, kPendant},
         .parts = {{"lantern 2: finest over coarsest hundredth", "",
                    [](const Runs& r) { return unevenness(r, 0, "hard+multi"); }, 0.0, 4.5},
                   {"pendant 13:", "", [](const Runs& r) { return unevenness(r, 1, "hard+multi"); }, 0.0, 4.5}},
         .verdict = Verdict::partly,
         .quick = true,
         .why = "Of surfaces that face eye and lamp. Shells are made where they save texels; `multi.most-times` makes "
                "them by this rule, and errs more."},
        {.id = "2006-near-more-texels",
         .claim = "Objects close to the viewer get more texels",
         .commands = {kLanternTwo, kPendant},
         .parts = {{"lantern 2: texels a pixel of the coarsest hundredth,", "times cube's",
                    [](const Runs& r) { return r.ratio("hard+multi", "hard+cube", "/texel_density/p01"); }, 1.2},
                   {"pendant 13:", "times cube's",
                    [](const Runs& r) {
                        return r.of(1, "hard+multi", "/texel_density/p01") / r.of(1, "hard+cube", "/texel_density/p01");
                    },
                    1.2}},
         .verdict = Verdict::holds,
         .quick = true,
         .why = "What is nearest has the fewest texels with a cube, at the same number in all."},
        {.id = "2006-better-than-cubes",
         .claim = "It is better than cube maps",
         .commands = {kLanternTwo, kPendant, kPendantOfDeck},
         .parts =
             {{"lantern 2: rmse", "of cube's",
               [](const Runs& r) { return r.ratio("hard+multi", "hard+cube", "/error/rmse"); }, 0.0, 0.995},
              {"pendant 13:", "of cube's",
               [](const Runs& r) { return r.of(1, "hard+multi", "/error/rmse") / r.of(1, "hard+cube", "/error/rmse"); },
               0.0, 0.995},
              {"pendant 15:", "of cube's",
               [](const Runs& r) { return r.of(2, "hard+multi", "/error/rmse") / r.of(2, "hard+cube", "/error/rmse"); },
               0.0, 0.995}},
         .verdict = Verdict::holds,
         .quick = true,
         .why = "With a million texels each; the table of `multi` has more lamps."},
        {.id = "2006-few-regions",
         .claim = "A duel is solved by 3 or 4 regions at the extreme",
         .commands = {kDuelOnPlanes, kDuelOfReactor},
         .parts = {{"regions that 1 to 4 times the texels make of a floor against a lamp", "",
                    [](const Runs& r) { return regionsOf(r, 0); }, 1.0, 4.0},
                   {"of the ring's reactor", "", [](const Runs& r) { return regionsOf(r, 1); }, 1.0, 4.0},
                   {"with multi.most-times=4, finest over coarsest hundredth of the floor", "",
                    [](const Runs& r) { return unevenness(r, 0, "hard+multi+multi.most-times=4"); }, 0.0, 4.5},
                   {"at the reactor", "",
                    [](const Runs& r) { return unevenness(r, 1, "hard+multi+multi.most-times=4"); }, 0.0, 4.5}},
         .verdict = Verdict::partly,
         .quick = true,
         .why = "Nothing bounds the number of regions here. `multi` bounds its own to four by itself; on the floor it "
                "takes two, since the points by which it judges are guesses on boxes, and part of the floor keeps too "
                "few texels."},
        {.id = "2006-unseen-sides",
         .claim = "Sides that nobody sees are never considered",
         .commands = {kDuelPlan},
         .parts = {{"lamps with a map", "of all that cast", [](const Runs& r) { return lightsWithMaps(r.json(0)); },
                    0.0, 0.5}},
         .verdict = Verdict::holds,
         .quick = true,
         .why = "The others light nothing in sight."},
        {.id = "2006-popping",
         .claim = "Popping is kept down if frustums pan by whole texels and receivers are blended over",
         .commands = {kPopping.begin(), kPopping.end()},
         .parts = {{"folk walk before a camera that stands: the worst frame changes, lantern 2,",
                    "of what it does without", [](const Runs& r) { return popLeft(r, 0); }, 0.0, 0.5},
                   {"reactor 12", "of it", [](const Runs& r) { return popLeft(r, 1); }, 0.0, 0.5},
                   {"a camera goes round, lantern 2", "of it", [](const Runs& r) { return popLeft(r, 2); }, 0.0, 0.5},
                   {"reactor 12", "of it", [](const Runs& r) { return popLeft(r, 3); }, 0.0, 0.5},
                   {"a camera goes by, lantern 2", "of it", [](const Runs& r) { return popLeft(r, 4); }, 0.0, 0.5},
                   {"reactor 12", "of it", [](const Runs& r) { return popLeft(r, 5); }, 0.0, 0.5},
                   {"lantern 0", "of it", [](const Runs& r) { return popLeft(r, 6); }, 0.0, 0.5}},
         .verdict = Verdict::partly,
         .quick = false,
         .why = "Where frustums would change their shells it helps; elsewhere the worst frame is somebody who walks, "
                "or edges of free frustums that change little. Motion `snap` of `multi`; frustums fade into others "
                "over eight frames."},
        {.id = "2006-soft-seams",
         .claim = "Soft shadows help to hide seams between frustums; a blur on the screen is effective",
         .commands =
             {("gnomon render planes --camera side --point -3.5,3,0.3,40 --partition multi --set multi.most-times=2 "
               "--texels 16384 --mask --size 240x135 --filter hard --set cascades.blend=0 -o hard_seams.png"),
              ("gnomon render planes --camera side --point -3.5,3,0.3,40 --partition multi --set multi.most-times=2 "
               "--texels 16384 --mask --size 240x135 --filter hard --set cascades.blend=0.5 -o hard_faded.png"),
              ("gnomon render planes --camera side --point -3.5,3,0.3,40 --partition multi --set multi.most-times=2 "
               "--texels 16384 --mask --size 240x135 --filter hard --soften blur --set soften.edges=plain --set "
               "cascades.blend=0 -o blur_seams.png"),
              ("gnomon render planes --camera side --point -3.5,3,0.3,40 --partition multi --set multi.most-times=2 "
               "--texels 16384 --mask --size 240x135 --filter hard --soften blur --set soften.edges=plain --set "
               "cascades.blend=0.5 -o blur_faded.png"),
              ("gnomon render planes --camera side --point -3.5,3,0.3,40 --partition multi --set multi.most-times=2 "
               "--texels 16384 --mask --size 240x135 --filter raymarch --light-size 0.2 --set cascades.blend=0 -o "
               "soft_seams.png"),
              ("gnomon render planes --camera side --point -3.5,3,0.3,40 --partition multi --set multi.most-times=2 "
               "--texels 16384 --mask --size 240x135 --filter raymarch --light-size 0.2 --set cascades.blend=0.5 -o "
               "soft_faded.png"),
              "gnomon metrics hard_seams.png hard_faded.png --json",
              "gnomon metrics blur_seams.png blur_faded.png --json",
              "gnomon metrics soft_seams.png soft_faded.png --json"},
         .parts = {{"what fading over changes of a mask that is blurred on the screen, rmse,",
                    "of what it changes of a hard one", [](const Runs& r) { return seamsLeft(r, 7, 6, "/error/rmse"); },
                    0.0, 0.5},
                   {"FLIP", "of it", [](const Runs& r) { return seamsLeft(r, 7, 6, "/error/flip"); }, 0.0, 0.5},
                   {"of soft shadows, rmse", "of it", [](const Runs& r) { return seamsLeft(r, 8, 6, "/error/rmse"); },
                    0.0, 0.5}},
         .verdict = Verdict::partly,
         .quick = true,
         .why = "With maps so small that a seam is twelve steps of 8 bits. In numbers a blur of fifteen pixels hides "
                "it. FLIP sees a wide faint step nearly as well as a sharp one, and penumbrae that are sampled have "
                "noise of their own on both sides."},
    };
    return table;
}

} // namespace gnomon::app
