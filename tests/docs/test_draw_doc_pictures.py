#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Drawing the documents' pictures must notice what is wrong, one fault at a time.

usage: test_draw_doc_pictures.py TOOL
"""

import shutil
import stat
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

TOOL = Path(sys.argv.pop(1))

PAGE = "docs/page.md"
KEPT = "docs/images/a.png"
TREE = {
    PAGE: "![a](images/a.png)\n```\nbuild/gnomon render rts --map-size 64 -o docs/images/a.png\n```\n"
          "`build/gnomon render rts -o out/other.png` is no picture of a document.\n",
    KEPT: "render rts --map-size 64\n",
}
# Stands for the program: a picture is the words that drew it.
PROGRAM = """#!/bin/sh
case "$*" in
    metrics*) echo "rmse 0.5";;
    *--bad*) echo "gnomon: no GPU found" >&2; echo "gnomon: --bad is unknown" >&2; exit 2;;
    compare*) for last; do :; done; mkdir "$last"; echo "$*" | sed 's/ --report .*//' > "$last/result.json";;
    *) for last; do :; done; echo "$*" | sed 's/ \\(-o\\|--draw\\) .*//' > "$last";;
esac
"""
# Stands for tools/plot.py: a plot is its result.
PLOT = """#!/bin/sh
cp "$1" "$2"
"""
FAULTS = [
    (KEPT, "64", "32", "a.png: differs: rmse 0.5"),
    (PAGE, "--map-size 64", "--bad", "a.png: gnomon: --bad is unknown"),
    (PAGE, "![a](images/a.png)", "", "a.png: drawn, but no document shows it"),
    (PAGE, "```\nbuild", "```\nbuild/gnomon render rts -o docs/images/a.png\nbuild", "another command draws a.png already"),
    (PAGE, "--map-size 64", "'--map-size 64", "No closing quotation"),
    (PAGE, "docs/images/a.png", "docs/images/b/a.png", "is not its end"),
    (PAGE, "-o docs/images/a.png", "-o out/a.png", "no document names a command"),
]


def run(tree: dict[str, str], *options: str) -> subprocess.CompletedProcess:
    with tempfile.TemporaryDirectory() as root:
        for name, text in tree.items():
            file = Path(root, name)
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(text, encoding="utf-8")
        tools = Path(root, "tools")
        tools.mkdir()
        for tool in (TOOL, TOOL.parent / "sources.py"):
            shutil.copy(tool, tools)
        program = Path(root, "gnomon")
        for script, text in ((program, PROGRAM), (tools / "plot.py", PLOT)):
            script.write_text(text, encoding="utf-8")
            script.chmod(script.stat().st_mode | stat.S_IXUSR)
        return subprocess.run([sys.executable, "-B", tools / TOOL.name, *options, program, Path(root, "out")],
                              capture_output=True, text=True, check=False)


class Pictures(unittest.TestCase):
    def test_true_pictures_pass(self):
        result = run(TREE, "--check")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("1 drawn, 0 faults", result.stdout)
        self.assertNotIn("notice", result.stdout)

    def test_plans_are_drawn_too(self):
        page = "![s](images/s.svg)\n`build/gnomon plan rts --fit tsm --draw docs/images/s.svg`\n"
        tree = {**TREE, "docs/plan.md": page, "docs/images/s.svg": "plan rts --fit tsm\n"}
        result = run(tree, "--check")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("2 drawn, 0 faults", result.stdout)
        result = run({**tree, "docs/images/s.svg": "plan rts --fit psm\n"}, "--check")
        self.assertNotEqual(result.returncode, 0)
        self.assertIn("s.svg: differs", result.stderr)

    def test_plots_are_those_of_reports(self):
        page = ("![p](images/p.svg)\n```\nbuild/gnomon compare rts --sweep fov=1:2:2 --report out/p\n"
                "build/gnomon compare rts --sweep fov=1:2:2 --report out/shown-nowhere\n```\n")
        tree = {**TREE, "docs/plot.md": page, "docs/images/p.svg": "compare rts --sweep fov=1:2:2\n"}
        result = run(tree, "--check")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("2 drawn, 0 faults", result.stdout)
        result = run({**tree, "docs/images/p.svg": "compare rts --sweep fov=1:3:2\n"}, "--check")
        self.assertIn("p.svg: differs", result.stderr)

    def test_without_check_nothing_is_compared(self):
        result = run({**TREE, KEPT: "another"})
        self.assertEqual(result.returncode, 0, result.stderr)

    def test_pictures_without_a_command_are_named(self):
        result = run({**TREE, "docs/images/c.png": ""}, "--check")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("c.png: no document names the command", result.stdout)

    def test_every_fault_is_named(self):
        for file, old, new, expected in FAULTS:
            with self.subTest(expected):
                self.assertIn(old, TREE[file])
                result = run({**TREE, file: TREE[file].replace(old, new)}, "--check")
                self.assertNotEqual(result.returncode, 0)
                self.assertIn(expected, result.stderr)


if __name__ == "__main__":
    unittest.main()
