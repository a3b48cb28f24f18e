#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""cmake/compile_shader.cmake takes what was compiled before, in any folder, and never where something has changed.

usage: test_shader_cache.py CMAKE SCRIPT GLSLC SPIRV_VAL
"""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

CMAKE, SCRIPT, GLSLC, SPIRV_VAL = sys.argv[1:5]
del sys.argv[1:5]
SHADER = '#version 460\n#extension GL_GOOGLE_include_directive : enable\n#include "gain.glsl"\n' \
         "layout(location = 0) out float colour;\nvoid main() { colour = GAIN; }\n"


class Cache(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.top = Path(folder.name)
        self.validator = self.top / "validate"
        self.let_pass(True)
        for name in ("one", "another place"):
            (self.top / name / "include").mkdir(parents=True)
            (self.top / name / "pass.frag").write_text(SHADER, encoding="utf-8")
            self.set_gain(name, "1.0")

    def let_pass(self, passes: bool) -> None:
        """Without it nothing can be made, only taken."""
        self.validator.write_text(f'#!/bin/sh\n{SPIRV_VAL} "$@" && {"true" if passes else "false"}\n', encoding="utf-8")
        self.validator.chmod(0o755)

    def set_gain(self, name: str, gain: str) -> None:
        (self.top / name / "include/gain.glsl").write_text(f"#define GAIN {gain}\n", encoding="utf-8")

    def compile(self, name: str, *flags: str, tools="1", cache="cache") -> tuple[bytes, str, str] | None:
        """Module, words and list of includes, or None where it was not made."""
        root = self.top / name
        out = root / "build" / "pass.frag"
        out.parent.mkdir(exist_ok=True)
        made = [Path(f"{out}.{ending}") for ending in ("spv", "inc", "d")]
        for file in made:
            file.unlink(missing_ok=True)
        words = [GLSLC, *flags, f"-I{root}/include", "-MD", "-MF", made[2], "-MT", made[1], "-o", f"{out}.new",
                 root / "pass.frag"]
        ran = subprocess.run([CMAKE, "-DCOMMAND=" + "|".join(map(str, words)), f"-DVALIDATE={self.validator}|{out}.new",
                              f"-DOUT={out}", f"-DROOT={root}", f"-DTOOLS={tools}",
                              f"-DCACHE={self.top / cache if cache else ''}", "-P", SCRIPT], capture_output=True, check=False)
        self.assertEqual(made[1].exists(), ran.returncode == 0, ran.stderr)
        return (made[0].read_bytes(), made[1].read_text(), made[2].read_text()) if made[1].exists() else None

    def test_has_what_was_compiled_wherever_it_lies(self):
        first = self.compile("one")
        self.assertEqual(first[0][:4], b"\x03\x02\x23\x07")
        self.assertTrue(first[1].startswith("{0x07230203,"))
        self.let_pass(False)
        for name in ("one", "another place"):
            taken = self.compile(name)
            self.assertEqual(taken[:2], first[:2])
            root = str(self.top / name).replace(" ", "\\ ")
            self.assertEqual(sorted(taken[2].split(": ", 1)[1].replace("\\ ", "?").split()),
                             sorted(f"{root}/{file}".replace("\\ ", "?") for file in ("pass.frag", "include/gain.glsl")))

    def test_has_nothing_of_what_has_changed(self):
        self.compile("one")
        self.let_pass(False)
        self.assertIsNone(self.compile("one", "-O"))
        self.assertIsNone(self.compile("one", tools="2"))
        self.set_gain("one", "2.0")
        self.assertIsNone(self.compile("one"))
        (self.top / "one/include/gain.glsl").unlink()
        self.assertIsNone(self.compile("one"))
        self.assertIsNone(self.compile("another place", cache=""))

    def test_has_both_of_two_that_take_turns(self):
        gains = ("1.0", "2.0")
        modules = []
        for gain in gains:
            self.set_gain("one", gain)
            modules.append(self.compile("one")[0])
        self.let_pass(False)
        for gain, module in zip(gains, modules):
            self.set_gain("one", gain)
            self.assertEqual(self.compile("one")[0], module)

    def test_keeps_nothing_that_was_refused(self):
        self.let_pass(False)
        self.assertIsNone(self.compile("one"))
        self.set_gain("one", "unknown")
        self.let_pass(True)
        self.assertIsNone(self.compile("one"))
        self.assertEqual(list((self.top / "cache").glob("*")), [])


if __name__ == "__main__":
    unittest.main()
