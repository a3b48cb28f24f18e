#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What filterable maps win and lose against PCF 3x3 of a d32f map, as Markdown on stdout.

usage: measure_filters.py [--tables LIST] [--only NAMES] [--filters NAMES] [--size WxH] [--samples N]
                          [--repetitions N] [--map-size N] GNOMON SHARED

GNOMON is the program, SHARED the folder that holds scenes/. The tables, of which --tables picks some:

bytes     each scene and filter at equal map bytes: sides of maps are chosen so that maps take what PCF's take
time      the same at equal time: sides of maps are chosen so that frames take what PCF's take, by straight lines
          between frames with maps of four sides; where even the smallest map is slower, it is that one
bleeding  light bleeding of the averaging filters, maps of equal bytes and blurs of as many texels, against both truths:
          vsm's, and that of others as a share of it. lvsm has two layers, by Lloyd relaxation and by hand, which is
          the best of nine splits; 4 and 8 layers have vsm's texels and so two and four times its bytes. pcf 7x7 of
          as many texels is there to tell apart what is no bleeding: edges put wrong by more than the class `edge` takes

--only and --filters name what to run, comma-separated: a scene whose name has one of the words, filters by label. A row
that is marked with (-) is nowhere better than PCF. A scene that is not there is named on stderr and left out, and the
exit status is then 1. Classes are mean squared errors in millionths; they add up to rmse squared. Frame times are
ratios to the frame without shadows of the same run; with --repetitions 1, which is no measurement, times are left out.
"""

import argparse
import functools
import math
import sys
from pathlib import Path

from measuring import cell, run

# Name, scene, options of its view, whether it is one of the scenes of overlapping casters.
VIEWS = [
    ("canopies, side", "canopies", ["--camera", "side", "--light", "sun"], True),
    ("canopies, top", "canopies", ["--camera", "top", "--light", "sun"], True),
    ("rts, camp", "rts", ["--camera", "camp"], True),
    ("rts, unit", "rts", ["--camera", "unit"], False),
    ("rts, map", "rts", ["--camera", "map"], False),
    ("kenney_city", "scenes/kenney_city/kenney_city.gltf",
     ["--eye", "3,3.2,6.5", "--target", "2.5,0.3,1.5", "--fov", "45", "--sun", "0.5826,-0.766,-0.2717"], True),
    ("truck_town", "scenes/truck_town/truck_town.gltf",
     ["--eye", "0,22,45", "--target", "2,8,5", "--fov", "50", "--sun", "0.4967,-0.819,0.2868"], False),
    ("spotlit, stage", "spotlit", ["--camera", "stage", "--light-size", "0.2"], False),
    # Clouds over a meadow, trees and the foot of a mountain.
    ("terrain, clouds", "scenes/terrain_lowpoly/terrain.glb",
     ["--eye", "2,9,12", "--target=-1,0,2", "--fov", "45", "--sun=-0.4,-1,0.5"], True),
    # A roof and a tree over the garden.
    ("house_leaves, garden", "scenes/house_leaves/house.glb",
     ["--eye", "0.35,0.35,0.4", "--target", "0.03,0.05,0", "--fov", "45", "--sun", "0.6,-1,0.3"], True),
    # Leaves and eaves at all heights over a porch.
    ("house_leaves, porch", "scenes/house_leaves/house.glb",
     ["--eye", "0.1,0.25,0.4", "--target=-0.02,0.05,0", "--fov", "45", "--sun", "0.3,-1,-0.3"], True),
    # Sails, yards and ropes at all heights over the deck.
    ("dutch_ship, deck", "scenes/dutch_ship/dutch_ship_medium_1k.gltf",
     ["--eye=-9,13,8", "--target", "1,3,0", "--fov", "45", "--sun=-0.2,-1,0.3", "--ground", "off"], True),
    # Arches over rails, walls and stairs.
    ("zdm2, arches", "scenes/zdm2/zdm2.glb",
     ["--override-material", "diffuse", "--eye", "45,30,25", "--target", "20,5,-15", "--fov", "40",
      "--sun=-0.5,-0.8,-0.6", "--ground", "off"], True),
]
# Label and technique. The first is what all others are held against.
FILTERS = [
    ("pcf 3x3", "pcf+pcf.kernel=3x3+map-format=d32f"),
    ("hard", "hard+map-format=d32f"),
    ("vsm", "vsm+map-format=rg32f"),
    ("lvsm", "lvsm+map-format=rgba16"),
    ("esm", "esm+map-format=r32f"),
    ("evsm4", "evsm+map-format=rgba32f"),
    ("evsm2", "evsm+map-format=rg32f"),
    ("msm", "msm+map-format=rgba16"),
]
# Those of the table of bleeding. The first is what others are a share of.
LAYERED = "lvsm+map-format=rgba16+lvsm.layers="
BLEEDING = [
    ("vsm", "vsm+map-format=rg32f"),
    ("lvsm by gaps", f"{LAYERED}2+lvsm.placement=gaps"),
    ("lvsm by Lloyd", f"{LAYERED}2+lvsm.placement=lloyd"),
    ("evsm4", "evsm+map-format=rgba32f"),
    ("evsm2", "evsm+map-format=rg32f"),
    ("msm", "msm+map-format=rgba16"),
]
SPLITS = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9]
CLASSES = ["edge", "acne", "detached", "bleeding", "terminator"]
SMALLEST_MAP, LARGEST_MAP = 128, 8192


class Runner:
    def __init__(self, options):
        self.options = options

    def run(self, command, scene, view, arguments):
        return run(self.options.gnomon, command, [scene, *view, *arguments, "--size", self.options.size])

    def compare(self, scene, view, techniques, truth, repetitions):
        """The whole result, its techniques best first; `truth` is "hard" or "area"."""
        if truth == "hard" and "--light-size" in view:  # means something to area truth only
            at = view.index("--light-size")
            view = view[:at] + view[at + 2:]
        arguments = ["--truth", truth, "--techniques", ",".join(techniques), "--repetitions", str(repetitions),
                     "--warmup", "1" if repetitions > 1 else "0"]
        if truth == "area":
            arguments += ["--samples", self.options.samples]
        return self.run("compare", scene, view, arguments)

    def frames(self, scene, view, techniques):
        """Median frames of techniques that take turns in one process, in their order."""
        drop = ["--light-size", "--sun-angle", "--light"]
        view = [o for i, o in enumerate(view) if o not in drop and (i == 0 or view[i - 1] not in drop)]
        whole = self.run("bench", scene, view, ["--techniques", ",".join(techniques), "--repetitions",
                                                str(max(3, self.options.repetitions)), "--warmup", "1"])
        return [result["frame_ratio"] for result in in_order(whole, techniques)]


def sized(technique, side):
    return f"{technique}+map-size={side}"


def even(side):
    return int(min(max(2 * round(side / 2), SMALLEST_MAP), LARGEST_MAP))


def in_order(whole, techniques):
    """The results of `techniques`, which a result names in its own shortened way: one by one by what they ask for."""
    left = list(whole["results"])
    found = []
    for technique in techniques:
        wanted = [part.split("=", 1) for part in technique.split("+")]
        for result in left:
            settings = result["settings"]
            if all(str(settings.get("filter" if len(w) == 1 else w[0])) in (w[-1], f"[{w[-1]}]") or
                   len(w) == 2 and number(settings.get(w[0])) == number(w[1]) for w in wanted):
                found.append(result)
                left.remove(result)
                break
        else:
            raise SystemExit(f"no result for {technique}")
    return found


def number(value):
    if isinstance(value, list):
        return [number(v) for v in value] if len(value) != 1 else number(value[0])
    try:
        return float(value)
    except (TypeError, ValueError):
        return value


@functools.cache
def bytes_per_square(runner, techniques):
    """Bytes of the map, mip levels included, per square of its side. Does not depend on the scene, so one run does."""
    asked = [sized(t, 512) for t in techniques]
    results = in_order(runner.compare("planes", ["--light", "sun"], asked, "hard", 1), asked)
    return [result["map"]["bytes"] / 512.0 ** 2 for result in results]


def sides_of_equal_bytes(runner, techniques):
    per_square = bytes_per_square(runner, tuple(techniques))
    return [even(runner.options.map_size * math.sqrt(per_square[0] / b)) for b in per_square]


def sides_of_equal_time(runner, scene, view, techniques):
    """Sides at which frames should take what the first technique's take."""
    largest = runner.options.map_size
    probes = sorted({even(largest * factor) for factor in [0.0, 0.5, 1.0, 1.5]})
    asked = [sized(t, side) for t in techniques[1:] for side in probes]
    pcf, *frames = runner.frames(scene, view, [sized(techniques[0], largest), *asked])
    rows = [frames[i:i + len(probes)] for i in range(0, len(frames), len(probes))]
    return [largest] + [side_where(pcf, probes, row) for row in rows]


def side_where(wanted, sides, frames):
    """Frames grow with a map's texels: the largest side whose frame is `wanted`, linear in the side's square."""
    for i in range(len(sides) - 1, 0, -1):
        if frames[i - 1] <= wanted < frames[i]:
            part = (wanted - frames[i - 1]) / (frames[i] - frames[i - 1])
            return even(math.sqrt((1.0 - part) * sides[i - 1] ** 2 + part * sides[i] ** 2))
    return sides[-1] if frames[-1] <= wanted else sides[0]


def numbers_of(result, timed):
    """All that can be better or worse, the smaller the better."""
    error = result["error"]
    return [error["rmse"], error["flip"], *(error[name] for name in CLASSES), result["map"]["bytes"],
            *([result["frame_ratio"]] if timed else [])]


def nowhere_better(result, reference, timed):
    tolerances = [1.0] * 6 + [0.97, 0.9]  # equal bytes and equal time are no win
    return all(own is None or other is None or own >= other * t
               for own, other, t in zip(numbers_of(result, timed), numbers_of(reference, timed), tolerances))


def filter_rows(results, labels, sides, timed):
    times = ["maps ms", "filter ms", "mask ms", "frame ratio"] if timed else []
    columns = ["filter", "map", "MiB", "all MiB", "rmse", "flip", *CLASSES, *times]
    lines = [f"| {' | '.join(columns)} |", "|---" * len(columns) + "|"]
    for result, label, side in zip(results, labels, sides):
        error, time = result["error"], result["time_ms"]
        mark = " (-)" if result is not results[0] and nowhere_better(result, results[0], timed) else ""
        cells = [f"{label}{mark}", str(side), cell(result["map"]["bytes"] / 2 ** 20, 1),
                 cell(result["memory_bytes"] / 2 ** 20, 1), cell(error["rmse"]), cell(error["flip"], 3),
                 *(cell(1e6 * error[name], 1 if error[name] < 1e-5 else 0) for name in CLASSES)]
        if timed:
            cells += [*(cell(time[stage], 1) for stage in ["maps", "filter", "mask"]), cell(result["frame_ratio"], 2)]
        lines.append(f"| {' | '.join(cells)} |")
    return lines


def filters_table(runner, view, labels, equal):
    name, scene, options, _ = view
    techniques = [dict(FILTERS)[label] for label in labels]
    sides = (sides_of_equal_bytes(runner, techniques) if equal == "bytes" else
             sides_of_equal_time(runner, scene, options, techniques))
    asked = [sized(t, s) for t, s in zip(techniques, sides)]
    whole = runner.compare(scene, options, asked, "area", runner.options.repetitions)
    results = in_order(whole, asked)
    title = [f"### {name}, equal {equal}", "", f"{whole['pixels']['counted']} pixels count; the truth's own noise is "
             f"{whole['truth']['standard_error']:.4f}.", ""]
    return "\n".join(title + filter_rows(results, labels, sides, runner.options.repetitions > 1)) + "\n"


def bleeding_table(runner, views):
    """Everything is run with the blur's compute shaders, which spares the trial of which are faster."""
    sides = sides_of_equal_bytes(runner, [FILTERS[0][1], *(technique for _, technique in BLEEDING)])[1:]
    own = [sized(technique, side) for (_, technique), side in zip(BLEEDING, sides)]
    side = sides[0]
    more = [sized(f"{LAYERED}{layers}+lvsm.placement=gaps", side) for layers in [4, 8]]
    by_hand = [sized(f"{LAYERED}2+lvsm.splits={split}", side) for split in SPLITS]
    floor = [sized("pcf+pcf.kernel=7x7", side)]
    asked = own + more + floor + by_hand
    labels = [f"{label} {s}" for (label, _), s in zip(BLEEDING[1:], sides[1:])]
    labels = [*labels[:2], f"lvsm by hand {side}", "split", *labels[2:], f"lvsm 4 layers {side}", f"8 layers {side}",
              f"pcf 7x7 {side}"]
    lines = ["### Bleeding", "", f"| scene | truth | vsm {side} | " + " | ".join(labels) + " |",
             "|---|---|" + "---|" * (len(labels) + 1)]
    for name, scene, options, _ in views:
        for truth in ["area", "hard"]:
            whole = runner.compare(scene, options + ["--set", "blur.path=compute"], asked, truth, 1)
            value = [r["error"]["bleeding"] for r in in_order(whole, asked)]
            vsm, split_values = value[0], value[-len(SPLITS):]
            best = min(split_values)
            share = [f"{100.0 * v / vsm:.0f} %" if vsm else "–" for v in value]
            best_share = f"{100.0 * best / vsm:.0f} %" if vsm else "–"
            cells = [*share[1:3], best_share, f"{SPLITS[split_values.index(best)]}", *share[3:len(own) + 3]]
            lines.append(f"| {name} | {truth} | {vsm:.2e} | " + " | ".join(cells) + " |")
            print(lines[-1], file=sys.stderr, flush=True)
    return "\n".join(lines) + "\n"


def parse():
    parser = argparse.ArgumentParser()
    parser.add_argument("--tables", default="bytes,time,bleeding")
    parser.add_argument("--only", default="")
    parser.add_argument("--filters", default=",".join(label for label, _ in FILTERS))
    parser.add_argument("--size", default="1280x720")
    parser.add_argument("--samples", default="256")
    parser.add_argument("--repetitions", type=int, default=5)
    parser.add_argument("--map-size", type=int, default=2048)
    parser.add_argument("gnomon")
    parser.add_argument("shared", type=Path)
    options = parser.parse_args()
    labels = [FILTERS[0][0]] + [f for f in options.filters.split(",") if f != FILTERS[0][0]]
    unknown = [f for f in labels if f not in dict(FILTERS)]
    tables = options.tables.split(",")
    if unknown or not set(tables) <= {"bytes", "time", "bleeding"}:
        parser.error(f"unknown: {unknown or tables}; filters are {', '.join(label for label, _ in FILTERS)}")
    return options, labels, tables


def main() -> int:
    options, labels, tables = parse()
    runner = Runner(options)
    views, missing = [], False
    for name, scene, view, overlapping in VIEWS:
        if options.only and not any(word.strip() in name for word in options.only.split(",")):
            continue
        if "/" in scene:
            file = options.shared / scene
            if not file.exists():
                print(f"{name}: {file} is not there", file=sys.stderr)
                missing = True
                continue
            scene = str(file)
        views.append((name, scene, view, overlapping))
    for equal in [t for t in ["bytes", "time"] if t in tables]:
        for view in views:
            print(filters_table(runner, view, labels, equal), flush=True)
    if "bleeding" in tables:
        print(bleeding_table(runner, [v for v in views if v[3]]), flush=True)
    return 1 if missing else 0


if __name__ == "__main__":
    sys.exit(main())
