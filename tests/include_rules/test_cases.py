#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""tools/cases.py counts what ran, chooses what runs, and finds what was left out.

usage: test_cases.py SCRIPT
"""

import importlib.util
import json
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

SCRIPT = Path(sys.argv.pop(1)).resolve()
sys.path.insert(0, str(SCRIPT.parent))
SPEC = importlib.util.spec_from_file_location("cases", SCRIPT)
TOOL = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(TOOL)

LISTS = "#!/bin/sh\necho 'Suite.'\necho '  a'\necho '  b  # GetParam() = 1'\n"
A = {"name": "a", "status": "RUN", "result": "COMPLETED", "processor_s": "0.5", "file": "/x/tests/y/tests/one/a_test.cpp"}
B = {"name": "b", "status": "RUN", "result": "SKIPPED", "processor_s": "0.1", "file": "tests/one/b_test.cpp"}
DREW = {"drew": "yes"}
CTEST = ('<testsuite><testcase name="one.1" status="run"/><testcase name="two.1" status="fail"/>'
         '<testcase name="docs" status="run"/></testsuite>')


def results(*cases: dict, suite: str = "Suite") -> str:
    return json.dumps({"testsuites": [{"name": suite, "testsuite": list(cases)}]})


class Cases(unittest.TestCase):
    def call(self, files: dict[str, str], *arguments: str, named=()) -> tuple[int, str, str]:
        """Status, standard output and error, where `named` stands in tests/stages.txt."""
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        for name, text in files.items():
            file = Path(folder.name, name)
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(text, encoding="utf-8")
            file.chmod(0o755)
        script = f"import cases, sys\ncases.patterns = lambda: {list(named)!r}\ncases.promises = lambda: []\n" \
                 "sys.exit(cases.main())"
        ran = subprocess.run([sys.executable, "-B", "-c", script, *arguments], cwd=folder.name, capture_output=True, text=True,
                             check=False, env={**os.environ, "PYTHONPATH": str(SCRIPT.parent)})
        return ran.returncode, ran.stdout, ran.stderr

    def prove(self, *cases: dict, sanitized=None, tests="", named=()) -> tuple[int, str, str]:
        files = {"build/test_one": LISTS, "build/CTestTestfile.cmake": 'add_test(docs "true")\n' + tests,
                 "ran/one.1.json": results(*cases), "ran/ctest.xml": CTEST}
        if sanitized is not None:
            files["asan/one.1.json"] = results(*sanitized)
        return self.call(files, "prove", "build", "ran", *(["asan"] if sanitized is not None else []), named=named)

    def test_counts_cases_and_what_crashed(self):
        status, out, _ = self.call({"r/one.1.json": results(A, B), "r/ctest.xml": CTEST}, "count", "r")
        self.assertEqual(status, 1)
        self.assertIn("2 passed, 1 failed, 1 skipped", out)
        self.assertIn("failed: two.1", out)
        self.assertIn("0.5 s  one Suite.a", out)

    def test_everything_run_is_proven(self):
        self.assertEqual(self.prove(A, B)[0], 0)
        self.assertEqual(self.prove(A, {**B, **DREW}, sanitized=[A])[0], 0)

    def test_what_was_not_run_is_named(self):
        status, _, err = self.prove(A)
        self.assertEqual((status, err), (1, "one Suite.b was not run, nor is it long\n"))
        self.assertEqual(self.prove(A, named=[("long", "one *.b")])[0], 0)
        self.assertIn("Suite.b was not run", self.prove(A, {**B, "status": "NOTRUN"})[2])

    def test_what_sanitizers_lack_is_named(self):
        self.assertIn("Suite.b was not run under sanitizers", self.prove(A, B, sanitized=[A])[2])
        self.assertEqual(self.prove(A, B, sanitized=[A], named=[("release only", "one *.b")])[0], 0)
        drawn = self.prove(A, {**B, **DREW}, sanitized=[A], named=[("drawn under sanitizers", "one *.b")])
        self.assertIn("Suite.b was not run under sanitizers", drawn[2])

    def test_pattern_of_nothing_is_named(self):
        self.assertIn("one Suite.c: tests/stages.txt names what is not there", self.prove(A, B, named=[("long", "one Suite.c")])[2])

    def test_a_test_of_ctest_that_nobody_runs_is_named(self):
        self.assertIn("more was not run, and has no label", self.prove(A, B, tests='add_test(more "true")\n')[2])
        label = 'add_test(more "true")\nset_tests_properties(more PROPERTIES LABELS "%s")\n'
        self.assertEqual(self.prove(A, B, tests=label % "long")[0], 0)
        self.assertIn("the label other, which tools/ci_turn.py has not", self.prove(A, B, tests=label % "other")[2])

    def choose(self, *cases: dict, named=()) -> list[str]:
        with tempfile.TemporaryDirectory() as folder, mock.patch.object(TOOL, "patterns", lambda: list(named)), \
                mock.patch("builtins.print") as prints:
            Path(folder, "one.1.json").write_text(results(*cases), encoding="utf-8")
            TOOL.choose(mock.Mock(ran_in=Path(folder)))
        return [" ".join(call.args) for call in prints.call_args_list]

    def test_leaves_out_what_drew_and_its_sources(self):
        self.assertEqual(self.choose(A, B), [])
        self.assertEqual(self.choose(A, {**B, **DREW}), ["without one Suite.b", "unused tests/one/b_test.cpp"])
        self.assertEqual(self.choose({**A, **DREW}, {**B, **DREW})[0], "without one Suite.*")

    def test_keeps_what_is_named(self):
        self.assertEqual(self.choose({**A, **DREW}, {**B, **DREW}, named=[("drawn under sanitizers", "one *.a")]),
                         ["without one Suite.b", "unused tests/one/b_test.cpp"])

    def test_leaves_out_what_is_long(self):
        self.assertEqual(self.choose(A, B, named=[("long", "one Suite.a")]),
                         ["long one Suite.a", "without one Suite.a:Suite.a", "unused tests/one/a_test.cpp"])


if __name__ == "__main__":
    unittest.main()
