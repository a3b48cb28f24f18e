#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The check of the documents must be able to fail: one fault at a time. usage: test_check_docs.py CHECKER"""

import stat
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

CHECKER = sys.argv.pop(1)

TREE = {
    "README.md": "See [the options](docs/cli.md#options).\n```cpp\nint a = 1;\n\nint b = a;\n```\n",
    "tests/docs/readme_snippet.cpp": "int main()\n{\n    // README begin\n    int a = 1;\n\n    int b = a;\n"
                                   "    // README end\n}\n",
    "docs/c.md": "```c\nint c;\n```\n",
    "examples/c_host/c_host.c": "// docs/c.md begin\nint c;\n// docs/c.md end\n",
    "docs/webgpu.md": "```js\nlet d;\n```\n",
    "tests/web/example.mjs": "// docs/webgpu.md begin\nlet d;\n// docs/webgpu.md end\n",
    "docs/cli.md": "`gnomon render rts --map-size 512 -o a.png`\n\n<!-- options begin -->\n"
                   "| option | default | what it is | for |\n|---|---|---|---|\n"
                   "| `--map-size` | `2048` | side (texels; 16 to 16384) | render, plan |\n"
                   "| `--set pcf.kernel=` | `3x3` | kernel (one of 2x2 3x3; with filter pcf) | render |\n"
                   "<!-- options end -->\n",
    "docs/drivers.md": "| Name | Driver |\n|---|---|\n| `mip` | one |\n",
    "core/a.cpp": "// A texel [drivers: mip].\n",
    "docs/techniques/vsm.md": "# vsm\n\n## Source\nSteps: W. Donnelly, A. Lauritzen, \"Variance\", 2006. A. Marinescu, 2011.\n",
    "docs/techniques/auto.md": "# auto\n\n## Source\nD. B. Lloyd, 2006.\n",
}
# Stands for the program: prints what `gnomon list --json` would.
PROGRAM = """#!/bin/sh
cat <<'END'
{"settings": [
  {"key": "map-size", "default": 2048, "doc": "side", "unit": "texels", "min": 16.0, "max": 16384.0,
   "subcommands": ["render", "plan"]},
  {"key": "pcf.kernel", "default": "3x3", "doc": "kernel", "values": ["2x2", "3x3"], "used_with": "filter pcf",
   "option": false, "subcommands": ["render"]}],
 "choices": [{"choice": "filter", "values": [{"name": "vsm", "source": "W. Donnelly, A. Lauritzen, Variance, 2006",
   "page": "docs/techniques/vsm.md"}, {"name": "hard", "source": "L. Williams, 1978", "page": "docs/conventions.md"},
   {"name": "auto", "source": "S. Xie, 2007", "page": "docs/techniques/auto.md"}]}]}
END
"""
FAULTS = [
    ("README.md", "docs/cli.md#options", "docs/none.md", "docs/none.md does not exist"),
    ("README.md", "int a = 1;", "int a = 2;", "README.md: no block is what"),
    ("docs/c.md", "int c;", "int d;", "docs/c.md: no block is what"),
    ("tests/docs/readme_snippet.cpp", "README end", "the end", "no lines between"),
    ("docs/cli.md", "| `2048` |", "| `1024` |", "the program's options differ"),
    ("docs/cli.md", "| `--map-size` | `2048` | side (texels; 16 to 16384) | render, plan |\n", "",
     "the program's options differ"),
    ("docs/cli.md", "<!-- options begin -->\n", "", "no table"),
    ("docs/cli.md", "--map-size 512", "--map-width 512", "no option map-width"),
    ("docs/cli.md", "--map-size 512", "--set map-widht=512", "no option map-widht"),
    ("core/a.cpp", "drivers: mip", "drivers: mop", "docs/drivers.md has no line mop"),
    ("core/a.cpp", " [drivers: mip]", "", "no source names mip"),
    ("docs/techniques/vsm.md", "W. Donnelly, A. Lauritzen, \"Variance\", 2006. ", "", "its first source is Marinescu"),
    ("docs/techniques/vsm.md", "## Source", "## From", "its first source is none"),
]


def run(tree: dict[str, str]) -> subprocess.CompletedProcess:
    with tempfile.TemporaryDirectory() as root:
        for name, text in tree.items():
            file = Path(root, name)
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(text, encoding="utf-8")
        program = Path(root, "gnomon")
        program.write_text(PROGRAM, encoding="utf-8")
        program.chmod(program.stat().st_mode | stat.S_IXUSR)
        return subprocess.run([sys.executable, CHECKER, root, str(program)], capture_output=True, text=True, check=False)


class Docs(unittest.TestCase):
    def test_true_documents_pass(self):
        result = run(TREE)
        self.assertEqual(result.returncode, 0, result.stderr)

    def test_every_fault_is_named(self):
        for file, old, new, expected in FAULTS:
            with self.subTest(expected):
                self.assertIn(old, TREE[file])
                result = run({**TREE, file: TREE[file].replace(old, new)})
                self.assertEqual(result.returncode, 1)
                self.assertIn(expected, result.stderr)


if __name__ == "__main__":
    unittest.main()
