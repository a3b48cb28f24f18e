// SPDX-License-Identifier: Apache-2.0
#include "claims_2006_ids.h"

#include "claim_runs.h"

namespace gnomon::app {
namespace {

using Runs = ClaimRuns;

constexpr std::string_view kIdsAtCamp =
    "gnomon compare rts --preset plain --camera camp --size 320x180 --truth hard --repetitions 1 --warmup 0 --map-size "
    "512 --techniques hard,hard+bias=none,id,id+map-format=r8,id+id.test=nearest,depth-id,"
    "depth-id+map-format=rg8";
constexpr std::string_view kIdsAtUnit =
    "gnomon compare rts --preset plain --camera unit --size 320x180 --truth hard --repetitions 1 --warmup 0 "
    "--techniques depth-id,depth-id+map-format=rg8";
constexpr std::string_view kIdsOnStage =
    "gnomon compare spotlit --preset plain --camera stage --size 320x180 --truth hard --repetitions 1 --warmup 0 "
    "--map-size 512 --techniques hard+bias=none,id,depth-id,depth-id+map-format=rg8";
constexpr std::string_view kIdsOnPlanes =
    "gnomon compare planes --preset plain --camera side --size 320x180 --truth hard --repetitions 1 --warmup 0 "
    "--map-size 512 --techniques hard,id";
constexpr std::string_view kSmoothiesAtCamp =
    "gnomon compare rts --preset plain --camera camp --sun-angle 2 --size 320x180 --samples 64 --repetitions 1 "
    "--warmup 0 --map-size 512 --techniques hard,pcf,pcf+smoothies,smoothies";
constexpr std::string_view kSmoothiesClose =
    "gnomon compare spotlit --preset plain --camera close --light-size 0.6 --size 320x180 --samples 64 --repetitions 1 "
    "--warmup 0 --map-size 1024 --techniques hard,pcf,pcf+smoothies,smoothies";

constexpr std::string_view kByteIdsAtCamp =
    "gnomon plan rts --preset plain --camera camp --filter id --map-format r8 --json";
constexpr std::string_view kByteIdsAtMap =
    "gnomon plan rts --preset plain --camera map --filter id --map-format r8 --json";
constexpr std::string_view kIdsOf16AtCamp =
    "gnomon plan rts --preset plain --camera camp --filter id --map-format r16 --json";
constexpr std::string_view kIdsOf16AtMap =
    "gnomon plan rts --preset plain --camera map --filter id --map-format r16 --json";

/// Pairs of casters that overlap in the first light's map and have one id, of all that overlap.
double collidingShare(const Runs& runs, std::size_t run)
{
    return runs.number(run, "/lights/0/ids/collisions") / runs.number(run, "/lights/0/ids/pairs");
}

/// The rmse of 8 bits of depth within an object by that of 16.
double rmseOfEightBits(const Runs& runs, std::size_t run)
{
    return runs.of(run, "depth-id+map-format=rg8", "/error/rmse") / runs.of(run, "depth-id", "/error/rmse");
}

/// Draws of a technique by those of pcf.
double drawsOverPcf(const Runs& runs, std::size_t run, std::string_view technique)
{
    return runs.of(run, technique, "/counters/draws") / runs.of(run, "pcf", "/counters/draws");
}

/// Of the casters that could shadow what is seen, those that are not closed or not whole.
double leftOutShare(const Runs& runs, std::size_t run)
{
    const double left_out = runs.number(run, "/lights/0/left_out");
    return left_out / (left_out + runs.number(run, "/lights/0/volume_count"));
}

} // namespace

const std::vector<Claim>& ids2006()
{
    static const std::vector<Claim> table{
        {.id = "2006-id-no-bias",
         .claim = "Ids need no bias and no epsilon",
         .commands = {kIdsAtCamp, kIdsOnStage},
         .parts = {{"at camp, acne without a bias", "of that of depths without",
                    [](const Runs& r) { return r.ratio("id", "hard+bias=none", "/error/acne"); }, 0.0, 0.05},
                   {"on a stage", "of it",
                    [](const Runs& r) {
                        return r.of(1, "id", "/error/acne") / r.of(1, "hard+bias=none", "/error/acne");
                    },
                    0.0, 0.05}},
         .verdict = Verdict::holds,
         .quick = true,
         .why = "There is nothing to round. What is left at camp is thinner than a texel and has none of its own."},
        {.id = "2006-id-no-self",
         .claim = "Nothing shadows itself",
         .commands = {kIdsOnStage, kIdsAtCamp},
         .parts = {{"acne on a stage", "", [](const Runs& r) { return r.of("id", "/error/acne"); }, 0.0, 1e-6},
                   {"at camp, light at contacts", "times that of hard",
                    [](const Runs& r) { return r.of(1, "id", "/error/detached") / r.of(1, "hard", "/error/detached"); },
                    5.0}},
         .verdict = Verdict::holds,
         .quick = true,
         .why =
             "Right where a surface would shade itself by mistake, wrong where one part of an object shades another."},
        {.id = "2006-id-shrink",
         .claim = "Shadows shrink by a texel, which is not noticed",
         .commands = {kIdsOnPlanes},
         .parts = {{"mean error towards light", "times that of hard",
                    [](const Runs& r) { return r.ratio("id", "hard", "/error/bias"); }, 1.5},
                   {"error at edges", "times hard's",
                    [](const Runs& r) { return r.ratio("id", "hard", "/error/edge"); }, 0.0, 1.25}},
         .verdict = Verdict::partly,
         .quick = true,
         .why = "A box that cannot shade itself, so the edge is all that errs. They shrink, and at 512 texels one sees "
                "it."},
        {.id = "2006-id-256",
         .claim = "256 ids are usually enough: a collision is unlikely",
         .commands = {kByteIdsAtCamp, kByteIdsAtMap},
         .parts = {{"at camp, pairs with one id", "of those that overlap",
                    [](const Runs& r) { return collidingShare(r, 0); }, 0.0, 1.0 / 255.0},
                   {"at map", "of them", [](const Runs& r) { return collidingShare(r, 1); }, 0.0, 1.0 / 255.0}},
         .verdict = Verdict::holds,
         .quick = true,
         .why = "Held against one of 255, which a lot would give. Ours are handed out along the light."},
        {.id = "2006-id-65536",
         .claim = "65536 ids are enough",
         .commands = {kIdsOf16AtCamp, kIdsOf16AtMap},
         .parts = {{"at camp, pairs with one id", "of those that overlap",
                    [](const Runs& r) { return collidingShare(r, 0); }, 0.0, 0.0},
                   {"at map", "of them", [](const Runs& r) { return collidingShare(r, 1); }, 0.0, 0.0}},
         .verdict = Verdict::holds,
         .quick = true,
         .why = "The largest scene here has 5756 objects."},
        {.id = "2006-id-collision",
         .claim = "A collision loses a shadow and never adds one",
         .commands = {kIdsAtCamp},
         .parts = {{"with 255 ids the mean error moves towards light by", "",
                    [](const Runs& r) { return r.of("id+map-format=r8", "/error/bias") - r.of("id", "/error/bias"); },
                    0.0},
                   {"acne grows by", "",
                    [](const Runs& r) { return r.of("id+map-format=r8", "/error/acne") - r.of("id", "/error/acne"); },
                    -1.0, 0.0}},
         .verdict = Verdict::holds,
         .quick = true,
         .why = "What has the occluder's id takes it for itself."},
        {.id = "2006-id-halos",
         .claim = "One sample at an object's edge finds what is behind: dark halos. The nearest four cure them",
         .commands = {kIdsAtCamp},
         .parts = {{"false shadow of one sample", "times that of four",
                    [](const Runs& r) { return r.ratio("id+id.test=nearest", "id", "/error/acne"); }, 2.0},
                   {"mean error of one sample less that of four", "",
                    [](const Runs& r) { return r.of("id+id.test=nearest", "/error/bias") - r.of("id", "/error/bias"); },
                    -1.0, -0.01}},
         .verdict = Verdict::holds,
         .quick = true,
         .why = "Below 0 is darker. All in all one sample errs less here, for its halos make up for shadow that ids "
                "lose."},
        {.id = "2006-own-range-drawn",
         .claim = "An id and 8 bits of depth within the object are barely enough",
         .commands = {kIdsOnStage, kIdsAtCamp, kIdsAtUnit},
         .parts = {{"on a stage, rmse", "of that of 16 bits of depth",
                    [](const Runs& r) { return rmseOfEightBits(r, 0); }, 0.0, 1.1},
                   {"at camp", "of it", [](const Runs& r) { return rmseOfEightBits(r, 1); }, 0.0, 1.1},
                   {"close to a soldier", "of it", [](const Runs& r) { return rmseOfEightBits(r, 2); }, 0.0, 1.1}},
         .verdict = Verdict::holds,
         .quick = true,
         .why = "Acne does not grow with them. An edge moves here and there."},
        {.id = "2006-smoothies",
         .claim = "Smoothies give good results",
         .commands = {kSmoothiesAtCamp, kSmoothiesClose},
         .parts = {{"at camp, rmse of fins along silhouettes", "of that of pcf",
                    [](const Runs& r) { return r.ratio("smoothies", "pcf", "/error/rmse"); }, 0.0, 0.85},
                   {"it is", "of that of hard",
                    [](const Runs& r) { return r.ratio("smoothies", "hard", "/error/rmse"); }, 0.0, 0.85},
                   {"by wide lamps", "of that of pcf",
                    [](const Runs& r) { return r.of(1, "smoothies", "/error/rmse") / r.of(1, "pcf", "/error/rmse"); },
                    0.0, 0.85},
                   {"it is", "of that of hard",
                    [](const Runs& r) { return r.of(1, "smoothies", "/error/rmse") / r.of(1, "hard", "/error/rmse"); },
                    0.0, 0.85}},
         .verdict = Verdict::fails,
         .quick = true,
         .why = "A smoothie lies outside of the hard shadow, and half of a true penumbra inside: all is too dark. They "
                "look soft, and are wrong."},
        {.id = "2006-smoothies-image",
         .claim = "Smoothies need geometric volumes; a variant is entirely image-based",
         .commands = {kSmoothiesAtCamp, kSmoothiesClose},
         .parts = {{"at camp, fins take", "times the draws of pcf",
                    [](const Runs& r) { return drawsOverPcf(r, 0, "smoothies"); }, 1.05},
                   {"edges found in the map", "times those",
                    [](const Runs& r) { return drawsOverPcf(r, 0, "pcf+smoothies"); }, 0.95, 1.05},
                   {"by wide lamps, fins", "times those", [](const Runs& r) { return drawsOverPcf(r, 1, "smoothies"); },
                    1.05},
                   {"edges found in the map", "times those",
                    [](const Runs& r) { return drawsOverPcf(r, 1, "pcf+smoothies"); }, 0.95, 1.05}},
         .verdict = Verdict::holds,
         .quick = true,
         .why =
             "Both are here, and their errors are alike within a tenth. Edges of the map need nothing of a host, and "
             "know what a texture cuts out."},
        {.id = "2006-volumes-watertight",
         .claim = "Shadow volumes need watertight meshes, and cannot cast what a texture cuts out",
         .commands = {"gnomon plan rts --preset plain --camera camp --filter volumes --set volumes.open=skip --json",
                      "gnomon plan sundial --preset plain --filter volumes --set volumes.open=skip --json"},
         .parts = {{"at camp casters left out are", "of all that could shadow what is seen",
                    [](const Runs& r) { return leftOutShare(r, 0); }, 0.25},
                   {"on a meadow with trees", "of them", [](const Runs& r) { return leftOutShare(r, 1); }, 0.25}},
         .verdict = Verdict::holds,
         .quick = true,
         .why = "Terrain, cloth and leaves. Without `volumes.open=skip` they are refused, with the reason."},
    };
    return table;
}

} // namespace gnomon::app
