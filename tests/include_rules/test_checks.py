#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The other checks of tools/ must be able to fail: plants one fault at a time. usage: test_checks.py TOOLS_FOLDER"""

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
