// SPDX-License-Identifier: Apache-2.0
#include "claims_2006_frustums.h"

#include "claim_runs.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cmath>
#include <limits>

namespace gnomon::app {
namespace {

using Runs = ClaimRuns;

/// The talk's own algorithm, as a technique.
constexpr std::string_view kTalks = "hard+multi+multi.divide=receivers+multi.most-times=4";
constexpr std::string_view kLanternTwo =
    "gnomon compare ring --camera duel --light \"lantern 2\" --light-size 0.02 --size 320x180 --samples 64 "
    "--repetitions 1 --warmup 0 --texels 1048576 --techniques "
    "hard+multi+multi.divide=receivers+multi.most-times=4,hard+cube";
constexpr std::string_view kPendant =
    "gnomon compare ring --camera bar --light \"pendant 13\" --light-size 0.02 --size 320x180 --samples 64 "
    "--repetitions 1 --warmup 0 --texels 1048576 --techniques "
    "hard+multi+multi.divide=receivers+multi.most-times=4,hard+cube";
constexpr std::string_view kPendantOfDeck =
    "gnomon compare ring --camera deck --light \"pendant 15\" --light-size 0.02 --size 320x180 --samples 64 "
    "--repetitions 1 --warmup 0 --texels 1048576 --techniques "
    "hard+multi+multi.divide=receivers+multi.most-times=4,hard+cube";
/// Eyes that look into a lamp behind what stands there: before an army, and on a meadow. How even texels are there.
constexpr glm::dvec3 kEyeBeforeArmy{27.2, 10.1, 19.2};
constexpr glm::dvec3 kEyeOnMeadow{0.0, 1.7, 20.0};
constexpr std::string_view kDuelBeforeArmy =
    "gnomon plan rts --preset plain --eye 27.2,10.1,19.2 --target 24.3,10.5,-6 --point 24.3,11,-6,60 --filter hard "
    "--partition multi --set multi.divide=receivers --set multi.most-times=4 --map-size auto --texels 1048576 --size "
    "240x135 --json";
constexpr std::string_view kDuelOnMeadow =
    "gnomon plan sundial --preset plain --eye 0,1.7,20 --target 0,1.2,-20 --point 0,3,-20,60 --filter hard --partition "
    "multi --set multi.divide=receivers --set multi.most-times=4 --map-size auto --texels 1048576 --size 240x135 "
    "--json";
constexpr std::string_view kTexelsBeforeArmy =
    "gnomon compare rts --preset plain --partition cube --map-size auto --eye 27.2,10.1,19.2 --target 24.3,10.5,-6 "
    "--point 24.3,11,-6,60 --size 240x135 --truth hard --repetitions 1 --warmup 0 --texels 1048576 --techniques "
    "hard+multi+multi.divide=receivers+multi.most-times=4";
constexpr std::string_view kTexelsOnMeadow =
    "gnomon compare sundial --preset plain --partition cube --map-size auto --eye 0,1.7,20 --target 0,1.2,-20 --point "
    "0,3,-20,60 --size 240x135 --truth hard --repetitions 1 --warmup 0 --texels 1048576 --techniques "
    "hard+multi+multi.divide=receivers+multi.most-times=4";
/// The first two cameras all but stand.
constexpr std::array<std::string_view, 4> kPopping{
    "gnomon compare ring --preset plain --partition cube --camera duel --light \"lantern 2\" --map-size auto --size "
    "192x108 --truth hard --frames 0-23 --path pan --set path.speed=0.001 --techniques "
    "hard+multi+multi.divide=receivers,hard+multi+multi.divide=receivers+snap",
    "gnomon compare ring --preset plain --partition cube --camera duel --light \"reactor 12\" --map-size auto --size "
    "192x108 --truth hard --frames 0-23 --path pan --set path.speed=0.001 --techniques "
    "hard+multi+multi.divide=receivers,hard+multi+multi.divide=receivers+snap",
    "gnomon compare ring --preset plain --partition cube --camera duel --light \"lantern 2\" --map-size auto --size "
    "192x108 --truth hard --frames 0-23 --path orbit --techniques "
    "hard+multi+multi.divide=receivers,hard+multi+multi.divide=receivers+snap",
    "gnomon compare ring --preset plain --partition cube --camera deck --light \"lantern 0\" --map-size auto --size "
    "192x108 --truth hard --frames 0-23 --path pan --techniques "
    "hard+multi+multi.divide=receivers,hard+multi+multi.divide=receivers+snap"};
constexpr std::string_view kUnderTheSky =
    "gnomon plan planes --preset plain --camera side --point 0,3,0,40 --filter hard --partition multi --json";
constexpr std::string_view kBesideTheViewer =
    "gnomon plan planes --preset plain --camera side --point 7.5,5,9.5,40 --filter hard --partition multi --json";

/// The pop in the worst frame of a path: held frustums' by free ones'.
double popLeft(const Runs& runs, std::size_t run)
{
    return runs.of(run, "hard+multi+multi.divide=receivers+snap", "/stability/pop") /
           runs.of(run, "hard+multi+multi.divide=receivers", "/stability/pop");
}

/// How uneven texels are on what faces eye and lamp: the finest hundredth by the coarsest.
double unevenness(const Runs& runs, std::size_t run)
{
    return runs.of(run, kTalks, "/texel_density/facing/p99") / runs.of(run, kTalks, "/texel_density/facing/p01");
}

/// How many frustums of the plan's only lamp look towards the eye, give or take 45 degrees: into how many the side of a
/// cube map that looks there is divided.
double regionsTowards(const Json& plan, const glm::dvec3& eye_ws)
{
    const auto place = plan.at("lights").at(0).at("position_ws").get<std::array<double, 3>>();
    const glm::dvec3 to_eye = glm::normalize(eye_ws - glm::dvec3(place[0], place[1], place[2]));
    double count = 0.0;
    for (const Json& view : plan.at("views")) {
        const auto w = view.at("clip_from_world_rows").at(3).get<std::array<double, 4>>();
        count += glm::dot(glm::normalize(glm::dvec3(w[0], w[1], w[2])), to_eye) >= std::sqrt(0.5) ? 1.0 : 0.0;
    }
    return count;
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
         .parts = {{"lantern 2: finest over coarsest hundredth", "", [](const Runs& r) { return unevenness(r, 0); },
                    0.0, 4.5},
                   {"pendant 13:", "", [](const Runs& r) { return unevenness(r, 1); }, 0.0, 4.5}},
         .verdict = Verdict::fails,
         .quick = true,
         .why =
             "On surfaces that face eye and lamp, with `multi.divide=receivers`. Sides of maps are rounded up, and a "
             "pixel takes the finest frustum that holds it."},
        {.id = "2006-near-more-texels",
         .claim = "Objects close to the viewer get more texels",
         .commands = {kLanternTwo, kPendant},
         .parts = {{"lantern 2: texels a pixel of the coarsest hundredth,", "times cube's",
                    [](const Runs& r) { return r.ratio(kTalks, "hard+cube", "/texel_density/p01"); }, 1.2},
                   {"pendant 13:", "times cube's",
                    [](const Runs& r) {
                        return r.of(1, kTalks, "/texel_density/p01") / r.of(1, "hard+cube", "/texel_density/p01");
                    },
                    1.2}},
         .verdict = Verdict::holds,
         .quick = true,
         .why = "What is nearest has the fewest texels with a cube, at the same number in all."},
        {.id = "2006-better-than-cubes",
         .claim = "It is better than cube maps",
         .commands = {kLanternTwo, kPendant, kPendantOfDeck},
         .parts = {{"lantern 2: rmse", "of cube's",
                    [](const Runs& r) { return r.ratio(kTalks, "hard+cube", "/error/rmse"); }, 0.0, 0.995},
                   {"pendant 13:", "of cube's",
                    [](const Runs& r) { return r.of(1, kTalks, "/error/rmse") / r.of(1, "hard+cube", "/error/rmse"); },
                    0.0, 0.995},
                   {"pendant 15:", "of cube's",
                    [](const Runs& r) { return r.of(2, kTalks, "/error/rmse") / r.of(2, "hard+cube", "/error/rmse"); },
                    0.0, 0.995}},
         .verdict = Verdict::partly,
         .quick = true,
         .why = "With a million texels each, by `multi.divide=receivers`. Each frustum has room to spare around its "
                "receivers. The table of `multi` has more lamps, and our own division."},
        {.id = "2006-few-regions",
         .claim = "A duel is solved by 3 or 4 regions at the extreme",
         .commands = {kDuelBeforeArmy, kDuelOnMeadow, kTexelsBeforeArmy, kTexelsOnMeadow},
         .parts = {{"frustums towards an eye that looks into a lamp behind an army", "",
                    [](const Runs& r) { return regionsTowards(r.json(0), kEyeBeforeArmy); }, 1.0, 4.0},
                   {"on a meadow", "", [](const Runs& r) { return regionsTowards(r.json(1), kEyeOnMeadow); }, 1.0, 4.0},
                   {"finest over coarsest hundredth before the army", "",
                    [](const Runs& r) { return unevenness(r, 2); }, 0.0, 4.5},
                   {"on a meadow", "", [](const Runs& r) { return unevenness(r, 3); }, 0.0, 4.5}},
         .verdict = Verdict::partly,
         .quick = true,
         .why = "By `multi.divide=receivers`, counted on the side of a cube that looks towards the eye. A pixel takes "
                "the finest frustum that holds it, which may be another receiver's, and sides of maps are rounded up."},
        {.id = "2006-unseen-sides",
         .claim = "Sides that nobody sees are never considered",
         .commands = {kUnderTheSky, kBesideTheViewer},
         .parts = {{"a lamp with nothing above it but the sky has", "sides of six",
                    [](const Runs& r) { return r.number(0, "/lights/0/view_count"); }, 1.0, 5.0},
                   {"one beside the viewer", "of six",
                    [](const Runs& r) { return r.number(1, "/lights/0/view_count"); }, 1.0, 3.0}},
         .verdict = Verdict::holds,
         .quick = true,
         .why = "Lamps that light nothing in sight have none."},
        {.id = "2006-popping",
         .claim = "Popping is kept down if frustums pan by whole texels and receivers are blended over",
         .commands = {kPopping.begin(), kPopping.end()},
         .parts = {{"folk walk before a camera that stands: the worst frame changes, lantern 2,",
                    "of what it does without", [](const Runs& r) { return popLeft(r, 0); }, 0.0, 0.5},
                   {"reactor 12", "of it", [](const Runs& r) { return popLeft(r, 1); }, 0.0, 0.5},
                   {"a camera goes round, lantern 2", "of it", [](const Runs& r) { return popLeft(r, 2); }, 0.0, 0.5},
                   {"a camera goes by, lantern 0", "of it", [](const Runs& r) { return popLeft(r, 3); }, 0.0, 0.5}},
         .verdict = Verdict::holds,
         .quick = false,
         .why = "`multi.divide=receivers` with motion `snap`; frustums fade into others over eight frames."},
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
               "--texels 16384 --mask --size 240x135 --filter smoothies --light-size 0.2 --set cascades.blend=0 -o "
               "soft_seams.png"),
              ("gnomon render planes --camera side --point -3.5,3,0.3,40 --partition multi --set multi.most-times=2 "
               "--texels 16384 --mask --size 240x135 --filter smoothies --light-size 0.2 --set cascades.blend=0.5 -o "
               "soft_faded.png"),
              "gnomon metrics hard_seams.png hard_faded.png --json",
              "gnomon metrics blur_seams.png blur_faded.png --json",
              "gnomon metrics soft_seams.png soft_faded.png --json"},
         .parts = {{"what fading over changes of a mask that is blurred on the screen, rmse,",
                    "of what it changes of a hard one", [](const Runs& r) { return seamsLeft(r, 7, 6, "/error/rmse"); },
                    0.0, 0.5},
                   {"FLIP", "of it", [](const Runs& r) { return seamsLeft(r, 7, 6, "/error/flip"); }, 0.0, 0.5},
                   {"of smoothies, rmse", "of it", [](const Runs& r) { return seamsLeft(r, 8, 6, "/error/rmse"); }, 0.0,
                    0.5},
                   {"FLIP", "of it", [](const Runs& r) { return seamsLeft(r, 8, 6, "/error/flip"); }, 0.0, 0.5}},
         .verdict = Verdict::partly,
         .quick = true,
         .why = "With maps so small that a seam is twelve steps of 8 bits. In numbers soft edges hide it. FLIP sees a "
                "wide faint step as well as a sharp one, or better."},
    };
    return table;
}

} // namespace gnomon::app
