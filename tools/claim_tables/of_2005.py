# SPDX-License-Identifier: Apache-2.0
"""What A. S. Shastry claims of soft-edged shadows."""

from claim_tables import BOX, FAILS, HOLDS, PARTLY, TIMES_AT_CAMP, TIMES_OF_BOX, Claim, Document, Part

# The blur as published: of nine comparisons as published, plain over silhouettes, by the article's taps.
BLURRED = ("gnomon render spotlit --preset plain --camera stage --light gear --mask --filter pcf --set pcf.kernel=3x3-projected --soften "
           "blur --set soften.edges=plain --set soften.taps=published --map-size 512 --size 320x180 -o blur_512.png")
HARD_512 = ("gnomon render spotlit --preset plain --camera stage --light gear --mask --filter hard --map-size 512 --size 320x180 -o "
           "hard_512.png")
HARD_4096 = ("gnomon render spotlit --preset plain --camera stage --light gear --mask --filter hard --map-size 4096 --size 320x180 -o "
            "hard_4096.png")
COARSE_AND_FINE = "gnomon metrics hard_512.png hard_4096.png --json"
SOFTENED_TIMES = ("gnomon bench spotlit --preset plain --camera stage --size 640x360 --map-size 512 --repetitions 11 --warmup 1 --set "
                  "pcf.kernel=3x3-projected --set soften.edges=plain --set soften.taps=published --techniques "
                  "pcf,pcf+blur,pcf+blur+soften.size=half")
SCREEN_BLUR = "/memory_by_purpose_bytes/screen blur"
MASK = "/memory_by_purpose_bytes/mask"

DOCUMENT = Document("2005", "A. S. Shastry, \"Soft-Edged Shadows\"", [
    Claim("2005-float-depth", HOLDS,
          "R32F has sufficient precision for a lamp's depths from 1 to 1024",
          parts=[Part("a step just below 1024 is", "m", lambda r: r.worked_out("step_of_floats_below_1024"), 0, 0.001)],
          why="Metres as they are, not scaled to 0 to 1."),
    Claim("2005-depth-per-vertex", HOLDS,
          "Depth may be worked out per vertex instead of per pixel",
          parts=[Part("interpolated z errs by", "m", lambda r: r.worked_out("error_of_clip_depth_m"), 0, 1e-12)],
          why="Clip-space z is affine in the point. Distance from the lamp is not (2011-vertex-distance)."),
    Claim("2005-pcf-smooth", FAILS,
          "Nine comparisons averaged smooth jagged edges",
          commands=[HARD_512,
                    HARD_4096,
                    "gnomon render spotlit --preset plain --camera stage --light gear --mask --filter pcf --set pcf.kernel=3x3-box "
                    "--map-size 512 --size 320x180 -o box_512.png",
                    "gnomon render spotlit --preset plain --camera stage --light gear --mask --filter pcf --set pcf.kernel=3x3-box "
                    "--map-size 4096 --size 320x180 -o box_4096.png",
                    COARSE_AND_FINE,
                    "gnomon metrics box_512.png box_4096.png --json"],
          parts=[Part("what coarse texels change, rmse,", "of what they change of hard shadows",
                      lambda r: r.number_over("/error/rmse", 5, 4), 0, 0.25)],
          why="Nine points of equal weight make steps of a ninth, each as long as a texel. As published they are one point nearly "
              "everywhere (2005-published-taps)."),
    Claim("2005-published-taps", FAILS,
          "The nine published taps are the texel under test and the eight around it",
          parts=[Part("10 m from the lamp they are", "texels apart", lambda r: r.worked_out("published_taps_apart_at_10_m"), 0.9, 1.1)],
          why="The offset is added before the division by w. So all nine are in one texel nearly everywhere."),
    Claim("2005-gaussian", FAILS,
          "The published fifteen taps are a Gaussian blur",
          parts=[Part("their weights sum to", "", lambda r: r.worked_out("published_blur_sum"), 0.99, 1.01),
                 Part("the right side weighs", "times the left", lambda r: r.worked_out("published_blur_sides"), 0.99, 1.01),
                 Part("their centre is off by", "px", lambda r: r.worked_out("published_blur_centre_px"), -0.01, 0.01)],
          why="Seven odd places, each side weighed for another place, and the middle by another width. Shadows get lighter, are cut off "
              "at white, and move."),
    Claim("2005-blur-edges", HOLDS,
          "Blurring the mask in screen space removes the aliasing of edges",
          commands=[HARD_512,
                    HARD_4096,
                    BLURRED,
                    "gnomon render spotlit --preset plain --camera stage --light gear --mask --filter pcf --set pcf.kernel=3x3-projected "
                    "--soften blur --set soften.edges=plain --set soften.taps=published --map-size 4096 --size 320x180 -o blur_4096.png",
                    COARSE_AND_FINE,
                    "gnomon metrics blur_512.png blur_4096.png --json"],
          parts=[Part("what coarse texels change, rmse,", "of what they change of hard shadows",
                      lambda r: r.number_over("/error/rmse", 5, 4), 0, 0.25)],
          why="As published: nine comparisons, a blur over silhouettes, and the article's taps. No steps are seen. Edges that lie "
              "elsewhere are left."),
    Claim("2005-blur-memory", PARTLY,
          "Screen and blur buffers are common to all lights, so many lights take little memory",
          commands=["gnomon bench planes --preset plain --camera side --partition cube --point=-3,3,-2,20 --size 160x90 --map-size 64 "
                    "--repetitions 1 --warmup 0 --techniques hard+blur",
                    "gnomon bench planes --preset plain --camera side --partition cube --point=-3,3,-2,20,-1,3,-2,20,1,3,-2,20 --size "
                    "160x90 --map-size 64 --repetitions 1 --warmup 0 --techniques hard+blur",
                    "gnomon bench planes --preset plain --camera side --partition cube --point=-3,3,-2,20,-1,3,-2,20,1,3,-2,20,3,3,-2,"
                    "20,-3,3,1,20,-1,3,1,20,1,3,1,20,3,3,1,20 --size 160x90 --map-size 64 --repetitions 1 --warmup 0 --techniques "
                    "hard+blur"],
          parts=[Part("the blur's image for eight lamps is", "times that for three",
                      lambda r: r.of("hard+blur", SCREEN_BLUR, 2) / r.of("hard+blur", SCREEN_BLUR, 1), 0, 1.1),
                 Part("that for three is", "times that for one",
                      lambda r: r.of("hard+blur", SCREEN_BLUR, 1) / r.of("hard+blur", SCREEN_BLUR), 0, 1.1),
                 Part("the screen's buffer, our mask, for eight is", "times that for one",
                      lambda r: r.of("hard+blur", MASK, 2) / r.of("hard+blur", MASK), 0, 1.1)],
          quick=False,
          why="The blur's image is one layer of the mask, which has a channel for one light and four for more. The mask has a layer for "
              "every four, because all lights are shaded from it at once; the article draws light by light."),
    Claim("2005-blur-cost", HOLDS,
          "It is a bit fill-rate intensive",
          commands=[SOFTENED_TIMES],
          parts=[Part("a frame takes", "times that without", lambda r: r.ratio("pcf+blur", "pcf", "/time_ms/frame"), 1.02, 1.6)],
          quick=False,
          why="With three lamps. Under one sun the blur is several times the work of the mask itself."),
    Claim("2005-blur-half", HOLDS,
          "Smaller blur buffers cut that, for little quality",
          commands=[SOFTENED_TIMES,
                    BLURRED,
                    "gnomon render spotlit --preset plain --camera stage --light gear --mask --filter pcf --set pcf.kernel=3x3-projected "
                    "--soften none --map-size 512 --size 320x180 -o unblurred.png",
                    "gnomon render spotlit --preset plain --camera stage --light gear --mask --filter pcf --set pcf.kernel=3x3-projected "
                    "--soften blur --set soften.edges=plain --set soften.taps=published --set soften.size=half --map-size 512 --size "
                    "320x180 -o half.png",
                    "gnomon metrics half.png blur_512.png --json",
                    "gnomon metrics unblurred.png blur_512.png --json"],
          parts=[Part("half the size takes", "of the blur's time",
                      lambda r: r.pass_ms("pcf+blur+soften.size=half", "soften") / r.pass_ms("pcf+blur", "soften"), 0, 0.4),
                 Part("it differs from full size, rmse, by", "of what the blur changes",
                      lambda r: r.number_over("/error/rmse", 4, 5), 0, 0.25)],
          quick=False,
          why="A quarter of the pixels, and reading them back by depth and normal."),
    Claim("2005-blur-volumes", HOLDS,
          "The blur works on shadow volumes too",
          commands=["gnomon render planes --preset plain --camera side --mask --filter volumes --set volumes.open=skip --size 320x180 -o "
                    "volumes.png",
                    "gnomon render planes --preset plain --camera side --mask --filter volumes --set volumes.open=skip --soften blur "
                    "--set soften.edges=plain --set soften.taps=published --size 320x180 -o volumes_blur.png",
                    "gnomon render planes --preset plain --camera side --mask --filter hard --map-size 4096 --size 320x180 -o map.png",
                    "gnomon render planes --preset plain --camera side --mask --filter hard --map-size 4096 --soften blur --set "
                    "soften.edges=plain --set soften.taps=published --size 320x180 -o map_blur.png",
                    "gnomon metrics volumes_blur.png volumes.png --json",
                    "gnomon metrics map_blur.png map.png --json"],
          parts=[Part("it changes the mask of volumes, rmse, by", "times what it changes that of a map",
                      lambda r: r.number_over("/error/rmse", 4, 5), 0.8, 1.25)],
          why="It blurs whatever mask there is."),
    Claim("2005-volumes-accurate", HOLDS,
          "Shadow volumes are pixel-accurate and have no aliasing",
          commands=[BOX],
          parts=[Part("rmse", "", lambda r: r.of("volumes+volumes.open=skip", "/error/rmse"), 0, 0.01)],
          why="One pixel errs, at an edge, where a ray and a rasteriser round another way."),
    Claim("2005-volumes-cost", HOLDS,
          "but depend heavily on geometry and fill rate",
          commands=[TIMES_AT_CAMP, TIMES_OF_BOX],
          parts=[Part("at camp, fragments drawn", "times those of hard",
                      lambda r: r.ratio("volumes+volumes.open=skip", "hard", "/counters/fragment_invocations"), least=1.5),
                 Part("maps and mask take", "times as long",
                      lambda r: r.shadow_ms("volumes+volumes.open=skip") / r.shadow_ms("hard"), least=1.1),
                 Part("on planes, of one box,", "times as long",
                      lambda r: r.shadow_ms("volumes+volumes.open=skip", 1) / r.shadow_ms("hard", 1), 0, 0.75)],
          quick=False,
          why="833 volumes at camp, though what is open casts nothing. Of one box they are the cheaper way."),
])
