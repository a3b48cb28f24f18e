# SPDX-License-Identifier: Apache-2.0
"""What P. Fortier claims of shadow maps under a sun that moves."""

from claim_tables import FAILS, HOLDS, Claim, Document, Part

PAN_OF_PLANES = ("gnomon compare planes --preset plain --camera side --path pan --frames 0-5 --size 240x135 --truth hard --map-size 512 "
                 "--techniques hard,hard+snap")
# The camera pans as ever while the world's time hardly goes on.
PAN_OF_MEADOW = ("gnomon compare sundial --preset plain --camera meadow --sun 0.4,-0.8,0.5 --path pan --frames 0-3 --fps 10000 --set "
                 "path.speed=333 --size 192x108 --truth hard --map-size 1024 --techniques hard,hard+snap")
# A camera that pans while the scene's time goes on: under a sun that stands, and under the scene's own.
PAN_UNDER_STILL_SUN = ("gnomon compare sundial --preset plain --camera meadow --sun 0.4,-0.8,0.5 --time 120 --path pan --frames 0-9 "
                       "--fps 10 --size 256x144 --truth hard --map-size 1024 --techniques pcf,pcf+snap")
PAN_UNDER_MOVING_SUN = ("gnomon compare sundial --preset plain --camera meadow --light sun --time 120 --path pan --frames 0-9 --fps 10 "
                        "--size 256x144 --truth hard --map-size 1024 --techniques pcf+snap")
SUN_OVER_MEADOW = ("gnomon compare sundial --preset plain --camera meadow --light sun --time 120 --path day --frames 0-19 --fps 10 "
                   "--size 256x144 --samples 256 --map-size 1024 --techniques pcf,pcf+step-jump,pcf+step-band,pcf+step-blend")
# As the document has it: nine samples, two depths in the channels of one texture, nothing kept, 1280x720.
SUN_TIMES = ("gnomon bench --preset icefall-2010 --time 300 --path day --frames 0-19 --fps 15 --size 1280x720 --set keep-still=never "
             "--techniques pcf+snap,pcf+step-band,pcf+step-blend,pcf+step-alternate")
TWO_IN_ONE = ("gnomon compare sundial --preset plain --camera meadow --size 64x36 --truth hard --repetitions 1 --warmup 0 --map-size "
              "1024 --techniques pcf+step-blend+map-format=rgba8,pcf+step-blend+map-format=r32f")

DOCUMENT = Document("2010", "P. Fortier, \"Shadow maps for moving light sources\", IceFall Games", [
    Claim("2010-snap", HOLDS,
          "A map that moves by whole texels does not swim when the camera moves",
          commands=[PAN_OF_PLANES, PAN_OF_MEADOW],
          parts=[Part("shimmer left on planes", "of that of a free map",
                      lambda r: r.ratio("hard+snap", "hard", "/stability/shimmer"), 0, 0.05),
                 Part("on a meadow, its time standing still,", "of it",
                      lambda r: r.ratio("hard+snap", "hard", "/stability/shimmer", 1), 0, 0.05)],
          why="Texels stay where they are in the world. What moves there flickers as before: trees, somebody who walks, and the scene's "
              "own sun, which is 2010-sun-swims."),
    Claim("2010-sun-swims", HOLDS,
          "The swimming comes back as soon as the sun moves",
          commands=[PAN_UNDER_STILL_SUN, PAN_UNDER_MOVING_SUN],
          parts=[Part("under a sun that stands, shimmer of a snapped map", "of that of a free one",
                      lambda r: r.ratio("pcf+snap", "pcf", "/stability/shimmer"), 0, 0.05),
                 Part("under one that moves", "of it",
                      lambda r: r.of("pcf+snap", "/stability/shimmer", 1) / r.of("pcf", "/stability/shimmer"), least=0.8)],
          why="The map turns with the light, and no whole texels undo that."),
    Claim("2010-jump", HOLDS,
          "To move the sun seldom makes a jump that is seen; to blend two positions does not",
          commands=[SUN_OVER_MEADOW],
          parts=[Part("the jump's worst frame changes", "times as much as a free map's",
                      lambda r: r.ratio("pcf+step-jump", "pcf", "/stability/pop"), least=2),
                 Part("the blend's", "of the jump's", lambda r: r.ratio("pcf+step-blend", "pcf+step-jump", "/stability/pop"), 0, 0.1)],
          quick=False,
          why="Half a degree at once, or over the twenty frames between."),
    Claim("2010-band-looks", HOLDS,
          "A band that sweeps over the screen looks less good than the full blend",
          commands=[SUN_OVER_MEADOW],
          parts=[Part("shimmer of the band", "times that of the blend",
                      lambda r: r.ratio("pcf+step-band", "pcf+step-blend", "/stability/shimmer"), least=1.1),
                 Part("its worst frame changes", "times as much",
                      lambda r: r.ratio("pcf+step-band", "pcf+step-blend", "/stability/pop"), least=1.1)],
          quick=False,
          why="What a band changes at a place it changes within a quarter of the time."),
    Claim("2010-band-cost", FAILS,
          "The band takes 4 ms more than a single map's 48 ms (+8 %), on the Xbox 2.5 more than 26 (+10 %)",
          commands=[SUN_TIMES],
          parts=[Part("a frame takes", "times one of a map that follows the sun",
                      lambda r: r.ratio("pcf+step-band", "pcf+snap", "/time_ms/frame"), 1.04, 1.2)],
          quick=False,
          why="Nothing is kept here, as in the document: every caster is drawn twice in every frame, which takes a software rasteriser a "
              "fifth of its time. Where maps are kept between steps, as they are by default, a frame takes less than with one map."),
    Claim("2010-blend-cost", HOLDS,
          "The full blend takes 13 ms more than 48 (+27 %), on the Xbox 9.5 more than 26 (+37 %)",
          commands=[SUN_TIMES],
          parts=[Part("a frame takes", "times one of a map that follows the sun",
                      lambda r: r.ratio("pcf+step-blend", "pcf+snap", "/time_ms/frame"), 1.2, 1.5)],
          quick=False,
          why="Casters and samples are twice as many all over the picture."),
    Claim("2010-alternate", HOLDS,
          "To draw the two positions in alternate frames would be cheaper than the full blend, and take one more target as large as the "
          "screen",
          commands=[SUN_TIMES],
          parts=[Part("a frame takes", "of the blend's",
                      lambda r: r.ratio("pcf+step-alternate", "pcf+step-blend", "/time_ms/frame"), 0, 0.95),
                 Part("it draws", "of the blend's triangles",
                      lambda r: r.ratio("pcf+step-alternate", "pcf+step-blend", "/counters/primitives"), 0, 0.75),
                 Part("memory", "times the blend's", lambda r: r.ratio("pcf+step-alternate", "pcf+step-blend", "/memory_bytes"), least=1)],
          quick=False,
          why="It draws one map a frame instead of two, and keeps what was shown in the frame before."),
    Claim("2010-two-in-one", HOLDS,
          "Two maps in the channels of one texture save memory",
          commands=[TWO_IN_ONE],
          parts=[Part("two in a texture take", "of two of 32 bits",
                      lambda r: r.ratio("pcf+step-blend+map-format=rgba8", "pcf+step-blend+map-format=r32f", "/map/bytes"), 0, 0.55),
                 Part("with all that is needed", "of it",
                      lambda r: r.ratio("pcf+step-blend+map-format=rgba8", "pcf+step-blend+map-format=r32f", "/memory_bytes"), 0, 0.95)],
          why="Colour targets, each with a depth buffer to be drawn with. Two depth maps of 16 bits take less (`map-format=d16`), and "
              "are what to use."),
    Claim("2010-two-bytes", HOLDS,
          "Depth fits two channels of 8 bits",
          parts=[Part("the published code errs by", "steps of 16 bits", lambda r: r.worked_out("error_of_published_bytes"), 0, 0.55),
                 Part("ours by", "steps", lambda r: r.worked_out("error_of_bytes"), 0, 0.55)],
          why="The published one shares a value between neighbours: 65,026 depths in place of 65,536."),
])
