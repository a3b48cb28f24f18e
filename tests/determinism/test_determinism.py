#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""determinism.py must be able to fail: against programs that are not the same every time. usage: test_determinism.py TOOL"""

import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

TOOL = sys.argv.pop(1)
PROGRAM = """#!{python}
import json, locale, os, sys, time
arguments = sys.argv[1:]
if "--out" in arguments:
    open(arguments[arguments.index("--out") + 1], "w").write({picture})
else:
    print(json.dumps({result}))
"""


def examine(picture: str = "'same'", result: str = "{'a': 1}", only: str = "evsm,plan", runs: int = 4,
            locales: str = "C"):
    with tempfile.TemporaryDirectory() as folder:
        program = Path(folder, "program")
        program.write_text(PROGRAM.format(python=sys.executable, picture=picture, result=result), encoding="utf-8")
        program.chmod(0o755)
        return subprocess.run([sys.executable, "-B", TOOL, "--load", "0", "--runs", str(runs), "--only", only,
                               "--locales", locales, program],
                              capture_output=True, text=True, check=False)


class Determinism(unittest.TestCase):
    def test_what_is_equal_passes(self):
        done = examine()
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("evsm: 4 runs, all equal", done.stdout)
        self.assertIn("plan: 4 runs, all equal", done.stdout)

    def test_times_may_differ(self):
        self.assertEqual(examine(result="{'seconds': time.time(), 'time_ms': [time.time()], 'a': {'plan_ms': time.time()}}").returncode, 0)

    def test_another_file_fails(self):
        done = examine(picture="str(time.time())")
        self.assertEqual(done.returncode, 1)
        self.assertIn("evsm: 4 results of 4 runs", done.stdout)

    def test_another_number_fails(self):
        self.assertEqual(examine(result="{'error': {'rmse': time.time()}}").returncode, 1)

    def test_the_number_of_cores_counts(self):
        if len(os.sched_getaffinity(0)) < 2:
            self.skipTest("there is one core only")
        self.assertEqual(examine(picture="str(len(os.sched_getaffinity(0)))", runs=2).returncode, 1)

    def test_the_locale_counts(self):
        done = examine(picture="(locale.setlocale(locale.LC_ALL, ''), locale.str(0.5))[1]", runs=2, locales="C,de_DE.UTF-8")
        if "skipped: localedef" in done.stdout:
            self.skipTest("there is no localedef")
        self.assertEqual(done.returncode, 1)

    def test_a_command_that_fails_is_told(self):
        done = examine(picture="sys.exit('no driver')")
        self.assertEqual(done.returncode, 2)
        self.assertIn("no driver", done.stderr)


if __name__ == "__main__":
    unittest.main()
