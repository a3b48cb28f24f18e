#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""tools/ci_turn.py has each item by what touches it, and every fifth time.

usage: test_ci_turn.py SCRIPT
"""

import importlib.util
import json
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

SCRIPT = Path(sys.argv.pop(1)).resolve()
sys.path.insert(0, str(SCRIPT.parent))
SPEC = importlib.util.spec_from_file_location("ci_turn", SCRIPT)
TOOL = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(TOOL)


class Turns(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.file = Path(folder.name, "cache", "turns.json")
        patches = [mock.patch.object(TOOL, "state_file", lambda: self.file), mock.patch.object(TOOL, "changed_since", lambda _: []),
                   mock.patch.object(TOOL, "git", lambda *arguments: "40" if arguments[0] == "rev-list" else "a1")]
        for patch in patches:
            patch.start()
            self.addCleanup(patch.stop)

    def test_come_every_fifth_time(self):
        last = {name: 0 for name in TOOL.TURNS}
        for number in range(1, 26):
            kept = TOOL.state()
            passed = TOOL.due(kept, ["scene/src/mesh.cpp"] if number == 8 else [])
            TOOL.note(list(passed))
            for name in passed:
                self.assertLessEqual(number - last[name], TOOL.EVERY, name)
                last[name] = number
        self.assertTrue(all(25 - number < TOOL.EVERY for number in last.values()), last)

    def test_go_by_the_commits_without_a_file(self):
        found = [set(TOOL.due({"run": number, "commit": "", "last": {}}, [])) for number in range(TOOL.EVERY)]
        self.assertEqual(set().union(*found), TOOL.TURNS.keys())
        self.assertEqual(sum(len(some) for some in found), len(TOOL.TURNS))
        self.assertTrue(all(found))

    def test_come_again_where_a_run_has_failed(self):
        kept = {"run": 9, "commit": "", "last": dict.fromkeys(TOOL.TURNS, 10)}
        kept["last"]["fuzz"] = 3
        self.assertEqual(list(TOOL.due(kept, [])), ["fuzz"])

    def test_begin_anew_with_a_broken_file(self):
        self.file.parent.mkdir()
        for text in ("", "{", "[]", '{"run": "x", "commit": "", "last": {}}', '{"run": 1}'):
            self.file.write_text(text, encoding="utf-8")
            self.assertEqual(TOOL.state(), {"run": 40, "commit": "", "last": {}}, text)

    def test_come_by_what_is_touched(self):
        touched = {path: {name for name, item in TOOL.ITEMS.items() if TOOL.touched_by(path, item)}
                   for path in ("docs/view.md", "scene/src/mesh.cpp", "files/src/temporary.cpp", "core/include/gnomon/error.h",
                                "core/src/planner.cpp", "host/src/gpu.cpp", "shaders/include/gnomon/shared/bias.h")}
        self.assertEqual(touched["docs/view.md"], set())
        self.assertEqual(touched["host/src/gpu.cpp"], {"tidy"})
        for path in ("scene/src/mesh.cpp", "files/src/temporary.cpp", "core/include/gnomon/error.h"):
            self.assertIn("fuzz", touched[path], path)
        self.assertIn("package", touched["core/include/gnomon/error.h"])
        for path in ("core/src/planner.cpp", "shaders/include/gnomon/shared/bias.h"):
            self.assertEqual(touched[path] & {"fuzz", "package"}, set(), path)

    def test_of_files_are_about_those_that_changed_and_in_their_turn_about_all(self):
        changed = ["core/src/planner.cpp", "core/src/gone.cpp", "core/src/planner.h", "tests/core/a_test.cpp"]
        kept = {"run": 9, "commit": "", "last": dict.fromkeys(TOOL.TURNS, 9)}
        with mock.patch.object(TOOL, "state", lambda: kept), mock.patch.object(TOOL, "changed_since", lambda _: changed):
            self.assertEqual(TOOL.files_of("tidy"), ["core/src/planner.cpp"])
            self.assertIsNone(TOOL.files_of("fuzz"))
            self.file.parent.mkdir()
            TOOL.note(["tidy", "fuzz"])
            noted = json.loads(self.file.read_text(encoding="utf-8"))["last"]
            self.assertEqual((noted["tidy"], noted["fuzz"]), (9, 10))
            kept["last"]["tidy"] = 5
            self.assertIsNone(TOOL.files_of("tidy"))
            kept["last"]["tidy"] = 9
            changed[:] = ["core/src/gone.cpp"]
            self.assertEqual(TOOL.files_of("tidy"), [])
            self.assertEqual(TOOL.run("tidy"), 0)

    def test_say_what_they_lack(self):
        with mock.patch.dict(TOOL.ITEMS, {"roots": TOOL.Item("false", needs="no-such-program")}), \
                mock.patch("builtins.print") as prints:
            self.assertEqual(TOOL.run("roots"), 0)
        self.assertIn("0 passed, 0 failed, 1 skipped", prints.call_args.args[0])


if __name__ == "__main__":
    unittest.main()
