#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Error and time of Gnomon's shadows in three.js beside three.js' own, on the same WebGPURenderer in one run (docs/three.md).

usage: measure_three.py [--size WxH] [--map-size N] [--frames N] [--techniques LIST] [--only SCENE] [--pictures FOLDER] GNOMON SHARED WEB

GNOMON is the program, which traces the truth; SHARED has scenes/; WEB has the built packages, dist/ and three/ with dist/ and
node_modules/. A technique of three.js' own may set members of its LightShadow: "pcf+bias=-0.002+normalBias=0.05+radius=2".
Chromium draws with SwiftShader. Times are milliseconds that shadows add to the frame without them: medians.
"""

import argparse
import base64
import subprocess
import sys
import tempfile
from pathlib import Path

from measuring import table

ROOT = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT / "tests/page"), str(ROOT / "tests/web")]
import browser  # noqa: E402
from serving import FLAGS, Server  # noqa: E402

VIEWS = {
    "kenney_city": {"eye": [3, 3.2, 6.5], "target": [2.5, 0.3, 1.5], "fov_deg": 45, "sun": [0.5826, -0.766, -0.2717],
                    "center": [1, 0, 1], "half_m": 12},
    "truck_town": {"eye": [0, 22, 45], "target": [2, 8, 5], "fov_deg": 50, "sun": [0.4967, -0.819, 0.2868], "center": [0, 8, 0], "half_m": 60},
}
# Biases of three.js' own are the best of a few that were tried on these views.
TECHNIQUES = ("hard+bias=-0.0005+normalBias=0,pcf+bias=-0.0008+normalBias=0,csm+bias=-0.00001+normalBias=0,csm+bias=-0.00003+normalBias=0,"
              "vsm+bias=-0.0005+normalBias=0+radius=2,gnomon:hard,gnomon:pcf,gnomon:pcf+lispsm,gnomon:pcf+cascades,gnomon:raymarch+cascades")
LONGEST_S = 600


def trace(options: argparse.Namespace, name: str, out: Path) -> None:
    """Area visibility at pixel centres under a sun of 0.53 degrees."""
    view = VIEWS[name]
    line = [options.gnomon, "render", str(options.shared / f"scenes/{name}/{name}.gltf"), "--eye", ",".join(map(str, view["eye"])),
            "--target=" + ",".join(map(str, view["target"])), "--fov", str(view["fov_deg"]), "--sun=" + ",".join(map(str, view["sun"])),
            "--sun-angle", "0.53", "--size", options.size, "--truth", "area", "--mask", "--out", str(out)]
    done = subprocess.run(line, capture_output=True, text=True)
    if done.returncode != 0:
        raise SystemExit(f"{' '.join(line)}: {done.stderr.strip()}")


def measure(options: argparse.Namespace, tab: browser.Browser, address: str, name: str) -> list[list[str]]:
    width, height = map(int, options.size.split("x"))
    rows, bare = [], 0.0
    for technique in ["none", *options.techniques.split(",")]:
        own, _, words = technique.partition("+") if not technique.startswith("gnomon:") else (technique, "", "")
        settings = {key: float(value) for key, value in (word.split("=") for word in words.split("+") if word)}
        job = VIEWS[name] | {"technique": own, "set": settings, "width": width, "height": height, "map_size": options.map_size, "frames": options.frames,
                             "address": f"{address}scenes/{name}/{name}.gltf", "truth": f"{address}{name}.png"}
        tab.problems.clear()
        tab.visit(f"{address}web/three/measure.html")
        tab.wait_for("globalThis.isReady === true")
        found = tab.run(f"measure({job!r})".replace("None", "null"))
        print(name, technique, {key: one for key, one in found.items() if key != "picture"}, tab.problems, file=sys.stderr, flush=True)
        if technique == "none":
            bare = found["ms"]
            rows.append(["none", "", "", f"{bare:.0f} ms a frame", ""])
            continue
        if options.pictures:
            options.pictures.mkdir(parents=True, exist_ok=True)
            (options.pictures / f"{name}-{technique.replace(':', '-')}.png").write_bytes(base64.b64decode(found["picture"].split(",")[1]))
        still = found["still_ms"]
        rows.append([f"`{technique}`", f"{found['rmse']:.4f}", f"{found['mean']:+.4f}", f"{found['ms'] - bare:.0f}", "" if still is None else f"{still - bare:.0f}"])
    return rows


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("--size", default="640x360")
    parser.add_argument("--map-size", type=int, default=2048)
    parser.add_argument("--frames", type=int, default=5)
    parser.add_argument("--techniques", default=TECHNIQUES)
    parser.add_argument("--only", default=",".join(VIEWS))
    parser.add_argument("--pictures", type=Path)
    parser.add_argument("gnomon")
    parser.add_argument("shared", type=Path)
    parser.add_argument("web", type=Path)
    options = parser.parse_args()
    browser.ARGUMENTS = [one for one in browser.ARGUMENTS if one != "--disable-gpu"] + list(FLAGS)
    browser.LONGEST_WAIT_S = LONGEST_S
    with tempfile.TemporaryDirectory() as kept:
        folder = Path(kept)
        for name, there in (("web", options.web), ("scenes", options.shared / "scenes")):
            (folder / name).symlink_to(there.resolve())
        server = Server(folder)
        for name in options.only.split(","):
            trace(options, name, folder / f"{name}.png")
            with browser.Browser(browser.find_chromium()) as tab:
                rows = measure(options, tab, server.address, name)
            print(f"{name}\n\n" + table([name, "rmse", "mean error", "added ms, maps drawn anew", "maps kept"], rows), flush=True)
        server.stop()
    return 0


if __name__ == "__main__":
    sys.exit(main())
