#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What motions win and cost, as Markdown on stdout: the tables of docs/measurements.md.

usage: measure_motion.py [--tables LIST] [--only NAMES] [--size WxH] [--samples N] [--map-size N] [--frames N] [--day N]
                         [--repetitions N] GNOMON SHARED

GNOMON is the program, SHARED the folder that holds scenes/. The tables, of which --tables picks some:

snap      shimmer of every filter with motion free and with snap while the camera pans and orbits, against hard truth
steps     shimmer, pop and lag of the step motions over a part of sundial's day, camera still, against area truth
lag       how far step-blend and step-jump are from the sun, by the angle of a step
cost      frames on sundial with its walker as ratios to free's, whose map is drawn in every frame, with the counters that
          explain them; and cascades against a single map of as many texels

--only names scenes by words in their names. A scene that is not there is named on stderr and left out, and the exit status
is then 1. Times are for a quiet machine.
"""

import argparse
import sys

from measuring import cell, print_tables, run, table

# Name, scene, options. In the second the map moves, because the scene is larger than what is shadowed of it.
WALKS = [
    ("kenney_city", "scenes/kenney_city/kenney_city.gltf",
     ["--eye", "3,3.2,6.5", "--target", "2.5,0.3,1.5", "--fov", "45", "--sun", "0.5826,-0.766,-0.2717"]),
    ("truck_town, within 150 m", "scenes/truck_town/truck_town.gltf",
     ["--eye", "0,22,45", "--target", "2,8,5", "--fov", "50", "--sun", "0.4967,-0.819,0.2868",
      "--set", "max-distance=150"]),
]
FILTERS = ["hard", "pcf", "vsm", "lvsm", "esm", "evsm", "msm"]
STEPPED = ["free", "snap", "step-jump", "step-band", "step-blend", "step-alternate"]
MORNING = ["--camera", "meadow", "--light", "sun", "--time", "120"]  # 10 o'clock


def compare(options, scene, arguments):
    return run(options.gnomon, "compare", [scene, *arguments, "--size", options.size, "--map-size",
                                           str(options.map_size)])["results"]


def by_choice(results, *choices):
    return {tuple(r["choices"][c] for c in choices): r for r in results}


def share(value, base):
    percent = 100.0 * value / base if base else None
    return "–" if percent is None else f"{percent:.0f} %" if percent >= 99.5 else f"{percent:.2g} %"


def snap_table(options, view):
    name, scene, arguments = view
    techniques = ",".join(f"{f}+{m}" for f in FILTERS for m in ["free", "snap"])
    rows = []
    for path in ["pan", "orbit"]:
        results = compare(options, scene, [*arguments, "--path", path, "--frames", f"0-{options.frames - 1}",
                                           "--truth", "hard", "--techniques", techniques])
        found = by_choice(results, "filter", "motion")
        for name_of_filter in FILTERS:
            free, snap = (found[(name_of_filter, motion)]["stability"]["shimmer"] for motion in ["free", "snap"])
            rows.append([path, name_of_filter, cell(free, 5), cell(snap, 5), share(snap, free)])
    return f"### Shimmer under a moving camera: {name}\n\n" + table(["path", "filter", "free", "snap", "share"], rows)


def steps_table(options, _):
    rows = []
    for name_of_filter in ["pcf", "vsm"]:
        techniques = ",".join(f"{name_of_filter}+{motion}" for motion in STEPPED)
        results = compare(options, "sundial", [*MORNING, "--path", "day", "--frames", f"0-{options.day - 1}", "--truth",
                                               "area", "--samples", str(options.samples), "--techniques", techniques])
        found = by_choice(results, "motion")
        free = found[("free",)]["stability"]
        jump = found[("step-jump",)]["stability"]
        for motion in STEPPED:
            s = found[(motion,)]["stability"]
            rows.append([name_of_filter, motion, cell(s["shimmer"], 5), share(s["shimmer"], free["shimmer"]),
                         cell(s["pop"], 5), share(s["pop"], jump["pop"]), cell(s["lag"]),
                         cell(found[(motion,)]["mean_texels_rendered"] / options.map_size ** 2, 2)])
    columns = ["filter", "motion", "shimmer", "of `free`'s", "pop", "of `step-jump`'s", "lag", "maps drawn a frame"]
    return "### A sun that moves: sundial\n\n" + table(columns, rows)


def lag_table(options, _):
    angles = [0.125, 0.25, 0.5, 1.0, 2.0, 4.0]
    motions = ["step-jump", "step-blend"]
    techniques = ["pcf+free"] + [f"pcf+{m}+step.angle={a}" for a in angles for m in motions]
    # Few frames far apart, so that they meet all phases of a step.
    results = compare(options, "sundial", [*MORNING, "--path", "day", "--frames", f"0-{options.day - 1}", "--fps", "3",
                                           "--truth", "area", "--samples", str(options.samples), "--techniques",
                                           ",".join(techniques)])
    found = {}
    for result in results:
        motion = result["choices"]["motion"]
        found[(motion, float(result["settings"].get("step.angle", 0.0)) if motion != "free" else 0.0)] = result
    free = found[("free", 0.0)]["stability"]["lag"]
    rows = [[f"{a}", *(cell(found[(m, a)]["stability"]["lag"]) for m in motions)] for a in angles]
    return (f"### Lag by the angle of a step: sundial\n\nThe same with motion free: {cell(free)}.\n\n" +
            table(["step, degrees", *motions], rows))


def bench(options, arguments, techniques):
    return run(options.gnomon, "bench", [*arguments, "--size", "1280x720", "--techniques", ",".join(techniques)])


def cost_table(options, _):
    techniques = [f"pcf+{motion}+map-size={options.map_size}" for motion in STEPPED]
    whole = bench(options, ["sundial", "--camera", "meadow", "--time", "120", "--path", "day", "--frames",
                            f"0-{options.day - 1}"], techniques)
    found = by_choice(whole["results"], "motion")

    base = found[("free",)]["static_time_ms"]["frame"]
    rows = []
    for motion in STEPPED:
        result = found[(motion,)]
        time, spread, reuse = (result[f"static_{part}"] for part in ["time_ms", "iqr_ms", "reuse"])
        rows.append([motion, f"{time['frame']:.0f} ({spread['frame']:.0f})",
                     f"{100.0 * (time['frame'] / base - 1.0):+.0f} %",
                     cell(time["maps"], 1), cell(time["mask"], 1),
                     cell(result["static_mean_texels_rendered"] / options.map_size ** 2, 2),
                     cell(sum(reuse[f"{which}_casters"] for which in ["still", "moving"]) + reuse["casters_at_once"], 0)])
    columns = ["motion", "frame ms (iqr)", "against free", "maps ms", "mask ms", "maps drawn a frame",
               "casters drawn a frame"]
    text = "### What steps cost: sundial\n\n" + table(columns, rows)
    side = options.map_size // 2
    pair = bench(options, ["sundial", "--camera", "long", "--time", "120", "--repetitions", str(options.repetitions)],
                 [f"pcf+single+map-size={options.map_size}", f"pcf+cascades+map-size={side}"])
    found = by_choice(pair["results"], "partition")
    rows = [[p, f"{found[(p,)]['time_ms']['frame']:.0f} ({found[(p,)]['iqr_ms']['frame']:.0f})",
             cell(found[(p,)]["time_ms"]["maps"], 1), cell(found[(p,)]["time_ms"]["mask"], 1)] for p in ["single", "cascades"]]
    ratio = found[("cascades",)]["time_ms"]["frame"] / found[("single",)]["time_ms"]["frame"]
    return (text + f"\nCascades of {side} against a single map of {options.map_size}: {ratio:.2f} times the frame.\n\n" +
            table(["partition", "frame ms (iqr)", "maps ms", "mask ms"], rows))


TABLES = {"snap": (WALKS, snap_table), "steps": ([("sundial", "sundial")], steps_table),
          "lag": ([("sundial", "sundial")], lag_table), "cost": ([("sundial", "sundial")], cost_table)}


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("--size", default="320x180")
    parser.add_argument("--samples", type=int, default=64)
    parser.add_argument("--map-size", type=int, default=1024)
    parser.add_argument("--frames", type=int, default=16, help="of paths of the camera")
    parser.add_argument("--day", type=int, default=90, help="frames of paths of the sun")
    parser.add_argument("--repetitions", type=int, default=9)
    return print_tables(parser, TABLES)


if __name__ == "__main__":
    sys.exit(main())
