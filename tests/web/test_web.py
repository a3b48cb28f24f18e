#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The npm package: it installs from its tarball in an empty folder, plans in node what the library plans on this machine, and draws in
Chromium the masks that the Vulkan backend draws.

usage: test_web.py PACKAGES WEB_CASES [RESULTS.json]

PACKAGES is the folder that `make web` fills, and WEB_CASES the program of draw_cases.cpp. Without a package, node or Chromium nothing is
tested, which is said; exit status 77.
"""

import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "page"))
import browser  # noqa: E402
from browser import Browser, find_chromium  # noqa: E402
from masks import Mask, beyond_edges, farthest  # noqa: E402
from recorder import run_cases  # noqa: E402
from serving import FLAGS, Server  # noqa: E402

PACKAGES, WEB_CASES = (Path(one).resolve() for one in sys.argv[1:3])
PACKAGE = next(iter(sorted(PACKAGES.glob("*.tgz"))), None)
RESULTS = Path(sys.argv[3]) if len(sys.argv) > 3 else None
# SwiftShader draws, which comes with Chromium: WebGPU without a GPU. As a Vulkan driver it rounds as there, so that masks are to be the
# same. It takes minutes to compile the larger filters; these are held to another driver's masks.
SWIFTSHADER = Path("/usr/lib/chromium/vk_swiftshader_icd.json")
SLOW_S = 120  # it compiles each pipeline on one processor
MOST_KB = 1500
# Pixels of 14400. Another driver places the edges of a map's casters otherwise, by a texel here and there: raymarch has one such pixel.
MOST_BEYOND = {"exact": 0, "cases": 1}


class Web(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.kept = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        cls.folder = Path(cls.kept.name)
        cls.addClassCleanup(cls.kept.cleanup)
        (cls.folder / "package.json").write_text('{"name": "host", "private": true, "type": "module"}')
        subprocess.run(["npm", "install", "--offline", "--no-audit", "--no-fund", str(PACKAGE)], cwd=cls.folder, check=True, capture_output=True)
        (cls.folder / "package").symlink_to("node_modules/gnomon-shadows")
        for name, rest in (("cases", ()), ("exact", ("exact",))):
            (cls.folder / name).mkdir()
            driver = {"VK_DRIVER_FILES": str(SWIFTSHADER), "VK_ICD_FILENAMES": str(SWIFTSHADER)} if rest else {}
            subprocess.run([WEB_CASES, cls.folder / name, *rest], check=True, env={**os.environ, **driver})
        for file in HERE.glob("*"):
            if file.suffix in (".mjs", ".html"):
                shutil.copy(file, cls.folder)
        cls.server = Server(cls.folder)
        cls.addClassCleanup(cls.server.stop)
        browser.ARGUMENTS = [one for one in browser.ARGUMENTS if one != "--disable-gpu"] + list(FLAGS)
        browser.LONGEST_WAIT_S = SLOW_S
        cls.browser = Browser(find_chromium())
        cls.addClassCleanup(cls.browser.__exit__)
        cls.browser.visit(cls.server.address + "index.html")
        cls.browser.wait_for("globalThis.isReady === true")

    def test_node_plans(self):
        done = subprocess.run(["node", "--test", "planner.test.mjs"], cwd=self.folder, capture_output=True, text=True, check=False,
                              env={**os.environ, "CASES": str(self.folder / "cases")})
        print("\n".join(line for line in done.stdout.splitlines() if "numbers differ" in line))
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertNotIn("# pass 0\n", done.stdout)

    def test_types_are_shipped(self):
        self.assertTrue((self.folder / "node_modules/gnomon-shadows/dist/index.d.ts").is_file())

    def test_it_is_light(self):
        self.assertLess(PACKAGE.stat().st_size, 1000 * MOST_KB)

    def drawn(self, folder: str, case: dict, scene: dict) -> tuple[Mask, Mask, dict]:
        """The mask by WebGPU, that by Vulkan, and which maps the second frame drew: nothing moved, so that it is to draw none."""
        shape = (scene["widthPx"], scene["heightPx"], case["channels"], case["layers"])
        answer = self.browser.run(f"drawCase({case['name']!r}, 2, {folder!r})")
        return Mask(bytes.fromhex(answer["texels"]), *shape), Mask((self.folder / folder / f"{case['name']}.bin").read_bytes(), *shape), answer["reuse"]

    def test_chromium_draws_the_masks_of_vulkan(self):
        self.assertTrue(self.browser.run("hasDevice"), "Chromium has no WebGPU")
        for folder in ("exact", "cases"):
            told = json.loads((self.folder / folder / "cases.json").read_text())
            for case in told["cases"]:
                with self.subTest(case["name"], folder=folder):
                    mask, wanted, reuse = self.drawn(folder, case, told["scene"])
                    apart, beyond = farthest(mask, wanted), beyond_edges(mask, wanted)
                    print(f"{folder} {case['name']:14} farthest {apart:3} of 255, {beyond} beyond edges")
                    self.assertGreater(wanted.spread(), 128, "there is no shadow to compare")
                    self.assertLessEqual(beyond, MOST_BEYOND[folder])
                    if folder == "exact":
                        self.assertLessEqual(apart, 1)
                    self.assertEqual(reuse["drawn"] + reuse["keptDrawn"], 0, "what stands still is drawn again")
        self.assertEqual(self.browser.problems, [])

    def test_what_is_kept_is_as_if_drawn_anew(self):
        for settings, lights in (({"filter": "pcf", "keep-still": "always", "partition": "single", "map-size": 256}, 1),
                                 ({"filter": "vsm", "keep-still": "always", "partition": "single", "map-size": 256}, 1),
                                 ({"filter": "hard", "keep-still": "always", "map-format": "r32f", "map-size": 128}, 3),
                                 ({"filter": "pcss", "partition": "auto", "map-size": 128}, 3)):
            with self.subTest(settings):
                told = self.browser.run(f"drawOn({json.dumps(settings)}, {lights})")
                print(f"{settings['filter']}: {told}")
                self.assertLessEqual(told["apart"], 1)
                if "keep-still" in settings:
                    self.assertGreater(told["reuse"]["restored"], 0, "nothing was restored")

    def test_no_frame_compiles_what_was_warmed_up(self):
        for settings in ({"filter": "hard", "partition": "single"}, {"filter": "vsm", "partition": "cascades", "map-size": 128}):
            with self.subTest(settings):
                told = self.browser.run(f"drawWarm({json.dumps(settings)})")
                print(f"{settings['filter']}: {told}")
                self.assertIn(f"gnomon mask_{settings['filter']}.frag", told["ahead"])
                self.assertEqual(told["late"], [])
                self.assertEqual(told["apart"], 0)
                self.assertLess(told["least"], 128, "there is no shadow to compare")

    def test_textures_cut_holes(self):
        self.assertEqual(self.browser.run("drawHoles()"), [0, 255])

    def test_the_example_of_the_document_draws(self):
        self.assertEqual(self.browser.run("drawExample()"), [0, 255, 160 * 90])

    def test_a_check_can_fail(self):
        shape = (160, 90, 1, 1)
        folder = self.folder / "cases"
        sun, spot = (Mask((folder / f"{name}.bin").read_bytes(), *shape) for name in ("hard_sun", "pcf_spot"))
        self.assertGreater(farthest(sun, spot), 128)
        self.assertGreater(beyond_edges(sun, spot), 20)

    def test_nothing_is_asked_for_beyond_its_own_files(self):
        self.assertTrue(self.browser.requests)
        self.assertEqual([one for one in self.browser.requests if not one.startswith(self.server.address)], [])
        # The observer would have seen it.
        self.browser.run("fetch('https://example.org/').catch(() => 0)")
        self.assertTrue(any("Content Security Policy" in one for one in self.browser.problems), self.browser.problems)
        self.browser.problems.clear()

    def test_what_a_device_lacks_is_told(self):
        for settings, found in (({"filter": "msm"}, "map-format=rgba32f"), ({"filter": "pcf", "partition": "sdsm"}, "sdsm"),
                                ({"filter": "pcf", "partition": "single", "map-size": 16384}, "texels")):
            with self.subTest(settings):
                self.assertIn(found, self.browser.run(f"refusal({json.dumps(settings)})"))


if __name__ == "__main__":
    missing = [name for name, there in (("the package (`make web`)", PACKAGE), (SWIFTSHADER.name, SWIFTSHADER.exists()), ("node", shutil.which("node")), ("npm", shutil.which("npm")), ("Chromium", find_chromium())) if not there]
    if missing:
        print(f"SKIPPED: there is no {', no '.join(missing)}; install the sections kit, web and tests of packages.txt")
        sys.exit(77)
    sys.exit(run_cases(Web, RESULTS))
