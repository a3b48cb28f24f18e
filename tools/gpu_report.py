#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Makes one file of what tools/on_gpu.sh found, and tables of such files.

usage: gpu_report.py collect FOLDER FILE.json    what a run left in FOLDER
       gpu_report.py taken DEVICE.json           the name of the device that `gnomon gpus` says is taken
       gpu_report.py filters DEVICE.json GPU     those that a device can have, with commas between
       gpu_report.py software DEVICE.json GPU    status 0 where that draws by the processor
       gpu_report.py table FILE.json...          a page of these files, to standard output
"""

import json
import statistics
import sys
from pathlib import Path

OUTCOMES = {"0": "done", "124": "not reached in time", "137": "not reached in time"}


def read(file: Path) -> dict:
    try:
        return json.loads(file.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}


def named(device: Path, name: str) -> dict:
    """The first device of this name, as --gpu finds it."""
    gpus = read(device).get("gpus", [])
    return next((gpu for gpu in gpus if (gpu["software"] if name == "software" else name.lower() in gpu["name"].lower())),
                {"parts": [], "software": False})


def filters_of(gpu: dict) -> list[str]:
    """Those that it can have; of a processor, which takes minutes to compile some, a few."""
    if gpu["software"]:
        return ["hard", "pcf", "pcss", "raymarch"]
    lacks = {part["name"] for part in gpu["parts"] if not part["there"]}
    filterable = [] if "shaderStorageImageWriteWithoutFormat" in lacks else ["vsm", "lvsm", "esm", "evsm", "msm"]
    return ["hard", "pcf", "pcss", "raymarch", *filterable, "id", "depth-id", "smoothies"]


def cases_of(files: list[Path]) -> dict:
    """How many cases there were, and which failed or were skipped; nothing where no results were written."""
    results = [read(file) for file in files]
    if not any(results):
        return {}
    found: dict = {"passed": 0, "failed": [], "skipped": []}
    for suite in [suite for result in results for suite in result.get("testsuites", [])]:
        for case in suite["testsuite"]:
            name = f"{suite['name']}.{case['name']}"
            if case.get("failures"):
                found["failed"].append(name)
            elif case.get("result") == "SKIPPED":
                found["skipped"].append(name)
            elif case.get("status") == "RUN":
                found["passed"] += 1
    return found


def properties_of(results: dict, *names: str) -> dict:
    return {name: float(case[name]) for suite in results.get("testsuites", []) for case in suite["testsuite"]
            for name in names if name in case}


def bench_of(result: dict) -> dict:
    return {"device": result.get("device"), "driver": result.get("driver"),
            "baseline_ms": (result.get("baseline", {}).get("time_ms") or {}).get("frame"),
            "techniques": {one["technique"]: {"frame_ms": one["time_ms"].get("frame"), "maps_ms": one["time_ms"].get("maps"),
                                              "filter_ms": one["time_ms"].get("filter"), "mask_ms": one["time_ms"].get("mask"),
                                              "frame_ratio": one.get("frame_ratio"),
                                              "filter_bytes": (one.get("counters") or {}).get("filter_bytes")}
                           for one in result.get("results", [])}}


def collect(folder: Path, file: Path) -> int:
    grid, benches = read(folder / "grid.json"), sorted(folder.glob("bench-*.json"))
    report = {
        "note": (folder / "note.txt").read_text(encoding="utf-8"),
        "device": read(folder / "device.json"),
        "steps": {status.stem: OUTCOMES.get(code := status.read_text().strip(), f"ended with {code}")
                  for status in sorted(folder.glob("*.status"))},
        "grid": properties_of(grid, "steps_of_sun", "steps_of_spot", "sub_pixel_bits", "unorm_read_steps", "half_read_steps"),
        "copy_bytes_per_s": properties_of(grid, "copy_bytes_per_s").get("copy_bytes_per_s"),
        "masks": cases_of(sorted(folder.glob("masks-*.json"))),
        "cases": cases_of(sorted(folder.glob("cases-*.json"))),
        "bench": {bench.stem.removeprefix("bench-"): bench_of(read(bench)) for bench in benches},
        "blur": bench_of(read(folder / "blur.json")),
        "lamps": {file.stem.removeprefix("lamps-"): bench_of(read(file)) for file in sorted(folder.glob("lamps-*.json"))},
    }
    file.write_text(json.dumps(report, indent=1) + "\n", encoding="utf-8")
    return 0


def middle(values: list[float]) -> str:
    return number(statistics.median(values) if values else None)


def number(value, digits: int = 2) -> str:
    return "not measured" if value is None else f"{value:.{digits}f}"


def times_of(title: str, benches: list[dict]) -> list[str]:
    """A table of each technique's medians over several views."""
    techniques = list(dict.fromkeys(technique for bench in benches for technique in bench["techniques"]))
    if not techniques:
        return []
    bare = [bench["baseline_ms"] for bench in benches if bench["baseline_ms"] is not None]
    lines = ["", f"{title}; the frame without shadows takes {middle(bare)} ms:", "",
             "| technique | maps ms | filter ms | mask ms | frame ms | frame / frame without shadows |", "|---|---|---|---|---|---|"]
    for technique in techniques:
        found = [bench["techniques"][technique] for bench in benches if technique in bench["techniques"]]
        cells = [middle([one[key] for one in found if one[key] is not None])
                 for key in ("maps_ms", "filter_ms", "mask_ms", "frame_ms", "frame_ratio")]
        ratios = [one["frame_ratio"] for one in found if one["frame_ratio"] is not None]
        if len(ratios) > 1:
            cells[-1] += f" ({min(ratios):.2f} to {max(ratios):.2f})"
        lines.append(f"| `{technique}` | " + " | ".join(cells) + " |")
    return lines


def device_section(report: dict) -> list[str]:
    benches = [*report["bench"].values(), *report["lamps"].values(), report["blur"]]
    taken = next((gpu for gpu in report["device"].get("gpus", []) if gpu["taken"]), {"name": "no device", "driver": ""})
    name = next((bench["device"] for bench in benches if bench.get("device")), taken["name"])
    driver = next((bench["driver"] for bench in benches if bench.get("driver")), taken["driver"])
    lines = [f"## {name}", "", driver, "", *([report["note"], ""] if report.get("note") else [])]
    for what, key in (("drawing cases under validation", "cases"), ("masks beside lavapipe's", "masks")):
        found = report[key]
        if not found:
            lines.append(f"- {what}: not reached in time")
            continue
        lines.append(f"- {what}: {found['passed']} pass, {len(found['failed'])} fail, {len(found['skipped'])} are skipped")
        lines += [f"  - fails: {case}" for case in found["failed"]]
    grid = report["grid"]
    if grid:
        lines.append(f"- depths are off by {number(grid.get('steps_of_sun'))} (sun) and {number(grid.get('steps_of_spot'))} (spot) "
                     "steps of the grid at most; the bias allows for 2")
        if "unorm_read_steps" in grid:
            lines.append(f"- a filtered read of 16 bits is off by {number(grid['unorm_read_steps'])} (UNORM) and "
                         f"{number(grid['half_read_steps'])} (SFLOAT) steps of its format at most")
    copy = report["copy_bytes_per_s"]
    for technique, one in report["blur"]["techniques"].items():
        if copy and one["filter_ms"] and one["filter_bytes"]:
            share = one["filter_bytes"] / (one["filter_ms"] * 1e-3) / copy
            lines.append(f"- the blur of {technique} moves its bytes at {number(share)} of the rate of vkCmdCopyBuffer")
    left_out = [f"{step} ({outcome})" for step, outcome in report["steps"].items() if outcome != "done" and not (outcome == "ended with 1" and report.get(step))]
    if left_out:
        lines.append("- left out: " + ", ".join(left_out))
    for size in sorted({view.split("-")[0] for view in report["bench"]}):
        views = [bench for view, bench in report["bench"].items() if view.startswith(size) and bench["techniques"]]
        lines += times_of(f"{len(views)} views, {size}", views)
    for size in sorted({name.split("-")[0] for name in report["lamps"]}):
        lines += times_of(f"one sun and 32 lamps, {size}", [bench for name, bench in report["lamps"].items() if name.startswith(size)])
    return [*lines, ""]


def table(files: list[str]) -> str:
    lines = ["# Devices", "",
             "This page says how Gnomon does on devices that it was tried on. Each part is of one file of [docs/gpus](gpus), which "
             "`tools/on_gpu.sh FILE.json` wrote on a machine with that device; `tools/check_docs.py --write .` makes this page of them. "
             "Ratios are medians over the views, with the least and the largest. Times of a processor say little, for other work may share it.", ""]
    for file in files:
        lines += device_section(json.loads(Path(file).read_text(encoding="utf-8")))
    return "\n".join(lines)


def main() -> int:
    if len(sys.argv) == 4 and sys.argv[1] == "collect":
        return collect(Path(sys.argv[2]), Path(sys.argv[3]))
    if len(sys.argv) == 3 and sys.argv[1] == "taken":
        print(next((gpu["name"] for gpu in read(Path(sys.argv[2])).get("gpus", []) if gpu["taken"]), ""))
        return 0
    if len(sys.argv) == 4 and sys.argv[1] == "filters":
        print(",".join(filters_of(named(Path(sys.argv[2]), sys.argv[3]))))
        return 0
    if len(sys.argv) == 4 and sys.argv[1] == "software":
        return 0 if named(Path(sys.argv[2]), sys.argv[3])["software"] else 1
    if len(sys.argv) > 2 and sys.argv[1] == "table":
        print(table(sys.argv[2:]))
        return 0
    print(__doc__, file=sys.stderr)
    return 2


if __name__ == "__main__":
    sys.exit(main())
