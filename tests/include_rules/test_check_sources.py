#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A source that compiles only beside others is found, and no other one is compiled. usage: test_check_sources.py TOOLS_FOLDER"""

import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

TOOLS = Path(sys.argv.pop(1))
THING = "#pragma once\nstruct Thing {\n    int a;\n};\nint makeThing();\n"
GOOD = '#include "thing.h"\nint one(Thing thing) { return thing.a; }\n'


class Sources(unittest.TestCase):
    @staticmethod
    def check(files: dict[str, str], *more: str) -> subprocess.CompletedProcess:
        with tempfile.TemporaryDirectory() as folder:
            root = Path(folder).resolve()
            (root / "build").mkdir()
            for name, text in files.items():
                (root / name).write_text(text, encoding="utf-8")
            entries = [{"directory": str(root), "file": str(root / name), "command": f"g++ -I{root} -std=c++20 -o {name}.o -c {root / name}"}
                       for name in files if name.endswith(".cpp")]
            (root / "build/compile_commands.json").write_text(json.dumps(entries), encoding="utf-8")
            return subprocess.run([sys.executable, "-B", TOOLS / "check_sources.py", "--build", root / "build", *more, root],
                                  capture_output=True, text=True, check=False)

    def finds(self, text: str, *more: str):
        done = self.check({"thing.h": THING, "good.cpp": GOOD, "bad.cpp": text}, *more)
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertIn("bad.cpp does not compile alone", done.stderr)
        self.assertNotIn("good.cpp does not", done.stderr)

    def test_type_of_anothers_header_is_found(self):
        self.finds("int other(Thing thing);\n")

    def test_function_of_anothers_header_is_found(self):
        self.finds("int other() { return makeThing(); }\n")

    def test_compiler_decides(self):
        for text in ("struct Thing;\nint other(Thing* thing);\n", "int other(int makeThing) { return makeThing; }\n"):
            with self.subTest(text):
                done = self.check({"thing.h": THING, "good.cpp": GOOD, "other.cpp": text})
                self.assertEqual(done.returncode, 0, done.stderr)

    def test_what_includes_all_is_not_compiled(self):
        done = self.check({"thing.h": THING, "between.h": '#pragma once\n#include "thing.h"\n', "good.cpp": GOOD,
                           "other.cpp": '#include "between.h"\nint other() { return makeThing(); } // Things\n'})
        self.assertIn("sources: 0 of 2 compiled alone", done.stdout)

    def test_all_finds_what_no_header_of_ours_declares(self):
        text = "std::size_t other();\n"
        self.assertEqual(self.check({"good.cpp": "#include <cstddef>\n", "bad.cpp": text}).returncode, 0)
        self.finds(text, "--all")

    def test_no_source_fails(self):
        self.assertEqual(self.check({"thing.h": THING}).returncode, 1)


class Since(unittest.TestCase):
    def test_what_has_changed_is_compiled(self):
        with tempfile.TemporaryDirectory() as folder:
            root = Path(folder).resolve()
            (root / "build").mkdir()
            git = ["git", "-C", root, "-c", "user.name=a", "-c", "user.email=a@b"]
            entries = []
            for name in ("old.cpp", "new.cpp"):
                (root / name).write_text("int a;\n", encoding="utf-8")
                entries.append({"directory": str(root), "file": str(root / name), "command": f"g++ -std=c++20 -c {root / name}"})
            (root / "build/compile_commands.json").write_text(json.dumps(entries), encoding="utf-8")
            for command in (["init", "-q"], ["add", "."], ["commit", "-qm", "a"]):
                subprocess.run([*git, *command], check=True)
            (root / "new.cpp").write_text("std::size_t a;\n", encoding="utf-8")
            call = [sys.executable, "-B", TOOLS / "check_sources.py", "--build", root / "build", root, "--since"]
            done = subprocess.run([*call, "HEAD"], capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 1)
            self.assertIn("sources: 1 of 2 compiled alone", done.stdout)
            done = subprocess.run([*call, "volcano"], capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 1)
            self.assertIn("git does not know what has changed since volcano", done.stderr)


if __name__ == "__main__":
    unittest.main()
