#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Error, time and memory of techniques beside each other: the tables of docs/which-technique.md.

usage: measure_techniques.py [--only NAMES] [--size WxH] [--samples N] [--repetitions N] [--keep FILE] GNOMON SHARED

GNOMON is the program, SHARED the folder that holds scenes/. The views are those of tools/measure_filters.py. rmse against
area truth of the sun's own size; time is that of the frame in ratio to the one without shadows; memory is all that shadows
take, masks among it. The first table has a row for each technique, best first: geometric mean over the views of its rmse
beside the least in the view, the greatest such ratio, the median of its mean error's size, median frame and memory; and the
technique that errs at least 5 % less in less time, in the mean of the views. The second has the views on which one does so
to each quality of auto. The third has the views' rmse and frame.
--only names views by words in their names. --keep writes what was measured to a JSON file, or reads it where it is there.
A scene that is not there is named on stderr and left out, and the exit status is then 1.
"""

import argparse
import json
import statistics
import sys
from pathlib import Path

from measure_auto import FITS, PARTITIONS
from measure_filters import VIEWS
from measuring import cell, present, run, table

QUALITIES = ["best", "balanced", "fast"]
COMPARE = ["raymarch", "pcss", "pcf", "hard"]
FILTERABLE = ["evsm", "msm", "lvsm", "vsm", "esm"]
SIDES = [1024, 2048, 4096]
CLEARLY_LESS = 0.95


def techniques():
    """Label to what is asked for, key by key."""
    auto = {"partition": "auto", "fit": "auto"}
    found = {f"auto, {quality}": {"filter": "auto", **auto, "quality": quality} for quality in QUALITIES}
    for side in SIDES:
        found.update({f"{name}, {side}²": {"filter": name, **auto, "quality": "balanced", "texels": str(side * side)}
                      for name in COMPARE})
    found.update({f"{name}, 2048²": {"filter": name, **auto, "quality": "balanced", "texels": str(2048 * 2048)}
                  for name in FILTERABLE})
    found.update({f"pcf, {partition}, {fit}, 2048²":
                  {"filter": "pcf", "partition": partition, "fit": fit, "texels": str(2048 * 2048)}
                  for partition in PARTITIONS for fit in FITS})
    return found


def shadow_mib(result):
    return sum(size for name, size in result["memory_by_purpose_bytes"].items() if not name.startswith("host")) / 2**20


def measure(options, view):
    """What compare says of each technique, by label: rmse, bias, frame, mib."""
    _, scene, arguments = view
    asked = techniques()
    results = run(options.gnomon, "compare",
                  [scene, *arguments, "--size", options.size, "--samples", str(options.samples), "--truth", "area",
                   "--map-size", "auto", "--techniques",
                   ",".join("+".join(f"{key}={value}" for key, value in one.items()) for one in asked.values()),
                   "--repetitions", str(options.repetitions), "--warmup", "1"])["results"]
    found = {}
    for label, wanted in asked.items():
        # Without texels a technique has those that memory has room for.
        wanted = {"texels": "auto", **wanted}
        one = next(result for result in results if all(str(result["settings"][key]) == value for key, value in wanted.items()))
        found[label] = {"rmse": one["error"]["rmse"], "bias": one["error"]["bias"], "frame": one["frame_ratio"],
                        "mib": shadow_mib(one)}
    return found


def beats(one, other):
    return one["rmse"] < CLEARLY_LESS * other["rmse"] and one["frame"] < other["frame"]


def means(found):
    """Label to geometric means over the views: of rmse beside the least, and of the frame."""
    least = [min(one["rmse"] for one in view.values()) for view in found.values()]
    return {label: {"rmse": statistics.geometric_mean(view[label]["rmse"] / best for view, best in zip(found.values(), least)),
                    "frame": statistics.geometric_mean(view[label]["frame"] for view in found.values()),
                    "most": max(view[label]["rmse"] / best for view, best in zip(found.values(), least))}
            for label in techniques()}


def summary(found):
    mean = means(found)
    rows = []
    for label, own in sorted(mean.items(), key=lambda item: item[1]["rmse"]):
        better = [other for other in mean if beats(mean[other], own)]
        rows.append([label, cell(own["rmse"], 2), cell(own["most"], 2),
                     cell(statistics.median(abs(view[label]["bias"]) for view in found.values())), cell(own["frame"], 2),
                     cell(statistics.median(view[label]["mib"] for view in found.values()), 0),
                     min(better, key=lambda other: mean[other]["frame"]) if better else ""])
    return table(["technique", "rmse beside the least, mean", "greatest", "mean error", "frame", "MiB", "take instead"], rows)


def losses(found):
    rows = []
    for quality in QUALITIES:
        own = f"auto, {quality}"
        lost = {}
        for name, view in found.items():
            better = [label for label in view if label not in (f"auto, {one}" for one in QUALITIES) and beats(view[label], view[own])]
            if better:
                lost[name] = min(better, key=lambda label: view[label]["rmse"])
        rows.append([own, f"{len(found) - len(lost)} of {len(found)}",
                     "; ".join(f"{name} ({label})" for name, label in lost.items())])
    return table(["quality", "views on which nothing named errs 5 % less in less time", "the others"], rows)


def details(found):
    own = [label for label in techniques() if label.count(",") == 1]
    return table(["view", *own], [[name, *(f"{cell(view[one]['rmse'])} ({cell(view[one]['frame'], 1)})" for one in own)]
                                  for name, view in found.items()])


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("--size", default="960x540")
    parser.add_argument("--samples", type=int, default=64)
    parser.add_argument("--repetitions", type=int, default=3)
    parser.add_argument("--only", default="")
    parser.add_argument("--keep", type=Path)
    parser.add_argument("gnomon")
    parser.add_argument("shared", type=Path)
    options = parser.parse_args()
    missing = False
    if options.keep and options.keep.exists():
        found = json.loads(options.keep.read_text())
    else:
        views, missing = present([view[:3] for view in VIEWS], options.shared, options.only)
        found = {view[0]: measure(options, view) for view in views}
        if options.keep:
            options.keep.write_text(json.dumps(found))
    print(summary(found))
    print(losses(found))
    print(details(found))
    return 1 if missing else 0


if __name__ == "__main__":
    sys.exit(main())
