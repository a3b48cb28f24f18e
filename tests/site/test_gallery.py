#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The gallery has every value of every choice, and what draws it draws.

usage: test_gallery.py ROOT GNOMON
"""

import json
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT, GNOMON = (Path(argument).resolve() for argument in (sys.argv.pop(1), sys.argv.pop(1)))
sys.path.insert(0, str(ROOT / "tools"))

import make_gallery  # noqa: E402

LISTED = json.loads((ROOT / "docs/gallery.json").read_text(encoding="utf-8"))


class Gallery(unittest.TestCase):
    def test_it_has_every_value(self):
        choices = json.loads(subprocess.run([GNOMON, "list", "--json"], capture_output=True, text=True, check=True).stdout)["choices"]
        wanted = {(choice["choice"], value["name"]) for choice in choices for value in choice["values"]} - {("soften", "none")}
        self.assertEqual({(one["choice"], one["name"]) for one in LISTED["entries"]}, {one for one in wanted if one[0] != "light"})

    def test_every_entry_is_its_value(self):
        for one in LISTED["entries"]:
            words = one["technique"].split("+")
            self.assertTrue(one["name"] in words or one["name"] in ("auto", "free"), one)
            for part in (one, one["fails"]):
                self.assertIn(part["view"], LISTED["views"])
        used = {part["view"] for one in LISTED["entries"] for part in (one, one["fails"])}
        self.assertEqual(used, set(LISTED["views"]))

    def test_what_is_made_goes_between_the_marks(self):
        page = f"before\n{make_gallery.BEGINS}\nold\n{make_gallery.ENDS}\nafter\n"
        self.assertEqual(make_gallery.page_with(page, "new\n"), page.replace("old", "new"))
        with self.assertRaises(make_gallery.Failed):
            make_gallery.page_with("no marks", "new")
        self.assertIn(make_gallery.BEGINS, (ROOT / "docs/gallery.md").read_text(encoding="utf-8"))

    def test_the_row_of_a_technique_is_found(self):
        rows = [{"technique": "pcf+pcf.kernel=3x3+map-size=64", "choices": {"filter": "pcf", "fit": "auto"}},
                {"technique": "hard+map-size=64", "choices": {"filter": "hard", "fit": "uniform"}}]
        self.assertIs(make_gallery.result_of(rows, "hard+uniform+map-size=64"), rows[1])
        self.assertIs(make_gallery.result_of(rows, "pcf+map-size=64"), rows[0])
        with self.assertRaises(make_gallery.Failed):
            make_gallery.result_of(rows, "vsm")

    @unittest.skipUnless(shutil.which("ffmpeg"), "there is no ffmpeg")
    def test_an_entry_and_a_film_are_drawn(self):
        with tempfile.TemporaryDirectory() as kept:
            gallery = make_gallery.Gallery(GNOMON, Path(kept), {"views": {"box": {"scene": "planes", "arguments": ["--camera", "side", "--light", "sun"],
                                                                                  "base": "hard+single+uniform+map-size=64"}}}, "32x18")
            text = gallery.draw({"choice": "filter", "name": "pcf", "view": "box", "technique": "pcf+map-size=64",
                                 "fails": {"view": "box", "technique": "pcf+map-size=16", "words": "Wide."}})
            self.assertIn("times `hard`'s time", text)
            self.assertEqual(sorted(file.name for file in (Path(kept) / "gallery").iterdir()), ["filter-pcf-fails.jpg", "filter-pcf.jpg"])
            gallery.film({"name": "two", "scene": "planes", "arguments": ["--camera", "side", "--frames", "0-3"], "size": "32x18", "fps": 12,
                          "techniques": ["hard", "pcf"], "words": "Two."})
            for name in ("two.webm", "two.png"):
                size = subprocess.run(["ffprobe", "-v", "error", "-select_streams", "v", "-show_entries", "stream=width,height", "-of", "csv=p=0",
                                       Path(kept) / "films" / name], capture_output=True, text=True, check=True).stdout
                self.assertEqual(size.strip(), "64,18")


if __name__ == "__main__":
    unittest.main()
