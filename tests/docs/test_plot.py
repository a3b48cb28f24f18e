#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""tools/plot.py draws every plot of a result, well-formed, the same bytes each time.

usage: test_plot.py SCRIPT PYTHON_WITH_MATPLOTLIB
"""

import json
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree
from pathlib import Path

SCRIPT, PYTHON = Path(sys.argv.pop(1)).resolve(), sys.argv.pop(1)
EVIL = "</text><script>\"&'<\x01 $x^2$ ä"


def sweep(techniques: list[str], values: list[float], logarithmic: bool) -> dict:
    gap = [None] + [0.25] * (len(values) - 1)
    line = {key: gap for key in ("rmse", "mae", "bias", "p99", "edge", "acne", "detached", "bleeding", "terminator")}
    return {"scene": EVIL, "results": [],
            "sweep": {"key": "map-size", "unit": "texels", "logarithmic": logarithmic, "values": values,
                      "class_colours": dict.fromkeys(["edge", "acne", "detached", "bleeding", "terminator"], "#0072b2"),
                      "results": [{"technique": name, **line} for name in techniques]}}


def path(first: int, last: int) -> dict:
    count = last - first + 1
    lists = {"rmse": [0.5] * count, "mean_abs_change": [None] + [0.1] * (count - 1)}
    return {"scene": "planes", "path": {"name": "orbit", "frames": {"first": first, "last": last}},
            "results": [{"technique": name, "over_frames": lists} for name in ("hard", "pcf")]}


class Plots(unittest.TestCase):
    def setUp(self):
        self.kept = tempfile.TemporaryDirectory()
        self.folder = Path(self.kept.name)

    def tearDown(self):
        self.kept.cleanup()

    def run_script(self, result: dict, *arguments: str) -> int:
        file = self.folder / "result.json"
        file.write_text(json.dumps(result), encoding="utf-8")
        run = subprocess.run([PYTHON, SCRIPT, file, *arguments], cwd=self.folder, capture_output=True, text=True,
                             check=False)
        self.said = run.stderr
        return run.returncode

    def drawn(self, result: dict, folder: str) -> dict[str, bytes]:
        (self.folder / folder).mkdir()
        self.assertEqual(self.run_script(result, folder), 0)
        return {file.name: file.read_bytes() for file in (self.folder / folder).iterdir()}

    def test_draws_the_sweep_and_each_technique(self):
        result = sweep([EVIL, "pcf", "hard"], [64.0, 128.0, 256.0], True)
        files = self.drawn(result, "a")
        self.assertEqual(sorted(files), ["01_sweep.svg", "02_sweep.svg", "03_sweep.svg", "sweep.svg"])
        for name, text in files.items():
            root = xml.etree.ElementTree.fromstring(text)
            self.assertTrue(root.tag.endswith("svg"), name)
        self.assertIn(b">pcf</text>", files["sweep.svg"])
        for tick in (b">64</text>", b">128</text>", b">256</text>"):
            self.assertIn(tick, files["sweep.svg"])
        for name in (b">edge</text>", b">acne</text>", b">detached</text>", b">bleeding</text>"):
            self.assertIn(name, files["02_sweep.svg"])
        self.assertEqual(files, self.drawn(result, "b"))

    def test_has_one_plot_of_one_technique(self):
        self.assertEqual(list(self.drawn(sweep(["hard"], [8.0, 1.0], False), "a")), ["sweep.svg"])

    def test_does_with_nothing_to_show(self):
        result = sweep(["hard"], [1.0], True)
        for key in ("rmse", "edge", "acne", "detached", "bleeding", "terminator"):
            result["sweep"]["results"][0][key] = [None]
        self.assertIn("sweep.svg", self.drawn(result, "a"))

    def test_draws_frames(self):
        self.assertEqual(sorted(self.drawn(path(3, 9), "a")), ["change.svg", "error.svg"])
        self.assertEqual(sorted(self.drawn(path(3, 3), "b")), ["error.svg"])

    def test_tells_thirty_lines_apart(self):
        names = [f"technique {i}" for i in range(30)]
        text = self.drawn(sweep(names, [1.0, 2.0], False), "a")["sweep.svg"]
        for name in names:
            self.assertEqual(text.count(f">{name}</text>".encode()), 1)

    def test_draws_one_into_a_picture(self):
        result = sweep(["hard", "pcf"], [1.0, 2.0], False)
        self.assertEqual(self.run_script(result, "one.png", "02_sweep"), 0)
        self.assertTrue((self.folder / "one.png").read_bytes().startswith(b"\x89PNG"))
        self.assertEqual(self.run_script(result, "one.svg", "03_sweep"), 2)
        self.assertIn("no plot 03_sweep; it has sweep, 01_sweep, 02_sweep", self.said)

    def test_refuses_what_has_no_plots(self):
        self.assertEqual(self.run_script({"scene": "planes", "results": []}, "."), 2)
        self.assertIn("--sweep and --path", self.said)


if __name__ == "__main__":
    unittest.main()
