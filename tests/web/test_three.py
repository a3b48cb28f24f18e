#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Gnomon's shadows for three.js (web/three): the example's mask is held to rays, and what it tracks to changes of the scene.

usage: test_three.py PACKAGES BUILD [RESULTS.json]

PACKAGES is the folder that `make web` fills; BUILD is a folder for what is made: npm installs three.js there at the version of
web/three/package-lock.json. Without the package, node, npm or Chromium nothing is tested, which is said; exit status 77.
"""

import shutil
import subprocess
import sys
import unittest
from pathlib import Path

HERE = Path(__file__).resolve().parent
THREE = HERE.parent.parent / "web/three"
sys.path[:0] = [str(HERE.parent / "page"), str(HERE)]
import browser  # noqa: E402
from browser import Browser, find_chromium  # noqa: E402
from recorder import run_cases  # noqa: E402
from serving import FLAGS, Server  # noqa: E402

PACKAGES, BUILD = (Path(one).resolve() for one in sys.argv[1:3])
RESULTS = Path(sys.argv[3]) if len(sys.argv) > 3 else None
SLOW_S = 300  # SwiftShader compiles each pipeline on one processor
MOST_WRONG = 0.02  # share of points: beside edges a texel of a map decides


def packages() -> list[Path]:
    return sorted(PACKAGES.glob("gnomon-shadows-*.tgz"))


def build(folder: Path) -> None:
    """web/three and the package beside it, as they would be served."""
    shutil.rmtree(folder / "three/src", ignore_errors=True)
    shutil.copytree(THREE, folder / "three", dirs_exist_ok=True, ignore=shutil.ignore_patterns("node_modules", "dist"))
    shutil.unpack_archive(packages()[0], folder / "unpacked")
    shutil.copytree(folder / "unpacked/package/dist", folder / "dist", dirs_exist_ok=True)
    if not (folder / "three/node_modules/.bin/tsc").exists():
        subprocess.run(["npm", "ci", "--ignore-scripts", "--no-audit", "--no-fund"], cwd=folder / "three", check=True, capture_output=True)
    subprocess.run(["node_modules/.bin/tsc", "-p", "."], cwd=folder / "three", check=True)
    for name in ("canvas.js", "three_checks.mjs"):
        shutil.copy(HERE / name, folder / "three")


class ForThree(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        build(BUILD)
        cls.server = Server(BUILD)
        cls.addClassCleanup(cls.server.stop)
        browser.ARGUMENTS = [one for one in browser.ARGUMENTS if one != "--disable-gpu"] + list(FLAGS)
        browser.LONGEST_WAIT_S = SLOW_S
        cls.tab = Browser(find_chromium())
        cls.addClassCleanup(cls.tab.__exit__)
        cls.tab.call("Page.addScriptToEvaluateOnNewDocument", source=(HERE / "canvas.js").read_text(encoding="utf-8"))
        cls.tab.screen(480, 270)
        cls.tab.visit(cls.server.address + "three/example.html")
        cls.tab.wait_for("window.framesDrawn >= 1 || document.getElementById('said').textContent.startsWith('cannot')")
        cls.tab.run("""(async () => {
            const {example} = window;
            example.renderer.setAnimationLoop(null);
            document.getElementById('moving').checked = false;
            window.checks = await import('./three_checks.mjs');
            window.draw = async () => { example.frame(0); await example.renderer.backend.device.queue.onSubmittedWorkDone(); };
            window.points = async (name, step) => {
                const {camera, court, renderer} = example;
                const shadows = example.shadows();
                const {mask} = shadows;
                const texels = await texelsOf(renderer.backend.device, mask, mask.format === 'r8unorm' ? 1 : 4);
                return checks.compare({camera, court, shadows, texels, width: mask.width, height: mask.height, light: court[name], step});
            };
        })()""")

    def test_a_picture_is_drawn(self):
        self.assertEqual(self.tab.run("document.getElementById('said').textContent").split("; ")[-1][-8:], "3 lights")
        self.assertEqual(self.tab.problems, [])

    def test_points_that_rays_find_lit_or_shadowed_are_so_in_the_mask(self):
        for light, least in (("sun", 60), ("spot", 5), ("lamp", 5)):
            with self.subTest(light):
                found = self.tab.run(f"draw().then(() => points('{light}', 7))")
                count = found["lit"] + found["shadowed"]
                print(f"{light}: {found['lit']} lit, {found['shadowed']} shadowed, {len(found['wrong'])} wrong {found['wrong'][:3]}")
                self.assertGreater(found["lit"], least)
                self.assertGreater(found["shadowed"], least)
                self.assertLessEqual(len(found["wrong"]), MOST_WRONG * count)

    def test_msm_draws_in_a_format_that_can_be_stored_to(self):
        found = self.tab.run("example.use('msm+cascades').then(draw).then(() => points('sun', 7))")
        self.tab.run("example.use('raymarch+cascades').then(draw)")
        self.assertGreater(found["shadowed"], 60)
        # It blurs farther than a texel. Without shadows 7 of a hundred points would be wrong.
        self.assertLessEqual(len(found["wrong"]), 2 * MOST_WRONG * (found["lit"] + found["shadowed"]), found["wrong"][:4])

    def test_a_check_can_fail(self):
        # The scene is another one than the mask was made of.
        found = self.tab.run("""(async () => {
            await draw();
            const {court} = example;
            court.sun.position.x *= -1;
            court.scene.updateMatrixWorld();
            const wrong = await points('sun', 7);
            court.sun.position.x *= -1;
            court.scene.updateMatrixWorld();
            return wrong;
        })()""")
        self.assertGreater(len(found["wrong"]), 0.1 * (found["lit"] + found["shadowed"]))

    def test_what_moves_comes_and_goes_is_followed(self):
        for change in ("court.knot.position.x += 3", "court.knot.visible = false", "court.knot.visible = true", "court.knot.castShadow = false",
                       "court.knot.castShadow = true; court.knot.position.x -= 3"):
            with self.subTest(change):
                self.tab.run(f"((court) => {{ {change}; }})(example.court)")
                found = self.tab.run("""draw().then(() => {
                    const {court} = example;
                    const casts = court.knot.castShadow;
                    if (!casts) { court.knot.visible = false; }
                    return points('sun', 6).finally(() => { court.knot.visible = court.knot.visible || !casts; });
                })""")
                self.assertLessEqual(len(found["wrong"]), MOST_WRONG * (found["lit"] + found["shadowed"]), found["wrong"][:4])

    def test_what_is_left_out_is_told(self):
        notices = self.tab.run("""(async () => {
            const THREE = await import('three/webgpu');
            const {court} = example;
            const mesh = new THREE.SkinnedMesh(new THREE.BoxGeometry(), new THREE.MeshStandardMaterial());
            const count = mesh.geometry.getAttribute('position').count;
            mesh.geometry.setAttribute('skinIndex', new THREE.Uint16BufferAttribute(new Uint16Array(4 * count), 4));
            mesh.geometry.setAttribute('skinWeight', new THREE.Float32BufferAttribute(new Float32Array(4 * count).fill(0.25), 4));
            const bone = new THREE.Bone();
            mesh.add(bone);
            mesh.bind(new THREE.Skeleton([bone]));
            mesh.castShadow = mesh.receiveShadow = true;
            mesh.position.set(0, 8, 0);
            court.scene.add(mesh);
            await draw();
            court.scene.remove(mesh);
            await draw();
            return [...example.shadows().notices];
        })()""")
        self.assertEqual(len(notices), 1)
        self.assertIn("skinned meshes receive shadows and cast none", notices[0])

    def test_zz_lights_get_their_own_shadows_back(self):
        self.assertEqual(self.tab.run("(() => { example.shadows().dispose(); return 'shadowNode' in example.court.sun.shadow; })()"), False)


if __name__ == "__main__":
    missing = [name for name, there in (("node", shutil.which("node")), ("npm", shutil.which("npm")), ("Chromium", find_chromium())) if not there]
    if not packages():
        print(f"SKIPPED: there is no package in {PACKAGES}; make web makes it")
        sys.exit(77)
    if missing:
        print(f"SKIPPED: {', '.join(missing)} is missing; install the sections kit and tests of packages.txt")
        sys.exit(77)
    sys.exit(run_cases(ForThree, RESULTS))
