#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The gallery's links to the playground lead to views that the playground has, and the site has it where it is built.

usage: test_links.py ROOT
"""

import json
import re
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(sys.argv.pop(1)).resolve()
sys.path.insert(0, str(ROOT / "tools"))

import site_playground  # noqa: E402

VIEWS = json.loads((ROOT / "docs/gallery.json").read_text(encoding="utf-8"))["views"]


class Links(unittest.TestCase):
    def test_a_view_is_in_the_address(self):
        self.assertEqual(site_playground.address(VIEWS["gate"], "pcf+map-size=2048"), "world=rts&technique=pcf+map-size=2048&light=2&camera=camp&fov=11")
        self.assertEqual(site_playground.address(VIEWS["dial"], "pcss"), "world=sundial&technique=pcss&light=4&camera=1.5,2.7,1.2,0.5,1.3,-0.15,45")

    def test_what_the_page_cannot_show_has_no_link(self):
        self.assertIsNone(site_playground.address(VIEWS["statue"], "pcf"))  # another world
        self.assertIsNone(site_playground.address(VIEWS["noon"], "pcf"))  # a path
        self.assertIsNone(site_playground.address(VIEWS["gate"], "volumes"))

    def test_worlds_and_values_are_the_page_s(self):
        page = (ROOT / "web/playground/src/main.ts").read_text(encoding="utf-8")
        self.assertEqual(set(re.findall(r"'([a-z]+)'", re.search(r"kWorlds = \[(.*?)\]", page)[1])), site_playground.WORLDS)
        offered = (ROOT / "web/playground/src/controls.ts").read_text(encoding="utf-8")
        self.assertEqual(set(re.findall(r"'([a-z-]+)'", re.search(r"kOffered = \{(.*?)\}", offered, re.DOTALL)[1])), site_playground.NAMES)

    def test_the_gallery_has_links(self):
        text = site_playground.with_links((ROOT / "docs/gallery.md").read_text(encoding="utf-8"), VIEWS)
        self.assertGreater(text.count("[Try it](../playground/index.html#world="), 20)

    def test_the_site_has_what_is_built(self):
        with tempfile.TemporaryDirectory() as kept:
            root = Path(kept)
            (root / "pages/docs").mkdir(parents=True)
            (root / "docs").mkdir()
            self.assertFalse(site_playground.install(root, root / "pages"))
            (root / site_playground.BUILT).mkdir(parents=True)
            (root / site_playground.BUILT / "index.html").write_text("here", encoding="utf-8")
            (root / "docs/gallery.json").write_text(json.dumps({"views": {"gate": VIEWS["gate"]}}), encoding="utf-8")
            (root / "pages/docs/gallery.md").write_text("`gate`, `pcf` |\n", encoding="utf-8")
            self.assertTrue(site_playground.install(root, root / "pages"))
            self.assertEqual((root / "pages" / site_playground.PAGE).read_text(encoding="utf-8"), "here")
            self.assertIn("[Try it](../playground/index.html#world=rts&technique=pcf&", (root / "pages/docs/gallery.md").read_text(encoding="utf-8"))
        settings = (ROOT / "site/mkdocs.yml").read_text(encoding="utf-8")
        self.assertIn("  - Playground: playground/index.html\n", site_playground.navigation(settings))


if __name__ == "__main__":
    unittest.main()
