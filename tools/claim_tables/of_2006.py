# SPDX-License-Identifier: Apache-2.0
"""T. Forsyth's claims about projections and frustums; of_2006_depth.py has the rest."""

from math import hypot, nan, sqrt

from claim_tables import CAMP_OF_POINT, FAILS, HOLDS, PARTLY, Claim, Document, Part, of_2006_depth

UNIT_WARPS = ("gnomon compare rts --preset plain --camera unit --size 320x180 --truth hard --repetitions 1 --warmup 0 --map-size 512 "
              "--techniques hard,hard+lispsm,hard+lispsm-simple,hard+tsm")
# A view and a size of map for which PSM does not fall back.
PERSPECTIVE_WARP = ("gnomon compare rts --preset plain --camera camp --size 320x180 --truth hard --repetitions 1 --warmup 0 --map-size "
                    "2048 --techniques hard,hard+psm")
LONG_WARPS = ("gnomon compare sundial --preset plain --camera long --size 320x180 --truth hard --repetitions 1 --warmup 0 --map-size 512 "
              "--techniques hard+lispsm,hard+tsm")
AGAINST_THE_SUN = ("gnomon compare sundial --preset plain --eye 0,1.7,0 --target 0,3,-20 --sun 0,-0.35,1 --size 320x180 --truth hard "
                   "--repetitions 1 --warmup 0 --map-size 512 --techniques hard,hard+lispsm,hard+lispsm-simple,hard+tsm")
# The talk's own algorithm, as a technique, and without its bound.
TALKS = "hard+multi+multi.divide=receivers+multi.most-times=4"
RECEIVERS = "hard+multi+multi.divide=receivers"
LANTERN_TWO = ("gnomon compare ring --camera duel --light \"lantern 2\" --light-size 0.02 --size 320x180 --samples 64 --repetitions 1 "
               "--warmup 0 --texels 1048576 --techniques hard+multi+multi.divide=receivers+multi.most-times=4,hard+cube")
PENDANT = ("gnomon compare ring --camera bar --light \"pendant 13\" --light-size 0.02 --size 320x180 --samples 64 --repetitions 1 "
           "--warmup 0 --texels 1048576 --techniques hard+multi+multi.divide=receivers+multi.most-times=4,hard+cube")
PENDANT_OF_DECK = ("gnomon compare ring --camera deck --light \"pendant 15\" --light-size 0.02 --size 320x180 --samples 64 --repetitions "
                   "1 --warmup 0 --texels 1048576 --techniques hard+multi+multi.divide=receivers+multi.most-times=4,hard+cube")
# Eyes that look into a lamp behind what stands there: before an army, and on a meadow. How even texels are there.
EYE_BEFORE_ARMY = (27.2, 10.1, 19.2)
EYE_ON_MEADOW = (0.0, 1.7, 20.0)
DUEL_BEFORE_ARMY = ("gnomon plan rts --preset plain --eye 27.2,10.1,19.2 --target 24.3,10.5,-6 --point 24.3,11,-6,60 --filter hard "
                    "--partition multi --set multi.divide=receivers --set multi.most-times=4 --map-size auto --texels 1048576 --size "
                    "240x135 --json")
DUEL_ON_MEADOW = ("gnomon plan sundial --preset plain --eye 0,1.7,20 --target 0,1.2,-20 --point 0,3,-20,60 --filter hard --partition "
                  "multi --set multi.divide=receivers --set multi.most-times=4 --map-size auto --texels 1048576 --size 240x135 --json")
TEXELS_BEFORE_ARMY = ("gnomon compare rts --preset plain --partition cube --map-size auto --eye 27.2,10.1,19.2 --target 24.3,10.5,-6 "
                      "--point 24.3,11,-6,60 --size 240x135 --truth hard --repetitions 1 --warmup 0 --texels 1048576 --techniques "
                      "hard+multi+multi.divide=receivers+multi.most-times=4")
TEXELS_ON_MEADOW = ("gnomon compare sundial --preset plain --partition cube --map-size auto --eye 0,1.7,20 --target 0,1.2,-20 --point "
                    "0,3,-20,60 --size 240x135 --truth hard --repetitions 1 --warmup 0 --texels 1048576 --techniques "
                    "hard+multi+multi.divide=receivers+multi.most-times=4")
UNDER_THE_SKY = "gnomon plan planes --preset plain --camera side --point 0,3,0,40 --filter hard --partition multi --json"
BESIDE_THE_VIEWER = "gnomon plan planes --preset plain --camera side --point 7.5,5,9.5,40 --filter hard --partition multi --json"
# The first two cameras all but stand.
POPPING = [f"gnomon compare ring --preset plain --partition cube {view} --map-size auto --size 192x108 --truth hard --frames 0-23 "
           f"--path {path} --techniques {RECEIVERS},{RECEIVERS}+snap"
           for view, path in (("--camera duel --light \"lantern 2\"", "pan --set path.speed=0.001"),
                              ("--camera duel --light \"reactor 12\"", "pan --set path.speed=0.001"),
                              ("--camera duel --light \"lantern 2\"", "orbit"),
                              ("--camera deck --light \"lantern 0\"", "pan"))]


def warp_acne(runs, warp):
    """The acne of a warp by that of the map without one, each with the same constant bias."""
    return runs.ratio(warp + "+bias=none+bias.constant=0.3", "hard+bias=none+bias.constant=0.3", "/error/acne")


def fallen_back(runs):
    """How many of the plans' suns have the outcome "fallback"."""
    return sum(plan["lights"][0]["outcome"] == "fallback" for plan in runs.found)


def unevenness(runs, run):
    """How uneven texels are on what faces eye and lamp: the finest hundredth by the coarsest."""
    return runs.of(TALKS, "/texel_density/facing/p99", run) / runs.of(TALKS, "/texel_density/facing/p01", run)


def regions_towards(plan, eye):
    """How many frustums of the plan's only lamp look towards the eye, give or take 45 degrees: into how many the side of a cube
    map that looks there is divided."""
    to_eye = [to - at for to, at in zip(eye, plan["lights"][0]["position_ws"], strict=True)]
    forwards = [view["clip_from_world_rows"][3][:3] for view in plan["views"]]
    return sum(sum(a * b for a, b in zip(forward, to_eye, strict=True)) >= hypot(*forward) * hypot(*to_eye) * sqrt(0.5)
               for forward in forwards)


def seams_left(runs, picture, hard, pointer):
    """How much fading over is left to do in a picture, by how much in one with hard edges. NaN where the seams of that are less
    than a step of 8 bits, so that there is nothing to hide."""
    return runs.number_over(pointer, picture, hard) if runs.number("/error/rmse", hard) * 255.0 >= 1.0 else nan


DOCUMENT = Document("2006", "T. Forsyth, \"Extremely Practical Shadows\", GDC", [
    Claim("2006-warps-help", PARTLY,
          "Smarter projections (PSM, LiSPSM, TSM) all help with spatial aliasing",
          commands=[UNIT_WARPS, PERSPECTIVE_WARP],
          parts=[Part("rmse of lispsm", "of uniform's", lambda r: r.ratio("hard+lispsm", "hard", "/error/rmse"), 0, 0.85),
                 Part("of lispsm-simple", "of it", lambda r: r.ratio("hard+lispsm-simple", "hard", "/error/rmse"), 0, 0.85),
                 Part("of tsm", "of it", lambda r: r.ratio("hard+tsm", "hard", "/error/rmse"), 0, 0.85),
                 Part("of psm at camp, with 2048 texels,", "of it", lambda r: r.ratio("hard+psm", "hard", "/error/rmse", 1), 0, 0.85)],
          why="From a unit's feet to the horizon, where a map without a warp wastes most. PSM falls back there (2006-psm-fragile). It "
              "does not at camp with a large map, and errs more."),
    Claim("2006-warps-and-depth", FAILS,
          "They help little with depth aliasing, and some make it worse",
          commands=[CAMP_OF_POINT],
          parts=[Part("with a bias of 0.3 m acne of lispsm", "of uniform's", lambda r: warp_acne(r, "hard+lispsm"), least=0.9),
                 Part("of lispsm-simple", "of it", lambda r: warp_acne(r, "hard+lispsm-simple"), least=0.9),
                 Part("of tsm", "of it", lambda r: warp_acne(r, "hard+tsm"), least=0.9),
                 Part("the most acne of a warp", "of it",
                      lambda r: max(warp_acne(r, "hard+lispsm"), warp_acne(r, "hard+lispsm-simple"), warp_acne(r, "hard+tsm")), least=1)],
          why="Near things have smaller texels with a warp, and a smaller texel needs less bias. Without any bias a slope shadows itself "
              "whatever the texel's size."),
    Claim("2006-psm-fragile", HOLDS,
          "PSM is hard to make robust: lights and casters cross the camera's plane",
          commands=["gnomon plan rts --camera camp --partition single --fit psm --filter hard --json",
                    "gnomon plan rts --camera unit --partition single --fit psm --filter hard --json",
                    "gnomon plan rts --camera map --partition single --fit psm --filter hard --json",
                    "gnomon plan sundial --camera meadow --partition single --fit psm --filter hard --json",
                    "gnomon plan sundial --camera long --partition single --fit psm --filter hard --json",
                    "gnomon plan sundial --camera porch --partition single --fit psm --filter hard --json"],
          parts=[Part("of six views it falls back in", "", lambda r: fallen_back(r), least=1)],
          why="The plan says why: post-perspective space asks for a stronger warp than the map can bear, near what crosses the eye's "
              "plane. Then the map is a uniform one."),
    Claim("2006-tsm-overdistorts", PARTLY,
          "TSM over-distorts in many cases: too much detail near the eye",
          commands=[UNIT_WARPS, LONG_WARPS],
          parts=[Part("at unit, texels a pixel of the coarsest hundredth", "of lispsm's",
                      lambda r: r.ratio("hard+tsm", "hard+lispsm", "/texel_density/p01"), 0, 0.8),
                 Part("at long", "of lispsm's", lambda r: r.ratio("hard+tsm", "hard+lispsm", "/texel_density/p01", 1), 0, 0.8)],
          why="Where it does, its rmse is higher than lispsm's; on open ground it is as good or better. Our trapezoid gives the near "
              "part 80 % of the map, as published, in one warp."),
    Claim("2006-duel", HOLDS,
          "In a duel, the eye looking into the light, all do the same as the standard projection",
          commands=[AGAINST_THE_SUN],
          parts=[Part("rmse of lispsm", "of uniform's", lambda r: r.ratio("hard+lispsm", "hard", "/error/rmse"), 0.95, 1.05),
                 Part("of lispsm-simple", "of it", lambda r: r.ratio("hard+lispsm-simple", "hard", "/error/rmse"), 0.95, 1.05),
                 Part("of tsm", "of it", lambda r: r.ratio("hard+tsm", "hard", "/error/rmse"), 0.95, 1.05)],
          why="A warp has no direction left to work along. They err by a few per cent more, because they turn the grid. PSM cannot be "
              "drawn there and falls back to the standard projection."),
    Claim("2006-field-of-view", HOLDS,
          "A map's field of view ends at 180 degrees, in practice at about 120",
          parts=[Part("at 120 degrees an edge has", "times the texels per degree of the middle",
                      lambda r: r.worked_out("density_at_edge_of_120_degrees"), 3.9, 4.1)],
          why="So 120 degrees are where the talk's own band of 1 to 4 ends. At 150 it is 15 times."),
    Claim("2006-even-texels", FAILS,
          "With many frustums texels are even: the best has 4 times those of the worst",
          commands=[LANTERN_TWO, PENDANT],
          parts=[Part("lantern 2: finest over coarsest hundredth", "", lambda r: unevenness(r, 0), 0, 4.5),
                 Part("pendant 13:", "", lambda r: unevenness(r, 1), 0, 4.5)],
          why="On surfaces that face eye and lamp, with `multi.divide=receivers`. Sides of maps are rounded up, and a pixel takes the "
              "finest frustum that holds it."),
    Claim("2006-near-more-texels", HOLDS,
          "Objects close to the viewer get more texels",
          commands=[LANTERN_TWO, PENDANT],
          parts=[Part("lantern 2: texels a pixel of the coarsest hundredth,", "times cube's",
                      lambda r: r.ratio(TALKS, "hard+cube", "/texel_density/p01"), least=1.2),
                 Part("pendant 13:", "times cube's", lambda r: r.ratio(TALKS, "hard+cube", "/texel_density/p01", 1), least=1.2)],
          why="What is nearest has the fewest texels with a cube, at the same number in all."),
    Claim("2006-better-than-cubes", PARTLY,
          "It is better than cube maps",
          commands=[LANTERN_TWO, PENDANT, PENDANT_OF_DECK],
          parts=[Part("lantern 2: rmse", "of cube's", lambda r: r.ratio(TALKS, "hard+cube", "/error/rmse"), 0, 0.995),
                 Part("pendant 13:", "of cube's", lambda r: r.ratio(TALKS, "hard+cube", "/error/rmse", 1), 0, 0.995),
                 Part("pendant 15:", "of cube's", lambda r: r.ratio(TALKS, "hard+cube", "/error/rmse", 2), 0, 0.995)],
          why="With a million texels each, by `multi.divide=receivers`. Each frustum has room to spare around its receivers. The table "
              "of `multi` has more lamps, and our own division."),
    Claim("2006-few-regions", PARTLY,
          "A duel is solved by 3 or 4 regions at the extreme",
          commands=[DUEL_BEFORE_ARMY, DUEL_ON_MEADOW, TEXELS_BEFORE_ARMY, TEXELS_ON_MEADOW],
          parts=[Part("frustums towards an eye that looks into a lamp behind an army", "",
                      lambda r: regions_towards(r.found[0], EYE_BEFORE_ARMY), 1, 4),
                 Part("on a meadow", "", lambda r: regions_towards(r.found[1], EYE_ON_MEADOW), 1, 4),
                 Part("finest over coarsest hundredth before the army", "", lambda r: unevenness(r, 2), 0, 4.5),
                 Part("on a meadow", "", lambda r: unevenness(r, 3), 0, 4.5)],
          why="By `multi.divide=receivers`, counted on the side of a cube that looks towards the eye. A pixel takes the finest frustum "
              "that holds it, which may be another receiver's, and sides of maps are rounded up."),
    Claim("2006-unseen-sides", HOLDS,
          "Sides that nobody sees are never considered",
          commands=[UNDER_THE_SKY, BESIDE_THE_VIEWER],
          parts=[Part("a lamp with nothing above it but the sky has", "sides of six", lambda r: r.number("/lights/0/view_count"), 1, 5),
                 Part("one beside the viewer", "of six", lambda r: r.number("/lights/0/view_count", 1), 1, 3)],
          why="Lamps that light nothing in sight have none."),
    Claim("2006-popping", HOLDS,
          "Popping is kept down if frustums pan by whole texels and receivers are blended over",
          commands=POPPING,
          parts=[Part("folk walk before a camera that stands: the worst frame changes, lantern 2,", "of what it does without",
                      lambda r: r.ratio(RECEIVERS + "+snap", RECEIVERS, "/stability/pop"), 0, 0.5),
                 Part("reactor 12", "of it", lambda r: r.ratio(RECEIVERS + "+snap", RECEIVERS, "/stability/pop", 1), 0, 0.5),
                 Part("a camera goes round, lantern 2", "of it",
                      lambda r: r.ratio(RECEIVERS + "+snap", RECEIVERS, "/stability/pop", 2), 0, 0.5),
                 Part("a camera goes by, lantern 0", "of it",
                      lambda r: r.ratio(RECEIVERS + "+snap", RECEIVERS, "/stability/pop", 3), 0, 0.5)],
          quick=False,
          why="`multi.divide=receivers` with motion `snap`; frustums fade into others over eight frames."),
    Claim("2006-soft-seams", PARTLY,
          "Soft shadows help to hide seams between frustums; a blur on the screen is effective",
          commands=["gnomon render planes --camera side --point -3.5,3,0.3,40 --partition multi --set multi.most-times=2 --texels 16384 "
                    "--mask --size 240x135 --filter hard --set cascades.blend=0 -o hard_seams.png",
                    "gnomon render planes --camera side --point -3.5,3,0.3,40 --partition multi --set multi.most-times=2 --texels 16384 "
                    "--mask --size 240x135 --filter hard --set cascades.blend=0.5 -o hard_faded.png",
                    "gnomon render planes --camera side --point -3.5,3,0.3,40 --partition multi --set multi.most-times=2 --texels 16384 "
                    "--mask --size 240x135 --filter hard --soften blur --set soften.edges=plain --set cascades.blend=0 -o blur_seams.png",
                    "gnomon render planes --camera side --point -3.5,3,0.3,40 --partition multi --set multi.most-times=2 --texels 16384 "
                    "--mask --size 240x135 --filter hard --soften blur --set soften.edges=plain --set cascades.blend=0.5 -o "
                    "blur_faded.png",
                    "gnomon render planes --camera side --point -3.5,3,0.3,40 --partition multi --set multi.most-times=2 --texels 16384 "
                    "--mask --size 240x135 --filter smoothies --light-size 0.2 --set cascades.blend=0 -o soft_seams.png",
                    "gnomon render planes --camera side --point -3.5,3,0.3,40 --partition multi --set multi.most-times=2 --texels 16384 "
                    "--mask --size 240x135 --filter smoothies --light-size 0.2 --set cascades.blend=0.5 -o soft_faded.png",
                    "gnomon metrics hard_seams.png hard_faded.png --json",
                    "gnomon metrics blur_seams.png blur_faded.png --json",
                    "gnomon metrics soft_seams.png soft_faded.png --json"],
          parts=[Part("what fading over changes of a mask that is blurred on the screen, rmse,", "of what it changes of a hard one",
                      lambda r: seams_left(r, 7, 6, "/error/rmse"), 0, 0.5),
                 Part("FLIP", "of it", lambda r: seams_left(r, 7, 6, "/error/flip"), 0, 0.5),
                 Part("of smoothies, rmse", "of it", lambda r: seams_left(r, 8, 6, "/error/rmse"), 0, 0.5),
                 Part("FLIP", "of it", lambda r: seams_left(r, 8, 6, "/error/flip"), 0, 0.5)],
          why="With maps so small that a seam is twelve steps of 8 bits. In numbers soft edges hide it. FLIP sees a wide faint step as "
              "well as a sharp one, or better."),
    *of_2006_depth.CLAIMS,
])
