// SPDX-License-Identifier: Apache-2.0
// What T. Forsyth claims of projections and of many frustums a lamp. claims_2006_depth.cpp and claims_2006_ids.cpp
// have the rest.
#include "claim.h"
#include "claim_runs.h"
#include "claims_2006_depth.h"
#include "claims_2006_ids.h"
#include "shared_commands.h"
#include "worked_out.h"

#include <set>
#include <string>

namespace gnomon::app {
namespace {

using Runs = ClaimRuns;

constexpr std::string_view kUnitWarps =
    "gnomon compare rts --preset plain --camera unit --size 320x180 --truth hard --repetitions 1 --warmup 0 --map-size "
    "512 --techniques hard,hard+lispsm,hard+lispsm-simple,hard+tsm,hard+psm";
constexpr std::string_view kLongWarps =
    "gnomon compare sundial --preset plain --camera long --size 320x180 --truth hard --repetitions 1 --warmup 0 "
    "--map-size 512 --techniques hard,hard+lispsm,hard+tsm,hard+psm";
constexpr std::string_view kAgainstTheSun =
    "gnomon compare sundial --preset plain --eye 0,1.7,0 --target 0,3,-20 --sun 0,-0.35,1 --size 320x180 --truth hard "
    "--repetitions 1 --warmup 0 --map-size 512 --techniques hard,hard+lispsm,hard+lispsm-simple,hard+tsm,hard+psm";
constexpr std::string_view kLanternTwo =
    "gnomon compare ring --camera duel --light \"lantern 2\" --light-size 0.02 --size 320x180 --samples 64 "
    "--repetitions 1 --warmup 0 --texels 1048576 --techniques hard+multi,hard+cube";
constexpr std::string_view kPendant =
    "gnomon compare ring --camera bar --light \"pendant 13\" --light-size 0.02 --size 320x180 --samples 64 "
    "--repetitions 1 --warmup 0 --texels 1048576 --techniques hard+multi,hard+cube";
constexpr std::string_view kPendantOfDeck =
    "gnomon compare ring --camera deck --light \"pendant 15\" --light-size 0.02 --size 320x180 --samples 64 "
    "--repetitions 1 --warmup 0 --texels 1048576 --techniques hard+multi,hard+cube";
constexpr std::string_view kDuelPlan = "gnomon plan ring --camera duel --partition multi --json";
/// The rmse of a warp by that of the map without one.
double warpRmse(const Runs& runs, std::string_view warp)
{
    return runs.ratio(warp, "hard", "/error/rmse");
}

/// Of a warp without a bias, a class of errors by that without a warp.
double warpClass(const Runs& runs, std::string_view warp, const char* pointer)
{
    return runs.ratio(warp, "hard+bias=none", pointer);
}

/// Which of the plans' suns have the outcome "fallback".
double fallenBack(const Runs& runs)
{
    double count = 0.0;
    for (std::size_t i = 0; i < runs.count(); ++i) {
        count += runs.json(i).at("lights").at(0).at("outcome") == "fallback" ? 1.0 : 0.0;
    }
    return count;
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

/// Of the light by that name.
Json viewsOf(const Json& plan, std::string_view name)
{
    Json found = Json::array();
    for (const Json& view : plan.at("views")) {
        if (plan.at("lights").at(view.at("light").get<std::size_t>()).at("name") == name) {
            found.push_back(view);
        }
    }
    return found;
}

/// How many ranges of depth they are in.
double shellsOf(const Json& views)
{
    std::set<std::string> shells;
    for (const Json& view : views) {
        shells.insert(view.at("slice").at("begin_m").dump());
    }
    return static_cast<double>(shells.size());
}

/// How uneven texels are on what faces eye and lamp: the finest hundredth by the coarsest.
double unevenness(const Runs& runs, std::size_t run, std::string_view technique)
{
    return runs.of(run, technique, "/texel_density/facing/p99") / runs.of(run, technique, "/texel_density/facing/p01");
}

const std::vector<Claim>& projections2006()
{
    static const std::vector<Claim> table{
        {.id = "2006-warps-help",
         .claim = "Smarter projections (PSM, LiSPSM, TSM) all help with spatial aliasing",
         .commands = {kUnitWarps},
         .parts = {{"rmse of lispsm", "of uniform's", [](const Runs& r) { return warpRmse(r, "hard+lispsm"); }, 0.0,
                    0.85},
                   {"of lispsm-simple", "of it", [](const Runs& r) { return warpRmse(r, "hard+lispsm-simple"); }, 0.0,
                    0.85},
                   {"of tsm", "of it", [](const Runs& r) { return warpRmse(r, "hard+tsm"); }, 0.0, 0.85},
                   {"of psm", "of it", [](const Runs& r) { return warpRmse(r, "hard+psm"); }, 0.0, 0.85}},
         .verdict = Verdict::partly,
         .quick = true,
         .why =
             "From a unit's feet to the horizon, where a map without a warp wastes most. PSM cannot be had there and "
             "falls back (2006-psm-fragile)."},
        {.id = "2006-warps-and-depth",
         .claim = "They help little with depth aliasing, and some make it worse",
         .commands = {kCampOfPoint},
         .parts = {{"acne of lispsm without a bias", "of uniform's",
                    [](const Runs& r) { return warpClass(r, "hard+lispsm+bias=none", "/error/acne"); }, 0.9},
                   {"of lispsm-simple", "of it",
                    [](const Runs& r) { return warpClass(r, "hard+lispsm-simple+bias=none", "/error/acne"); }, 0.9},
                   {"of tsm", "of it", [](const Runs& r) { return warpClass(r, "hard+tsm+bias=none", "/error/acne"); },
                    0.9}},
         .verdict = Verdict::holds,
         .quick = true,
         .why = "A slope that a texel cannot follow shadows itself whatever the texel's size: half of it, without a "
                "bias. Each warp has a little more."},
        {.id = "2006-psm-fragile",
         .claim = "PSM is hard to make robust: lights and casters cross the camera's plane",
         .commands = {"gnomon plan rts --camera camp --partition single --fit psm --filter hard --json",
                      "gnomon plan rts --camera unit --partition single --fit psm --filter hard --json",
                      "gnomon plan rts --camera map --partition single --fit psm --filter hard --json",
                      "gnomon plan sundial --camera meadow --partition single --fit psm --filter hard --json",
                      "gnomon plan sundial --camera long --partition single --fit psm --filter hard --json",
                      "gnomon plan sundial --camera porch --partition single --fit psm --filter hard --json"},
         .parts = {{"of six views it falls back in", "", [](const Runs& r) { return fallenBack(r); }, 1.0}},
         .verdict = Verdict::holds,
         .quick = true,
         .why = "The plan says why: post-perspective space asks for a stronger warp than the map can bear, near what "
                "crosses the eye's plane. Then the map is a uniform one."},
        {.id = "2006-tsm-overdistorts",
         .claim = "TSM over-distorts in many cases: too much detail near the eye",
         .commands = {kUnitWarps, kLongWarps},
         .parts = {{"at unit, texels a pixel of the coarsest hundredth", "of lispsm's",
                    [](const Runs& r) { return r.ratio("hard+tsm", "hard+lispsm", "/texel_density/p01"); }, 0.0, 0.8},
                   {"at long", "of lispsm's",
                    [](const Runs& r) {
                        return r.of(1, "hard+tsm", "/texel_density/p01") / r.of(1, "hard+lispsm", "/texel_density/p01");
                    },
                    0.0, 0.8}},
         .verdict = Verdict::partly,
         .quick = true,
         .why =
             "Where it does, its rmse is higher than lispsm's; on open ground it is as good or better. Our trapezoid "
             "gives the near part 80 % of the map, as published, in one warp."},
        {.id = "2006-duel",
         .claim = "In a duel, the eye looking into the light, all do the same as the standard projection",
         .commands = {kAgainstTheSun},
         .parts = {{"rmse of lispsm", "of uniform's", [](const Runs& r) { return warpRmse(r, "hard+lispsm"); }, 0.95,
                    1.05},
                   {"of lispsm-simple", "of it", [](const Runs& r) { return warpRmse(r, "hard+lispsm-simple"); }, 0.95,
                    1.05},
                   {"of tsm", "of it", [](const Runs& r) { return warpRmse(r, "hard+tsm"); }, 0.95, 1.05},
                   {"of psm", "of it", [](const Runs& r) { return warpRmse(r, "hard+psm"); }, 0.95, 1.05}},
         .verdict = Verdict::holds,
         .quick = true,
         .why = "A warp has no direction left to work along. They err by a few per cent more, because they turn the "
                "grid."},
        {.id = "2006-field-of-view",
         .claim = "A map's field of view ends at 180 degrees, in practice at about 120",
         .parts = {{"at 120 degrees an edge has", "times the texels per degree of the middle",
                    [](const Runs&) { return densityAtEdge(120.0); }, 3.9, 4.1}},
         .verdict = Verdict::holds,
         .quick = true,
         .why = "So 120 degrees are where the talk's own band of 1 to 4 ends. At 150 it is 15 times."},
    };
    return table;
}

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
         .verdict = Verdict::partly,
         .quick = true,
         .why = "With a million texels each. On the last lamp it takes fewer texels than it may have; the table of "
                "`multi` has more lamps."},
        {.id = "2006-few-regions",
         .claim = "A duel takes 3 or 4 regions at the extreme",
         .commands = {kDuelPlan},
         .parts = {{"ranges of depth", "of the lamp that is looked into",
                    [](const Runs& r) { return shellsOf(viewsOf(r.json(0), "lantern 2")); }, 1.0, 4.0},
                   {"frustums", "in them",
                    [](const Runs& r) { return static_cast<double>(viewsOf(r.json(0), "lantern 2").size()); }, 1.0,
                    6.0}},
         .verdict = Verdict::partly,
         .quick = true,
         .why = "Each range is seen in several directions of the lamp, and each of these has a frustum."},
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
         .commands = {"gnomon compare ring --preset plain --partition cube --camera duel --light \"lantern 2\" "
                      "--map-size auto --size 240x135 --truth hard --frames 0-7 --path orbit --techniques "
                      "hard+multi,hard+multi+snap"},
         .parts = {{"the worst frame changes", "of what it does without",
                    [](const Runs& r) { return r.ratio("hard+multi+snap", "hard+multi", "/stability/pop"); }, 0.0,
                    0.5}},
         .verdict = Verdict::holds,
         .quick = false,
         .why = "Motion `snap` of `multi` does so; frustums fade into others over eight frames."},
        {.id = "2006-soft-seams",
         .claim = "Soft shadows help to hide seams between frustums",
         .commands = {"gnomon render planes --camera side --point -3.5,3,0.3,40 --partition multi --filter hard --set "
                      "multi.most-times=2 --set cascades.blend=0 --size 240x135 -o hard_seams.png",
                      "gnomon render planes --camera side --point -3.5,3,0.3,40 --partition multi --filter hard --set "
                      "multi.most-times=2 --set cascades.blend=0.5 --size 240x135 -o hard_faded.png",
                      "gnomon render planes --camera side --point -3.5,3,0.3,40 --partition multi --filter raymarch "
                      "--light-size 0.2 --set multi.most-times=2 --set cascades.blend=0 --size 240x135 -o "
                      "soft_seams.png",
                      "gnomon render planes --camera side --point -3.5,3,0.3,40 --partition multi --filter raymarch "
                      "--light-size 0.2 --set multi.most-times=2 --set cascades.blend=0.5 --size 240x135 -o "
                      "soft_faded.png",
                      "gnomon metrics hard_seams.png hard_faded.png --json",
                      "gnomon metrics soft_seams.png soft_faded.png --json"},
         .parts = {{"what fading changes of a soft picture, rmse,", "of what it changes of a hard one",
                    [](const Runs& r) { return r.number(5, "/error/rmse") / r.number(4, "/error/rmse"); }, 0.0, 0.5}},
         .verdict = Verdict::holds,
         .quick = true,
         .why = "As far as there is something to hide: both are below 0.003."},
    };
    return table;
}

} // namespace

std::span<const Claim> claimsOf2006()
{
    static const std::vector<Claim> table = [] {
        std::vector<Claim> all;
        for (const std::vector<Claim>* part : {&projections2006(), &frustums2006(), &depths2006(), &ids2006()}) {
            all.insert(all.end(), part->begin(), part->end());
        }
        return all;
    }();
    return table;
}

} // namespace gnomon::app
