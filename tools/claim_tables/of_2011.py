# SPDX-License-Identifier: Apache-2.0
"""What A. Marinescu claims of layered variance shadow maps and of the settings of his game."""

from claim_tables import (BOX, CAMP, CANOPIES, FAILS, HOLDS, PARTLY, TIMES_AT_CAMP, TIMES_OF_BOX, TIMES_OF_TAPS, Claim, Document, Part)

# Each means against aliasing, beside a map of which one texel is read.
POINT = "vsm+msaa=1+blur=none+map-sampling=nearest"
ALL_MEANS = "vsm+blur=none+map-sampling=anisotropic"
MEANS = ("gnomon compare rts --preset plain --camera camp --size 320x180 --samples 64 --repetitions 1 --warmup 0 --map-size 1024 "
         "--techniques vsm+msaa=1+blur=none+map-sampling=nearest,vsm+msaa=1+blur=none,vsm+blur=none,vsm+msaa=1,"
         "vsm+msaa=1+blur=none+map-sampling=trilinear,vsm+msaa=1+blur=none+map-sampling=anisotropic")
MEANS_IN_MOTION = ("gnomon compare rts --preset plain --camera camp --path orbit --frames 0-3 --size 192x108 --truth hard --map-size "
                   "1024 --techniques vsm+msaa=1+blur=none+map-sampling=nearest,vsm+blur=none+map-sampling=anisotropic")
# Steps of 16 bits and nothing that hides them: no bias, no blur, one sample, no least variance.
LAYERS = ("gnomon compare rts --preset plain --camera map --size 320x180 --samples 64 --repetitions 1 --warmup 0 --map-size 512 --bias "
          "none --set msaa=1 --set blur=none --set min-variance=0 --techniques vsm+map-format=rg16,lvsm+lvsm.placement=uniform,"
          "lvsm+lvsm.placement=uniform+lvsm.layers=4,lvsm+lvsm.placement=hand+lvsm.splits=0.35,lvsm+lvsm.placement=hand+lvsm.splits=0.65")
# Moments in 16 bits, by their least variance.
ROUNDED = "vsm+bias=none+map-format=rg16+msaa=1+blur=none+min-variance="
# A camera that pans beside a box, under lamps in one direction.
LAMP_AT_10_M = ("gnomon compare planes --preset plain --partition multi --camera side --point=-3,9,3,20 --map-size auto --texels 262144 "
                "--path pan --frames 0-11 --size 240x135 --truth hard --techniques hard+snap")
LAMP_AT_100_KM = ("gnomon compare planes --preset plain --partition multi --camera side --point=-30000,90000,30000,200000 --map-size auto "
                  "--texels 262144 --path pan --frames 0-11 --size 240x135 --truth hard --techniques hard+snap")


def drawn_share(plan):
    """Casters that the first view draws, of all objects that cast."""
    return len(plan["views"][0]["casters"]) / sum(one["casts"] for one in plan["objects"])


def slower_at_camp(runs, technique):
    """The time of a camp's shadows by that of one box's."""
    return runs.shadow_ms(technique) / runs.shadow_ms(technique, 1)


SOURCE = ("A. Marinescu, \"Achieving real-time soft shadows using layered variance shadow maps (LVSM) in a real-time strategy (RTS) "
          "game\"")
DOCUMENT = Document("2011", SOURCE, [
    Claim("2011-range", HOLDS,
          "Near and far planes at 1 and 100 make stored depth 100 times as accurate as at 1 and 10,000",
          parts=[Part("a metre takes", "times as much of the range", lambda r: r.worked_out("precision_of_tight_planes"), 90, 110)],
          why="Depth is linear, so its step is the range's length over the number of codes: 9999 over 99."),
    Claim("2011-float-digits", PARTLY,
          "Floats of 32 bits are accurate to 1e-6 only: finer differences of depth are not seen",
          parts=[Part("a step of floats just below 1 is", "", lambda r: r.worked_out("step_of_floats_below_1"), least=1e-6),
                 Part("two moments lose a deviation of", "of the range", lambda r: r.worked_out("deviation_lost_by_moments"), least=1e-6)],
          why="A plain map keeps far finer steps. A map of moments keeps far coarser ones, because a variance is the difference of two "
              "squares."),
    Claim("2011-flicker", FAILS,
          "Errors of floats make the boundary of shadows flicker, the more the farther light and camera are apart",
          commands=[LAMP_AT_10_M, LAMP_AT_100_KM],
          parts=[Part("shimmer of a map that holds still, the lamp 100 km away, less that at 10 m", "",
                      lambda r: r.of("hard+snap", "/stability/shimmer", 1) - r.of("hard+snap", "/stability/shimmer"), least=0.001)],
          why="The paper's own remedy is always on: a map's planes are close around what is seen. Matrices are made in double precision, "
              "relative to the eye."),
    Claim("2011-vertex-distance", HOLDS,
          "Under a sun the distance to the light's plane may be worked out per vertex; that to a place may not",
          parts=[Part("interpolated distance to a plane errs by", "m", lambda r: r.worked_out("error_of_plane_distance_m"), 0, 1e-12),
                 Part("to a place by", "m", lambda r: r.worked_out("error_of_place_distance_m"), least=0.1)],
          why="The first is affine in the point, the second is not. A triangle 20 m across was tried, some 10 m away."),
    Claim("2011-planar-bound", HOLDS,
          "Chebyshev's bound is exact for one flat occluder over one flat receiver",
          parts=[Part("the bound errs by", "at most", lambda r: r.worked_out("error_of_planar_bound"), 0, 1e-9)],
          why="Two depths with shares p and 1 - p have the variance that makes it an equality."),
    Claim("2011-double-storage", HOLDS,
          "A variance map takes twice the memory of a plain map",
          commands=[CANOPIES],
          parts=[Part("the map takes", "times as much", lambda r: r.ratio("vsm", "hard", "/map/bytes"), 1.9, 2.1)],
          why="Depth and its square. While it is made, four samples a texel and the blur's second image come on top: 7 times in all."),
    Claim("2011-minimum-variance", HOLDS,
          "A small least variance, once tuned, nearly removes the artefacts of inexact numbers",
          commands=[CAMP],
          parts=[Part("acne left by a least variance of 0.0001,", "of that without, moments in 16 bits",
                      lambda r: r.ratio(ROUNDED + "0.0001", ROUNDED + "0", "/error/acne"), 0, 0.1)],
          why="No bias, blur or samples helped. It is a hundredth of the paper's value."),
    Claim("2011-published-variance", HOLDS,
          "0.01 is such a value",
          commands=["gnomon compare --preset rts-2011 --camera camp --set lighten=0 --size 320x180 --samples 64 --repetitions 1 --warmup "
                    "0 --techniques lvsm+bias=none,lvsm+bias=none+min-variance=0"],
          parts=[Part("acne", "of that without",
                      lambda r: r.ratio("lvsm+bias=none", "lvsm+bias=none+min-variance=0", "/error/acne"), 0, 0.1),
                 Part("rmse", "of it", lambda r: r.ratio("lvsm+bias=none", "lvsm+bias=none+min-variance=0", "/error/rmse"), 0, 1.05)],
          why="In the paper's layers, which are thin volumes of the world. Over a range of more than 100 m it is a deviation of 10 m, "
              "and with `vsm+min-variance=0.01` no unit casts a dark shadow."),
    Claim("2011-bleeding-reduction", HOLDS,
          "Light bleeding is attenuated by cutting off low visibility, or by a power of it",
          commands=[CANOPIES],
          parts=[Part("cut off at 0.3, bleeding left", "of that without",
                      lambda r: r.ratio("vsm+bleeding.linstep=0.3", "vsm", "/error/bleeding"), 0, 0.5),
                 Part("the paper's power of 1.3 leaves", "of it",
                      lambda r: r.ratio("vsm+bleeding.power=1.3", "vsm", "/error/bleeding"), 0, 0.75)],
          why="What it costs is in 2014-fat-shadows."),
    Claim("2011-one-layer", HOLDS,
          "It is enough to sample the one layer that holds the receiver, and layers reduce bleeding",
          commands=[CANOPIES],
          parts=[Part("bleeding with two layers", "of vsm's", lambda r: r.ratio("lvsm", "vsm", "/error/bleeding"), 0, 0.05),
                 Part("rmse", "times vsm's", lambda r: r.ratio("lvsm", "vsm", "/error/rmse"), 0, 0.9)],
          why="For the layer of the receiver all casters of nearer layers are one flat caster."),
    Claim("2011-layers-precision", HOLDS,
          "Layers make depth more precise, because their near and far planes are closer together",
          commands=[LAYERS],
          parts=[Part("acne of two layers of 16 bits", "of vsm's",
                      lambda r: r.ratio("lvsm+lvsm.placement=uniform", "vsm+map-format=rg16", "/error/acne"), 0, 0.75),
                 Part("of four", "of vsm's",
                      lambda r: r.ratio("lvsm+lvsm.placement=uniform+lvsm.layers=4", "vsm+map-format=rg16", "/error/acne"), 0, 0.5)],
          why="Nothing else hides rounding here: no bias, no blur, one sample, no least variance."),
    Claim("2011-uniform-layers", HOLDS,
          "Layers of equal thickness are the most precise; against bleeding, place them by what is there",
          commands=[LAYERS, CANOPIES],
          parts=[Part("acne of two equal layers of 16 bits", "of that of layers that meet at 0.35",
                      lambda r: r.ratio("lvsm+lvsm.placement=uniform", "lvsm+lvsm.placement=hand+lvsm.splits=0.35", "/error/acne"), 0, 1),
                 Part("it is", "of that of layers that meet at 0.65",
                      lambda r: r.ratio("lvsm+lvsm.placement=uniform", "lvsm+lvsm.placement=hand+lvsm.splits=0.65", "/error/acne"), 0, 1),
                 Part("layers placed in gaps bleed", "of what equal ones do",
                      lambda r: r.ratio("lvsm", "lvsm+lvsm.placement=uniform", "/error/bleeding", 1), 0, 0.5)],
          why="The default, `gaps`, looks for where the least light bleeds."),
    Claim("2011-filtering-cheap", PARTLY,
          "Bilinear reads, samples, a blur, mip levels and anisotropic reads make variance maps much better",
          commands=[MEANS, MEANS_IN_MOTION],
          parts=[Part("beside point sampling, rmse with bilinear reads", "of that without",
                      lambda r: r.ratio("vsm+msaa=1+blur=none", POINT, "/error/rmse"), 0, 0.85),
                 Part("with those and four samples", "of it", lambda r: r.ratio("vsm+blur=none", POINT, "/error/rmse"), 0, 0.85),
                 Part("with those and a blur", "of it", lambda r: r.ratio("vsm+msaa=1", POINT, "/error/rmse"), 0, 0.85),
                 Part("with mip levels", "of it",
                      lambda r: r.ratio("vsm+msaa=1+blur=none+map-sampling=trilinear", POINT, "/error/rmse"), 0, 0.85),
                 Part("with anisotropic reads", "of it",
                      lambda r: r.ratio("vsm+msaa=1+blur=none+map-sampling=anisotropic", POINT, "/error/rmse"), 0, 0.85),
                 Part("shimmer under a camera that goes round, with samples and anisotropic reads,", "of that without",
                      lambda r: r.ratio(ALL_MEANS, POINT, "/stability/shimmer", 1), 0, 0.85)],
          why="In a still picture bilinear reads do most of it. Mip levels, anisotropic reads and a blur make variances of wider places, "
              "which bleed; under a camera that moves they flicker less, which is what they are for."),
    Claim("2011-filtering-cost", FAILS,
          "Mip levels, anisotropic reading and samples do so at almost no extra cost",
          commands=[TIMES_OF_TAPS],
          parts=[Part("a frame with all three takes", "times that with point sampling",
                      lambda r: r.ratio(ALL_MEANS, POINT, "/time_ms/frame"), 0, 1.1)],
          quick=False,
          why="On a software rasteriser, which has no fixed units for samples and filters."),
    Claim("2011-bloom", PARTLY,
          "Bloom helps to hide what artefacts remain",
          commands=["gnomon render --preset rts-2011 --set bloom=0 --size 320x180 --truth area --samples 64 -o truth.png",
                    "gnomon render --preset rts-2011 --size 320x180 --truth area --samples 64 -o truth_bloom.png",
                    "gnomon render --preset rts-2011 --set lighten=0 --set bloom=0 --size 320x180 -o plain.png",
                    "gnomon render --preset rts-2011 --set lighten=0 --size 320x180 -o bloom.png",
                    "gnomon metrics plain.png truth.png --json",
                    "gnomon metrics bloom.png truth_bloom.png --json"],
          parts=[Part("rmse to the truth with bloom in both", "of that without",
                      lambda r: r.number_over("/error/rmse", 5, 4), 0, 0.95),
                 Part("FLIP", "of that without", lambda r: r.number_over("/error/flip", 5, 4), 0, 0.95)],
          why="It lowers the contrast at edges, and with it an error in numbers. The eye sees it as before. With `bloom.threshold` 0.3, "
              "as in the preset; at 0.8 bloom could not be seen."),
    Claim("2011-4096", HOLDS,
          "There are situations in which even a map of 4096 texels is too small",
          commands=["gnomon compare rts --preset plain --camera unit --size 320x180 --truth hard --repetitions 1 --warmup 0 --techniques "
                    "hard+map-size=4096,hard+map-size=1024"],
          parts=[Part("texels a pixel, in the median,", "", lambda r: r.of("hard+map-size=4096", "/texel_density/p50"), 0, 1)],
          why="One map from a unit's feet to the horizon; 320x180 pixels were too many for it."),
    Claim("2011-larger-maps", HOLDS,
          "Larger maps make shadows better, and cost memory",
          commands=["gnomon compare rts --preset plain --camera unit --size 320x180 --truth hard --repetitions 1 --warmup 0 --techniques "
                    "hard+map-size=4096,hard+map-size=1024"],
          parts=[Part("rmse of a map of 4096", "of one of 1024",
                      lambda r: r.ratio("hard+map-size=4096", "hard+map-size=1024", "/error/rmse"), 0, 0.8),
                 Part("memory", "times as much", lambda r: r.ratio("hard+map-size=4096", "hard+map-size=1024", "/map/bytes"), 15, 17)],
          why="Sixteen times the memory does not nearly divide the error by four: what is thinner than a texel is missed until texels "
              "are finer."),
    Claim("2011-octree", HOLDS,
          "An octree culls efficiently what need not be drawn",
          commands=["gnomon plan rts --preset plain --camera unit --json"],
          parts=[Part("casters drawn", "of all", lambda r: drawn_share(r.found[0]), 0, 0.5)],
          why="Of a view to the horizon; those that cannot shadow anything in sight are left out. How much sooner a tree finds them than "
              "a list is not tried."),
    Claim("2011-complexity", HOLDS,
          "Shadow maps depend little on a scene's complexity, shadow volumes highly",
          commands=[TIMES_AT_CAMP, TIMES_OF_BOX],
          parts=[Part("from one box to a camp a map draws", "times the triangles",
                      lambda r: r.of("hard", "/counters/primitives") / r.of("hard", "/counters/primitives", 1), least=100),
                 Part("maps and mask take", "times as long", lambda r: slower_at_camp(r, "hard"), 0, 10),
                 Part("with volumes", "times as long as that",
                      lambda r: slower_at_camp(r, "volumes+volumes.open=skip") / slower_at_camp(r, "hard"), least=2)],
          quick=False,
          why="A map's time is mostly that of texels and pixels. A volume is drawn over all that lies behind its caster, and at camp "
              "there are 833."),
    Claim("2011-world-layers", HOLDS,
          "Two layers are to be volumes of the world, with a least variance of 0.01",
          commands=["gnomon compare --preset rts-2011 --camera camp --set lighten=0 --size 320x180 --samples 64 --repetitions 1 --warmup "
                    "0 --techniques lvsm,lvsm+lvsm.placement=gaps"],
          parts=[Part("rmse", "of that of layers found in gaps",
                      lambda r: r.ratio("lvsm", "lvsm+lvsm.placement=gaps", "/error/rmse"), 0, 0.85),
                 Part("light at contacts", "of it", lambda r: r.ratio("lvsm", "lvsm+lvsm.placement=gaps", "/error/detached"), 0, 0.5)],
          why="Over a slab of 6 m, 0.01 is a deviation of 0.6 m. Over the whole range it is too large (2011-published-variance)."),
    Claim("2011-animated", HOLDS,
          "All geometry casts soft shadows, units with an animation system too",
          commands=["gnomon render --preset rts-2011 --camera giant --time 0.5 --set lighten=0 --mask --size 320x180 -o giant.png",
                    "gnomon render --preset rts-2011 --camera giant --time 0.5 --set lighten=0 --mask --size 320x180 --set "
                    "object=giant/skin:casts=false -o no_giant.png",
                    "gnomon render --preset rts-2011 --camera giant --time 0.5 --mask --size 320x180 --truth area --samples 64 -o "
                    "giant_truth.png",
                    "gnomon render --preset rts-2011 --camera giant --time 0.5 --mask --size 320x180 --truth area --samples 64 --set "
                    "object=giant/skin:casts=false -o no_giant_truth.png",
                    "gnomon metrics giant.png no_giant.png --json",
                    "gnomon metrics giant_truth.png no_giant_truth.png --json"],
          parts=[Part("the one unit with a skin, half a second into its walk, changes the mask, rmse, by",
                      "of what it changes of the truth",
                      lambda r: r.number_over("/error/rmse", 4, 5), 0.5, 1.5)],
          why="His vertices are made anew in each frame."),
    Claim("2011-matrices-once", PARTLY,
          "The light's matrices need making only once, when a map is loaded",
          commands=["gnomon compare planes --preset plain --camera side --path pan --frames 0-5 --size 192x108 --truth hard --map-size "
                    "512 --techniques hard,hard+scene",
                    "gnomon compare rts --preset plain --camera map --size 320x180 --truth hard --repetitions 1 --warmup 0 --map-size "
                    "1024 --techniques hard,hard+scene",
                    "gnomon compare rts --preset plain --camera camp --size 320x180 --truth hard --repetitions 1 --warmup 0 --map-size "
                    "1024 --techniques hard,hard+scene"],
          parts=[Part("shimmer while the camera pans", "of that of a map that follows it",
                      lambda r: r.ratio("hard+scene", "hard", "/stability/shimmer"), 0, 0.05),
                 Part("at map, rmse", "times its", lambda r: r.ratio("hard+scene", "hard", "/error/rmse", 1), 0, 1.1),
                 Part("at camp", "times its", lambda r: r.ratio("hard+scene", "hard", "/error/rmse", 2), 0, 1.1)],
          why="Nothing swims, and the whole map seen from above loses nothing. Closer by, texels stay as coarse as the map is large."),
    Claim("2011-volumes-accurate", HOLDS,
          "Shadow volumes are extremely accurate, regardless of the distance from caster to receiver",
          commands=[BOX,
                    "gnomon compare planes --preset plain --camera side --sun=0.3,-0.5,1 --size 320x180 --truth hard --repetitions 1 "
                    "--warmup 0 --map-size 512 --techniques hard,volumes+volumes.open=skip"],
          parts=[Part("rmse", "of that of a map of 512", lambda r: r.ratio("volumes+volumes.open=skip", "hard", "/error/rmse"), 0, 0.5),
                 Part("where the shadow is long", "of it",
                      lambda r: r.ratio("volumes+volumes.open=skip", "hard", "/error/rmse", 1), 0, 0.5),
                 Part("itself", "", lambda r: r.of("volumes+volumes.open=skip", "/error/rmse", 1), 0, 0.01)],
          why="Edges are those of the picture's pixels, wherever they fall."),
])
