// SPDX-License-Identifier: Apache-2.0
// What Kite & Lightning claim of variance shadow maps, and of what goes wrong when one writes them.
#include "claim.h"
#include "claim_runs.h"
#include "shared_commands.h"
#include "worked_out.h"

namespace gnomon::app {
namespace {

using Runs = ClaimRuns;

const std::vector<Claim>& table2014()
{
    static const std::vector<Claim> table{
        {.id = "2014-acne",
         .claim = "Most acne comes from one depth a texel; a distribution of depths prevents it",
         .commands = {kCamp},
         .parts = {{"acne of vsm without a bias", "of that of hard",
                    [](const Runs& r) { return r.ratio("vsm+bias=none", "hard+bias=none", "/error/acne"); }, 0.0, 0.1}},
         .verdict = Verdict::holds,
         .quick = true,
         .why = "What a texel's slope spans is in its variance."},
        {.id = "2014-bleeding",
         .claim = "Where occluders overlap variance maps leak light, unavoidably",
         .commands = {kCanopies},
         .parts = {{"bleeding, mean square, of vsm", "", [](const Runs& r) { return r.of("vsm", "/error/bleeding"); },
                    1e-4},
                   {"of pcf", "", [](const Runs& r) { return r.of("pcf", "/error/bleeding"); }, 0.0, 1e-6}},
         .verdict = Verdict::holds,
         .quick = true,
         .why = "Two depths of occluders have a variance that a receiver's bound must allow for."},
        {.id = "2014-fat-shadows",
         .claim = "The usual reduction of light leaking makes shadows fat",
         .commands = {kCanopies},
         .parts = {{"mean error with linstep 0.3", "",
                    [](const Runs& r) { return r.of("vsm+bleeding.linstep=0.3", "/error/bias"); }, -kNoBound, -0.003},
                   {"error at edges", "times that without",
                    [](const Runs& r) { return r.ratio("vsm+bleeding.linstep=0.3", "vsm", "/error/edge"); }, 1.05}},
         .verdict = Verdict::holds,
         .quick = true,
         .why = "Below 0 is too dark: every penumbra loses its dark end, also where nothing leaked."},
        {.id = "2014-z-over-w",
         .claim = "Use linear depth; z / w is horrible",
         .commands = {kStage},
         .parts = {{"rmse of z / w", "times that of linear depth",
                    [](const Runs& r) { return r.ratio("vsm+depth-metric=z-over-w", "vsm", "/error/rmse"); }, 1.2},
                   {"bleeding", "times",
                    [](const Runs& r) { return r.ratio("vsm+depth-metric=z-over-w", "vsm", "/error/bleeding"); }, 2.0}},
         .verdict = Verdict::holds,
         .quick = true,
         .why =
             "z / w crowds all that is far into a small part of the range, where least variances weigh more. That is "
             "the difference which the article saw with 32 bits and could not explain."},
        {.id = "2014-half-range",
         .claim = "Depth that is scaled into 0.5 to 1 by mistake has half the resolution",
         .parts = {{"a step of 16 bits becomes", "times as long", [](const Runs&) { return coarserInUpperHalf(); }, 1.9,
                    2.1},
                   {"one of floats at the far end", "times", [](const Runs&) { return coarserInUpperHalf(0.99); }, 1.9,
                    2.1},
                   {"one of floats at a tenth of the range", "times",
                    [](const Runs&) { return coarserInUpperHalf(0.1); }, 1.9, 2.1}},
         .verdict = Verdict::partly,
         .quick = true,
         .why = "Of fixed point it is half. Floats also lose their fine steps near 0."},
        {.id = "2014-remap",
         .claim = "With floats, depth may be stored in -1 to 1, where the sign is precision too",
         .commands = {kStage},
         .parts = {{"the least deviation that is told shrinks", "times", [](const Runs&) { return finerBySign(); }, 1.9,
                    2.1},
                   {"rmse in half floats", "of that in 0 to 1",
                    [](const Runs& r) {
                        return r.ratio("vsm+map-format=rg16f+depth-remap=1", "vsm+map-format=rg16f", "/error/rmse");
                    },
                    0.0, 0.9}},
         .verdict = Verdict::holds,
         .quick = true,
         .why = "The range is twice as long and floats below 1 step alike."},
        {.id = "2014-front-culling",
         .claim = "Casters drawn with their front faces culled have shrunken shadows",
         .commands = {kClose},
         .parts = {{"mean error towards light", "times that of both faces",
                    [](const Runs& r) {
                        return r.ratio("vsm+bias=none+caster-cull=front", "vsm+bias=none", "/error/bias");
                    },
                    1.5},
                   {"light at contacts", "times that of both",
                    [](const Runs& r) {
                        return r.ratio("vsm+bias=none+caster-cull=front", "vsm+bias=none", "/error/detached");
                    },
                    1.5}},
         .verdict = Verdict::holds,
         .quick = true,
         .why = "Every shadow begins at the far side of its caster, and what is open, as cloth and leaves, loses the "
                "half of it that faces the light."},
        {.id = "2014-esm-better",
         .claim = "Exponential shadow maps are better than variance shadow maps",
         .commands = {kCanopies, kCamp, kStage},
         .parts = {{"rmse on canopies", "of vsm's", [](const Runs& r) { return r.ratio("esm", "vsm", "/error/rmse"); },
                    0.0, 1.0},
                   {"on rts", "of vsm's",
                    [](const Runs& r) { return r.of(1, "esm", "/error/rmse") / r.of(1, "vsm", "/error/rmse"); }, 0.0,
                    1.0},
                   {"on spotlit", "of vsm's",
                    [](const Runs& r) { return r.of(2, "esm", "/error/rmse") / r.of(2, "vsm", "/error/rmse"); }, 0.0,
                    1.0}},
         .verdict = Verdict::partly,
         .quick = true,
         .why = "Where roofs lie over roofs, by far: nothing bleeds. Where things stand on the ground their contacts "
                "are pale."},
        {.id = "2014-esm-faster",
         .claim = "and even faster",
         .commands = {kTimes},
         .parts = {{"a frame takes", "of vsm's time",
                    [](const Runs& r) { return r.ratio("esm", "vsm", "/time_ms/frame"); }, 0.0, 0.95}},
         .verdict = Verdict::fails,
         .quick = false,
         .why = "Its map has one number a texel in place of two, and its blur moves 0.72 of the bytes. Bytes are not "
                "what takes a software rasteriser its time, and its mask takes longer."},
        {.id = "2014-vsm-fast",
         .claim = "Variance maps are fast, because they are filtered before they are read",
         .commands = {kTimes},
         .parts = {{"the mask takes", "of the time of that of pcf 7x7",
                    [](const Runs& r) { return r.ratio("vsm", "pcf+pcf.kernel=7x7", "/time_ms/mask"); }, 0.0, 0.75},
                   {"a frame with its maps", "of that of pcf 7x7",
                    [](const Runs& r) { return r.ratio("vsm", "pcf+pcf.kernel=7x7", "/time_ms/frame"); }, 0.0, 0.75}},
         .verdict = Verdict::partly,
         .quick = false,
         .why = "Reading takes two thirds of the time. The maps are for what moves, as the article's characters do, so "
                "four samples and a blur are made in each frame."},
    };
    return table;
}

} // namespace

std::span<const Claim> claimsOf2014()
{
    return table2014();
}

} // namespace gnomon::app
