#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What filterable maps win and lose against PCF 3x3 of a d32f map, as Markdown on stdout.

usage: measure_filters.py [--tables LIST] [--only NAMES] [--filters NAMES] [--size WxH] [--samples N]
                          [--repetitions N] [--map-size N] GNOMON SHARED

GNOMON is the program, SHARED the folder that holds scenes/. The tables, of which --tables picks some:

bytes     each scene and filter at equal map bytes: sides of maps are chosen so that maps take what PCF's take
time      the same at equal time: sides of maps are chosen so that frames take what PCF's take, within 10 %; where
          even the smallest map is slower, it is that one
bleeding  light bleeding of the averaging filters, maps of equal bytes and equal blur, against both truths, and as a
          share of vsm's. lvsm has two layers, by Lloyd relaxation and by hand; by hand is the best of nine splits

--only and --filters name what to run, comma-separated: a scene whose name has one of the words, filters by label. A row
that is marked with (-) is nowhere better than PCF. A scene that is not there is named on stderr and left out, and the
exit status is then 1. Frame times are ratios to the frame without shadows of the same run.
"""

import argparse
import json
import math
import subprocess
import sys
from pathlib import Path

# Name, scene, options of its view, whether it is one of the scenes of overlapping casters.
VIEWS = [
    ("canopies, side", "canopies", ["--camera", "side", "--light", "sun"], True),
    ("canopies, top", "canopies", ["--camera", "top", "--light", "sun"], True),
    ("rts, camp", "rts", ["--camera", "camp"], True),
    ("rts, unit", "rts", ["--camera", "unit"], False),
    ("rts, map", "rts", ["--camera", "map"], False),
    ("kenney_city", "scenes/kenney_city/kenney_city.gltf",
     ["--eye", "3,3.2,6.5", "--target", "2.5,0.3,1.5", "--fov", "45", "--sun", "0.5826,-0.766,-0.2717"], False),
    ("truck_town", "scenes/truck_town/truck_town.gltf",
     ["--eye", "0,22,45", "--target", "2,8,5", "--fov", "50", "--sun", "0.4967,-0.819,0.2868"], False),
    ("spotlit, stage", "spotlit", ["--camera", "stage", "--light-size", "0.2"], False),
    # Sails and yards over the deck.
    ("dutch_ship, deck", "scenes/dutch_ship/dutch_ship_medium_1k.gltf",
     ["--eye=-9,13,8", "--target", "1,3,0", "--fov", "45", "--sun=-0.2,-1,0.3"], True),
    # A bridge over a cutting, trees over houses.
    ("truck_town, bridge", "scenes/truck_town/truck_town.gltf",
     ["--eye", "40,18,10", "--target", "14,4,8", "--fov", "50", "--sun", "0.8,-0.6,0.1"], True),
    # Clouds over trees and a mountain.
    ("terrain, clouds", "scenes/terrain_lowpoly/terrain.glb",
     ["--eye", "2,9,12", "--target=-1,0,2", "--fov", "45", "--sun=-0.1,-1,0.2"], True),
    # Leaves and eaves over a porch.
    ("house_leaves, porch", "scenes/house_leaves/house.glb",
     ["--eye", "0.1,0.25,0.4", "--target=-0.02,0.05,0", "--fov", "45", "--sun", "0.3,-1,-0.3"], True),
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
BLEEDING = ["vsm", "lvsm", "evsm4", "evsm2", "msm"]
SPLITS = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9]
CLASSES = ["edge", "acne", "detached", "bleeding"]
SMALLEST_MAP, LARGEST_MAP = 128, 8192


class Runner:
    def __init__(self, options):
        self.options = options

    def run(self, command, scene, view, arguments):
        line = [self.options.gnomon, command, scene, *view, *arguments, "--size", self.options.size, "--json", "-"]
        print(" ".join(line), file=sys.stderr)
        done = subprocess.run(line, capture_output=True, text=True)
        if done.returncode != 0:
            raise SystemExit(f"{' '.join(line)}: {done.stderr.strip()}")
        return json.loads(done.stdout)

    def compare(self, scene, view, techniques, truth, repetitions):
        """Results in the order of `techniques`; `truth` is "hard" or "area"."""
        if truth == "hard" and "--light-size" in view:  # means something to area truth only
            at = view.index("--light-size")
            view = view[:at] + view[at + 2:]
        arguments = ["--truth", truth, "--techniques", ",".join(techniques), "--repetitions", str(repetitions),
                     "--warmup", "1" if repetitions > 1 else "0"]
        if truth == "area":
            arguments += ["--samples", self.options.samples]
        whole = self.run("compare", scene, view, arguments)
        # They come best first; what was asked for is told by the settings, which hold all of them.
        by_name = {}
        for result in whole["results"]:
            by_name.setdefault(result["technique"], result)
        return whole, by_name

    def frames(self, scene, view, techniques):
        """Median frames of techniques that take turns in one process."""
        drop = ["--light-size", "--sun-angle", "--light"]
        view = [o for i, o in enumerate(view) if o not in drop and (i == 0 or view[i - 1] not in drop)]
        whole = self.run("bench", scene, view, ["--techniques", ",".join(techniques), "--repetitions",
                                                str(max(3, self.options.repetitions)), "--warmup", "1"])
        return [result["time_ms"]["frame"] for result in whole["results"]]


def sized(technique, side):
    return f"{technique}+map-size={side}"


def even(side):
    return int(min(max(2 * round(side / 2), SMALLEST_MAP), LARGEST_MAP))


def in_order(whole, by_name, techniques, options):
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


def bytes_per_square(runner, techniques):
    """Bytes of the map, mip levels included, per square of its side. Does not depend on the scene."""
    whole, by_name = runner.compare("planes", ["--light", "sun"], [sized(t, 512) for t in techniques], "hard", 1)
    results = in_order(whole, by_name, [sized(t, 512) for t in techniques], runner.options)
    return [result["map"]["bytes"] / 512.0 ** 2 for result in results]


def sides_of_equal_bytes(runner, techniques):
    per_square = bytes_per_square(runner, techniques)
    return [even(runner.options.map_size * math.sqrt(per_square[0] / b)) for b in per_square]


def side_of_equal_time(runner, scene, view, reference, technique, start):
    """A side at which `technique` takes what `reference` takes within 10 %; halving on the logarithm of the side."""
    low, high, side = math.log2(SMALLEST_MAP), math.log2(LARGEST_MAP), start
    for _ in range(7):
        pcf, own = runner.frames(scene, view, [sized(reference, runner.options.map_size), sized(technique, side)])
        if abs(own / pcf - 1.0) <= 0.1 or high - low < 0.1:
            break
        if own > pcf:
            high = math.log2(side)
        else:
            low = math.log2(side)
        side = even(2.0 ** (0.5 * (low + high)))
        if side == start and high == low:
            break
    return side


def cell(value, digits=4):
    return "–" if value is None else f"{value:.{digits}f}"


def numbers_of(result):
    """All that can be better or worse, the smaller the better."""
    error = result["error"]
    return [error["rmse"], error["flip"], *(error[name] for name in CLASSES), result["frame_ratio"],
            result["map"]["bytes"]]


def nowhere_better(result, reference):
    tolerances = [1.0] * 6 + [0.9, 0.97]  # equal time and equal bytes are no win
    return all(own is None or other is None or own >= other * t
               for own, other, t in zip(numbers_of(result), numbers_of(reference), tolerances))


def filter_rows(results, labels, sides):
    lines = ["| filter | map | MiB | all MiB | rmse | flip | edge | acne | detached | bleeding | maps ms | filter ms | "
             "mask ms | frame ratio |", "|---|" + "---|" * 13]
    for result, label, side in zip(results, labels, sides):
        error, time = result["error"], result["time_ms"]
        mark = " (-)" if result is not results[0] and nowhere_better(result, results[0]) else ""
        classes = " | ".join(cell(error[name], 6) for name in CLASSES)
        lines.append(
            f"| {label}{mark} | {side} | {result['map']['bytes'] / 2 ** 20:.1f} | {result['memory_bytes'] / 2 ** 20:.1f} | "
            f"{cell(error['rmse'])} | {cell(error['flip'], 3)} | {classes} | {cell(time['maps'], 1)} | "
            f"{cell(time['filter'], 1)} | {cell(time['mask'], 1)} | {cell(result['frame_ratio'], 2)} |")
    return lines


def filters_table(runner, view, labels, equal):
    name, scene, options, _ = view
    techniques = [dict(FILTERS)[label] for label in labels]
    sides = sides_of_equal_bytes(runner, techniques)
    if equal == "time":
        sides = [runner.options.map_size] + [
            side_of_equal_time(runner, scene, options, techniques[0], technique, side)
            for technique, side in zip(techniques[1:], sides[1:])]
    asked = [sized(t, s) for t, s in zip(techniques, sides)]
    whole, by_name = runner.compare(scene, options, asked, "area", runner.options.repetitions)
    results = in_order(whole, by_name, asked, runner.options)
    title = [f"### {name}, equal {equal}", "", f"{whole['pixels']['counted']} pixels count; the truth's own noise is "
             f"{whole['truth']['standard_error']:.4f}.", ""]
    return "\n".join(title + filter_rows(results, labels, sides)) + "\n"


def bleeding_table(runner, views, labels):
    techniques = [dict(FILTERS)[label] for label in labels]
    sides = sides_of_equal_bytes(runner, [FILTERS[0][1], *techniques])[1:]
    side_of = dict(zip(labels, sides))
    hand = f"{dict(FILTERS)['lvsm']}+lvsm.layers=2"
    lines = ["### Bleeding", "", "| scene | truth | " + " | ".join(labels) + " | lvsm by hand | split | "
             "lvsm / vsm | by hand / vsm |", "|---|---|" + "---|" * (len(labels) + 4)]
    for name, scene, options, _ in views:
        for truth in ["area", "hard"]:
            asked = [sized(t, s) for t, s in zip(techniques, sides)]
            splits = [sized(f"{hand}+lvsm.splits={split}", side_of["lvsm"]) for split in SPLITS]
            whole, by_name = runner.compare(scene, options, asked, truth, 1)
            own = [r["error"]["bleeding"] for r in in_order(whole, by_name, asked, runner.options)]
            whole, by_name = runner.compare(scene, options, splits, truth, 1)
            by_hand = [r["error"]["bleeding"] for r in in_order(whole, by_name, splits, runner.options)]
            best = min(by_hand)
            vsm = own[labels.index("vsm")]
            share = lambda value: "–" if not vsm else f"{100.0 * value / vsm:.0f} %"
            lines.append(f"| {name} | {truth} | " + " | ".join(f"{value:.2e}" for value in own) +
                         f" | {best:.2e} | {SPLITS[by_hand.index(best)]} | {share(own[labels.index('lvsm')])} | "
                         f"{share(best)} |")
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
        print(bleeding_table(runner, [v for v in views if v[3]], BLEEDING), flush=True)
    return 1 if missing else 0


if __name__ == "__main__":
    sys.exit(main())
