#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The error tables of docs/measurements.md: every technique on every scene that has a view, against both truths.

usage: measure_scenes.py [--size WxH] [--samples N] [--map-size N] [--techniques LIST] [--only NAME] GNOMON SHARED

GNOMON is the program, SHARED the folder that holds scenes/. Prints Markdown on stdout, one table a scene and view, best
first against area truth; says on stderr what it runs. A scene that is not there is named and left out, and the exit
status is then 1.
"""

import argparse
import sys
from pathlib import Path

from measuring import cell, run

# Name of the table, scene, options of its view. The files' views are those of their index.
VIEWS = [
    ("kenney_city", "scenes/kenney_city/kenney_city.gltf",
     ["--eye", "3,3.2,6.5", "--target", "2.5,0.3,1.5", "--fov", "45", "--sun", "0.5826,-0.766,-0.2717"]),
    ("truck_town", "scenes/truck_town/truck_town.gltf",
     ["--eye", "0,22,45", "--target", "2,8,5", "--fov", "50", "--sun", "0.4967,-0.819,0.2868"]),
    ("rts, camp", "rts", ["--camera", "camp"]),
    ("rts, unit", "rts", ["--camera", "unit"]),
    ("rts, map", "rts", ["--camera", "map"]),
    ("planes, side", "planes", ["--camera", "side"]),
    ("spotlit, stage", "spotlit", ["--camera", "stage", "--light-size", "0.2"]),
]
# The light of each truth: sun angles in degrees for area.
SUNS = ["0.53", "2"]
CLASSES = ["edge", "acne", "detached", "bleeding", "terminator"]


def compare(options, gnomon: str, scene: str, view: list[str], truth: list[str]):
    view = [o for i, o in enumerate(view) if truth[1] == "area" or o != "--light-size" and view[i - 1] != "--light-size"]
    return run(gnomon, "compare", [scene, *view, *truth, "--size", options.size, "--map-size", str(options.map_size),
                                   "--techniques", options.techniques, "--repetitions", "1", "--warmup", "0"])


def class_cells(error) -> str:
    whole = error["rmse"] ** 2 if error["rmse"] else 0.0
    return " | ".join("–" if not whole else f"{100.0 * error[name] / whole:.0f}" for name in CLASSES)


def table(name: str, runs) -> str:
    """`runs`: label of a truth and the result of comparing with it."""
    main = runs[1][1]  # area at the sun's own size
    counted = main["pixels"]["counted"]
    head = " | ".join(f"rmse {label}" for label, _ in runs)
    lines = [f"### {name}", "", f"{counted} pixels count; the area truth's own noise is {main['truth']['standard_error']:.4f}.", "",
             f"| technique | {head} | bias | edge % | acne % | detached % | bleeding % | terminator % | ssim | flip | fit efficiency |",
             "|---|" + "---|" * (len(runs) + 9)]
    by_name = [{r["technique"]: r for r in one["results"]} for _, one in runs]
    for row in sorted(main["results"], key=lambda r: r["error"]["rmse"]):
        error = row["error"]
        rmses = " | ".join(cell(results[row["technique"]]["error"]["rmse"]) for results in by_name)
        lines.append(f"| `{row['technique']}` | {rmses} | {cell(error['bias'])} | {class_cells(error)} | "
                     f"{cell(error['ssim'], 3)} | {cell(error['flip'], 3)} | {cell(row['fit_efficiency'], 2)} |")
    return "\n".join(lines) + "\n"


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("--size", default="1280x720")
    parser.add_argument("--samples", default="256")
    parser.add_argument("--map-size", type=int, default=2048)
    parser.add_argument("--techniques", default="all")
    parser.add_argument("--only", default="")
    parser.add_argument("gnomon")
    parser.add_argument("shared", type=Path)
    options = parser.parse_args()
    missing = False
    for name, scene, view in VIEWS:
        if options.only and options.only not in name:
            continue
        if "/" in scene:
            file = options.shared / scene
            if not file.exists():
                print(f"{name}: {file} is not there", file=sys.stderr)
                missing = True
                continue
            scene = str(file)
        runs = [("hard", compare(options, options.gnomon, scene, view, ["--truth", "hard"]))]
        area = ["--truth", "area", "--samples", options.samples]
        if "--light-size" in view:
            runs.append(("area 0.2 m", compare(options, options.gnomon, scene, view, area)))
        else:
            runs += [(f"area {sun}°", compare(options, options.gnomon, scene, view, [*area, "--sun-angle", sun]))
                     for sun in SUNS]
        print(table(name, runs), flush=True)
    return 1 if missing else 0


if __name__ == "__main__":
    sys.exit(main())
