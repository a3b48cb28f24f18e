// SPDX-License-Identifier: Apache-2.0
#include "claims_2006_depth.h"

#include "claim_runs.h"
#include "shared_commands.h"
#include "worked_out.h"

#include <algorithm>

namespace gnomon::app {
namespace {

using Runs = ClaimRuns;

constexpr std::string_view kConstantsAtCamp =
    "gnomon compare rts --preset plain --camera camp --size 320x180 --truth hard --map-size 512 --techniques "
    "hard+bias=none --sweep bias.constant=0.1:10:5:log";
constexpr std::string_view kConstantsAtMap =
    "gnomon compare rts --preset plain --camera map --size 320x180 --truth hard --map-size 512 --techniques "
    "hard+bias=none --sweep bias.constant=0.1:10:5:log";
constexpr std::string_view kSoftCamp =
    "gnomon compare rts --preset plain --camera camp --sun-angle 2 --size 320x180 --samples 64 --repetitions 1 "
    "--warmup 0 --map-size 512 --techniques pcf,pcf+pcf.kernel=7x7,pcf+pcf.kernel=vogel,"
    "pcf+pcf.kernel=vogel+pcf.taps=64,pcss";
constexpr std::string_view kSoftClose =
    "gnomon compare spotlit --preset plain --camera close --light-size 0.6 --size 320x180 --samples 64 --repetitions 1 "
    "--warmup 0 --map-size 1024 --techniques pcf+pcf.kernel=7x7,pcss";
/// Which faces a map holds.
constexpr std::string_view kFacesAtCamp =
    "gnomon compare rts --preset plain --camera camp --size 640x360 --truth hard --repetitions 1 --warmup 0 --map-size "
    "512 --techniques hard+bias=none,hard+bias=none+caster-cull=front";

/// Of a sweep's only technique.
std::vector<double> rmseOverSweep(const Json& sweep)
{
    return sweep.at("sweep").at("results").at(0).at("rmse").get<std::vector<double>>();
}

double leastOverSweep(const Json& sweep)
{
    const std::vector<double> rmse = rmseOverSweep(sweep);
    return *std::min_element(rmse.begin(), rmse.end());
}

/// Light at contacts under a wide kernel, by that under one as wide as the distance asks.
double detachedByKernel(const Runs& runs, std::size_t run)
{
    return runs.of(run, "pcf+pcf.kernel=7x7", "/error/detached") / runs.of(run, "pcss", "/error/detached");
}

/// The value of the setting at which the rmse is least.
double bestOfSweep(const Json& sweep)
{
    const std::vector<double> rmse = rmseOverSweep(sweep);
    const auto best = std::min_element(rmse.begin(), rmse.end()) - rmse.begin();
    return sweep.at("sweep").at("values").at(static_cast<std::size_t>(best)).get<double>();
}

} // namespace

const std::vector<Claim>& depths2006()
{
    static const std::vector<Claim> table{
        {.id = "2006-bias-high",
         .claim = "Too much bias, and shadows detach from feet",
         .commands = {kCampOfPoint},
         .parts = {{"light at contacts with a constant 3 m", "times that of auto",
                    [](const Runs& r) { return r.ratio("hard+bias=none+bias.constant=3", "hard", "/error/detached"); },
                    5.0}},
         .verdict = Verdict::holds,
         .quick = true,
         .why = "Peter-panning. Of acne little is left then."},
        {.id = "2006-bias-low",
         .claim = "Too little, and surfaces shadow themselves",
         .commands = {kCampOfPoint},
         .parts = {{"acne without a bias", "times that of auto",
                    [](const Runs& r) { return r.ratio("hard+bias=none", "hard", "/error/acne"); }, 10.0},
                   {"with a constant 0.3 m", "times",
                    [](const Runs& r) { return r.ratio("hard+bias=none+bias.constant=0.3", "hard", "/error/acne"); },
                    3.0}},
         .verdict = Verdict::holds,
         .quick = true,
         .why = "A texel of half a metre on a slope spans more than that."},
        {.id = "2006-no-one-bias",
         .claim = "No one bias works for an entire scene",
         .commands = {kConstantsAtCamp, kConstantsAtMap, kCampOfPoint},
         .parts = {{"the best constant from 0.1 to 10 m errs", "times as much as auto at camp",
                    [](const Runs& r) { return leastOverSweep(r.json(0)) / r.of(2, "hard", "/error/rmse"); }, 1.02},
                   {"the best constant at map is", "times that at camp",
                    [](const Runs& r) { return bestOfSweep(r.json(1)) / bestOfSweep(r.json(0)); }, 1.5}},
         .verdict = Verdict::holds,
         .quick = true,
         .why = "A constant that is right on one slope is wrong on the next. `auto` takes each receiver's own."},
        {.id = "2006-24-bits",
         .claim = "24 bits of depth are still not enough",
         .commands = {kCampOfPoint},
         .parts = {{"a step of 24 bits of z / w, 1000 m from a near plane at 0.1 m,", "m",
                    [](const Runs&) { return stepOfBitsInZOverW(24); }, 0.01},
                   {"of linear depth", "m", [](const Runs&) { return stepOfBits(24); }, 0.01},
                   {"acne without a bias of 32 bits", "of that of 16",
                    [](const Runs& r) {
                        return r.ratio("hard+bias=none", "hard+bias=none+map-format=d16", "/error/acne");
                    },
                    0.9}},
         .verdict = Verdict::partly,
         .quick = true,
         .why = "Of z / w they are not. Of linear depth they are plenty, and no number of bits replaces a bias: acne "
                "is the slope within a texel."},
        {.id = "2006-back-faces",
         .claim = "To render back faces instead of nearest ones gives terrible peter-panning",
         .commands = {kFacesAtCamp},
         .parts = {{"front faces culled, light at contacts", "times that of both faces",
                    [](const Runs& r) {
                        return r.ratio("hard+bias=none+caster-cull=front", "hard+bias=none", "/error/detached");
                    },
                    5.0}},
         .verdict = Verdict::holds,
         .quick = true,
         .why = "Neither has a bias. With `--camera unit`, at a unit's feet, it is 4 times, with `--camera map` 57 "
                "times. Culling front faces leaves a tenth of the acne, and far less light at contacts than a bias "
                "that is too high (2006-bias-high)."},
        {.id = "2006-midpoint",
         .claim = "Midpoint rendering is expensive",
         .commands = {kTimes},
         .parts = {{"the maps take", "times as long",
                    [](const Runs& r) { return r.ratio("hard+caster-faces=midpoint", "hard", "/time_ms/maps"); }, 1.3},
                   {"memory", "times as much",
                    [](const Runs& r) { return r.ratio("hard+caster-faces=midpoint", "hard", "/memory_bytes"); }, 1.3}},
         .verdict = Verdict::holds,
         .quick = false,
         .why = "Casters are drawn twice, into two more images of depth."},
        {.id = "2006-midpoint-tricky",
         .claim = "and tricky: it does not do away with bias",
         .commands = {kClose},
         .parts = {{"acne of the midpoint without a bias", "of that of nearest faces",
                    [](const Runs& r) {
                        return r.ratio("hard+bias=none+caster-faces=midpoint", "hard+bias=none", "/error/acne");
                    },
                    0.3}},
         .verdict = Verdict::holds,
         .quick = true,
         .why = "What is a single surface has no second one to be midway to."},
        {.id = "2006-own-range",
         .claim = "Depth within one object: 8 bits over 2 m are about 1 cm, barely enough",
         .parts = {{"a step is", "cm", [](const Runs&) { return 100.0 * 2.0 / 255.0; }, 0.5, 1.5}},
         .verdict = Verdict::holds,
         .quick = true,
         .why = "2 m over 255."},
        {.id = "2006-pcf-blurs-contacts",
         .claim = "PCF does not depend on distance: blurry feet look wrong",
         .commands = {kSoftClose, kSoftCamp},
         .parts = {{"under a wide lamp, light at contacts with 7x7", "times that of pcss",
                    [](const Runs& r) { return detachedByKernel(r, 0); }, 2.0},
                   {"under a sun of 2 degrees", "times it", [](const Runs& r) { return detachedByKernel(r, 1); }, 2.0}},
         .verdict = Verdict::holds,
         .quick = true,
         .why = "`pcss` is a kernel whose width goes by the distance. Penumbrae are none at a foot and grow from "
                "there."},
        {.id = "2006-more-taps",
         .claim = "More taps are expensive and bring little extra quality",
         .commands = {kSoftCamp, kTimesOfTaps},
         .parts = {{"rmse of 64 taps", "of that of 16 in a disc as wide",
                    [](const Runs& r) {
                        return r.ratio("pcf+pcf.kernel=vogel+pcf.taps=64", "pcf+pcf.kernel=vogel", "/error/rmse");
                    },
                    0.95},
                   {"of 7x7", "of that of 3x3",
                    [](const Runs& r) { return r.ratio("pcf+pcf.kernel=7x7", "pcf", "/error/rmse"); }, 0.95},
                   {"its mask takes", "times as long",
                    [](const Runs& r) {
                        return r.of(1, "pcf+pcf.kernel=7x7", "/time_ms/mask") / r.of(1, "pcf", "/time_ms/mask");
                    },
                    1.3}},
         .verdict = Verdict::holds,
         .quick = false,
         .why = "Under a sun of 2 degrees. A wider kernel errs more even there, where texels are larger than pixels."},
        {.id = "2006-noise",
         .claim = "PCF looks bad; one can get away with it on noisy surfaces",
         .commands =
             {("gnomon render rts --preset plain --camera camp --sun-angle 2 --truth area --samples 64 --size "
               "320x180 -o camp_noisy_truth.png"),
              ("gnomon render rts --preset plain --camera camp --filter pcf --map-size 512 --size 320x180 -o "
               "camp_noisy.png"),
              ("gnomon render rts --preset plain --camera camp --sun-angle 2 --override-material diffuse "
               "--truth area --samples 64 --size 320x180 -o camp_smooth_truth.png"),
              ("gnomon render rts --preset plain --camera camp --override-material diffuse --filter pcf "
               "--map-size 512 --size 320x180 -o camp_smooth.png"),
              "gnomon metrics camp_noisy.png camp_noisy_truth.png --json",
              "gnomon metrics camp_smooth.png camp_smooth_truth.png --json",
              ("gnomon render planes --preset plain --camera side --sun-angle 2 --truth area --samples 64 "
               "--size 320x180 -o box_noisy_truth.png"),
              ("gnomon render planes --preset plain --camera side --filter pcf --map-size 256 --size 320x180 -o "
               "box_noisy.png"),
              ("gnomon render planes --preset plain --camera side --sun-angle 2 --override-material diffuse "
               "--truth area --samples 64 --size 320x180 -o box_smooth_truth.png"),
              ("gnomon render planes --preset plain --camera side --override-material diffuse --filter pcf "
               "--map-size 256 --size 320x180 -o box_smooth.png"),
              "gnomon metrics box_noisy.png box_noisy_truth.png --json",
              "gnomon metrics box_smooth.png box_smooth_truth.png --json"},
         .parts = {{"FLIP to the truth on tiles", "of that on one smooth material",
                    [](const Runs& r) { return r.number(10, "/error/flip") / r.number(11, "/error/flip"); }, 0.0, 0.85},
                   {"on the ground of a camp", "of it",
                    [](const Runs& r) { return r.number(4, "/error/flip") / r.number(5, "/error/flip"); }, 0.0, 0.85}},
         .verdict = Verdict::partly,
         .quick = true,
         .why = "Under a sun of 2 degrees. Where a pattern is as strong as a shadow is dark, some of the error is lost "
                "in it; on grass and earth nothing is."},
    };
    return table;
}

} // namespace gnomon::app
