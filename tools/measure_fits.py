#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What fits and partitions win and lose, as Markdown on stdout: the tables of docs/which-fit.md and docs/measurements.md.

usage: measure_fits.py [--tables LIST] [--only NAMES] [--size WxH] [--samples N] [--map-size N] GNOMON SHARED

GNOMON is the program, SHARED the folder that holds scenes/. The tables, of which --tables picks some:

density   texels per pixel along the worse axis, 1st and 50th percentile, of every fit with single maps, cascades and sdsm,
          and of snap, and what that is of uniform's; all techniques have the same number of texels in all
error     rmse against area truth of the sun's own size with hard and pcf, for the same fits and snap, and the density beside it

A technique of four maps has maps of half the side. One that fell back says so. --only names scenes by words in their
names. A scene that is not there is named on stderr and left out, and the exit status is then 1.
"""

import argparse
import sys

from measuring import cell, print_tables, run, table

OVERHEAD = ["--sun", "0,-1,0"]
TOWN = ["--eye", "0,22,45", "--target", "2,8,5", "--fov", "50"]
CITY = ["--eye", "3,3.2,6.5", "--target", "2.5,0.3,1.5", "--fov", "45"]
SLOPE = ["--eye", "2,1.2,12", "--target=-1,0.5,2", "--fov", "45"]
LOW = ["--eye", "6,0.5,8", "--target=-8,0.3,-7", "--fov", "45"]
# Name, scene, options of its view. Those of the table of density.
LONG_VIEWS = [
    ("sundial, long", "sundial", ["--camera", "long"]),
    ("sundial, long, sun overhead", "sundial", ["--camera", "long", *OVERHEAD]),
    ("sundial, long, sun ahead", "sundial", ["--camera", "long", "--sun", "0,-0.3,1"]),
    ("rts, unit", "rts", ["--camera", "unit"]),
    ("rts, unit, sun overhead", "rts", ["--camera", "unit", *OVERHEAD]),
    ("rts, map", "rts", ["--camera", "map"]),
    ("terrain_lowpoly", "scenes/terrain_lowpoly/terrain.glb", [*SLOPE, "--sun=-0.4,-1,0.5"]),
    ("terrain_lowpoly, sun overhead", "scenes/terrain_lowpoly/terrain.glb", [*SLOPE, *OVERHEAD]),
    ("terrain_lowpoly, low", "scenes/terrain_lowpoly/terrain.glb", [*LOW, "--sun=-0.4,-1,0.5"]),
    ("terrain_lowpoly, low, sun overhead", "scenes/terrain_lowpoly/terrain.glb", [*LOW, *OVERHEAD]),
    ("truck_town", "scenes/truck_town/truck_town.gltf", [*TOWN, "--sun", "0.4967,-0.819,0.2868"]),
    ("truck_town, sun overhead", "scenes/truck_town/truck_town.gltf", [*TOWN, *OVERHEAD]),
]
# And of that of errors: the views of the files' index.
TOWNS = [
    ("kenney_city", "scenes/kenney_city/kenney_city.gltf", [*CITY, "--sun", "0.5826,-0.766,-0.2717"]),
    ("truck_town", "scenes/truck_town/truck_town.gltf", [*TOWN, "--sun", "0.4967,-0.819,0.2868"]),
]
FITS = ["uniform", "lispsm", "lispsm-simple", "tsm", "psm"]
CASCADES = 4
PARTITIONS = ["single", "cascades", "sdsm"]
MOTIONS = [("single", "snap"), ("cascades", "snap")]
FILTERS = ["hard", "pcf+pcf.kernel=2x2", "pcf+pcf.kernel=3x3"]


def side(partition, map_size):
    return map_size if partition == "single" else map_size // 2


def techniques(map_size, filters, motions):
    """(label, filter's label, technique), uniform single first for each filter."""
    found = []
    for name in filters:
        for partition in PARTITIONS:
            for fit in FITS:
                label = fit if partition == "single" else f"{partition}, {fit}"
                found.append((label, name, f"{name}+{partition}+{fit}+free+map-size={side(partition, map_size)}"))
        for partition, motion in motions:
            label = motion if partition == "single" else f"{partition}, {motion}"
            found.append((label, name, f"{name}+{partition}+uniform+{motion}+map-size={side(partition, map_size)}"))
    return found


def compare(options, scene, view, asked):
    arguments = [scene, *view, "--size", options.size, "--samples", str(options.samples), "--truth", "area",
                 "--set", f"cascades.count={CASCADES}", "--techniques", ",".join(t for _, _, t in asked),
                 "--repetitions", "1", "--warmup", "0"]
    results = run(options.gnomon, "compare", arguments)["results"]
    found = {}
    for result in results:
        choices, settings = result["choices"], result["settings"]
        kernel = f"+pcf.kernel={settings['pcf.kernel']}" if choices["filter"] == "pcf" else ""
        key = (choices["filter"] + kernel, choices["partition"], choices["fit"], choices["motion"])
        found[key] = result
    return [found[tuple(part for i, part in enumerate(keyed(t)))] for _, _, t in asked]


def keyed(technique):
    parts = technique.split("+")
    kernel = f"+{parts[1]}" if parts[1].startswith("pcf.") else ""
    partition, fit, motion = parts[2:5] if kernel else parts[1:4]
    return parts[0] + kernel, partition, fit, motion


def note(result):
    outcome = result.get("outcome") or {}
    return "" if outcome.get("kind") in (None, "ok") else " (fell back)"


def times(value, base):
    return f"{value / base:.1f}" if base else "–"


def density_table(options, view):
    name, scene, arguments = view
    asked = techniques(options.map_size, ["hard"], MOTIONS)
    results = compare(options, scene, arguments, asked)
    base = results[0]["texel_density"]
    rows = []
    for (label, _, _), result in zip(asked, results):
        d = result["texel_density"]
        rows.append([label + note(result), cell(d["p01"]), times(d["p01"], base["p01"]), cell(d["p50"], 3),
                     times(d["p50"], base["p50"]), cell(result["error"]["rmse"])])
    return f"### Density: {name}\n\n" + table(["maps", "p01", "of uniform's", "p50", "of uniform's", "rmse, hard"], rows)


def error_table(options, view):
    name, scene, arguments = view
    asked = techniques(options.map_size, FILTERS, MOTIONS)
    results = compare(options, scene, arguments, asked)
    count = len(asked) // len(FILTERS)
    rows = []
    for i in range(count):
        d = results[i]["texel_density"]
        rows.append([asked[i][0] + note(results[i]), cell(d["p01"]), cell(d["p50"], 3),
                     *(cell(results[i + count * f]["error"]["rmse"]) for f in range(len(FILTERS)))])
    rows.sort(key=lambda row: min(float(v) for v in row[3:]))
    columns = ["maps", "p01", "p50", *(f"rmse, {f.replace('+pcf.kernel=', ' ')}" for f in FILTERS)]
    return f"### Error: {name}, {options.map_size} x {options.map_size} texels in all\n\n" + table(columns, rows)


TABLES = {"density": (LONG_VIEWS, density_table), "error": (TOWNS, error_table)}


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("--size", default="640x360")
    parser.add_argument("--samples", type=int, default=256)
    parser.add_argument("--map-size", type=int, default=2048)
    return print_tables(parser, TABLES)


if __name__ == "__main__":
    sys.exit(main())
