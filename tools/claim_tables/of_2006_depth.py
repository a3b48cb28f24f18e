# SPDX-License-Identifier: Apache-2.0
"""T. Forsyth's claims about depth and ids."""

from claim_tables import CAMP_OF_POINT, CLOSE, FAILS, HOLDS, PARTLY, TIMES, TIMES_OF_TAPS, Claim, Part

CONSTANTS_AT_CAMP = ("gnomon compare rts --preset plain --camera camp --size 320x180 --truth hard --map-size 512 --techniques "
                     "hard+bias=none --sweep bias.constant=0.1:10:5:log")
CONSTANTS_AT_MAP = ("gnomon compare rts --preset plain --camera map --size 320x180 --truth hard --map-size 512 --techniques "
                    "hard+bias=none --sweep bias.constant=0.1:10:5:log")
SOFT_CAMP = ("gnomon compare rts --preset plain --camera camp --sun-angle 2 --size 320x180 --samples 64 --repetitions 1 --warmup 0 "
             "--map-size 512 --techniques pcf,pcf+pcf.kernel=7x7,pcf+pcf.kernel=vogel,pcf+pcf.kernel=vogel+pcf.taps=64,pcss")
SOFT_CLOSE = ("gnomon compare spotlit --preset plain --camera close --light-size 0.6 --size 320x180 --samples 64 --repetitions 1 "
              "--warmup 0 --map-size 1024 --techniques pcf+pcf.kernel=7x7,pcss")
# Which faces a map holds.
FACES_AT_CAMP = ("gnomon compare rts --preset plain --camera camp --size 640x360 --truth hard --repetitions 1 --warmup 0 --map-size 512 "
                 "--techniques hard+bias=none,hard+bias=none+caster-cull=front")
IDS_AT_CAMP = ("gnomon compare rts --preset plain --camera camp --size 320x180 --truth hard --repetitions 1 --warmup 0 --map-size 512 "
               "--techniques hard,hard+bias=none,id,id+map-format=r8,id+id.test=nearest,depth-id,depth-id+map-format=rg8")
IDS_AT_UNIT = ("gnomon compare rts --preset plain --camera unit --size 320x180 --truth hard --repetitions 1 --warmup 0 --techniques "
               "depth-id,depth-id+map-format=rg8")
IDS_ON_STAGE = ("gnomon compare spotlit --preset plain --camera stage --size 320x180 --truth hard --repetitions 1 --warmup 0 --map-size "
                "512 --techniques hard+bias=none,id,depth-id,depth-id+map-format=rg8")
IDS_ON_PLANES = ("gnomon compare planes --preset plain --camera side --size 320x180 --truth hard --repetitions 1 --warmup 0 --map-size "
                 "512 --techniques hard,id")
SMOOTHIES_AT_CAMP = ("gnomon compare rts --preset plain --camera camp --sun-angle 2 --size 320x180 --samples 64 --repetitions 1 --warmup "
                     "0 --map-size 512 --techniques hard,pcf,pcf+smoothies,smoothies")
SMOOTHIES_CLOSE = ("gnomon compare spotlit --preset plain --camera close --light-size 0.6 --size 320x180 --samples 64 --repetitions 1 "
                   "--warmup 0 --map-size 1024 --techniques hard,pcf,pcf+smoothies,smoothies")
BYTE_IDS_AT_CAMP = "gnomon plan rts --preset plain --camera camp --filter id --map-format r8 --json"
BYTE_IDS_AT_MAP = "gnomon plan rts --preset plain --camera map --filter id --map-format r8 --json"
IDS_OF_16_AT_CAMP = "gnomon plan rts --preset plain --camera camp --filter id --map-format r16 --json"
IDS_OF_16_AT_MAP = "gnomon plan rts --preset plain --camera map --filter id --map-format r16 --json"


def rmse_over_sweep(sweep):
    """Of a sweep's only technique."""
    return sweep["sweep"]["results"][0]["rmse"]


def best_of_sweep(sweep):
    """The value of the setting at which the rmse is least."""
    rmse = rmse_over_sweep(sweep)
    return sweep["sweep"]["values"][rmse.index(min(rmse))]


def colliding_share(runs, run):
    """Pairs of casters that overlap in the first light's map and have one id, of all that overlap."""
    return runs.number("/lights/0/ids/collisions", run) / runs.number("/lights/0/ids/pairs", run)


def left_out_share(runs, run):
    """Of the casters that could shadow what is seen, those that are not closed or not whole."""
    left_out = runs.number("/lights/0/left_out", run)
    return left_out / (left_out + runs.number("/lights/0/volume_count", run))


CLAIMS = [
    Claim("2006-bias-high", HOLDS,
          "Too much bias, and shadows detach from feet",
          commands=[CAMP_OF_POINT],
          parts=[Part("light at contacts with a constant 3 m", "times that of auto",
                      lambda r: r.ratio("hard+bias=none+bias.constant=3", "hard", "/error/detached"), least=5)],
          why="Peter-panning. Of acne little is left then."),
    Claim("2006-bias-low", HOLDS,
          "Too little, and surfaces shadow themselves",
          commands=[CAMP_OF_POINT],
          parts=[Part("acne without a bias", "times that of auto", lambda r: r.ratio("hard+bias=none", "hard", "/error/acne"), least=10),
                 Part("with a constant 0.3 m", "times",
                      lambda r: r.ratio("hard+bias=none+bias.constant=0.3", "hard", "/error/acne"), least=3)],
          why="A texel of half a metre on a slope spans more than that."),
    Claim("2006-no-one-bias", HOLDS,
          "No one bias works for an entire scene",
          commands=[CONSTANTS_AT_CAMP, CONSTANTS_AT_MAP, CAMP_OF_POINT],
          parts=[Part("the best constant from 0.1 to 10 m errs", "times as much as auto at camp",
                      lambda r: min(rmse_over_sweep(r.found[0])) / r.of("hard", "/error/rmse", 2), least=1.02),
                 Part("the best constant at map is", "times that at camp",
                      lambda r: best_of_sweep(r.found[1]) / best_of_sweep(r.found[0]), least=1.5)],
          why="A constant that is right on one slope is wrong on the next. `auto` takes each receiver's own."),
    Claim("2006-24-bits", PARTLY,
          "24 bits of depth are still not enough",
          commands=[CAMP_OF_POINT],
          parts=[Part("a step of 24 bits of z / w, 1000 m from a near plane at 0.1 m,", "m",
                      lambda r: r.worked_out("step_of_24_bits_in_z_over_w_m"), least=0.01),
                 Part("of linear depth", "m", lambda r: r.worked_out("step_of_24_bits_m"), least=0.01),
                 Part("acne without a bias of 32 bits", "of that of 16",
                      lambda r: r.ratio("hard+bias=none", "hard+bias=none+map-format=d16", "/error/acne"), least=0.9)],
          why="Of z / w they are not. Of linear depth they are plenty, and no number of bits replaces a bias: acne is the slope within a "
              "texel."),
    Claim("2006-back-faces", HOLDS,
          "To render back faces instead of nearest ones gives terrible peter-panning",
          commands=[FACES_AT_CAMP],
          parts=[Part("front faces culled, light at contacts", "times that of both faces",
                      lambda r: r.ratio("hard+bias=none+caster-cull=front", "hard+bias=none", "/error/detached"), least=5)],
          why="Neither has a bias. With `--camera unit`, at a unit's feet, it is 4 times, with `--camera map` 57 times. Culling front "
              "faces leaves a tenth of the acne, and far less light at contacts than a bias that is too high (2006-bias-high)."),
    Claim("2006-midpoint", HOLDS,
          "Midpoint rendering is expensive",
          commands=[TIMES],
          parts=[Part("the maps take", "times as long",
                      lambda r: r.ratio("hard+caster-faces=midpoint", "hard", "/time_ms/maps"), least=1.3),
                 Part("memory", "times as much", lambda r: r.ratio("hard+caster-faces=midpoint", "hard", "/memory_bytes"), least=1.3)],
          quick=False,
          why="Casters are drawn twice, into two more images of depth."),
    Claim("2006-midpoint-tricky", HOLDS,
          "and tricky: it does not do away with bias",
          commands=[CLOSE],
          parts=[Part("acne of the midpoint without a bias", "of that of nearest faces",
                      lambda r: r.ratio("hard+bias=none+caster-faces=midpoint", "hard+bias=none", "/error/acne"), least=0.3)],
          why="What is a single surface has no second one to be midway to."),
    Claim("2006-own-range", HOLDS,
          "Depth within one object: 8 bits over 2 m are about 1 cm, barely enough",
          parts=[Part("a step is", "cm", lambda r: 100.0 * 2.0 / 255.0, 0.5, 1.5)],
          why="2 m over 255."),
    Claim("2006-pcf-blurs-contacts", HOLDS,
          "PCF does not depend on distance: blurry feet look wrong",
          commands=[SOFT_CLOSE, SOFT_CAMP],
          parts=[Part("under a wide lamp, light at contacts with 7x7", "times that of pcss",
                      lambda r: r.ratio("pcf+pcf.kernel=7x7", "pcss", "/error/detached"), least=2),
                 Part("under a sun of 2 degrees", "times it",
                      lambda r: r.ratio("pcf+pcf.kernel=7x7", "pcss", "/error/detached", 1), least=2)],
          why="`pcss` is a kernel whose width goes by the distance. Penumbrae are none at a foot and grow from there."),
    Claim("2006-more-taps", HOLDS,
          "More taps are expensive and bring little extra quality",
          commands=[SOFT_CAMP, TIMES_OF_TAPS],
          parts=[Part("rmse of 64 taps", "of that of 16 in a disc as wide",
                      lambda r: r.ratio("pcf+pcf.kernel=vogel+pcf.taps=64", "pcf+pcf.kernel=vogel", "/error/rmse"), least=0.95),
                 Part("of 7x7", "of that of 3x3", lambda r: r.ratio("pcf+pcf.kernel=7x7", "pcf", "/error/rmse"), least=0.95),
                 Part("its mask takes", "times as long", lambda r: r.ratio("pcf+pcf.kernel=7x7", "pcf", "/time_ms/mask", 1), least=1.3)],
          quick=False,
          why="Under a sun of 2 degrees. A wider kernel errs more even there, where texels are larger than pixels."),
    Claim("2006-noise", PARTLY,
          "PCF looks bad; one can get away with it on noisy surfaces",
          commands=["gnomon render rts --preset plain --camera camp --sun-angle 2 --truth area --samples 64 --size 320x180 -o "
                    "camp_noisy_truth.png",
                    "gnomon render rts --preset plain --camera camp --filter pcf --map-size 512 --size 320x180 -o camp_noisy.png",
                    "gnomon render rts --preset plain --camera camp --sun-angle 2 --override-material diffuse --truth area --samples 64 "
                    "--size 320x180 -o camp_smooth_truth.png",
                    "gnomon render rts --preset plain --camera camp --override-material diffuse --filter pcf --map-size 512 --size "
                    "320x180 -o camp_smooth.png",
                    "gnomon metrics camp_noisy.png camp_noisy_truth.png --json",
                    "gnomon metrics camp_smooth.png camp_smooth_truth.png --json",
                    "gnomon render planes --preset plain --camera side --sun-angle 2 --truth area --samples 64 --size 320x180 -o "
                    "box_noisy_truth.png",
                    "gnomon render planes --preset plain --camera side --filter pcf --map-size 256 --size 320x180 -o box_noisy.png",
                    "gnomon render planes --preset plain --camera side --sun-angle 2 --override-material diffuse --truth area --samples "
                    "64 --size 320x180 -o box_smooth_truth.png",
                    "gnomon render planes --preset plain --camera side --override-material diffuse --filter pcf --map-size 256 --size "
                    "320x180 -o box_smooth.png",
                    "gnomon metrics box_noisy.png box_noisy_truth.png --json",
                    "gnomon metrics box_smooth.png box_smooth_truth.png --json"],
          parts=[Part("FLIP to the truth on tiles", "of that on one smooth material",
                      lambda r: r.number_over("/error/flip", 10, 11), 0, 0.85),
                 Part("on the ground of a camp", "of it", lambda r: r.number_over("/error/flip", 4, 5), 0, 0.85)],
          why="Under a sun of 2 degrees. Where a pattern is as strong as a shadow is dark, some of the error is lost in it; on grass and "
              "earth nothing is."),
    Claim("2006-id-no-bias", HOLDS,
          "Ids need no bias and no epsilon",
          commands=[IDS_AT_CAMP, IDS_ON_STAGE],
          parts=[Part("at camp, acne without a bias", "of that of depths without",
                      lambda r: r.ratio("id", "hard+bias=none", "/error/acne"), 0, 0.05),
                 Part("on a stage", "of it", lambda r: r.ratio("id", "hard+bias=none", "/error/acne", 1), 0, 0.05)],
          why="There is nothing to round. What is left at camp is thinner than a texel and has none of its own."),
    Claim("2006-id-no-self", HOLDS,
          "Nothing shadows itself",
          commands=[IDS_ON_STAGE, IDS_AT_CAMP],
          parts=[Part("acne on a stage", "", lambda r: r.of("id", "/error/acne"), 0, 1e-6),
                 Part("at camp, light at contacts", "times that of hard", lambda r: r.ratio("id", "hard", "/error/detached", 1), least=5)],
          why="Right where a surface would shade itself by mistake, wrong where one part of an object shades another."),
    Claim("2006-id-shrink", PARTLY,
          "Shadows shrink by a texel, which is not noticed",
          commands=[IDS_ON_PLANES],
          parts=[Part("mean error towards light", "times that of hard", lambda r: r.ratio("id", "hard", "/error/bias"), least=1.5),
                 Part("error at edges", "times hard's", lambda r: r.ratio("id", "hard", "/error/edge"), 0, 1.25)],
          why="A box that cannot shade itself, so the edge is all that errs. They shrink, and at 512 texels one sees it."),
    Claim("2006-id-256", HOLDS,
          "256 ids are usually enough: a collision is unlikely",
          commands=[BYTE_IDS_AT_CAMP, BYTE_IDS_AT_MAP],
          parts=[Part("at camp, pairs with one id", "of those that overlap", lambda r: colliding_share(r, 0), 0, 1.0 / 255.0),
                 Part("at map", "of them", lambda r: colliding_share(r, 1), 0, 1.0 / 255.0)],
          why="Held against one of 255, which a lot would give. Ours are handed out along the light."),
    Claim("2006-id-65536", HOLDS,
          "65536 ids are enough",
          commands=[IDS_OF_16_AT_CAMP, IDS_OF_16_AT_MAP],
          parts=[Part("at camp, pairs with one id", "of those that overlap", lambda r: colliding_share(r, 0), 0, 0),
                 Part("at map", "of them", lambda r: colliding_share(r, 1), 0, 0)],
          why="The largest scene here has 5756 objects."),
    Claim("2006-id-collision", HOLDS,
          "A collision loses a shadow and never adds one",
          commands=[IDS_AT_CAMP],
          parts=[Part("with 255 ids the mean error moves towards light by", "",
                      lambda r: r.of("id+map-format=r8", "/error/bias") - r.of("id", "/error/bias"), least=0),
                 Part("acne grows by", "", lambda r: r.of("id+map-format=r8", "/error/acne") - r.of("id", "/error/acne"), -1, 0)],
          why="What has the occluder's id takes it for itself."),
    Claim("2006-id-halos", HOLDS,
          "One sample at an object's edge finds what is behind: dark halos. The nearest four cure them",
          commands=[IDS_AT_CAMP],
          parts=[Part("false shadow of one sample", "times that of four",
                      lambda r: r.ratio("id+id.test=nearest", "id", "/error/acne"), least=2),
                 Part("mean error of one sample less that of four", "",
                      lambda r: r.of("id+id.test=nearest", "/error/bias") - r.of("id", "/error/bias"), -1, -0.01)],
          why="Below 0 is darker. All in all one sample errs less here, for its halos make up for shadow that ids lose."),
    Claim("2006-own-range-drawn", HOLDS,
          "An id and 8 bits of depth within the object are barely enough",
          commands=[IDS_ON_STAGE, IDS_AT_CAMP, IDS_AT_UNIT],
          parts=[Part("on a stage, rmse", "of that of 16 bits of depth",
                      lambda r: r.ratio("depth-id+map-format=rg8", "depth-id", "/error/rmse"), 0, 1.1),
                 Part("at camp", "of it", lambda r: r.ratio("depth-id+map-format=rg8", "depth-id", "/error/rmse", 1), 0, 1.1),
                 Part("close to a soldier", "of it", lambda r: r.ratio("depth-id+map-format=rg8", "depth-id", "/error/rmse", 2), 0, 1.1)],
          why="Acne does not grow with them. An edge moves here and there."),
    Claim("2006-smoothies", FAILS,
          "Smoothies give good results",
          commands=[SMOOTHIES_AT_CAMP, SMOOTHIES_CLOSE],
          parts=[Part("at camp, rmse of fins along silhouettes", "of that of pcf",
                      lambda r: r.ratio("smoothies", "pcf", "/error/rmse"), 0, 0.85),
                 Part("it is", "of that of hard", lambda r: r.ratio("smoothies", "hard", "/error/rmse"), 0, 0.85),
                 Part("by wide lamps", "of that of pcf", lambda r: r.ratio("smoothies", "pcf", "/error/rmse", 1), 0, 0.85),
                 Part("it is", "of that of hard", lambda r: r.ratio("smoothies", "hard", "/error/rmse", 1), 0, 0.85)],
          why="A smoothie lies outside of the hard shadow, and half of a true penumbra inside: all is too dark. They look soft, and are "
              "wrong."),
    Claim("2006-smoothies-image", HOLDS,
          "Smoothies need geometric volumes; a variant is entirely image-based",
          commands=[SMOOTHIES_AT_CAMP, SMOOTHIES_CLOSE],
          parts=[Part("at camp, fins take", "times the draws of pcf", lambda r: r.ratio("smoothies", "pcf", "/counters/draws"), least=1.05),
                 Part("edges found in the map", "times those", lambda r: r.ratio("pcf+smoothies", "pcf", "/counters/draws"), 0.95, 1.05),
                 Part("by wide lamps, fins", "times those", lambda r: r.ratio("smoothies", "pcf", "/counters/draws", 1), least=1.05),
                 Part("edges found in the map", "times those",
                      lambda r: r.ratio("pcf+smoothies", "pcf", "/counters/draws", 1), 0.95, 1.05)],
          why="Both are here, and their errors are alike within a tenth. Edges of the map need nothing of a host, and know what a "
              "texture cuts out."),
    Claim("2006-volumes-watertight", HOLDS,
          "Shadow volumes need watertight meshes, and cannot cast what a texture cuts out",
          commands=["gnomon plan rts --preset plain --camera camp --filter volumes --set volumes.open=skip --json",
                    "gnomon plan sundial --preset plain --filter volumes --set volumes.open=skip --json"],
          parts=[Part("at camp casters left out are", "of all that could shadow what is seen", lambda r: left_out_share(r, 0), least=0.25),
                 Part("on a meadow with trees", "of them", lambda r: left_out_share(r, 1), least=0.25)],
          why="Terrain, cloth and leaves. Without `volumes.open=skip` they are refused, with the reason."),
]
