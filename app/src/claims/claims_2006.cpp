// SPDX-License-Identifier: Apache-2.0
// T. Forsyth's claims about projections. claims_2006_frustums.cpp has those about frustums,
// claims_2006_depth.cpp and claims_2006_ids.cpp the rest.
#include "claim.h"
#include "claim_runs.h"
#include "claims_2006_depth.h"
#include "claims_2006_frustums.h"
#include "claims_2006_ids.h"
#include "shared_commands.h"
#include "worked_out.h"

#include <algorithm>
#include <string>

namespace gnomon::app {
namespace {

using Runs = ClaimRuns;

constexpr std::string_view kUnitWarps =
    "gnomon compare rts --preset plain --camera unit --size 320x180 --truth hard --repetitions 1 --warmup 0 --map-size "
    "512 --techniques hard,hard+lispsm,hard+lispsm-simple,hard+tsm";
/// A view and a size of map for which PSM does not fall back.
constexpr std::string_view kPerspectiveWarp =
    "gnomon compare rts --preset plain --camera camp --size 320x180 --truth hard --repetitions 1 --warmup 0 --map-size "
    "2048 --techniques hard,hard+psm";
constexpr std::string_view kLongWarps =
    "gnomon compare sundial --preset plain --camera long --size 320x180 --truth hard --repetitions 1 --warmup 0 "
    "--map-size 512 --techniques hard+lispsm,hard+tsm";
constexpr std::string_view kAgainstTheSun =
    "gnomon compare sundial --preset plain --eye 0,1.7,0 --target 0,3,-20 --sun 0,-0.35,1 --size 320x180 --truth hard "
    "--repetitions 1 --warmup 0 --map-size 512 --techniques hard,hard+lispsm,hard+lispsm-simple,hard+tsm";
/// The rmse of a warp by that of the map without one.
double warpRmse(const Runs& runs, std::string_view warp)
{
    return runs.ratio(warp, "hard", "/error/rmse");
}

/// The acne of a warp by that of the map without one, each with the same constant bias.
double warpAcne(const Runs& runs, std::string_view warp)
{
    return runs.ratio(std::string(warp) + "+bias=none+bias.constant=0.3", "hard+bias=none+bias.constant=0.3",
                      "/error/acne");
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

const std::vector<Claim>& projections2006()
{
    static const std::vector<Claim> table{
        {.id = "2006-warps-help",
         .claim = "Smarter projections (PSM, LiSPSM, TSM) all help with spatial aliasing",
         .commands = {kUnitWarps, kPerspectiveWarp},
         .parts = {{"rmse of lispsm", "of uniform's", [](const Runs& r) { return warpRmse(r, "hard+lispsm"); }, 0.0,
                    0.85},
                   {"of lispsm-simple", "of it", [](const Runs& r) { return warpRmse(r, "hard+lispsm-simple"); }, 0.0,
                    0.85},
                   {"of tsm", "of it", [](const Runs& r) { return warpRmse(r, "hard+tsm"); }, 0.0, 0.85},
                   {"of psm at camp, with 2048 texels,", "of it",
                    [](const Runs& r) { return r.of(1, "hard+psm", "/error/rmse") / r.of(1, "hard", "/error/rmse"); },
                    0.0, 0.85}},
         .verdict = Verdict::partly,
         .quick = true,
         .why = "From a unit's feet to the horizon, where a map without a warp wastes most. PSM falls back there "
                "(2006-psm-fragile). It does not at camp with a large map, and errs more."},
        {.id = "2006-warps-and-depth",
         .claim = "They help little with depth aliasing, and some make it worse",
         .commands = {kCampOfPoint},
         .parts = {{"with a bias of 0.3 m acne of lispsm", "of uniform's",
                    [](const Runs& r) { return warpAcne(r, "hard+lispsm"); }, 0.9},
                   {"of lispsm-simple", "of it", [](const Runs& r) { return warpAcne(r, "hard+lispsm-simple"); }, 0.9},
                   {"of tsm", "of it", [](const Runs& r) { return warpAcne(r, "hard+tsm"); }, 0.9},
                   {"the most acne of a warp", "of it",
                    [](const Runs& r) {
                        return std::max(
                            {warpAcne(r, "hard+lispsm"), warpAcne(r, "hard+lispsm-simple"), warpAcne(r, "hard+tsm")});
                    },
                    1.0}},
         .verdict = Verdict::fails,
         .quick = true,
         .why = "Near things have smaller texels with a warp, and a smaller texel needs less bias. Without any bias a "
                "slope shadows itself whatever the texel's size."},
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
                   {"of tsm", "of it", [](const Runs& r) { return warpRmse(r, "hard+tsm"); }, 0.95, 1.05}},
         .verdict = Verdict::holds,
         .quick = true,
         .why = "A warp has no direction left to work along. They err by a few per cent more, because they turn the "
                "grid. PSM cannot be drawn there and falls back to the standard projection."},
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
