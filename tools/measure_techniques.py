#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What every filter errs by where all else is found by itself, beside `auto` and beside combinations asked for by name: the
tables of docs/which-technique.md.

usage: measure_techniques.py [--only NAMES] [--size WxH] [--samples N] [--texels N] GNOMON SHARED

GNOMON is the program, SHARED the folder that holds scenes/. The views are those of tools/measure_filters.py. Every light's
maps have --texels texels together. rmse against area truth of the sun's own size; frames in ratio to that without shadows.
The first table has a row for each technique, best first: the geometric mean over the views of its rmse beside the least in
the view, the greatest such ratio, the median of its mean error's size, and the median frame. The second has the views' rmse.
--only names views by words in their names. A scene that is not there is named on stderr and left out, and the exit status
is then 1.
"""

import argparse
import statistics
import sys
from pathlib import Path

from measure_auto import FITS, PARTITIONS
from measure_filters import VIEWS
from measuring import cell, present, run, table

FILTERS = ["pcss", "evsm", "msm", "lvsm", "vsm", "esm", "hard"]
QUALITIES = ["best", "balanced", "fast"]
KEYS = ["filter", "partition", "fit", "quality"]


def techniques():
    """Label to the values of KEYS. Filter auto is pcf for quality fast and raymarch for the others."""
    found = {f"auto, {quality}": ("auto", "auto", "auto", quality) for quality in QUALITIES}
    found["pcf, auto"] = ("pcf", "auto", "auto", "balanced")
    found.update({f"{name}, auto": (name, "auto", "auto", "balanced") for name in FILTERS})
    found.update({f"pcf, {partition}, {fit}": ("pcf", partition, fit, "balanced")
                  for partition in PARTITIONS for fit in FITS})
    found["plain"] = found.pop("pcf, single, uniform")
    return found


def measure(options, view):
    """What compare says of each technique, by label."""
    _, scene, arguments = view
    # Quality has an effect with auto only.
    asked = ",".join("+".join(f"{key}={value}" for key, value in zip(KEYS, values)
                              if key != "quality" or values[1] == "auto") for values in techniques().values())
    results = run(options.gnomon, "compare",
                  [scene, *arguments, "--size", options.size, "--samples", str(options.samples), "--truth", "area",
                   "--map-size", "auto", "--texels", str(options.texels), "--techniques", asked,
                   "--repetitions", "3", "--warmup", "1"])["results"]
    by_values = {tuple(one["settings"][key] for key in KEYS): one for one in results}
    return {label: by_values[values] for label, values in techniques().items()}


def summary(found):
    """`found`: of each view, what measure() gave."""
    rows = []
    for label in techniques():
        ratios = [view[label]["error"]["rmse"] / min(one["error"]["rmse"] for one in view.values()) for view in found.values()]
        bias = statistics.median(abs(view[label]["error"]["bias"]) for view in found.values())
        frame = statistics.median(view[label]["frame_ratio"] for view in found.values())
        rows.append((statistics.geometric_mean(ratios), label, max(ratios), bias, frame))
    columns = ["technique", "rmse beside the least, mean", "greatest", "mean error", "frame"]
    return table(columns, [[label, cell(mean, 2), cell(most, 2), cell(bias), cell(frame, 2)]
                           for mean, label, most, bias, frame in sorted(rows)])


def details(found):
    own = [label for label in techniques() if not label.startswith("pcf, ") or label == "pcf, auto"]
    rows = []
    for name, view in found.items():
        rmse, label = min((view[one]["error"]["rmse"], one) for one in techniques() if one not in own)
        rows.append([name, *(cell(view[one]["error"]["rmse"]) for one in own), f"{cell(rmse)} ({label})"])
    return table(["view", *own, "best by name"], rows)


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("--size", default="960x540")
    parser.add_argument("--samples", type=int, default=64)
    parser.add_argument("--texels", type=int, default=1536 * 1536)
    parser.add_argument("--only", default="")
    parser.add_argument("gnomon")
    parser.add_argument("shared", type=Path)
    options = parser.parse_args()
    views, missing = present([view[:3] for view in VIEWS], options.shared, options.only)
    found = {view[0]: measure(options, view) for view in views}
    print(summary(found))
    print(details(found))
    return 1 if missing else 0


if __name__ == "__main__":
    sys.exit(main())
