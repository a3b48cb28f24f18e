#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What `auto` errs by beside every fit and partition asked for by name: the table of docs/techniques/auto.md.

usage: measure_auto.py [--only NAMES] [--size WxH] [--samples N] [--map-size N] GNOMON SHARED

GNOMON is the program, SHARED the folder that holds scenes/. The views are those of tools/measure_filters.py. Every
technique has the same number of texels: four maps of half the side where cascades.count is 4. rmse with pcf 3x3 against
area truth of the sun's own size. --only names views by words in their names. A scene that is not there is named on stderr and left
out, and the exit status is then 1.
"""

import argparse
import sys
from pathlib import Path

from measure_filters import VIEWS
from measuring import cell, present, run, table

QUALITIES = ["fast", "balanced", "best"]
FITS = ["uniform", "lispsm", "lispsm-simple", "tsm", "psm"]
PARTITIONS = ["single", "cascades", "sdsm"]


def techniques(map_size):
    named = [(f"{partition}, {fit}",
              f"pcf+{partition}+{fit}+map-size={map_size if partition == 'single' else map_size // 2}")
             for partition in PARTITIONS for fit in FITS]
    return [(q, f"pcf+auto+quality={q}+map-size={map_size}") for q in QUALITIES] + named


def errors(options, scene, view):
    found = {}
    for label, technique in techniques(options.map_size):
        result = run(options.gnomon, "compare", [scene, *view, "--size", options.size, "--samples", str(options.samples),
                                                 "--truth", "area", "--techniques", technique,
                                                 "--repetitions", "1", "--warmup", "0"])["results"][0]
        found[label] = result["error"]["rmse"]
    return found


def row(options, view):
    name, scene, arguments = view
    found = errors(options, scene, arguments)
    named = sorted((rmse, label) for label, rmse in found.items() if label not in QUALITIES)
    return [name, *(cell(found[q]) for q in QUALITIES), cell(found["single, uniform"]),
            *(f"{cell(rmse)} ({label})" for rmse, label in named[:2])]


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("--size", default="1280x720")
    parser.add_argument("--samples", type=int, default=64)
    parser.add_argument("--map-size", type=int, default=2048)
    parser.add_argument("--only", default="")
    parser.add_argument("gnomon")
    parser.add_argument("shared", type=Path)
    options = parser.parse_args()
    views, missing = present([view[:3] for view in VIEWS], options.shared, options.only)
    columns = ["view", *(f"auto, {q}" for q in QUALITIES), "single, uniform", "best by name", "second"]
    print(table(columns, [row(options, view) for view in views]))
    return 1 if missing else 0


if __name__ == "__main__":
    sys.exit(main())
