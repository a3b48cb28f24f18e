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

    def test_what_is_precompiled_for_others_is_not_seen(self):
        top, use = "#pragma once\n#include <string>\n", "inline std::vector<int> a;\n"
        tree = {f"core/src/good{number}.h": top + "#include <vector>\n" + use for number in range(4)}
        tree |= {"core/src/without.h": top + use, "core/src/late.h": top + use + "#include <vector>\n",
                 "core/src/never.h": top + "#ifdef NEVER\n#include <vector>\n#endif\n" + use}
        result = run("check_headers.py", tree)
        self.assertEqual(result.returncode, 1)
        named = [line.split()[0] for line in result.stderr.splitlines() if "does not stand alone" in line]
        self.assertEqual(sorted(named), ["core/src/late.h", "core/src/never.h", "core/src/without.h"])

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


class UnityGroups(unittest.TestCase):
    @staticmethod
    def groups(*sources: str) -> list[str]:
        with tempfile.TemporaryDirectory() as root:
            files = []
            for number, text in enumerate(sources):
                files.append(Path(root, f"{number}.cpp"))
                files[-1].write_text(text, encoding="utf-8")
            result = subprocess.run([sys.executable, TOOLS / "unity_groups.py", "--target", "one", *files], capture_output=True, text=True,
                                    check=True)
        return [line.split()[1] for line in result.stdout.splitlines()]

    UNNAMED = "namespace {\n%s\n} // namespace\n"

    def test_sources_without_a_name_in_common_go_together(self):
        self.assertEqual(self.groups(self.UNNAMED % "int a();", self.UNNAMED % "int b();", "int c();"), ["part1"] * 3)

    def test_a_name_declared_twice_parts(self):
        for one, other in (("int a(int);", "double a = 1;"), ("struct A {", "using A = int;"),
                           ("std::vector<int> a{1};", "int a[3];")):
            with self.subTest(one=one):
                self.assertEqual(len(set(self.groups(self.UNNAMED % one, self.UNNAMED % other))), 2)

    def test_a_name_that_another_uses_parts(self):
        self.assertEqual(len(set(self.groups(self.UNNAMED % "struct Light {", "Light of();"))), 2)

    def test_what_both_bring_in_parts_only_where_it_differs(self):
        brings = "using a::%s;\n"
        self.assertEqual(len(set(self.groups(brings % "Thing", brings % "Thing"))), 1)
        self.assertEqual(len(set(self.groups(brings % "Thing", brings % "b::Thing"))), 2)
        self.assertEqual(len(set(self.groups(brings % "Thing", "Thing of();"))), 2)
        self.assertEqual(len(set(self.groups("Thing of();", brings % "Thing"))), 2)
        self.assertEqual(len(set(self.groups(brings % "Thing", self.UNNAMED % "struct Thing {"))), 2)

    def test_an_opened_namespace_is_alone(self):
        self.assertEqual(len(set(self.groups("using namespace a;", "int b();"))), 2)

    def test_a_macro_for_a_header_is_alone(self):
        self.assertEqual(len(set(self.groups('#define A\n#include "a.h"\n', '#include "a.h"\n'))), 2)
        self.assertEqual(len(set(self.groups('#include "a.h"\n#define A\n', '#include "b.h"\n'))), 1)


if __name__ == "__main__":
    unittest.main()
