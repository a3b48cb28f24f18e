#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What bias `auto` errs by beside explicit settings: the table of docs/techniques/bias.md.

usage: measure_bias.py [--only NAMES] [--size WxH] [--samples N] [--map-size N] GNOMON SHARED

GNOMON is the program, SHARED the folder that holds scenes/. A set-up is a view, a light (sun or spot), a depth metric and a
filter. Filters that find penumbrae are held against area truth, the others against hard truth. A sun's two metrics are one
and the same, and of a spot's z-over-w is stored by filterable maps alone, so a spot's vsm has two rows and all else one.
The last two lines say how far the worst of them is from what is asked of `auto`. --only names views by words in their
names. A scene that is not there is named on stderr and left out, and the exit status is then 1.
"""

import argparse
import sys
from pathlib import Path

from measuring import cell, present, run, table

# Name, scene, camera, lights (each: name, options of both truths, options of area truth), and the scale of what is
# seen in metres, of which constants are shares.
VIEWS = [
    ("rts, camp", "rts", ["--camera", "camp"],
     [("sun", [], []), ("spot", ["--spot", "30,40,30,0,0,0,60"], ["--light-size", "1"])], 50.0),
    ("spotlit, stage", "spotlit", ["--camera", "stage"],
     [("sun", ["--sun=-0.4,-1,-0.3"], []), ("spot", [], ["--light-size", "0.2"])], 8.0),
    ("kenney_city", "scenes/kenney_city/kenney_city.gltf",
     ["--eye", "3,3.2,6.5", "--target", "2.5,0.3,1.5", "--fov", "45"],
     [("sun", ["--sun", "0.5826,-0.766,-0.2717"], []),
      ("spot", ["--spot=-1,4.9,3.1,2.5,0.3,1.5,60"], ["--light-size", "0.1"])], 5.0),
    ("house_leaves, garden", "scenes/house_leaves/house.glb",
     ["--eye", "0.35,0.35,0.4", "--target", "0.03,0.05,0", "--fov", "45"],
     [("sun", ["--sun", "0.6,-1,0.3"], []),
      ("spot", ["--spot=-0.33,0.65,-0.18,0.03,0.05,0,60"], ["--light-size", "0.01"])], 0.5),
]
# Filter, truth.
FILTERS = [("hard", "hard"), ("pcf", "hard"), ("vsm", "hard"), ("pcss", "area"), ("raymarch", "area")]
CONSTANTS = [0.0001, 0.0003, 0.001, 0.003, 0.01, 0.03]  # shares of the view's scale
STEPS = [0.5, 1, 2, 4]
PARTS = ["bias.constant", "bias.slope", "bias.normal", "bias.receiver-plane"]
MOST_RATIO, MOST_SHARE, MOST_MEAN = 1.1, 0.05, 0.002


def settings(scale_m):
    """Label and values of each setting, `auto` first."""
    metres = [float(f"{scale_m * c:.3g}") for c in CONSTANTS]
    return [("auto", {}), ("none", {"bias": "none"}),
            *((f"constant {m:g} m", {"bias.constant": m}) for m in metres),
            *((f"slope {s:g}", {"bias.slope": s}) for s in STEPS),
            *((f"normal {s:g}", {"bias.normal": s}) for s in STEPS),
            *((f"plane, constant {m:g} m", {"bias.receiver-plane": 1, "bias.constant": m}) for m in metres[1:4]),
            ("plane, slope 0.5", {"bias.receiver-plane": 1, "bias.slope": 0.5})]


def errors(options, scene, arguments, truth, filter_name, scale_m):
    """Error by label of the setting."""
    samples = ["--samples", str(options.samples)] if truth == "area" else []
    names = settings(scale_m)
    techniques = ["+".join([filter_name, *(f"{key}={value}" for key, value in values.items())]) for _, values in names]
    result = run(options.gnomon, "compare", [scene, *arguments, "--size", options.size, "--truth", truth, *samples,
                                             "--map-size", str(options.map_size), "--techniques", ",".join(techniques),
                                             "--repetitions", "1", "--warmup", "0"])
    found = {}
    for label, values in names:
        found[label] = next(row["error"] for row in result["results"] if explicit(row["settings"]) == explicit(values))
    return found


def explicit(values):
    """What of a technique's settings says its bias."""
    automatic = values.get("bias") == "auto" or not values
    numbers = {key: round(float(value), 9) for key, value in values.items() if key in PARTS and float(value) != 0}
    return automatic, numbers


def setups(view):
    """Light, metric, filter, truth, options."""
    _, _, camera, lights, _ = view
    for light, both, area in lights:
        for name, truth in FILTERS:
            arguments = [*camera, *both, *(area if truth == "area" else [])]
            yield light, "linear", name, truth, arguments
            if light == "spot" and name == "vsm":
                yield light, "z-over-w", "vsm+depth-metric=z-over-w", truth, arguments


def measure(options, view, worst, sums):
    name, scene, _, _, scale_m = view
    rows = []
    for light, metric, filter_name, truth, arguments in setups(view):
        found = errors(options, scene, arguments, truth, filter_name, scale_m)
        own = found.pop("auto")
        best = min(found, key=lambda label: found[label]["rmse"])
        ratio = own["rmse"] / found[best]["rmse"]
        moved = own["acne"] + own["detached"]
        whole = own["rmse"] ** 2
        rows.append([name, light, metric, filter_name.split("+")[0], cell(own["rmse"]),
                     f"{cell(found[best]['rmse'])} ({best})", cell(ratio, 2), cell(100.0 * moved / whole, 1),
                     f"{own['bias']:+.4f}"])
        worst.append((ratio, abs(own["bias"])))
        sums.append((moved, whole))
    return rows


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("--size", default="480x270")
    parser.add_argument("--samples", type=int, default=64)
    parser.add_argument("--map-size", type=int, default=1024)
    parser.add_argument("--only", default="")
    parser.add_argument("gnomon")
    parser.add_argument("shared", type=Path)
    options = parser.parse_args()
    views, missing = present(VIEWS, options.shared, options.only)
    worst, sums, rows = [], [], []
    for view in views:
        rows += measure(options, view, worst, sums)
    columns = ["view", "light", "metric", "filter", "rmse, auto", "best by hand", "ratio", "acne and detached %", "mean error"]
    print(table(columns, rows))
    if worst:
        lost = sum(ratio > MOST_RATIO for ratio, _ in worst)
        far = sum(mean > MOST_MEAN for _, mean in worst)
        share = sum(moved for moved, _ in sums) / sum(whole for _, whole in sums)
        print(f"{len(worst)} set-ups: {lost} lose by more than 10 % (worst {max(ratio for ratio, _ in worst):.2f}); "
              f"acne and detached {100.0 * share:.1f} % of the squared error (at most {100.0 * MOST_SHARE:.0f} asked);")
        print(f"mean error beyond {MOST_MEAN} in {far} (worst {max(mean for _, mean in worst):.4f}).")
    return 1 if missing else 0


if __name__ == "__main__":
    sys.exit(main())
