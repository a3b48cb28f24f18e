# SPDX-License-Identifier: Apache-2.0
"""Claims of the documents that this project began with, as data: what is claimed, how it is tried, when it holds. Here is what
their tables share; each table is a module, and tools/claims.py tries them."""

from collections.abc import Callable, Sequence
from math import inf
from typing import Any, NamedTuple

HOLDS, PARTLY, FAILS = "holds", "partly", "does not hold"


class Part(NamedTuple):
    """One number that a claim is held against. It holds from `least` to `most`, both included; a NaN never does."""
    what: str  # "acne with a least variance of 0.0001"
    unit: str  # "of that without"
    figure: Callable[[Any], float]  # the number from all that the claim's commands have found, a Runs of tools/claims.py
    least: float = -inf
    most: float = inf


class Claim(NamedTuple):
    id: str  # the document's year and a name: "2006-duel"
    verdict: str  # that is recorded: all parts hold, some, or none
    claim: str  # in our own words
    parts: Sequence[Part]  # one at least
    why: str  # one sentence or two
    # One types these to see the numbers. Without any the figures are worked out from the library's own arithmetic.
    commands: Sequence[str] = ()
    quick: bool = True  # takes seconds and depends on no clock


class Document(NamedTuple):
    year: str
    source: str  # author and title
    claims: Sequence[Claim]


# Commands that several documents' claims name.
# Roofs over each other: what bleeds.
CANOPIES = ("gnomon compare canopies --preset plain --camera side --size 320x180 --samples 64 --repetitions 1 --warmup 0 --map-size 512 "
            "--techniques hard,pcf,vsm,lvsm,lvsm+lvsm.placement=uniform,vsm+bleeding.linstep=0.3,vsm+bleeding.power=1.3,esm")
# Tents, units and foliage on open ground, against a sun's disc.
CAMP = ("gnomon compare rts --preset plain --camera camp --size 320x180 --samples 64 --repetitions 1 --warmup 0 --map-size 512 "
        "--techniques hard+bias=none,vsm,vsm+bias=none,vsm+bias=none+map-format=rg16+msaa=1+blur=none+min-variance=0,"
        "vsm+bias=none+map-format=rg16+msaa=1+blur=none+min-variance=0.0001,esm")
# The same against the sun's centre: bias, and depth aliasing of warps with one bias for all.
CAMP_OF_POINT = ("gnomon compare rts --preset plain --camera camp --size 320x180 --truth hard --repetitions 1 --warmup 0 --map-size 512 "
                 "--techniques hard,hard+bias=none,hard+bias=none+map-format=d16,hard+bias=none+bias.constant=3,"
                 "hard+bias=none+bias.constant=0.3,hard+lispsm+bias=none+bias.constant=0.3,"
                 "hard+lispsm-simple+bias=none+bias.constant=0.3,hard+tsm+bias=none+bias.constant=0.3")
# A lamp over a stage.
STAGE = ("gnomon compare spotlit --preset plain --camera stage --light-size 0.2 --size 320x180 --samples 64 --repetitions 1 --warmup 0 "
         "--map-size 512 --techniques vsm,vsm+depth-metric=z-over-w,esm,vsm+map-format=rg16f,vsm+map-format=rg16f+depth-remap=1")
# Closed bodies nearby: which faces a map holds.
CLOSE = ("gnomon compare spotlit --preset plain --camera close --size 320x180 --truth hard --repetitions 1 --warmup 0 --map-size 512 "
         "--techniques hard+bias=none,hard+bias=none+caster-faces=midpoint,vsm+bias=none,vsm+bias=none+caster-cull=front")
# One closed box, by volumes and by a map.
BOX = ("gnomon compare planes --preset plain --camera side --size 320x180 --truth hard --repetitions 1 --warmup 0 --map-size 512 "
       "--techniques hard,volumes+volumes.open=skip")
# Many casters, and one; by volumes and by a map.
TIMES_AT_CAMP = ("gnomon bench rts --preset plain --camera camp --size 640x360 --map-size 512 --repetitions 3 --warmup 1 --techniques "
                 "hard,volumes+volumes.open=skip")
TIMES_OF_BOX = ("gnomon bench planes --preset plain --camera side --size 640x360 --map-size 512 --repetitions 3 --warmup 1 --techniques "
                "hard,volumes+volumes.open=skip")
# Times of frames of which nothing is kept.
TIMES = ("gnomon bench spotlit --preset plain --camera stage --size 640x360 --map-size 512 --repetitions 11 --warmup 1 --techniques "
         "hard,hard+caster-faces=midpoint,pcf+pcf.kernel=7x7,vsm,esm")
TIMES_OF_TAPS = ("gnomon bench rts --preset plain --camera camp --size 640x360 --map-size 1024 --repetitions 11 --warmup 1 --techniques "
                 "pcf,pcf+pcf.kernel=7x7,vsm+msaa=1+blur=none+map-sampling=nearest,vsm+blur=none+map-sampling=anisotropic")