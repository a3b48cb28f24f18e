#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The other checks of tools/ must be able to fail: plants one fault at a time. usage: test_checks.py TOOLS_FOLDER"""

import json
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

TOOLS = Path(sys.argv.pop(1))


def run(tool: str, tree: dict[str, str]) -> subprocess.CompletedProcess:
    with tempfile.TemporaryDirectory() as root:
        for name, text in tree.items():
            file = Path(root, name)
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(text, encoding="utf-8")
        return subprocess.run([sys.executable, TOOLS / tool, root], capture_output=True, text=True, check=False)


class Headers(unittest.TestCase):
    def test_header_that_stands_alone_passes(self):
        result = run("check_headers.py", {"core/include/gnomon/a.h": "#pragma once\n#include <vector>\n"
                                                                     "inline std::vector<int> a;\n"})
        self.assertEqual(result.returncode, 0, result.stderr)

    def test_missing_include_fails(self):
        result = run("check_headers.py", {"core/include/gnomon/a.h": "#pragma once\ninline std::vector<int> a;\n"})
        self.assertEqual(result.returncode, 1)
        self.assertIn("core/include/gnomon/a.h", result.stderr)

    def test_missing_guard_fails(self):
        result = run("check_headers.py", {"core/include/gnomon/a.h": "inline int a = 0;\n"})
        self.assertEqual(result.returncode, 1)

    def test_public_header_cannot_see_private_one(self):
        result = run("check_headers.py", {"core/include/gnomon/a.h": '#pragma once\n#include "b.h"\n',
                                          "core/src/b.h": "#pragma once\n"})
        self.assertEqual(result.returncode, 1)

    def test_object_shows_what_its_source_includes_first_unless_a_header_is_newer(self):
        for guard, older, stands in (("#pragma once\n", True, True), ("#pragma once\n", False, False), ("", True, False)):
            with self.subTest(guard=guard, older=older), tempfile.TemporaryDirectory() as folder:
                root, build = Path(folder, "root").resolve(), Path(folder, "build").resolve()
                header, source, made = root / "core/src/a.h", root / "core/src/a.cpp", build / "a.o"
                header.parent.mkdir(parents=True)
                build.mkdir()
                # Only by taking the object's word can this header pass.
                header.write_text(guard + "inline std::vector<int> a;\n", encoding="utf-8")
                source.write_text('#include "a.h"\n', encoding="utf-8")
                made.write_text("", encoding="utf-8")
                for file, time in ((header, 1 if older else 3), (source, 1), (made, 2)):
                    os.utime(file, (time, time))
                (build / "compile_commands.json").write_text(json.dumps(
                    [{"file": str(source), "command": "c++ -o a.o -c a.cpp"}]), encoding="utf-8")
                result = subprocess.run([sys.executable, TOOLS / "check_headers.py", "--build", build, root],
                                        capture_output=True, text=True, check=False)
                self.assertEqual(result.returncode == 0, stands, result.stderr)

    def test_no_header_fails(self):
        self.assertEqual(run("check_headers.py", {"README.md": ""}).returncode, 1)


class Text(unittest.TestCase):
    def test_plain_text_passes(self):
        result = run("check_text.py", {"a.cpp": "int a; // See ../shared and <sys/stat.h>, 1/home, $HOME/x.\n"})
        self.assertEqual(result.returncode, 0, result.stderr)

    def test_forbidden_text_fails(self):
        for line in ("// TO" "DO: later", "// FIX" "ME", "a stu" "b", "it is not" " implemented",
                     '"/hom' 'e/somebody/file"', "cd /wor" "k/main"):
            with self.subTest(line):
                result = run("check_text.py", {"core/a.cpp": "int a;\n" + line + "\n"})
                self.assertEqual(result.returncode, 1)
                self.assertIn("core/a.cpp:2:", result.stderr)

    def test_build_folders_are_not_the_project(self):
        result = run("check_text.py", {"a.cpp": "int a;\n", "build-asan/b.cpp": "// TO" "DO\n"})
        self.assertEqual(result.returncode, 0, result.stderr)

    def test_long_file_is_noticed(self):
        result = run("check_text.py", {"a.cpp": "int a;\n" * 401})
        self.assertIn("notice: a.cpp has 401 lines", result.stdout)


if __name__ == "__main__":
    unittest.main()
