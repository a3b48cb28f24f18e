#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Takes a package at a time from the list of a small project and expects the checker to name it and its user; the whole list
must pass. usage: test_check_packages.py TOOLS_FOLDER"""

import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

TOOLS = Path(sys.argv.pop(1))

LIST = """= library
g++
ninja-build
libglm-dev
= program
libpng-dev
libxxhash-dev
python3-matplotlib
= tests and benchmarks
groff-base
"""
TREE = {
    "core/a.cpp": "#include <glm/vec3.hpp>\nint main() { return 0; }\n",
    "image/b.cpp": "#include <png.h>\nint main() { return 0; }\n",
    "tests/page.sh": "#!/usr/bin/env bash\nif true; then cat page | groff -man; fi # zsh\n",
    "tools/draw.py": "import json\nimport matplotlib.pyplot\n",
    "build/CMakeCache.txt": "",
    "build/build.ninja": """rule CXX_COMPILER
  command = g++ -MD -MF $out.d -c $in -o $out
  depfile = $out.d
  deps = gcc
rule CXX_EXECUTABLE_LINKER__core_Release
  command = true
rule CXX_EXECUTABLE_LINKER__image_Release
  command = true
build core/CMakeFiles/core.dir/a.o: CXX_COMPILER ../core/a.cpp
build image/CMakeFiles/image.dir/b.o: CXX_COMPILER ../image/b.cpp
build one: CXX_EXECUTABLE_LINKER__core_Release core/CMakeFiles/core.dir/a.o
  LINK_LIBRARIES =
build other: CXX_EXECUTABLE_LINKER__image_Release image/CMakeFiles/image.dir/b.o
  LINK_LIBRARIES = /usr/lib/x86_64-linux-gnu/libpng.so -lxxhash
""",
}


@unittest.skipUnless(shutil.which("dpkg-query") and os.uname().machine == "x86_64", "this is not a Debian system on x86-64")
class Lists(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.root = Path(cls.folder.name)
        for name, text in TREE.items():
            file = cls.root / name
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(text, encoding="utf-8")
        subprocess.run(["ninja", "-C", cls.root / "build"], check=True, stdout=subprocess.DEVNULL)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def check(self, text: str, *more) -> subprocess.CompletedProcess:
        (self.root / "packages.txt").write_text(text, encoding="utf-8")
        return subprocess.run([sys.executable, "-B", TOOLS / "check_packages.py", "--root", self.root, *more, self.root / "build"],
                              capture_output=True, text=True, check=False)

    def lacks(self, package: str, *users: str):
        done = self.check(LIST.replace(package + "\n", ""))
        self.assertEqual(done.returncode, 1)
        self.assertIn(f"packages: {package} comes with none of the sections", done.stderr)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        self.assertTrue(any(user in done.stderr for user in users), done.stderr)

    def test_whole_list_passes(self):
        done = self.check(LIST)
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_header_is_missed(self):
        self.lacks("libglm-dev", "core/CMakeFiles/core.dir/a.o uses /usr/include/glm/")

    def test_library_is_missed(self):
        self.lacks("libxxhash-dev", "image/CMakeFiles/image.dir uses /usr/lib/x86_64-linux-gnu/libxxhash.so")

    def test_header_and_library_are_missed_together(self):
        self.lacks("libpng-dev", "image/CMakeFiles/image.dir")

    def test_program_is_missed(self):
        self.lacks("groff-base", "tests/page.sh uses /usr/bin/groff", "tests/page.sh uses /bin/groff")

    def test_module_of_python_is_missed(self):
        self.lacks("python3-matplotlib", "tools/draw.py uses /usr/lib/python3/dist-packages/matplotlib")

    def test_section_of_another_does_not_serve_the_library(self):
        done = self.check(LIST.replace("libglm-dev\n", "") + "libglm-dev\n")
        self.assertEqual(done.returncode, 1)
        self.assertIn("libglm-dev comes with none of the sections library of packages.txt", done.stderr)

    def test_path_of_allowed_programs_hides_all_others(self):
        programs = self.root / "programs"
        self.assertEqual(self.check(LIST, "--programs", programs).returncode, 0)
        self.assertIsNotNone(shutil.which("groff", path=programs))
        self.assertIsNotNone(shutil.which("c++", path=programs))
        self.check(LIST.replace("groff-base\n", ""), "--programs", programs)
        self.assertIsNone(shutil.which("groff", path=programs))


if __name__ == "__main__":
    unittest.main()
