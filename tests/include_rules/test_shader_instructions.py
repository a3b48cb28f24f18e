#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""tools/shader_instructions.py counts what functions do, and says what grew.

usage: test_shader_instructions.py SCRIPT
"""

import importlib.util
import json
import struct
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SCRIPT = Path(sys.argv.pop(1)).resolve()
SPEC = importlib.util.spec_from_file_location("shader_instructions", SCRIPT)
TOOL = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(TOOL)


def module(*body: int) -> bytes:
    """One function of instructions of one word each, by opcode, after a capability and a type."""
    opcodes = [17, 19, 54, 248, *body, 56]
    return struct.pack(f"<{5 + len(opcodes)}I", TOOL.MAGIC, 0x10600, 0, 100, 0, *((1 << 16) | op for op in opcodes))


ADD, SAMPLE, SELECT, LOOP, RETURN = 129, 88, 250, 246, 253


class Instructions(unittest.TestCase):
    def test_are_those_within_functions(self):
        counts = TOOL.count(module(59, ADD, SAMPLE, LOOP, SELECT, 248, ADD, RETURN))
        self.assertEqual(counts, {"instructions": 6, "image_reads": 1, "branches": 1, "loops": 1})

    def test_of_what_is_no_module_are_an_error(self):
        whole = module(ADD, RETURN)
        for broken in (b"", whole[:-1], whole[:16], b"\0" * 40, whole + b"\0\0\0\0", whole + struct.pack("<I", 9 << 16)):
            with self.assertRaises(TOOL.NoModule):
                TOOL.count(broken)

    def test_that_grew_are_named_and_fail(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            (folder / "a.comp.spv").write_bytes(module(ADD, ADD, RETURN))
            (folder / "b.comp.spv").write_bytes(module(ADD, RETURN))

            def run(*options):
                return subprocess.run([sys.executable, "-B", SCRIPT, *options, folder], capture_output=True, text=True)

            first = run("--json", folder / "before.json")
            self.assertEqual(first.returncode, 0, first.stderr)
            self.assertIn("| `a.comp` | 3 | 0 | 0 | 0 |", first.stdout)
            self.assertEqual(run("--against", folder / "before.json").returncode, 0)
            before = json.loads((folder / "before.json").read_text())
            before["a.comp"]["instructions"] -= 1
            (folder / "before.json").write_text(json.dumps(before))
            grown = run("--against", folder / "before.json")
            self.assertEqual(grown.returncode, 1)
            self.assertEqual(grown.stdout, "a.comp has grown from 2 to 3 instructions, times 1.500\n")
            self.assertEqual(run("--only", "c.").returncode, 1)


if __name__ == "__main__":
    unittest.main()
