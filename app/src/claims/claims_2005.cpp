// SPDX-License-Identifier: Apache-2.0
// What A. S. Shastry claims of soft-edged shadows.
#include "claim.h"
#include "claim_runs.h"
#include "shared_commands.h"
#include "worked_out.h"

namespace gnomon::app {
namespace {

using Runs = ClaimRuns;

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
         .parts = {{"rmse of pcf 3x3", "of that of hard",
                    [](const Runs& r) { return r.ratio("pcf", "hard", "/error/rmse"); }, 0.0, 0.85},
                   {"error at edges", "of it", [](const Runs& r) { return r.ratio("pcf", "hard", "/error/edge"); }, 0.0,
                    0.7}},
         .verdict = Verdict::holds,
         .quick = true,
         .why = "Held against a lamp 0.2 m across. Ours weighs the nine by a Gaussian and reads between texels."},
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
    };
    return table;
}

} // namespace

std::span<const Claim> claimsOf2005()
{
    return table2005();
}

} // namespace gnomon::app
