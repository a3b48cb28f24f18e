#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Where each millisecond of a frame goes, pass by pass, and what each pass counts: the tables of docs/performance.md.

usage: measure_passes.py [--tables times,counts] [--only NAMES] [--size WxH] [--map-size N] [--repetitions N]
                         [--techniques LIST] [--keep FOLDER] [--from FOLDER] GNOMON SHARED

GNOMON is the program, SHARED the folder that holds scenes/. `times`: the median of each pass in milliseconds of GPU time,
and of what of the frame is outside of them. `counts`: what each pass that shadows take counts. --keep leaves the results
in a folder, for `gnomon bench --against` and for --from, which makes tables of results that were kept and runs nothing.
--only names views by words in their names. A scene that is not there is named on stderr and left out, and the exit status
is then 1.
"""

import argparse
import json
import sys
from pathlib import Path

from measuring import cell, print_tables, run, table

VIEWS = [
    ("kenney_city", "scenes/kenney_city/kenney_city.gltf",
     ["--eye", "3,3.2,6.5", "--target", "2.5,0.3,1.5", "--fov", "45", "--sun", "0.5826,-0.766,-0.2717"]),
    ("truck_town", "scenes/truck_town/truck_town.gltf",
     ["--eye", "0,22,45", "--target", "2,8,5", "--fov", "50", "--sun", "0.4967,-0.819,0.2868"]),
]
COUNTS = ["texels", "vertex_invocations", "fragment_invocations", "compute_invocations", "draws"]
MIB = 1024 * 1024
RESULTS = {}  # by view: both tables are of one run


def measured(options, view):
    name, scene, arguments = view
    if name not in RESULTS:
        if options.from_folder:
            RESULTS[name] = json.loads((options.from_folder / f"{name}.json").read_text(encoding="utf-8"))
        else:
            RESULTS[name] = run(options.gnomon, "bench",
                                [scene, *arguments, "--size", options.size, "--map-size", options.map_size,
                                 "--repetitions", options.repetitions, "--techniques", options.techniques])
        if options.keep:
            options.keep.mkdir(parents=True, exist_ok=True)
            (options.keep / f"{name}.json").write_text(json.dumps(RESULTS[name], indent=2), encoding="utf-8")
    return RESULTS[name]


def short(result):
    plain = {"single", "uniform"}
    return "`" + "+".join(part for part in result["technique"].split("+") if "=" not in part and part not in plain) + "`"


def times(options, view):
    bench = measured(options, view)
    columns = [("no shadows", bench["baseline"])] + [(short(one), one) for one in bench["results"]]
    order = []
    for _, one in columns:  # a pass stands before those that follow it wherever they are
        names = [found["name"] for found in one["passes"]]
        for place, name in enumerate(names):
            if name not in order:
                after = [order.index(later) for later in names[place + 1:] if later in order]
                order.insert(min(after, default=len(order)), name)
    rows = []
    for name in order:
        found = [next((one["ms"] for one in column["passes"] if one["name"] == name), None) for _, column in columns]
        rows.append([name, *("" if ms is None else cell(ms, 1) for ms in found)])
    outside = [column["time_ms"]["frame"] - sum(one["ms"] for one in column["passes"]) for _, column in columns]
    rows.append(["outside of passes", *(cell(ms, 1) for ms in outside)])
    rows.append(["**frame**", *(cell(column["time_ms"]["frame"], 1) for _, column in columns)])
    rows.append(["spread (iqr)", *(cell(column["iqr_ms"]["frame"], 1) for _, column in columns)])
    rows.append(["beside no shadows", "1.00", *(cell(one["frame_ratio"], 2) for one in bench["results"])])
    return f"{view[0]}, milliseconds:\n\n" + table(["pass", *(name for name, _ in columns)], rows)


def counts(options, view):
    bench = measured(options, view)
    without = {one["name"] for one in bench["baseline"]["passes"]}
    rows = []
    for result in bench["results"]:
        for one in result["passes"]:
            if one["name"] not in without:
                least = one["bytes_minimum"]
                numbers = ["–" if one[key] is None else str(one[key]) for key in COUNTS]
                rows.append([short(result), one["name"], *numbers, "–" if least is None else cell(least / MIB, 2)])
    columns = ["technique", "pass", "texels", "vertices", "fragments", "compute", "draws", "least MiB"]
    return f"{view[0]}, counts:\n\n" + table(columns, rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--size", default="1280x720")
    parser.add_argument("--map-size", default="2048")
    parser.add_argument("--repetitions", default="11")
    parser.add_argument("--techniques", default="hard,pcf,vsm,pcf+cascades,pcf+sdsm")
    parser.add_argument("--keep", type=Path)
    parser.add_argument("--from", type=Path, dest="from_folder")
    return print_tables(parser, {"times": (VIEWS, times), "counts": (VIEWS, counts)})


if __name__ == "__main__":
    sys.exit(main())
